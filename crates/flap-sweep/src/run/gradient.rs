//! Derivatives of the measures of a row.

use flap_core::simulate::{Change, Interrupt, NoSlope, Point, PointRun, Row};
use flap_core::vehicle::standing;

use super::RunOptions;
use crate::plan::Plan;
use crate::plan::gradient::{Gradient, Per, is_least, moved, size};

/// The share that changes for the derivatives of the plan's own measures, which are computed from those and need not be as small.
const OWN_SHARE: f64 = 1e-5;

/// Adds the derivatives that `plan` asks for to the measures of the row of `point`, which has the plan's own, and at the end the
/// reasons why some are not known, as a sum of powers of two by their places in [`NoSlope::ALL`]; NaN if all are known.
/// False if it was interrupted.
pub(super) fn add(
    plan: &Plan,
    options: &RunOptions,
    point: &Point,
    row: &mut Row,
    interrupted: Interrupt<'_>,
) -> bool {
    let Some(gradient) = plan.gradient().filter(|_| !row.measures.is_empty()) else { return true };
    let changes = gradient.with_respect_to.iter().map(|&parameter| {
        let changed = |share| changed(plan, gradient.per, point, parameter, share);
        let back = if is_least(plan.parameters(), &point.values, parameter) { 0.0 } else { -Change::SHARE };
        Change { ahead: changed(Change::SHARE), behind: changed(back), size: Change::SHARE }
    });
    let changes: Vec<Change> = changes.collect();
    let run = PointRun::new(options.instructions, plan.solver(), &point.values).until(interrupted);
    let found =
        plan.simulator().gradients().and_then(|gradients| gradients.gradient(&run, &row.state, &changes));
    if interrupted() {
        return false;
    }
    let slopes = match found {
        Ok(found) => {
            row.rhs_evals += found.rhs_evals;
            found.slopes
        }
        Err(_) => vec![vec![Err(NoSlope::Lost); plan.simulator().columns().len()]; changes.len()],
    };
    let derivatives = derivatives(plan, gradient, point, &row.measures, &slopes);
    let mut reasons: Vec<NoSlope> = derivatives.iter().filter_map(|derivative| derivative.err()).collect();
    reasons.sort_unstable();
    reasons.dedup();
    row.measures.extend(derivatives.iter().map(|derivative| derivative.unwrap_or(f64::NAN)));
    let places = NoSlope::ALL.iter().enumerate().filter(|(_, reason)| reasons.contains(reason));
    let set: u32 = places.map(|(place, _)| 1 << place).sum();
    row.measures.push(if set == 0 { f64::NAN } else { f64::from(set) });
    true
}

/// The size of a parameter at a point, of which shares change it; `None` if none is known. Zero has no per cent.
fn size_at(plan: &Plan, per: Per, point: &Point, parameter: usize) -> Option<f64> {
    let value = standing(plan.parameters(), &point.values, parameter);
    let has_shares = per == Per::Unit || value != 0.0;
    size(plan.simulator(), &point.values, parameter).filter(|_| has_shares)
}

/// The values of a point with one parameter larger by a share of its size.
fn changed(plan: &Plan, per: Per, point: &Point, parameter: usize, share: f64) -> Vec<f64> {
    let size = size_at(plan, per, point, parameter);
    let shared = standing(plan.parameters(), &point.values, parameter);
    plan.changed(point.index, parameter, |own| moved(if own.is_nan() { shared } else { own }, size, share))
}

/// The derivatives in the order of their columns.
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

/// The derivatives of the plan's own measures by one parameter, from those of the model's.
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
            // Not known where a measure that it is computed from has no derivative.
            Err(trouble.unwrap_or(NoSlope::Kink))
        } else {
            Ok(slope)
        }
    });
    slopes.collect()
}
