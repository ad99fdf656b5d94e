//! Responses: the motions of a design as one parameter, usually the drive frequency, rises and falls.
//!
//! Every point is begun where its neighbour's motion has ended, so that a branch of orbits is followed as far as it goes.
//! Where the way up and the way down differ, the design has two motions at the same drive.
//!
//! - `along`: the values that the parameter takes
//! - `follow`: one curve, up and down, with the ends of its bistable bands
//! - `continuation`: the unstable orbits that join the branches of a bistable band
//! - `verdict`: what a curve shows
//! - `table`: curves as rows of CSV

mod along;
mod continuation;
mod follow;
mod table;
mod verdict;

use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

pub use along::{Along, AlongError};
use flap_core::num::InstructionSet;
use flap_core::parameter::{Invalid, Parameter};
use flap_core::simulate::{Interrupt, Point, Row, Status, never};
pub use table::{Motions, Table};
pub use verdict::{Band, BandKind, Verdict};

use crate::plan::{self, Plan};
use crate::resonance::study::{self, Desk};
use crate::run::RunError;
use follow::Follow;

/// A motion on a curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// Value of the parameter that rises and falls.
    pub value: f64,
    /// The motion.
    pub row: Row,
}

/// The response of one design.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// The design.
    pub design: Point,
    /// The motions on the way up, by rising value.
    pub up: Vec<Step>,
    /// The motions on the way down, by rising value too: at the values of `up`.
    pub down: Vec<Step>,
    /// Unstable orbits, if they were looked for: for each bistable band, from the end of the upward branch to that of the
    /// downward one. Values fall and may turn.
    pub unstable: Vec<Step>,
}

impl Curve {
    /// The curve of a design that cannot be run.
    fn impossible(along: &Along, design: Point, reason: &Invalid) -> Curve {
        let step = |value: &f64| Step { value: *value, row: Row::invalid(reason.clone()) };
        let up: Vec<Step> = along.values.iter().map(step).collect();
        Curve { design, down: up.clone(), up, unstable: Vec::new() }
    }

    /// Why the design has no response, if its parameters are impossible together.
    pub fn invalid(&self) -> Option<&str> {
        let first = &self.up.first()?.row;
        if first.status == Status::Invalid { first.reason.as_deref() } else { None }
    }
}

/// Curves that are run before they are handed on, per thread: enough to keep lanes full, few enough for memory.
const CURVES_AT_ONCE: u64 = 128;

/// Follows the response of every point of `plan` that its conditions do not exclude everywhere on its curve, on `threads`
/// threads, and hands the curves on in the order of the points. When `stop` is raised, curves in hand are dropped and no more
/// are handed on.
///
/// # Errors
/// Those of `take`, at the first of which it ends, and those of starting threads.
pub fn run<E: From<RunError>>(
    plan: &Plan,
    along: &Along,
    threads: NonZeroUsize,
    stop: &AtomicBool,
    mut take: impl FnMut(Curve) -> Result<(), E>,
) -> Result<(), E> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.get()).build();
    let pool = pool.map_err(RunError::Threads)?;
    let at_once = CURVES_AT_ONCE * threads.get() as u64;
    let mut begin = 0;
    while begin < plan.len() {
        let end = plan.len().min(begin + at_once);
        let shared = Mutex::new(Shared { next: begin, end, curves: Vec::new() });
        pool.scope(|scope| {
            for _ in 0..threads.get() {
                scope.spawn(|_| {
                    let set = InstructionSet::best();
                    let mut designs = Designs { plan, along, stop, shared: &shared };
                    study::run_all(plan.simulator(), set, plan.solver(), &mut designs);
                });
            }
        });
        if stop.load(Ordering::Relaxed) {
            return Ok(());
        }
        let mut curves = shared.into_inner().unwrap_or_else(PoisonError::into_inner).curves;
        curves.sort_by_key(|curve| curve.design.index);
        curves.into_iter().try_for_each(&mut take)?;
        begin = end;
    }
    Ok(())
}

/// The response of one point, on scalars. Gives the same bits as [`run`].
pub fn run_one(plan: &Plan, along: &Along, design: Point) -> Curve {
    let mut follow = Follow::new(plan, along, design);
    study::run_one(plan.simulator(), InstructionSet::best(), plan.solver(), &mut follow);
    complete(plan, along, follow.finish(), &never)
}

/// Adds the unstable orbits to a curve, if they are wanted, and the plan's own measures to all of its rows. Interrupted, it
/// leaves orbits out.
fn complete(plan: &Plan, along: &Along, mut curve: Curve, interrupted: Interrupt<'_>) -> Curve {
    if along.unstable {
        curve.unstable = continuation::unstable(plan, along, &curve, interrupted);
    }
    let Curve { design, up, down, unstable } = &mut curve;
    for Step { value, row } in up.iter_mut().chain(down).chain(unstable) {
        plan.add_own_measures(&values(plan, along, design, *value), &mut row.measures);
    }
    curve
}

/// One value per parameter of the model, for a design where the followed parameter has come to `value`.
fn values(plan: &Plan, along: &Along, design: &Point, value: f64) -> Vec<f64> {
    let mut values = design.values.clone();
    values[along.parameter] = value;
    plan.derived().fill(&mut values, &[]);
    values
}

/// Whether a design is followed: if it runs anywhere on its curve.
fn judge(plan: &Plan, along: &Along, design: &Point) -> plan::Verdict {
    let mut verdicts = along.values.iter().map(|&value| plan.judge(&values(plan, along, design, value)));
    let first = verdicts.next().unwrap_or(plan::Verdict::Runs);
    if first == plan::Verdict::Runs || verdicts.any(|verdict| verdict == plan::Verdict::Runs) {
        plan::Verdict::Runs
    } else {
        first
    }
}

/// What the threads share.
struct Shared {
    next: u64,
    end: u64,
    curves: Vec<Curve>,
}

/// Designs on their way from the plan to their curves.
struct Designs<'a> {
    plan: &'a Plan,
    along: &'a Along,
    stop: &'a AtomicBool,
    shared: &'a Mutex<Shared>,
}

impl<'a> Desk for Designs<'a> {
    type Study = Follow<'a>;

    fn next(&mut self, _idle: bool) -> Option<Follow<'a>> {
        let Designs { plan, along, .. } = *self;
        loop {
            let index = {
                let mut shared = self.shared.lock().unwrap_or_else(PoisonError::into_inner);
                if shared.next == shared.end || self.interrupted() {
                    return None;
                }
                shared.next += 1;
                shared.next - 1
            };
            let design = plan.point(index);
            match judge(plan, along, &design) {
                plan::Verdict::Runs => return Some(Follow::new(plan, along, design)),
                plan::Verdict::Excluded(_) => {}
                plan::Verdict::Invalid(reason) => self.put(Curve::impossible(along, design, &reason)),
            }
        }
    }

    fn done(&mut self, follow: Follow<'a>) {
        let interrupted = || self.interrupted();
        self.put(complete(self.plan, self.along, follow.finish(), &interrupted));
    }

    fn interrupted(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }
}

impl Designs<'_> {
    fn put(&self, curve: Curve) {
        self.shared.lock().unwrap_or_else(PoisonError::into_inner).curves.push(curve);
    }
}

/// The parameter of `along`, in the table of the plan's model.
pub fn parameter(plan: &Plan, along: &Along) -> &'static Parameter {
    &plan.parameters()[along.parameter]
}
