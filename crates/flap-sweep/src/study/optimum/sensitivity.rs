//! Computes which conditions and ends of axes restrict an optimum, and the Lagrange multiplier of each
//! restriction.

use nalgebra::{DMatrix, DVector};

use super::answer::{Active, Edge};
use super::evaluate::Trial;
use super::problem::Problem;

/// A limit can restrict the optimum if the distance from the limit, divided by the limit's size, is below
/// this value.
const NEAR: f64 = 1e-4;

/// If a pattern search found the optimum, this value replaces [`NEAR`], because a pattern search is less
/// accurate than a search with derivatives.
const NEAR_PATTERN: f64 = 5e-3;

/// An end of an axis can restrict the optimum if the coordinate is closer to the end than this distance.
const AT_BOUND: f64 = 1e-6;

/// An optimum is confirmed if the derivatives predict at most this relative gain of the goal for a change by
/// the width of an axis.
pub(super) const CONVERGED: f64 = 0.02;

/// A condition or an end of an axis that can restrict the optimum.
#[derive(Clone, Copy)]
enum Restriction {
    Limit(usize),
    /// An end of an axis: the index of the continuous parameter, and a flag. The flag is true for the end
    /// with the largest value, and false for the end with the smallest value.
    Bound(usize, bool),
}

/// Returns the restrictions of an optimum with their Lagrange multipliers. The second result is the largest
/// relative gain of the goal if one parameter changes by the width of its axis. The gain is predicted from
/// the derivatives at the optimum.
pub(super) fn active(problem: &Problem, at: &Trial, is_polished: bool) -> (Vec<Active>, f64) {
    let Some(goal) = at.slopes.first() else { return (Vec::new(), f64::NAN) };
    let near = if is_polished { NEAR_PATTERN } else { NEAR };
    let limits = (0..problem.limits.len()).filter(|&number| at.margin(problem, number) < near);
    let bounds = at.coordinates.iter().enumerate().filter_map(|(number, coordinate)| {
        let is_low = *coordinate <= AT_BOUND;
        (is_low || *coordinate >= 1.0 - AT_BOUND).then_some(Restriction::Bound(number, !is_low))
    });
    let mut restrictions: Vec<Restriction> = limits.map(Restriction::Limit).chain(bounds).collect();
    // The gain per coordinate; each restriction has a multiplier that is the gain per unit of its distance.
    let gain = DVector::from_iterator(goal.len(), goal.iter().map(|slope| -problem.aim.sign() * slope));
    let inward = |restriction: &Restriction| match *restriction {
        Restriction::Limit(number) => DVector::from_column_slice(&at.slopes[1 + number]),
        Restriction::Bound(number, is_high) => {
            let side = if is_high { -1.0 } else { 1.0 };
            DVector::from_fn(goal.len(), |row, _| if row == number { side } else { 0.0 })
        }
    };
    let multipliers = loop {
        let columns: Vec<DVector<f64>> =
            restrictions.iter().map(|restriction| -inward(restriction)).collect();
        if columns.is_empty() {
            break DVector::zeros(0);
        }
        // Columns of one size: limits are in their own units.
        let sizes: Vec<f64> = columns.iter().map(|column| column.norm().max(f64::MIN_POSITIVE)).collect();
        let scaled: Vec<DVector<f64>> =
            columns.iter().zip(&sizes).map(|(column, size)| column / *size).collect();
        let matrix = DMatrix::from_columns(&scaled);
        let found = matrix.svd(true, true).solve(&gain, 1e-9);
        let Ok(found) = found else { break DVector::zeros(restrictions.len()) };
        let least = found.iter().enumerate().min_by(|one, other| one.1.total_cmp(other.1));
        match least {
            Some((place, &value)) if value < 0.0 => {
                restrictions.remove(place);
            }
            _ => break DVector::from_fn(found.len(), |row, _| found[row] / sizes[row]),
        }
    };
    let balanced: DVector<f64> = restrictions
        .iter()
        .zip(multipliers.iter())
        .fold(DVector::zeros(goal.len()), |sum, (restriction, multiplier)| {
            sum - inward(restriction) * *multiplier
        });
    let left_over = (&gain - balanced).amax() / problem.size(at.goal);
    let mut active: Vec<Active> = restrictions
        .iter()
        .zip(multipliers.iter())
        .map(|(restriction, &multiplier)| described(problem, at, *restriction, multiplier))
        .collect();
    active.retain(|active| active.per_unit != 0.0);
    (active, left_over)
}

/// Describes a restriction of the optimum. `multiplier` is the gain of the goal if the restriction is relaxed
/// by one unit.
fn described(problem: &Problem, at: &Trial, restriction: Restriction, multiplier: f64) -> Active {
    // The change of the number itself, not the gain.
    let change = -problem.aim.sign() * multiplier;
    let (edge, name, limit, per_unit) = match restriction {
        Restriction::Limit(number) => {
            let known = &problem.limits[number];
            let [less, more] = at.sides[number];
            let (limit, side) = if known.is_upper() { (more, 1.0) } else { (less, -1.0) };
            (Edge::Limit, known.text.clone(), limit, side * change)
        }
        Restriction::Bound(number, is_high) => {
            let variable = problem.region.variables[number];
            let per_value = change / variable.slope(at.coordinates[number]);
            let name = problem.plan.parameters()[variable.parameter].name.to_owned();
            let (edge, limit) =
                if is_high { (Edge::Largest, variable.to) } else { (Edge::Smallest, variable.from) };
            (edge, name, limit, if is_high { per_value } else { -per_value })
        }
    };
    let percent = per_unit * limit / at.goal.abs();
    Active { edge, name, limit, per_unit, percent }
}
