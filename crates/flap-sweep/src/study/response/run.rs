//! Computes one response for each design of a plan, on several threads.

use std::sync::Arc;

use flap_core::num::Backend;
use flap_core::simulate::{Interrupt, Point, PointRun, Row, Status, never};

use super::continuation;
use super::curve::{Curve, Step};
use super::follow::Follow;
use crate::plan::{Admission, Along, Plan};
use crate::resonance::sequence::{self, Sequence, SequenceSource};
use crate::run::{Outcome, RowWriter, Run, RunError, RunOptions, Worker};

/// Lower and upper limit of the window per thread. The window is the largest number of responses that may be
/// computed while an earlier response is not finished.
///
/// With a window below the lower limit, some lanes would be empty. With a window above the upper limit, the
/// memory could be too small.
const AHEAD: [usize; 2] = [16, 128];

/// The responses of the designs of a plan. The designs are the selected points of the plan. If conditions
/// exclude a design at every value of the response's parameter, the design has no response.
#[derive(Clone, Copy)]
pub struct Responses<'a> {
    pub(super) plan: &'a Plan,
    pub(super) along: &'a Along,
}

impl<'a> Responses<'a> {
    /// Returns the responses of a plan, or `None` if the plan requests no responses.
    pub fn of(plan: &'a Plan) -> Option<Responses<'a>> {
        plan.followed().map(|along| Responses { plan, along })
    }

    /// Computes the responses of the designs in order, beginning with the selected point at position `first`.
    pub fn curves(self, options: &RunOptions, first: u64) -> Run<Outcome<Curve>> {
        let window = self.window(options);
        let (plan, backend) = (Arc::new(self.plan.clone()), options.instructions);
        Run::new(first..self.plan.selected(), &RunOptions { window, ..*options }, move |worker| {
            let Some(responses) = Responses::of(&plan) else { return };
            let mut designs = Designs { responses, backend, worker };
            sequence::run_all(plan.simulator(), backend, plan.solver(), &mut designs);
        })
    }

    /// Returns the window: the largest number of responses that may be computed while an earlier response is
    /// not finished.
    fn window(self, options: &RunOptions) -> usize {
        let [least, most] = AHEAD.map(|curves| curves * options.threads.get());
        (options.window / (2 * self.along.values.len())).clamp(least, most)
    }

    /// Computes the response of one design with scalar arithmetic. All bits of the result are the same as
    /// with [`Responses::curves`].
    pub fn curve(self, design: Point) -> Curve {
        let backend = Backend::best();
        let run = PointRun::new(backend, self.plan.solver(), &[]);
        let follow = Follow::new(self.plan, self.along, design);
        let curve = follow.sequence().run_alone(self.plan.simulator(), &run);
        self.complete(curve, backend, &never)
    }

    /// Adds the unstable orbits to a response, if the plan requests unstable orbits. The function also adds
    /// to all rows the measures that the grid file defines.
    ///
    /// If the computation is interrupted, some unstable orbits are missing.
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
    /// Writes the rows of the next design's response. If the design is excluded, the function only counts the
    /// design.
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

/// Takes designs from the queue, and returns their responses to the queue.
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

/// Returns the number of measures that a row must have. Rows with a periodic motion have `measures` measures,
/// and rows without a periodic motion have no measures.
fn expected(row: &Row, measures: usize) -> usize {
    if row.status == Status::Periodic { measures } else { 0 }
}
