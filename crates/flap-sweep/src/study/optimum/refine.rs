//! Searches the optimum from one start by sequential quadratic programming. If derivatives are missing or do
//! not confirm the optimum, a pattern search continues.

use std::cell::RefCell;
use std::rc::Rc;

use nalgebra::{DMatrix, DVector};
use slsqp::{Func, StopTols, minimize};

use super::evaluate::{Evaluator, Trial};
use super::problem::Problem;
use super::sensitivity::{CONVERGED, active};

/// Clearance: the smallest distance between the optimum and a limit, as a fraction of the limit's size. With
/// this clearance, the optimum satisfies the limit in spite of rounding errors.
const CLEARANCE: f64 = 1e-6;

/// A point is also accepted if its clearance is smaller than [`CLEARANCE`] by at most this value. This value,
/// a fraction of the limit's size, is about as large as the numerical errors of rows.
const CLEARANCE_ERROR: f64 = 5e-7;

/// The search from one start ends when the relative change of the goal in a step is smaller than this value.
const SMALL_CHANGE: f64 = 1e-6;

/// The search from one start ends when every coordinate changes by less than this value in a step.
const SMALL_STEP: f64 = 1e-5;

/// Largest number of points in one run of sequential quadratic programming.
const MOST_TRIALS: usize = 60;

/// Largest number of runs of sequential quadratic programming. Each run begins at the best point of the
/// previous run.
const MOST_RUNS: usize = 4;

/// The first step length and the smallest step length of the pattern search, in units of the coordinates.
const PATTERN: [f64; 2] = [0.02, 1e-4];

/// Largest number of points that the pattern search computes in each direction, on average.
const MOST_TESTS: u64 = 40;

/// If a point is closer to a limit than this fraction of the limit's size, the pattern search also tries
/// steps along the limit.
const NEAR: f64 = 0.02;

/// The values of a function and of all constraints at one point, with their derivatives. A constraint is
/// satisfied if its value is at most zero.
struct Local {
    value: f64,
    slopes: Vec<f64>,
    constraints: Vec<(f64, Vec<f64>)>,
}

/// The result of the search from one start.
pub(super) struct Refined {
    pub(super) best: Rc<Trial>,
    /// True if the search included a pattern search.
    pub(super) is_polished: bool,
}

/// Returns the best point that a search from `start` finds.
pub(super) fn refine(points: &Evaluator<'_>, start: &[f64]) -> Refined {
    let mut best = points.with_slopes(start);
    if start.is_empty() || best.excess.is_infinite() {
        return Refined { best, is_polished: false };
    }
    if best.excess > 0.0 {
        best = approach(points, &best);
    }
    let mut clearance = CLEARANCE;
    for _ in 0..MOST_RUNS {
        let (found, last) = descend(points, &best, clearance);
        let gain = change(points.problem, &best, &found);
        let is_beyond = last.excess > 0.0 && change(points.problem, &found, &last) > SMALL_CHANGE;
        best = found;
        if is_beyond {
            clearance *= 10.0;
        } else if gain <= SMALL_CHANGE {
            break;
        }
    }
    let is_confirmed = || {
        let best = points.with_slopes(&best.coordinates);
        best.excess > 0.0 || active(points.problem, &best, false).1 <= CONVERGED
    };
    let is_polished = points.has_differences.get() || !is_confirmed();
    if is_polished {
        best = pattern(points, best);
        if best.excess == 0.0 {
            best = descend(points, &points.with_slopes(&best.coordinates), CLEARANCE).0;
        }
    }
    Refined { best, is_polished }
}

/// Returns the relative gain of the goal from the point `before` to the point `after`. If `before` exceeds a
/// limit, the gain is infinite or zero. The gain is infinite if `after` exceeds the limits by less than
/// `before`.
fn change(problem: &Problem, before: &Trial, after: &Trial) -> f64 {
    if before.excess > 0.0 {
        return if after.excess < before.excess { f64::INFINITY } else { 0.0 };
    }
    let size = problem.size(before.goal).max(problem.size(after.goal));
    problem.aim.sign() * (before.goal - after.goal) / size
}

/// Runs sequential quadratic programming from `begin`, and returns the best computed point and the last
/// computed point.
fn descend(points: &Evaluator<'_>, begin: &Rc<Trial>, clearance: f64) -> (Rc<Trial>, Rc<Trial>) {
    let problem = points.problem;
    let factor = problem.aim.sign() / problem.size(begin.goal);
    let best = RefCell::new(Rc::clone(begin));
    let last = RefCell::new(Rc::clone(begin));
    let local = |at: &[f64], has_slopes: bool| {
        let trial = if has_slopes { points.with_slopes(at) } else { points.at(at) };
        if trial.is_better(problem, &best.borrow()) {
            *best.borrow_mut() = Rc::clone(&trial);
        }
        if trial.excess.is_infinite() {
            return None;
        }
        *last.borrow_mut() = Rc::clone(&trial);
        let slopes = |quantity: usize, factor: f64| -> Vec<f64> {
            trial
                .slopes
                .get(quantity)
                .map_or_else(Vec::new, |slopes| slopes.iter().map(|slope| factor * slope).collect())
        };
        let constraint = |number: usize| {
            let scale = problem.limits[number].scale(begin.sides[number]);
            let [less, more] = trial.sides[number];
            let over = clearance - (more - less) / scale;
            // slsqp ends only at points that satisfy all constraints.
            let over = if (0.0..=CLEARANCE_ERROR).contains(&over) { 0.0 } else { over };
            (over, slopes(1 + number, -1.0 / scale))
        };
        Some(Local {
            value: factor * trial.goal,
            slopes: slopes(0, factor),
            constraints: (0..problem.limits.len()).map(constraint).collect(),
        })
    };
    solve(&begin.coordinates, &vec![(0.0, 1.0); begin.coordinates.len()], problem.limits.len(), &local);
    (best.into_inner(), last.into_inner())
}

/// Starts at a point that exceeds some limits, and searches the point that exceeds the limits least. The
/// search relaxes all limits by one relative amount, and seeks the point that needs the smallest relaxation.
fn approach(points: &Evaluator<'_>, begin: &Rc<Trial>) -> Rc<Trial> {
    let problem = points.problem;
    let dimensions = begin.coordinates.len();
    let best = RefCell::new(Rc::clone(begin));
    let local = |at: &[f64], has_slopes: bool| {
        let (at, moved) = (&at[..dimensions], at[dimensions]);
        let trial = if has_slopes { points.with_slopes(at) } else { points.at(at) };
        if trial.is_better(problem, &best.borrow()) {
            *best.borrow_mut() = Rc::clone(&trial);
        }
        if trial.excess.is_infinite() {
            return None;
        }
        let constraint = |number: usize| {
            let scale = problem.limits[number].scale(begin.sides[number]);
            let [less, more] = trial.sides[number];
            let slopes = trial.slopes.get(1 + number);
            let slopes = slopes.into_iter().flatten().map(|slope| -slope / scale).chain([-1.0]);
            (CLEARANCE - (more - less) / scale - moved, slopes.collect())
        };
        let mut slopes = vec![0.0; dimensions];
        slopes.push(1.0);
        let constraints = (0..problem.limits.len()).map(constraint).collect();
        Some(Local { value: moved, slopes, constraints })
    };
    let mut from = begin.coordinates.clone();
    let excess = begin.excess;
    from.push(excess + CLEARANCE);
    let mut bounds = vec![(0.0, 1.0); dimensions];
    bounds.push((-CLEARANCE, 2.0 * excess + 1.0));
    solve(&from, &bounds, problem.limits.len(), &local);
    best.into_inner()
}

/// Minimises the function `local` within `bounds`. At points without a value, `local` returns `None`.
fn solve(begin: &[f64], bounds: &[(f64, f64)], limits: usize, local: &dyn Fn(&[f64], bool) -> Option<Local>) {
    let put = |slopes: Option<&mut [f64]>, found: &[f64]| {
        if let Some(slopes) = slopes.filter(|slopes| slopes.len() == found.len()) {
            slopes.copy_from_slice(found);
        }
    };
    let value = |at: &[f64], slopes: Option<&mut [f64]>, (): &mut ()| match local(at, slopes.is_some()) {
        Some(found) => {
            put(slopes, &found.slopes);
            found.value
        }
        // A value that is not finite shortens the step.
        None => f64::INFINITY,
    };
    let constraint = |number: usize| {
        move |at: &[f64], slopes: Option<&mut [f64]>, (): &mut ()| match local(at, slopes.is_some()) {
            Some(found) => {
                let (value, found) = &found.constraints[number];
                put(slopes, found);
                *value
            }
            None => f64::INFINITY,
        }
    };
    let constraints: Vec<_> = (0..limits).map(constraint).collect();
    let constraints: Vec<&dyn Func<()>> =
        constraints.iter().map(|constraint| constraint as &dyn Func<()>).collect();
    let tolerances =
        StopTols { ftol_rel: SMALL_CHANGE, xtol_abs: vec![SMALL_STEP; begin.len()], ..StopTols::default() };
    // slsqp calls each constraint as if it had the type of the function: both are `&dyn Func`.
    let value: &dyn Func<()> = &value;
    // Its verdict is not needed: the best point that was computed counts.
    let _ = minimize(value, begin, bounds, &constraints, (), MOST_TRIALS, Some(tolerances));
}

/// Runs a pattern search from `best` and returns the best point. The search tries steps along the coordinates
/// and along nearby limits.
fn pattern(points: &Evaluator<'_>, mut best: Rc<Trial>) -> Rc<Trial> {
    let problem = points.problem;
    let [mut step, smallest] = PATTERN;
    let before = points.rows.get();
    let most = MOST_TESTS * 4 * best.coordinates.len() as u64;
    let mut directions = directions(problem, &points.with_slopes(&best.coordinates));
    while step >= smallest && points.rows.get() - before < most {
        let tests = directions.iter().flat_map(|direction| [1.0, -1.0].map(|sign| (direction, sign * step)));
        let tests = tests.map(|(direction, step)| {
            let moved = best.coordinates.iter().zip(direction.iter());
            let moved: Vec<f64> = moved.map(|(at, along)| (at + step * along).clamp(0.0, 1.0)).collect();
            points.at(&moved)
        });
        let found = tests.fold(
            Rc::clone(&best),
            |best, trial| {
                if trial.is_better(problem, &best) { trial } else { best }
            },
        );
        if change(problem, &best, &found) > SMALL_CHANGE {
            best = found;
            directions = self::directions(problem, &points.with_slopes(&best.coordinates));
        } else {
            step *= 0.5;
        }
    }
    best
}

/// Returns the directions of the coordinate axes, and the projections of these directions onto the nearby
/// limits.
fn directions(problem: &Problem, at: &Trial) -> Vec<Vec<f64>> {
    let dimensions = at.coordinates.len();
    let axis = |number: usize| DVector::from_fn(dimensions, |row, _| if row == number { 1.0 } else { 0.0 });
    let mut found: Vec<DVector<f64>> = (0..dimensions).map(axis).collect();
    let near = (0..problem.limits.len()).filter(|&number| at.margin(problem, number) < NEAR);
    let across: Vec<DVector<f64>> = near
        .filter_map(|number| at.slopes.get(1 + number))
        .map(|slopes| DVector::from_column_slice(slopes))
        .filter(|slopes| slopes.norm() > 0.0 && slopes.norm().is_finite())
        .map(|slopes| slopes.normalize())
        .collect();
    if !across.is_empty() {
        let basis = DMatrix::from_columns(&across);
        if let Ok(inverse) = basis.clone().pseudo_inverse(1e-9) {
            let along = (0..dimensions).map(|number| axis(number) - &basis * (&inverse * axis(number)));
            let along: Vec<DVector<f64>> =
                along.filter(|along| along.norm() > 1e-3).map(|along| along.normalize()).collect();
            found.extend(along);
        }
    }
    found.into_iter().map(|direction| direction.iter().copied().collect()).collect()
}
