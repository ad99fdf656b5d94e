//! Computes points of the grid, and chooses the best of them as starts of the searches.

use super::evaluate::Trial;
use super::problem::Problem;
use crate::plan::Plan;
use crate::run::{Outcome, Run, RunError, RunOptions, rows};
use crate::study::survey::spread;

/// Two starts with equal values of the choices must differ by at least this distance in one coordinate.
const DISTINCT: f64 = 0.2;

/// Selects the points of the grid that are computed: all points, or about `most` points that are spread over
/// the grid.
pub(super) fn selected(plan: Plan, most: u64) -> Plan {
    let plan = plan.with_all_points();
    if plan.len() <= most {
        return plan;
    }
    let mut list: Vec<u64> = (0..most).map(|number| spread(number, plan.len())).collect();
    list.sort_unstable();
    list.dedup();
    // Indices below the length that rise.
    plan.clone().with_points(list).unwrap_or(plan)
}

/// Computes the selected points of a plan, and returns the points with a periodic motion. `stops` is called
/// several times a second. If `stops` returns true, the computation ends early and the list is incomplete.
///
/// # Errors
/// [`RunError`] if a thread panics or cannot be started, or if the model returns wrong rows.
pub(super) fn computed(
    problem: &Problem,
    plan: &Plan,
    options: &RunOptions,
    mut stops: impl FnMut(&Run<Outcome>) -> bool,
) -> Result<Vec<Trial>, RunError> {
    let mut run = rows(plan, options, 0);
    let mut starts = Vec::new();
    let mut position = 0;
    while let Some(batch) = run.next_batch()? {
        for outcome in batch {
            let point = plan.selected_point(position);
            position += 1;
            let Outcome::Ran(row) = outcome else { continue };
            let (coordinates, choice) =
                (problem.region.coordinates(&point.values), problem.region.choice(&point.values));
            let trial = Trial::new(problem, coordinates, choice, row);
            if trial.excess.is_finite() {
                starts.push(trial);
            }
        }
        if stops(&run) {
            run.stop();
        }
    }
    Ok(starts)
}

/// Returns the best starts, at most `most`. The list begins with the best start for each combination of
/// choices. Each later start is far from all earlier starts that have the values of its choices.
pub(super) fn best(problem: &Problem, mut starts: Vec<Trial>, most: usize) -> Vec<Trial> {
    // A stable sort: of equal starts the first one comes first.
    starts.sort_by(|one, other| one.order(problem, other));
    let has_feasible = starts.first().is_some_and(|start| start.excess == 0.0);
    starts.retain(|start| !has_feasible || start.excess == 0.0);
    let mut chosen: Vec<Trial> = Vec::new();
    let mut others: Vec<Trial> = Vec::new();
    for start in starts {
        let is_new = chosen.iter().all(|before| before.choice != start.choice);
        if is_new && chosen.len() < most { chosen.push(start) } else { others.push(start) }
    }
    for start in others {
        let is_distinct =
            chosen.iter().all(|before| before.choice != start.choice || distance(before, &start) >= DISTINCT);
        if is_distinct && chosen.len() < most {
            chosen.push(start);
        }
    }
    chosen
}

/// Returns the largest difference between the coordinates of two points.
pub(super) fn distance(one: &Trial, other: &Trial) -> f64 {
    let pairs = one.coordinates.iter().zip(&other.coordinates);
    pairs.map(|(one, other)| (one - other).abs()).fold(0.0, f64::max)
}
