//! Rows of a plan: one row for each point, with the measures and derivatives of the plan.

use std::ops::Range;
use std::sync::Arc;

use flap_core::num::Backend;
use flap_core::simulate::{Change, Interrupt, Jobs, NoSlope, Point, PointRun, Row, Status};
use flap_core::vehicle::standing;
use serde::{Deserialize, Serialize};

use super::{Run, RunError, RunOptions, Worker};
use crate::derivative::{Per, gap_code, is_least, moved, size};
use crate::plan::gradient::Gradient;
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

/// Relative change for derivatives of the measures of the plan, which need not be as small as for the model's
/// measures.
const OWN_SHARE: f64 = 1e-5;

/// Adds the measures and derivatives of the plan to `row`, which the model has computed for `point`.
///
/// The last added value contains the reasons for missing derivatives, see [`gap_code`]. Returns false if the run was
/// interrupted.
pub fn add_columns(
    plan: &Plan,
    instructions: Backend,
    point: &Point,
    row: &mut Row,
    interrupted: Interrupt<'_>,
) -> bool {
    plan.add_own_measures(&point.values, &mut row.measures);
    let Some(gradient) = plan.gradient().filter(|_| !row.measures.is_empty()) else { return true };
    let changes = gradient.with_respect_to.iter().map(|&parameter| {
        let changed = |share| changed(plan, gradient.per, point, parameter, share);
        let back = if is_least(plan.parameters(), &point.values, parameter) { 0.0 } else { -Change::SHARE };
        Change { ahead: changed(Change::SHARE), behind: changed(back), size: Change::SHARE }
    });
    let changes: Vec<Change> = changes.collect();
    let run = PointRun::new(instructions, plan.solver(), &point.values).until(interrupted);
    let found = if let Some(body) = plan.body() {
        body.gradient(&run, row, &changes)
    } else {
        let gradients = plan.simulator().gradients();
        gradients.and_then(|gradients| gradients.gradient(&run, &row.state, &changes))
    };
    if interrupted() {
        return false;
    }
    let slopes = match found {
        Ok(found) => {
            row.rhs_evals += found.rhs_evals;
            found.slopes
        }
        Err(_) => vec![vec![Err(NoSlope::Lost); plan.rows().columns().len()]; changes.len()],
    };
    let derivatives = derivatives(plan, gradient, point, &row.measures, &slopes);
    row.measures.extend(derivatives.iter().map(|derivative| derivative.unwrap_or(f64::NAN)));
    row.measures.push(gap_code(derivatives.iter().filter_map(|derivative| derivative.err())));
    true
}

/// Returns the size to which relative changes of a parameter refer; `None` if the size is unknown. A parameter with the
/// value zero has no relative change.
fn size_at(plan: &Plan, per: Per, point: &Point, parameter: usize) -> Option<f64> {
    let value = standing(plan.parameters(), &point.values, parameter);
    let has_shares = per == Per::Unit || value != 0.0;
    size(plan.simulator(), &point.values, parameter).filter(|_| has_shares)
}

/// Returns the values of a point with one parameter increased by a fraction of its size.
fn changed(plan: &Plan, per: Per, point: &Point, parameter: usize, share: f64) -> Vec<f64> {
    let size = size_at(plan, per, point, parameter);
    let shared = standing(plan.parameters(), &point.values, parameter);
    plan.changed(point.index, parameter, |own| moved(if own.is_nan() { shared } else { own }, size, share))
}

/// Returns the derivatives in the order of their columns.
fn derivatives(
    plan: &Plan,
    gradient: &Gradient,
    point: &Point,
    measures: &[f64],
    slopes: &[Vec<Result<f64, NoSlope>>],
) -> Vec<Result<f64, NoSlope>> {
    let own_slopes = gradient.with_respect_to.iter().zip(slopes);
    let own_slopes =
        own_slopes.map(|(&parameter, slopes)| own(plan, gradient.per, point, parameter, measures, slopes));
    let own_slopes: Vec<Vec<Result<f64, NoSlope>>> = own_slopes.collect();
    let by = |parameter: usize| gradient.with_respect_to.iter().position(|other| *other == parameter);
    let pairs = gradient.pairs().map(|(of, parameter)| {
        let by = by(parameter).unwrap_or_default();
        let slope = match of.checked_sub(slopes[by].len()) {
            None => slopes[by][of],
            Some(place) => own_slopes[by][place],
        };
        let size = size_at(plan, gradient.per, point, parameter).unwrap_or(f64::NAN);
        slope.map(|slope| match gradient.per {
            Per::Cent => 0.01 * slope * (standing(plan.parameters(), &point.values, parameter) / size),
            Per::Unit => slope / size,
        })
    });
    pairs.collect()
}

/// Returns the derivatives of the measures of the plan with respect to one parameter, from derivatives of the model's
/// measures.
fn own(
    plan: &Plan,
    per: Per,
    point: &Point,
    parameter: usize,
    measures: &[f64],
    slopes: &[Result<f64, NoSlope>],
) -> Vec<Result<f64, NoSlope>> {
    let count = slopes.len();
    let trouble = slopes.iter().filter_map(|slope| slope.err()).min();
    let moved = |share: f64| {
        let values = changed(plan, per, point, parameter, share);
        let slopes = slopes.iter().map(|slope| slope.unwrap_or(f64::NAN));
        let mut moved: Vec<f64> =
            measures.iter().zip(slopes).map(|(measure, slope)| slope.mul_add(share, *measure)).collect();
        plan.add_own_measures(&values, &mut moved);
        moved.split_off(count)
    };
    let back = if is_least(plan.parameters(), &point.values, parameter) { 0.0 } else { -OWN_SHARE };
    let [ahead, behind] = [OWN_SHARE, back].map(moved);
    let here = &measures[slopes.len()..];
    let slopes = here.iter().zip(ahead.iter().zip(&behind)).map(|(here, (ahead, behind))| {
        let slope = (ahead - behind) / (OWN_SHARE - back);
        if here.is_nan() {
            Err(NoSlope::Missing)
        } else if slope.is_nan() {
            // Missing if a measure that it depends on has no derivative.
            Err(trouble.unwrap_or(NoSlope::Kink))
        } else {
            Ok(slope)
        }
    });
    slopes.collect()
}
