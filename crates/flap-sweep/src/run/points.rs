//! Rows of a plan: one row for each point, with the measures and derivatives of the plan.

use std::ops::Range;
use std::sync::Arc;

use flap_core::simulate::{Interrupt, Jobs, Point, PointRun, Row, Status};
use serde::{Deserialize, Serialize};

use super::added_columns::add_columns;
use super::{Run, RunError, RunOptions, Worker};
use crate::plan::{Admission, Plan};

/// Result of running a point, or a design with a curve.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Outcome<T = Row> {
    /// A row of a point, or the rows of a curve.
    Ran(T),
    /// The point does not satisfy the conditions with these indices, so the point has no row.
    Excluded(Vec<usize>),
}

/// Returns the rows of the selected points of `plan` beginning at position `first`, in the order of the points.
///
/// To resume a run, begin after the finished points.
pub fn rows(plan: &Plan, options: &RunOptions, first: u64) -> Run<Outcome> {
    rows_of(plan, options, first..plan.selected())
}

/// Returns the rows of the points at the given positions among the selected points.
pub(super) fn rows_of(plan: &Plan, options: &RunOptions, positions: Range<u64>) -> Run<Outcome> {
    let few = (positions.end - positions.start).div_ceil(options.threads.get() as u64) <= FEW;
    let (plan, run_options) = (Arc::new(plan.clone()), *options);
    Run::new(positions, options, move |worker| {
        let mut points = Points { plan: &plan, options: &run_options, worker };
        if few && plan.resonance().is_none() {
            points.run_singly();
        } else {
            plan.rows().run(run_options.instructions, plan.solver(), &mut points);
        }
    })
}

/// Returns the rows of the selected points of `plan`, computed one after another on the calling thread, on scalars.
///
/// The rows equal the rows of [`rows`]. For a few points, computation without lanes is faster, because flap starts no
/// threads and no lanes stay empty. The iterator ends when the run is `interrupted`.
pub fn alone<'a>(
    plan: &'a Plan,
    options: &'a RunOptions,
    interrupted: Interrupt<'a>,
) -> impl Iterator<Item = Result<Outcome, RunError>> + 'a {
    (0..plan.selected()).map_while(move |position| {
        let point = match taken(plan, position) {
            Ok(point) => point,
            Err(outcome) => return Some(Ok(outcome)),
        };
        let run = PointRun::new(options.instructions, plan.solver(), &point.values);
        let row = plan.rows().run_point(&run.until(interrupted), point.begin.as_deref());
        if interrupted() {
            return None;
        }
        completed(plan, options, position, row, interrupted).map_err(RunError::Model).transpose()
    })
}

/// Returns the point at `position` among the selected points, or the outcome of the point if the point is not run.
fn taken(plan: &Plan, position: u64) -> Result<Point, Outcome> {
    let point = plan.selected_point(position);
    match plan.judge(&point.values) {
        // The model only returns the index, so it can be the position, by which rows are ordered.
        Admission::Runs => Ok(Point { index: position, ..point }),
        Admission::Excluded(unsatisfied) => Err(Outcome::Excluded(unsatisfied)),
        Admission::Invalid(invalid) => Err(Outcome::Ran(Row::invalid(invalid))),
    }
}

/// Returns the outcome of a point with the row of the model; `None` if the run was interrupted. The error is a mistake
/// of the model.
fn completed(
    plan: &Plan,
    options: &RunOptions,
    position: u64,
    mut row: Row,
    interrupted: Interrupt<'_>,
) -> Result<Option<Outcome>, String> {
    let expected = if row.status == Status::Periodic { plan.rows().columns().len() } else { 0 };
    if row.measures.len() != expected {
        let found = row.measures.len();
        return Err(format!("it returned {found} measures, not {expected}, for point {position}"));
    }
    let has_more = !plan.measures().is_empty() || plan.gradient().is_some();
    if has_more && position < plan.selected() {
        let point = plan.selected_point(position);
        if !add_columns(plan, options.instructions, &point, &mut row, interrupted) {
            return Ok(None);
        }
    }
    Ok(Some(Outcome::Ran(row)))
}

/// Largest number of points per thread for which scalars are faster than lanes, most of which would stay empty.
const FEW: u64 = 2;

/// The points of a plan as jobs of a model.
struct Points<'a, 'q> {
    plan: &'a Plan,
    options: &'a RunOptions,
    worker: &'a mut Worker<'q, Outcome>,
}

impl Points<'_, '_> {
    /// Runs points one after another on scalars.
    fn run_singly(&mut self) {
        while let Some(point) = self.next(true) {
            let cancelled = || self.worker.is_cancelled();
            let run = PointRun::new(self.options.instructions, self.plan.solver(), &point.values);
            let row = self.plan.rows().run_point(&run.until(&cancelled), point.begin.as_deref());
            if self.worker.is_cancelled() {
                break;
            }
            self.done(point.index, row);
        }
    }
}

impl Jobs for Points<'_, '_> {
    fn next(&mut self, idle: bool) -> Option<Point> {
        loop {
            let position = self.worker.next(idle)?;
            match taken(self.plan, position) {
                Ok(point) => return Some(point),
                Err(outcome) => self.worker.done(position, outcome),
            }
        }
    }

    fn done(&mut self, position: u64, row: Row) {
        let cancelled = || self.worker.is_cancelled();
        match completed(self.plan, self.options, position, row, &cancelled) {
            Ok(Some(outcome)) => self.worker.done(position, outcome),
            Ok(None) => {}
            Err(fault) => self.worker.fail(fault),
        }
    }

    fn interrupted(&self) -> bool {
        self.worker.is_cancelled()
    }
}
