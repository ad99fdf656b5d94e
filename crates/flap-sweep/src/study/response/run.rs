//! The runner of responses: a curve for each design of a plan.

use std::io;
use std::sync::atomic::AtomicBool;

use flap_core::num::Backend;
use flap_core::simulate::{Interrupt, Point, Row, Status, never};

use super::continuation;
use super::curve::{Curve, Step};
use super::follow::Follow;
use crate::plan::{Along, Plan, Verdict};
use crate::resonance::study::{self, Desk};
use crate::run::sink::Sink;
use crate::run::{Hand, Ledger, Progress, RunError, RunOptions, Summary, ordered};
use crate::table::layout::Layout;

/// Fewest and most curves per thread that are run ahead of the last one written: enough to keep lanes full, few enough for
/// memory.
const AHEAD: [usize; 2] = [16, 128];

/// The responses of the designs of a plan: of its selected points that its conditions do not exclude everywhere on their curves.
#[derive(Clone, Copy)]
pub struct Responses<'a> {
    plan: &'a Plan,
    along: &'a Along,
}

/// The outcome of a design.
enum Followed {
    /// It has a curve.
    Curve(Box<Curve>),
    /// It does not satisfy the conditions with these numbers, and has no curve.
    Excluded(Vec<usize>),
}

impl<'a> Responses<'a> {
    /// The responses of a plan that follows a parameter; `None` of any other.
    pub fn of(plan: &'a Plan) -> Option<Responses<'a>> {
        plan.followed().map(|along| Responses { plan, along })
    }

    /// Follows the designs after those that `before` counts, and writes the rows of their curves to `sink` in the order of
    /// the designs. `tell` is given every curve before its rows are written. The summary is of the rows of `before` too.
    ///
    /// Raising `stop` ends the run within a second: curves in hand have half of it and are dropped then. `progress`
    /// counts designs, and is called from this thread several times a second.
    ///
    /// # Errors
    /// [`RunError::Sink`] if rows cannot be written or `tell` fails, other kinds if a worker does. The rows written are those
    /// of the first designs, in this case too.
    pub fn run(
        self,
        options: &RunOptions,
        before: Summary,
        sink: &mut dyn Sink,
        stop: &AtomicBool,
        progress: &mut dyn FnMut(Progress),
        tell: &mut dyn FnMut(&Curve) -> io::Result<()>,
    ) -> Result<Summary, RunError> {
        let layout = Layout::of(self.plan);
        let mut ledger = Ledger::begin(self.plan, self.plan.selected(), before, sink)?;
        let designs = ledger.remaining();
        let mut write = |batch: &mut Vec<Followed>| -> io::Result<()> {
            for followed in batch.drain(..) {
                match followed {
                    Followed::Curve(curve) => {
                        tell(&curve)?;
                        ledger.unit(curve.design.index, curve.rows(&layout))?;
                    }
                    Followed::Excluded(unsatisfied) => ledger.exclude(&unsatisfied)?,
                }
            }
            ledger.flush()
        };
        let mut take = |batch: &mut Vec<Followed>| write(batch).map_err(RunError::Sink);
        let backend = options.instructions;
        let worker = |hand: &mut Hand<'_, Followed>| {
            let mut designs = Designs { responses: self, backend, hand };
            study::run_all(self.plan.simulator(), backend, self.plan.solver(), &mut designs);
        };
        let options = RunOptions { window: self.window(options), ..*options };
        let worked = ordered::run(designs, &options, stop, &worker, &mut take, progress);
        ledger.end(worked)
    }

    /// Most curves that are run ahead of the last one written.
    fn window(self, options: &RunOptions) -> usize {
        let [least, most] = AHEAD.map(|curves| curves * options.threads.get());
        (options.window / (2 * self.along.values.len())).clamp(least, most)
    }

    /// The response of one design, on scalars. Gives the same bits as [`Responses::run`].
    pub fn curve(self, design: Point) -> Curve {
        let backend = Backend::best();
        let mut follow = Follow::new(self.plan, self.along, design);
        study::run_one(self.plan.simulator(), backend, self.plan.solver(), &mut follow);
        self.complete(follow.finish(), backend, &never)
    }

    /// Adds the unstable orbits to a curve, if they are wanted, and the plan's own measures to all of its rows. Interrupted,
    /// it leaves orbits out.
    fn complete(self, mut curve: Curve, backend: Backend, interrupted: Interrupt<'_>) -> Curve {
        let Responses { plan, along } = self;
        if along.unstable {
            curve.unstable = continuation::unstable(plan, along, &curve, backend, interrupted);
        }
        let Curve { design, up, down, unstable } = &mut curve;
        for Step { value, row } in up.iter_mut().chain(down).chain(unstable) {
            plan.add_own_measures(&along.values_at(plan, design, *value), &mut row.measures);
        }
        curve
    }
}

/// Designs on their way from the queue to their curves.
struct Designs<'a, 'h, 'q> {
    responses: Responses<'a>,
    backend: Backend,
    hand: &'h mut Hand<'q, Followed>,
}

impl<'a> Desk for Designs<'a, '_, '_> {
    type Study = Follow<'a>;

    fn next(&mut self, idle: bool) -> Option<Follow<'a>> {
        let Responses { plan, along } = self.responses;
        loop {
            let position = self.hand.next(idle)?;
            let design = plan.selected_point(position);
            match along.judge(plan, &design) {
                Verdict::Runs => return Some(Follow::new(plan, along, design)),
                Verdict::Excluded(unsatisfied) => self.hand.done(position, Followed::Excluded(unsatisfied)),
                Verdict::Invalid(reason) => {
                    let curve = Curve::impossible(along, design, &reason);
                    self.hand.done(position, Followed::Curve(Box::new(curve)));
                }
            }
        }
    }

    fn done(&mut self, follow: Follow<'a>) {
        let curve = follow.finish();
        let measures = self.responses.plan.simulator().columns().len();
        let mut rows = curve.up.iter().chain(&curve.down).map(|step| &step.row);
        if let Some(row) = rows.find(|row| row.measures.len() != expected(row, measures)) {
            let (found, index) = (row.measures.len(), curve.design.index);
            self.hand.fail(format!("it returned {found} measures, not {measures}, for design {index}"));
            return;
        }
        let curve = self.responses.complete(curve, self.backend, &|| self.hand.is_cancelled());
        // Interrupted, it may lack orbits.
        if !self.hand.is_cancelled() {
            let position = self.responses.plan.selection().position(curve.design.index);
            self.hand.done(position, Followed::Curve(Box::new(curve)));
        }
    }

    fn interrupted(&self) -> bool {
        self.hand.is_cancelled()
    }
}

/// The number of measures of a row, where a periodic one has so many.
fn expected(row: &Row, measures: usize) -> usize {
    if row.status == Status::Periodic { measures } else { 0 }
}
