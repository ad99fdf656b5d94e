//! Runner of responses: a curve for each design of a plan.

use std::sync::Arc;

use flap_core::num::Backend;
use flap_core::simulate::{Interrupt, Point, PointRun, Row, Status, never};

use super::continuation;
use super::curve::{Curve, Step};
use super::follow::Follow;
use crate::plan::{Admission, Along, Plan};
use crate::resonance::sequence::{self, Sequence, SequenceSource};
use crate::run::{Outcome, RowWriter, Run, RunError, RunOptions, Worker};

/// Smallest and largest number of curves per thread ahead of the last returned curve.
///
/// These numbers of curves, which are computed at the same time, keep the lanes full and fit into memory.
const AHEAD: [usize; 2] = [16, 128];

/// Responses of the designs of a plan: of its selected points, except points that are excluded at all values of the
/// parameter.
#[derive(Clone, Copy)]
pub struct Responses<'a> {
    pub(super) plan: &'a Plan,
    pub(super) along: &'a Along,
}

impl<'a> Responses<'a> {
    /// Returns the responses of a plan that follows a parameter; `None` for any other plan.
    pub fn of(plan: &'a Plan) -> Option<Responses<'a>> {
        plan.followed().map(|along| Responses { plan, along })
    }

    /// Returns the curves of the designs beginning at position `first` among the selected points, in order.
    pub fn curves(self, options: &RunOptions, first: u64) -> Run<Outcome<Curve>> {
        let window = self.window(options);
        let (plan, backend) = (Arc::new(self.plan.clone()), options.instructions);
        Run::new(first..self.plan.selected(), &RunOptions { window, ..*options }, move |worker| {
            let Some(responses) = Responses::of(&plan) else { return };
            let mut designs = Designs { responses, backend, worker };
            sequence::run_all(plan.simulator(), backend, plan.solver(), &mut designs);
        })
    }

    /// Returns the largest number of curves ahead of the last written curve.
    fn window(self, options: &RunOptions) -> usize {
        let [least, most] = AHEAD.map(|curves| curves * options.threads.get());
        (options.window / (2 * self.along.values.len())).clamp(least, most)
    }

    /// Returns the response of one design, computed on scalars with the same bits as [`Responses::curves`].
    pub fn curve(self, design: Point) -> Curve {
        let backend = Backend::best();
        let run = PointRun::new(backend, self.plan.solver(), &[]);
        let follow = Follow::new(self.plan, self.along, design);
        let curve = follow.sequence().run_alone(self.plan.simulator(), &run);
        self.complete(curve, backend, &never)
    }

    /// Adds the unstable orbits to a curve, if requested, and adds the measures of the plan to all rows of the curve.
    ///
    /// If the computation is interrupted, orbits are left out.
    fn complete(self, mut curve: Curve, backend: Backend, interrupted: Interrupt<'_>) -> Curve {
        let Responses { plan, along } = self;
        if along.unstable {
            curve.unstable = continuation::unstable(plan, along, &curve, backend, interrupted);
        }
        let Curve { design, up, down, unstable, .. } = &mut curve;
        for Step { value, row } in up.iter_mut().chain(down).chain(unstable) {
            plan.add_own_measures(&along.values_at(plan, design, *value), &mut row.measures);
        }
        curve
    }
}

impl RowWriter<'_> {
    /// Writes the rows of the next design's curve, or counts an excluded design.
    ///
    /// # Errors
    /// [`RunError::Sink`] if the rows cannot be written.
    pub fn write_curve(&mut self, outcome: &Outcome<Curve>) -> Result<(), RunError> {
        match outcome {
            Outcome::Ran(curve) => {
                let rows: Vec<_> = curve.rows(self.plan(), self.layout()).collect();
                self.write_rows(curve.design.index, rows)
            }
            Outcome::Excluded(unsatisfied) => self.exclude(unsatisfied),
        }
    }
}

/// Designs from the queue whose curves are being computed.
struct Designs<'a, 'w, 'q> {
    responses: Responses<'a>,
    backend: Backend,
    worker: &'w mut Worker<'q, Outcome<Curve>>,
}

impl<'a> SequenceSource<'a> for Designs<'a, '_, '_> {
    type Output = Curve;

    fn next(&mut self, idle: bool) -> Option<Sequence<'a, Curve>> {
        let Responses { plan, along } = self.responses;
        loop {
            let position = self.worker.next(idle)?;
            let design = plan.selected_point(position);
            match along.judge(plan, &design) {
                Admission::Runs => return Some(Follow::new(plan, along, design).sequence()),
                Admission::Excluded(unsatisfied) => {
                    self.worker.done(position, Outcome::Excluded(unsatisfied));
                }
                Admission::Invalid(reason) => {
                    let curve = Curve::impossible(along, design, &reason);
                    self.worker.done(position, Outcome::Ran(curve));
                }
            }
        }
    }

    fn done(&mut self, curve: Curve) {
        let measures = self.responses.plan.simulator().columns().len();
        let mut rows = curve.up.iter().chain(&curve.down).map(|step| &step.row);
        if let Some(row) = rows.find(|row| row.measures.len() != expected(row, measures)) {
            let (found, index) = (row.measures.len(), curve.design.index);
            self.worker.fail(format!("it returned {found} measures, not {measures}, for design {index}"));
            return;
        }
        let curve = self.responses.complete(curve, self.backend, &|| self.worker.is_cancelled());
        // After an interruption, the curve may lack orbits.
        if !self.worker.is_cancelled() {
            let position = self.responses.plan.selection().position(curve.design.index);
            self.worker.done(position, Outcome::Ran(curve));
        }
    }

    fn interrupted(&self) -> bool {
        self.worker.is_cancelled()
    }
}

/// Returns the expected number of measures of a row. A row of a periodic motion has `measures` measures.
fn expected(row: &Row, measures: usize) -> usize {
    if row.status == Status::Periodic { measures } else { 0 }
}
