//! Computes the Pareto front of two goals: the best values of the first goal for several limits on the second
//! goal.

use super::answer::{Optimum, Status};
use super::problem::{Aim, Problem, ProblemError};
use super::search::{Settings, optimise, optimise_from};
use crate::plan::Plan;
use crate::run::RunError;

/// A goal of an optimisation: an expression whose value must be as large or as small as possible.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Goal<'t> {
    /// The expression, as the user wrote it.
    pub text: &'t str,
    /// The better direction: larger or smaller values of the expression.
    pub aim: Aim,
}

/// A Pareto front of two goals.
#[derive(Clone, Debug)]
pub struct Front {
    /// The points of the front, from the best value of the first goal to the best value of the second goal.
    pub points: Vec<FrontPoint>,
    /// Number of all computed rows.
    pub rows: u64,
    /// Number of computed rows with derivatives.
    pub sloped: u64,
}

/// A point of a Pareto front.
#[derive(Clone, Debug)]
pub struct FrontPoint {
    /// The values of both goals at this point.
    pub goals: [f64; 2],
    /// The design with the best value of the first goal, for a limit on the second goal.
    pub best: Optimum,
}

/// The reason why a Pareto front cannot be computed.
#[derive(Debug, thiserror::Error)]
pub enum FrontError {
    /// A goal or a condition is invalid. The error contains the index of the goal, 0 or 1, and the
    /// description of the mistake.
    #[error("{1}")]
    Problem(usize, ProblemError),
    /// The rows could not be computed.
    #[error(transparent)]
    Run(#[from] RunError),
}

/// Computes the Pareto front of two goals within the axes of `plan`. All points satisfy the `conditions`. The
/// front has at most `count` points, and values of `count` below 2 count as 2.
///
/// Each point has the best value of the first goal for a limit on the second goal. The limits are evenly
/// spaced between the ends of the front. For each point, one search starts from the previous point of the
/// front, and one search starts from the last point of the front. A point is left out if a different point is
/// at least as good in both goals and better in one goal. `stops` is called with two arguments: the number of
/// finished points and the number of all points of the front. If `stops` returns true, the computation ends
/// without a result.
///
/// Returns `None` if no point has a periodic motion, or if `stops` returned true.
///
/// If no design satisfies all conditions, the front consists of the one point that violates the conditions
/// least.
///
/// # Errors
/// [`FrontError`] if a goal or a condition is invalid, or if rows cannot be computed.
pub fn front(
    plan: &Plan,
    goals: [Goal<'_>; 2],
    conditions: &[String],
    count: usize,
    settings: &Settings,
    stops: &dyn Fn(u64, u64) -> bool,
) -> Result<Option<Front>, FrontError> {
    let all = count.max(2) as u64;
    let problem = |place: usize, more: Option<String>| {
        let conditions: Vec<String> = conditions.iter().cloned().chain(more).collect();
        let Goal { text, aim } = goals[place];
        Problem::new(plan.clone(), text, aim, &conditions).map_err(|error| FrontError::Problem(place, error))
    };
    let [first, second] = [problem(0, None)?, problem(1, None)?];
    let mut front = Front { points: Vec::new(), rows: 0, sloped: 0 };
    let Some(begin) = optimise(&first, settings, &|_, _| stops(0, all))? else { return Ok(None) };
    let Some(end) = optimise(&second, settings, &|_, _| stops(1, all))? else { return Ok(None) };
    let mut point = |best: Optimum| {
        front.rows += best.rows;
        front.sloped += best.sloped;
        FrontPoint { goals: [&first, &second].map(|problem| problem.value(&best)), best }
    };
    let (begin, end) = (point(begin), point(end));
    if begin.best.status == Status::Infeasible {
        front.points.push(begin);
        return Ok(Some(front));
    }
    let [from, to] = [begin.goals[1], end.goals[1]];
    let mut points = vec![begin];
    let relation = match goals[1].aim {
        Aim::Largest => ">=",
        Aim::Smallest => "<=",
    };
    let signs = goals.map(|goal| goal.aim.sign());
    for number in 1..all {
        let share = number as f64 / (all - 1) as f64;
        // The last limit is the best value of the second goal. Several designs can have this value.
        let limit = if number == all - 1 { to } else { from + (to - from) * share };
        let beside = &points[points.len() - 1];
        if signs[1] * beside.goals[1] <= signs[1] * limit {
            continue;
        }
        let limited = problem(0, Some(format!("({}) {relation} {limit:?}", goals[1].text)))?;
        let starts = [&beside.best, &end.best];
        let found = optimise_from(&limited, settings, &starts, &|_, _| stops(number + 1, all))?;
        let Some(found) = found.map(&mut point) else { return Ok(None) };
        if found.best.is_feasible() {
            points.push(found);
        } else if number == all - 1 {
            // Without a design at the last limit, the front ends with the best design for the second goal.
            points.push(end.clone());
        }
    }
    front.points = not_improved(points, signs);
    Ok(Some(front))
}

/// Returns the points that no other point dominates. The element of `signs` for a goal is 1 if smaller values
/// of the goal are better, and -1 if larger values are better.
fn not_improved(points: Vec<FrontPoint>, signs: [f64; 2]) -> Vec<FrontPoint> {
    let scores: Vec<[f64; 2]> =
        points.iter().map(|point| [0, 1].map(|goal| signs[goal] * point.goals[goal])).collect();
    let improves =
        |other: &[f64; 2], score: &[f64; 2]| other != score && other[0] <= score[0] && other[1] <= score[1];
    let is_kept = |score: &[f64; 2]| !scores.iter().any(|other| improves(other, score));
    points.into_iter().zip(&scores).filter(|(_, score)| is_kept(score)).map(|(point, _)| point).collect()
}
