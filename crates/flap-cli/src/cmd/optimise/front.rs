//! The Pareto front of two goals: `flap optimise --points`.

use std::time::Instant;

use flap_sweep::notation::text::{self, count};
use flap_sweep::plan::Plan;
use flap_sweep::study::optimum::{Aim, Front, FrontError, FrontPoint, Goal, front};

use super::shared::{measures, refused, settings, watched};
use crate::args::OptimiseArgs;
use crate::console;
use crate::failure::{Exit, Failure};
use crate::print;
use crate::table::{Table, six_digits};

pub(super) fn run(
    args: &OptimiseArgs,
    plan: &Plan,
    [largest, smallest]: [&str; 2],
    points: u32,
) -> Result<Exit, Failure> {
    let begun = Instant::now();
    let goals = [Goal { text: largest, aim: Aim::Largest }, Goal { text: smallest, aim: Aim::Smallest }];
    let settings = settings(args);
    let front = watched(args, "points of the front", |stops| {
        front(plan, goals, &args.conditions, points as usize, &settings, stops).map_err(|error| match error {
            FrontError::Problem(place, error) => refused(args, place == 1, &error),
            FrontError::Run(error) => error.into(),
        })
    })?;
    let names = [largest, smallest].map(str::trim);
    print::table(args.format, &columns(plan, names, &front), &cells(plan, names, &front), || {
        page(plan, names, &front)
    })?;
    let is_feasible = front.points.iter().all(|point| point.best.is_feasible());
    if !is_feasible {
        console::say(
            "infeasible: no design satisfies all conditions; this design has the smallest violation of the conditions",
        );
    }
    let seconds = begun.elapsed().as_secs_f64();
    let rows = count(front.rows, "row");
    console::say(&format!("{rows}, {} of them with derivatives, in {seconds:.1} s", front.sloped));
    Ok(if is_feasible { Exit::Done } else { Exit::NotAll })
}

/// Returns the positions and the texts of the goals that are expressions and not names of measures or
/// parameters.
fn expressions<'n>(plan: &Plan, names: [&'n str; 2], point: &FrontPoint) -> Vec<(usize, &'n str)> {
    let is_known = |name: &str| {
        measures(plan, &point.best).iter().any(|(known, ..)| *known == name)
            || plan.differing().any(|index| plan.parameters()[index].name == name)
    };
    names.into_iter().enumerate().filter(|(_, name)| !is_known(name)).collect()
}

/// Returns the names of the columns in csv and json: the columns of a sweep, then the goals that are
/// expressions.
fn columns(plan: &Plan, names: [&str; 2], front: &Front) -> Vec<String> {
    let mut columns = vec!["point".to_owned()];
    columns.extend(plan.differing().map(|index| plan.parameters()[index].name.to_owned()));
    columns.push("status".to_owned());
    if let Some(first) = front.points.first() {
        columns.extend(measures(plan, &first.best).iter().map(|(name, ..)| (*name).to_owned()));
        columns.extend(
            expressions(plan, names, first).into_iter().map(|(place, _)| format!("goal_{}", place + 1)),
        );
    }
    columns
}

/// Returns the rows of the front for csv and json, with all digits.
fn cells(plan: &Plan, names: [&str; 2], front: &Front) -> Vec<Vec<String>> {
    let row = |(number, point): (usize, &FrontPoint)| {
        let mut row = vec![number.to_string()];
        row.extend(
            plan.differing().map(|index| text::value(&plan.parameters()[index], point.best.values[index])),
        );
        row.push(point.best.row.status.name().to_owned());
        row.extend(measures(plan, &point.best).iter().map(|(_, value, _)| text::float(*value)));
        let goals =
            expressions(plan, names, point).into_iter().map(|(place, _)| text::float(point.goals[place]));
        row.extend(goals);
        row
    };
    front.points.iter().enumerate().map(row).collect()
}

/// Returns the front as a table for a terminal, with both goals and the varied parameters.
fn page(plan: &Plan, names: [&str; 2], front: &Front) -> String {
    let mut headings: Vec<String> = names.map(str::to_owned).to_vec();
    headings.extend(plan.differing().map(|index| {
        let parameter = &plan.parameters()[index];
        let unit = if parameter.unit.is_empty() { String::new() } else { format!(" ({})", parameter.unit) };
        format!("{}{unit}", parameter.name)
    }));
    let mut table = Table::with_names(headings).with_keys(2);
    for point in &front.points {
        let mut row: Vec<String> = point.goals.map(six_digits).to_vec();
        row.extend(plan.differing().map(|index| {
            let parameter = &plan.parameters()[index];
            let value = point.best.values[index];
            text::option(parameter, value).map_or_else(|| six_digits(value), str::to_owned)
        }));
        table.row(row);
    }
    table.text_within(console::width())
}
