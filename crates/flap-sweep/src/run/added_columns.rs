//! Computes the columns that a grid file adds to the columns of the model: measures under `[measure]`, and
//! derivatives.

use flap_core::num::Backend;
use flap_core::simulate::{Change, Interrupt, NoSlope, Point, PointRun, Row};
use flap_core::vehicle::standing;

use crate::derivative::{Per, gap_code, is_least, moved, size};
use crate::plan::Plan;
use crate::plan::gradient::Gradient;

/// To compute derivatives of the formulas under `[measure]`, flap changes a parameter by this fraction of its
/// reference size. The fraction is larger than [`Change::SHARE`], so that rounding errors have less effect.
const OWN_SHARE: f64 = 1e-5;

/// Adds the measures of the plan and the derivatives to `row`. The model has computed `row` for `point`.
///
/// If the plan has derivatives, the last added value is a number that encodes the reasons for missing
/// derivatives. Returns false if the run was interrupted.
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
        let values = |share| changed(plan, gradient.per, point, parameter, share);
        let back = if is_least(plan.parameters(), &point.values, parameter) { 0.0 } else { -Change::SHARE };
        Change { ahead: values(Change::SHARE), behind: values(back), size: Change::SHARE }
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

/// Returns the reference size of a parameter, or `None` if the size is unknown. The result is also `None` if
/// the parameter is zero and derivatives refer to a change of 1 %.
fn size_at(plan: &Plan, per: Per, point: &Point, parameter: usize) -> Option<f64> {
    let value = standing(plan.parameters(), &point.values, parameter);
    let has_shares = per == Per::Unit || value != 0.0;
    size(plan.simulator(), &point.values, parameter).filter(|_| has_shares)
}

/// Returns the parameter values of a point in which one parameter is increased by `share` times the reference
/// size of this parameter.
fn changed(plan: &Plan, per: Per, point: &Point, parameter: usize, share: f64) -> Vec<f64> {
    let size = size_at(plan, per, point, parameter);
    let shared = standing(plan.parameters(), &point.values, parameter);
    plan.values_with(point.index, parameter, |own| {
        moved(if own.is_nan() { shared } else { own }, size, share)
    })
}

/// Returns the values of the columns with derivatives, in the order of the columns.
fn derivatives(
    plan: &Plan,
    gradient: &Gradient,
    point: &Point,
    measures: &[f64],
    slopes: &[Vec<Result<f64, NoSlope>>],
) -> Vec<Result<f64, NoSlope>> {
    let own_slopes = gradient.with_respect_to.iter().zip(slopes);
    let own_slopes = own_slopes.map(|(&parameter, slopes)| {
        slopes_of_own_measures(plan, gradient.per, point, parameter, measures, slopes)
    });
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

/// Returns the derivatives of the measures under `[measure]` with respect to one parameter. `slopes` contains
/// the derivatives of the model's measures.
fn slopes_of_own_measures(
    plan: &Plan,
    per: Per,
    point: &Point,
    parameter: usize,
    measures: &[f64],
    slopes: &[Result<f64, NoSlope>],
) -> Vec<Result<f64, NoSlope>> {
    let count = slopes.len();
    let trouble = slopes.iter().filter_map(|slope| slope.err()).min();
    let own_measures_after = |share: f64| {
        let values = changed(plan, per, point, parameter, share);
        let slopes = slopes.iter().map(|slope| slope.unwrap_or(f64::NAN));
        let mut all: Vec<f64> =
            measures.iter().zip(slopes).map(|(measure, slope)| slope.mul_add(share, *measure)).collect();
        plan.add_own_measures(&values, &mut all);
        all.split_off(count)
    };
    let back = if is_least(plan.parameters(), &point.values, parameter) { 0.0 } else { -OWN_SHARE };
    let [ahead, behind] = [OWN_SHARE, back].map(own_measures_after);
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
