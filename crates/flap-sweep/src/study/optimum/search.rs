//! Searches an optimum: computes the rows of the grid, and then refines the best points in parallel.

use std::num::NonZeroUsize;
use std::sync::Arc;

use flap_core::parameter::{Kind, Parameter};
use flap_core::simulate::{NoSlope, Rows as _};

use super::answer::{LimitAt, LocalOptimum, Optimum, Status};
use super::evaluate::{Evaluator, Trial};
use super::problem::Problem;
use super::refine::refine;
use super::sensitivity::{CONVERGED, active};
use super::starts;
use crate::resonance::{DRIVE_FREQUENCY, RESONANCE_HZ};
use crate::run::{Run, RunError, RunOptions};

/// Tolerances with which two end points of searches count as one optimum. Each pair of tolerances contains
/// the largest relative difference of the goal and the largest difference of a coordinate between the two end
/// points.
///
/// Two end points count as one optimum if, for one of the pairs, the differences of goal and coordinates are
/// within both tolerances. For a smaller difference of the goal, a larger difference of the coordinates is
/// allowed.
const SAME_OPTIMUM: [[f64; 2]; 2] = [[1e-3, 0.02], [2e-4, 0.2]];

/// Settings of an optimisation.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    /// Options for the computation of rows, for example the number of threads and the instruction set.
    pub run: RunOptions,
    /// Largest number of searches. Each search starts from a different grid point.
    pub starts: NonZeroUsize,
    /// Largest number of grid points that are computed to choose the starts of the searches.
    pub points: u64,
}

impl Settings {
    /// Default of [`Settings::starts`].
    pub const STARTS: usize = 8;

    /// Default of [`Settings::points`].
    pub const POINTS: u64 = 4096;
}

impl Default for Settings {
    fn default() -> Self {
        let starts = NonZeroUsize::new(Settings::STARTS).unwrap_or(NonZeroUsize::MIN);
        Settings { run: RunOptions::default(), starts, points: Settings::POINTS }
    }
}

/// The end point of a search, with statistics of the search.
struct End {
    trial: Trial,
    missing: Vec<NoSlope>,
    is_polished: bool,
    rows: u64,
    sloped: u64,
}

/// Returns the best point of an optimisation problem. Returns `None` if no grid point has a periodic motion,
/// or if `stops` returned true.
///
/// `stops` is called several times a second on the thread of the caller. The arguments of `stops` are the
/// number of finished grid points and searches, and the number of all grid points and searches. If `stops`
/// returns true, the optimisation ends without a result. The result does not depend on the number of threads.
///
/// # Errors
/// [`RunError`] if a thread panics or cannot be started, or if the model returns wrong rows.
pub fn optimise(
    problem: &Problem,
    settings: &Settings,
    stops: &dyn Fn(u64, u64) -> bool,
) -> Result<Option<Optimum>, RunError> {
    let plan = starts::selected(problem.measured.clone(), settings.points);
    let (computed, most) = (plan.selected(), settings.starts.get());
    let all = computed + most as u64;
    let mut is_stopped = false;
    let found = starts::computed(problem, &plan, &settings.run, |run| {
        is_stopped |= stops(run.progress().finished, all);
        is_stopped
    })?;
    if is_stopped {
        return Ok(None);
    }
    let problem = &Arc::new(problem.sized_by(found.iter().map(|start| start.goal)));
    let start_point = |start: Trial| StartPoint { coordinates: start.coordinates, choice: start.choice };
    let starts = starts::best(problem, found, most).into_iter().map(start_point).collect();
    let Some(ends) = refined(problem, settings, starts, |done| stops(computed + done, all))? else {
        return Ok(None);
    };
    Ok(answer(problem, &ends, computed))
}

/// Returns the best point of an optimisation problem, like [`optimise`]. The searches start from `designs`.
/// The `designs` must be results of problems with the plan of `problem`.
///
/// # Errors
/// The errors of [`optimise`].
pub fn optimise_from(
    problem: &Problem,
    settings: &Settings,
    designs: &[&Optimum],
    stops: &dyn Fn(u64, u64) -> bool,
) -> Result<Option<Optimum>, RunError> {
    let problem = &Arc::new(problem.sized_by(designs.iter().map(|best| problem.value(best))));
    let start_point = |best: &&Optimum| StartPoint {
        coordinates: problem.region.coordinates(&best.values),
        choice: problem.region.choice(&best.values),
    };
    let starts: Vec<StartPoint> = designs.iter().map(start_point).collect();
    let all = starts.len() as u64;
    let ends = refined(problem, settings, starts, |done| stops(done, all))?;
    Ok(ends.and_then(|ends| answer(problem, &ends, 0)))
}

/// The point from which a search starts.
struct StartPoint {
    coordinates: Vec<f64>,
    choice: Vec<f64>,
}

/// Runs one search from each start, and returns the end points in the order of the starts. Returns `None` if
/// `stops` returned true.
fn refined(
    problem: &Arc<Problem>,
    settings: &Settings,
    starts: Vec<StartPoint>,
    stops: impl Fn(u64) -> bool,
) -> Result<Option<Vec<End>>, RunError> {
    let (problem, options) = (Arc::clone(problem), settings.run);
    let mut run = Run::new(0..starts.len() as u64, &settings.run, move |worker| {
        while let Some(position) = worker.next(true) {
            let start = &starts[usize::try_from(position).unwrap_or(usize::MAX)];
            let end = end_of(&problem, &options, start, &|| worker.is_cancelled());
            worker.done(position, end);
        }
    });
    let mut ends = Vec::new();
    while let Some(batch) = run.next_batch()? {
        for end in batch {
            ends.push(end?);
        }
        if stops(run.progress().finished) {
            return Ok(None);
        }
    }
    Ok(Some(ends))
}

/// Runs the search from one start and returns its end point.
fn end_of(
    problem: &Problem,
    options: &RunOptions,
    start: &StartPoint,
    interrupted: &dyn Fn() -> bool,
) -> Result<End, RunError> {
    let points = Evaluator::new(problem, options, start.choice.clone(), interrupted);
    let refined = refine(&points, &start.coordinates);
    let best = points.with_slopes(&refined.best.coordinates);
    match points.failure() {
        Some(failure) => Err(failure),
        None => Ok(End {
            missing: points.missing(),
            is_polished: refined.is_polished,
            rows: points.rows.get(),
            sloped: points.sloped.get(),
            trial: Trial::clone(&best),
        }),
    }
}

/// Returns the result of the optimisation, computed from the end points of all searches.
fn answer(problem: &Problem, ends: &[End], computed: u64) -> Option<Optimum> {
    let mut order: Vec<&End> = ends.iter().collect();
    order.sort_by(|one, other| one.trial.order(problem, &other.trial));
    let best = *order.first()?;
    let End { trial, missing, is_polished, .. } = best;
    let varied = problem.region.varied(&trial.coordinates, &trial.choice);
    let (active, left_over) = active(problem, trial, *is_polished);
    let is_confirmed = trial.coordinates.is_empty() || left_over <= CONVERGED && !trial.lacks_slopes;
    let status = match trial.excess > 0.0 {
        true => Status::Infeasible,
        false if is_confirmed => Status::Optimal,
        false => Status::Approximate,
    };
    let limits = problem.limits.iter().zip(&trial.sides).map(|(limit, &sides)| {
        let excess = if limit.holds(sides) { 0.0 } else { (sides[0] - sides[1]) / limit.scale(sides) };
        LimitAt { text: limit.text.clone(), sides, excess }
    });
    let mut row = trial.row.clone();
    row.measures.truncate(problem.goal_index());
    let mut values = problem.measured.clone().at(&varied).ok()?.point(0).values;
    set_resonance(problem, &row.measures, &mut values);
    Some(Optimum {
        status,
        goal: trial.goal,
        values,
        row,
        at_end: at_end(problem, &varied),
        varied,
        active: if status == Status::Infeasible { Vec::new() } else { active },
        limits: limits.collect(),
        optima: optima(problem, &order),
        starts: ends.len(),
        points: problem.plan.len(),
        computed,
        rows: computed + ends.iter().map(|end| end.rows).sum::<u64>(),
        sloped: ends.iter().map(|end| end.sloped).sum(),
        missing: missing.clone(),
        is_polished: *is_polished,
        left_over,
    })
}

/// If designs are run at their resonance, sets the drive frequency in `values` to the resonance in
/// `measures`.
fn set_resonance(problem: &Problem, measures: &[f64], values: &mut [f64]) {
    let Some(resonance) = problem.plan.resonance() else { return };
    let place = resonance.columns().iter().position(|column| column.name == RESONANCE_HZ);
    let found = place.and_then(|place| measures.get(place));
    let frequency = Parameter::index(problem.plan.parameters(), DRIVE_FREQUENCY);
    if let Some((index, found)) = frequency.zip(found) {
        values[index] = *found;
    }
}

/// Returns the varied parameters whose value is at an end of their axis, with both ends of the axis. Choices
/// are left out.
fn at_end(problem: &Problem, varied: &[(usize, f64)]) -> Vec<(usize, [f64; 2])> {
    let region = &problem.region;
    let continuous =
        region.variables.iter().map(|variable| (variable.parameter, [variable.from, variable.to]));
    let counts = problem.plan.axes().as_slice().iter().filter_map(|axis| match axis.parameters() {
        [(parameter, values)] if region.enumerated.contains(parameter) => {
            let is_number = !matches!(problem.plan.parameters()[*parameter].kind, Kind::Choice(_));
            let all = (0..values.len()).map(|place| values.get(place));
            let ends = all.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], value| {
                [least.min(value), most.max(value)]
            });
            (is_number && ends[0] < ends[1]).then_some((*parameter, ends))
        }
        _ => None,
    });
    let is_at_end = |(parameter, ends): &(usize, [f64; 2])| {
        let tolerance = 1e-6 * (ends[1] - ends[0]);
        let value = varied.iter().find(|(other, _)| other == parameter).map(|(_, value)| *value);
        value.is_some_and(|value| ends.iter().any(|end| (value - end).abs() <= tolerance))
    };
    continuous.chain(counts).filter(is_at_end).collect()
}

/// Returns the different end points of the searches, in the given order. End points that are almost equal
/// count as one optimum.
fn optima(problem: &Problem, order: &[&End]) -> Vec<LocalOptimum> {
    let mut found: Vec<(LocalOptimum, &Trial)> = Vec::new();
    for end in order {
        let same = found.iter_mut().find(|(other, trial)| {
            let size = problem.size(other.goal).max(problem.size(end.trial.goal));
            other.is_feasible == (end.trial.excess == 0.0)
                && trial.choice == end.trial.choice
                && SAME_OPTIMUM.iter().any(|[numbers, coordinates]| {
                    (other.goal - end.trial.goal).abs() <= numbers * size
                        && starts::distance(trial, &end.trial) <= *coordinates
                })
        });
        if let Some((other, _)) = same {
            other.starts += 1;
            continue;
        }
        let is_feasible = end.trial.excess == 0.0;
        let Trial { coordinates, choice, goal, .. } = &end.trial;
        let varied = problem.region.varied(coordinates, choice);
        found.push((LocalOptimum { goal: *goal, varied, is_feasible, starts: 1 }, &end.trial));
    }
    found.into_iter().map(|(other, _)| other).collect()
}
