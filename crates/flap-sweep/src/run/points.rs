//! Computes the rows of a plan: one row for each point, with the measures and derivatives that the grid file
//! adds.

use std::ops::Range;
use std::sync::Arc;

use flap_core::simulate::{Interrupt, Jobs, Point, PointRun, Row, Status};
use serde::{Deserialize, Serialize};

use super::added_columns::add_columns;
use super::{Run, RunError, RunOptions, Worker};
use crate::plan::{Admission, Plan};

/// The result for a point, or for a design whose response curve is computed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Outcome<T = Row> {
    /// The row of a point, or the rows of a response curve.
    Ran(T),
    /// The point has no row, because the point does not satisfy the conditions with these indices.
    Excluded(Vec<usize>),
}

/// Returns the rows of the selected points of `plan`, in the order of the points. The rows begin with the
/// selected point at position `first`.
///
/// To resume a run, set `first` to the number of points that are already finished.
pub fn rows(plan: &Plan, options: &RunOptions, first: u64) -> Run<Outcome> {
    rows_of(plan, options, first..plan.selected())
}

/// Returns the rows of the points at the given `positions` in the list of selected points.
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

/// Computes the rows of the selected points of `plan` one after another on the thread of the caller, with
/// scalar arithmetic.
///
/// The rows have the same bytes as the rows of [`rows`]. For a few points this function is faster than
/// [`rows`], because no threads are started and no lanes are empty. The iterator ends when the function
/// `interrupted` returns true.
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

/// Returns the selected point at `position`. If a condition excludes the point or its parameter values are
/// impossible, `Err` contains the outcome of the point.
fn taken(plan: &Plan, position: u64) -> Result<Point, Outcome> {
    let point = plan.selected_point(position);
    match plan.judge(&point.values) {
        // The model only returns the index, so it can be the position, by which rows are ordered.
        Admission::Runs => Ok(Point { index: position, ..point }),
        Admission::Excluded(unsatisfied) => Err(Outcome::Excluded(unsatisfied)),
        Admission::Invalid(invalid) => Err(Outcome::Ran(Row::invalid(invalid))),
    }
}

/// Adds the columns of the plan to the row that the model computed for a point. Returns `None` if the run was
/// interrupted. `Err` describes a mistake in the program of the model.
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

/// Up to this number of points per thread, scalar arithmetic is faster than lanes, because most lanes would
/// be empty.
const FEW: u64 = 2;

/// Passes the points of a plan to the model, and receives the rows that the model computes.
struct Points<'a, 'q> {
    plan: &'a Plan,
    options: &'a RunOptions,
    worker: &'a mut Worker<'q, Outcome>,
}

impl Points<'_, '_> {
    /// Computes points one after another with scalar arithmetic.
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
