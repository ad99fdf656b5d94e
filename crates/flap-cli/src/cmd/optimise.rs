//! `flap optimise`: the best design within the ranges of a grid's axes.

mod front;
mod shared;

use std::fmt::Write as _;
use std::io::{self, Write as _};
use std::path::Path;
use std::time::Instant;

use flap_core::simulate::{NoSlope, Setting, SolverSettings};
use flap_sweep::files::inputs::Inputs;
use flap_sweep::grid;
use flap_sweep::notation::text::{self, count};
use flap_sweep::notation::units::prefixed;
use flap_sweep::plan::Plan;
use flap_sweep::study::deviation;
use flap_sweep::study::optimum::{Aim, Optimum, Problem, Status, optimise};
use shared::{measures, refused, settings, watched};

use super::{deviations, grid as grids, outputs, point};
use crate::args::OptimiseArgs;
use crate::console::{self, shell_word};
use crate::failure::{Exit, Failure};
use crate::table::{Table, six_digits, wrapped};
use crate::{job, print};

/// Columns of the output in csv and json.
const NAMES: [&str; 7] = ["section", "name", "value", "unit", "limit", "per_unit", "percent_per_percent"];

/// Measures that the table always shows, in addition to the measures in the goal and the conditions.
const MAIN: [&str; 6] = [
    "stroke_pp_deg",
    "pitch_pp_deg",
    "lift_mean_mn",
    "vehicle_lift_mgf",
    "power_mean_mw",
    "efficiency_gf_per_w",
];

pub(crate) fn run(args: &OptimiseArgs) -> Result<Exit, Failure> {
    let plan = point::with_solver(grids::read(&args.grid)?, &args.solver)?;
    deviations::warn(&deviation::of(&plan));
    if args.out.is_some() {
        let what = args.grid.display().to_string();
        point::check_one_wing(&plan, &what, "a device, which --out writes,")?;
    }
    let mut inputs = Inputs::new();
    inputs.add_plan(&plan);
    outputs::check(&inputs, [args.out.as_deref()])?;
    let (goal, aim) = match (&args.maximise, &args.minimise, args.points) {
        (Some(largest), Some(smallest), Some(points)) => {
            return front::run(args, &plan, [largest, smallest], points);
        }
        (Some(_), Some(_), None) => {
            let failure = Failure::usage(
                "--maximise and --minimise together give a front of designs, not one best design",
            );
            return Err(failure
                .help("add --points N, or keep one of these options and limit the other goal with --where"));
        }
        (_, _, Some(_)) => {
            return Err(Failure::usage("--points needs both --maximise and --minimise"));
        }
        (Some(goal), None, None) => (goal, Aim::Largest),
        (None, Some(goal), None) => (goal, Aim::Smallest),
        (None, None, None) => return Err(Failure::usage("--maximise or --minimise is missing")),
    };
    let problem = Problem::new(plan, goal, aim, &args.conditions)
        .map_err(|error| refused(args, aim == Aim::Smallest, &error))?;
    search(args, &problem)
}

fn search(args: &OptimiseArgs, problem: &Problem) -> Result<Exit, Failure> {
    let begun = Instant::now();
    let settings = settings(args);
    let best = watched(args, "points and starts", |stops| optimise(problem, &settings, stops))?;
    if let Some(out) = &args.out {
        write(&problem.plan().clone().of_point(&best.values), out, args.overwrite.force)?;
    }
    print::table(args.format, &NAMES, &cells(problem, &best), || page(problem, &best))?;
    let seconds = begun.elapsed().as_secs_f64();
    let (rows, sloped) = (count(best.rows, "row"), best.sloped);
    console::say(&format!("{rows}, {sloped} of them with derivatives, in {seconds:.1} s"));
    remark(problem, &best);
    Ok(if best.is_feasible() { Exit::Done } else { Exit::NotAll })
}

/// Writes the best design as a device file.
fn write(plan: &Plan, out: &Path, overwrite: bool) -> Result<(), Failure> {
    let text = grid::device(plan)?;
    if console::is_stdout(out) {
        return Err(Failure::usage("--out -: flap already prints the result to stdout").help("name a file"));
    }
    let written = job::make(out, overwrite, |mut file| file.write_all(text.as_bytes()).map(|()| None))?;
    written.map_err(|error: io::Error| Failure::cannot_write(out, &error))?;
    let (options, lost) = options(plan.solver());
    let name = shell_word(&out.display().to_string());
    console::say(&format!("the design is in {}: `flap run {name}{options}` computes its row", out.display()));
    if !lost.is_empty() {
        let lost = lost.join(", ");
        console::say(&format!(
            "a device has no [solver], so this row is computed with the default of {lost}"
        ));
    }
    Ok(())
}

/// Returns command-line options for the solver settings that differ from the defaults. Also returns the names
/// of changed settings for which no option exists.
fn options(solver: &SolverSettings) -> (String, Vec<&'static str>) {
    // `--rtol` also sets the settings that follow it.
    let usual = SolverSettings::default().with_rtol(solver.rtol);
    let (mut options, mut lost) = (String::new(), Vec::new());
    if usual.rtol != SolverSettings::DEFAULT.rtol {
        let _ = write!(options, " --rtol {}", text::float(usual.rtol));
    }
    for Setting { name, kind, .. } in SolverSettings::TABLE {
        let value = text::setting(*kind, solver);
        if value == text::setting(*kind, &usual) {
            continue;
        }
        if ["accuracy", "settle_tol", "max_cycles"].contains(name) {
            let _ = write!(options, " --{} {value}", name.replace('_', "-"));
        } else {
            lost.push(*name);
        }
    }
    (options, lost)
}

/// Prints warnings and notes about the result of the search.
fn remark(problem: &Problem, best: &Optimum) {
    let plan = problem.plan();
    if best.computed < best.points {
        console::say(&format!(
            "{} of the {} points of the grid were computed; these points are spread over the grid",
            best.computed, best.points
        ));
    }
    if !problem.has_slopes() && plan.resonance().is_some() {
        console::say(
            "rows at the resonance of each design have no derivatives: differences of rows and a pattern search \
             replace them",
        );
    } else if !best.missing.is_empty() {
        let reasons: Vec<&str> = best.missing.iter().map(|reason| NoSlope::name(*reason)).collect();
        console::say(&format!(
            "some rows lack derivatives ({}): differences of rows and a pattern search replace the derivatives",
            reasons.join(", ")
        ));
    } else if best.is_polished {
        console::say("the search with derivatives did not converge: a pattern search completed the search");
    }
    for (parameter, [from, to]) in &best.at_end {
        let known = &plan.parameters()[*parameter];
        let value = best.values[*parameter];
        let ends = [from, to].map(|end| prefixed(*end, known.unit));
        console::warn(&format!(
            "{} = {} is at an end of its axis ({} to {}): a wider axis may have a better design",
            known.name,
            prefixed(value, known.unit),
            ends[0],
            ends[1]
        ));
    }
}

/// Returns the unit of the goal. The unit is empty if the goal is neither a measure nor a parameter.
fn unit<'p>(plan: &'p Plan, goal: &str) -> &'p str {
    let column = plan.rows().columns().iter().find(|column| column.name == goal);
    let parameter = || plan.parameters().iter().find(|parameter| parameter.name == goal);
    column
        .map(|column| column.unit)
        .or_else(|| parameter().map(|parameter| parameter.unit))
        .unwrap_or_default()
}

/// Returns the number of searches that end at the best design.
fn starts_at_optimum(best: &Optimum) -> usize {
    best.optima.first().map_or(0, |first| first.starts)
}

/// Returns the result as rows for csv and json, in the columns [`NAMES`] and with all digits.
fn cells(problem: &Problem, best: &Optimum) -> Vec<Vec<String>> {
    let plan = problem.plan();
    let mut rows: Vec<Vec<String>> = Vec::new();
    let mut put = |section: &str, cells: [String; 6]| {
        rows.push(std::iter::once(section.to_owned()).chain(cells).collect());
    };
    let none = String::new;
    let with_unit = |name: &str, value: String, unit: &str| {
        [name.to_owned(), value, unit.to_owned(), none(), none(), none()]
    };
    let plain = |name: &str, value: String| with_unit(name, value, "");
    let goal = |value: f64| with_unit(problem.goal(), text::float(value), unit(plan, problem.goal()));
    let parameter = |index: usize, value: f64| {
        let parameter = &plan.parameters()[index];
        with_unit(parameter.name, text::value(parameter, value), parameter.unit)
    };
    put("answer", plain("status", best.status.name().to_owned()));
    put("answer", goal(best.goal));
    let numbers = [
        ("starts", best.starts as u64),
        ("starts_at_optimum", starts_at_optimum(best) as u64),
        ("points", best.points),
        ("points_computed", best.computed),
        ("rows", best.rows),
        ("rows_with_derivatives", best.sloped),
    ];
    for (name, number) in numbers {
        put("answer", plain(name, number.to_string()));
    }
    for index in plan.differing() {
        put("parameter", parameter(index, best.values[index]));
    }
    for (name, value, unit) in measures(plan, best) {
        put("measure", with_unit(name, text::float(value), unit));
    }
    for limit in &best.limits {
        let [less, more] = limit.sides.map(text::float);
        put("condition", [limit.text.clone(), less, none(), more, none(), none()]);
    }
    for active in &best.active {
        let numbers = [active.limit, active.per_unit, active.percent].map(text::float);
        let [limit, per_unit, percent] = numbers;
        let section = format!("active_{}", active.edge.name());
        put(&section, [active.name.clone(), none(), none(), limit, per_unit, percent]);
    }
    for (number, other) in (1..).zip(&best.optima) {
        let section = format!("optimum_{number}");
        put(&section, goal(other.goal));
        put(&section, plain("starts", other.starts.to_string()));
        put(&section, plain("feasible", other.is_feasible.to_string()));
        for (index, value) in &other.varied {
            put(&section, parameter(*index, *value));
        }
    }
    rows
}

/// Returns the result as text for a terminal.
fn page(problem: &Problem, best: &Optimum) -> String {
    let plan = problem.plan();
    let goal = problem.goal();
    let word = match problem.aim() {
        Aim::Largest => "largest",
        Aim::Smallest => "smallest",
    };
    let value = format!("{} {}", six_digits(best.goal), unit(plan, goal));
    let (status, value) = (best.status.name(), value.trim_end());
    let head = match best.status {
        Status::Infeasible => {
            format!(
                "{status}: no design satisfies all conditions; this design has the smallest violation of the conditions ({goal} = {value})"
            )
        }
        Status::Optimal | Status::Approximate => format!("{status}: the {word} {goal} is {value}"),
    };
    let mut page = wrapped(&head, 0) + "\n\n";
    let mut table = Table::with_headings(&["parameter", "value"]);
    for index in plan.differing() {
        let parameter = &plan.parameters()[index];
        table.row([parameter.name.to_owned(), text::shown(parameter, best.values[index])]);
    }
    page += &table.text_within(console::width());
    page.push('\n');
    let mut table = Table::with_headings(&["measure", "value", "unit"]);
    let is_named = |name: &str| {
        let limits = best.limits.iter().map(|limit| limit.text.as_str());
        MAIN.contains(&name) || limits.chain([goal]).any(|text| text.contains(name))
    };
    for (name, value, unit) in measures(plan, best).into_iter().filter(|(name, ..)| is_named(name)) {
        table.row([name.to_owned(), six_digits(value), unit.to_owned()]);
    }
    page += &table.text_within(console::width());
    page += &conditions(best);
    page += &ends(problem, best);
    page
}

/// Returns a table of the conditions. The text is empty without conditions.
fn conditions(best: &Optimum) -> String {
    if best.limits.is_empty() {
        return String::new();
    }
    let mut table = Table::with_headings(&["condition", "smaller side", "larger side", "holds"]);
    for limit in &best.limits {
        let [less, more] = limit.sides.map(six_digits);
        let holds = match limit.excess {
            0.0 => "yes".to_owned(),
            excess => format!("no, by {} %", six_digits(100.0 * excess)),
        };
        table.row([limit.text.clone(), less, more, holds]);
    }
    format!("\n{}", table.text_within(console::width()))
}

/// Returns a text about the bounds and conditions that limit the best design, and about the designs at which
/// the searches end.
fn ends(problem: &Problem, best: &Optimum) -> String {
    let mut page = String::new();
    if !best.active.is_empty() {
        page += "\nbounds and conditions that limit the design:\n";
        for active in &best.active {
            let _ = writeln!(page, "{}", wrapped(&format!("  {}", active.sentence(problem.goal())), 4));
        }
    }
    let (starts, at_optimum) = (count(best.starts as u64, "start"), starts_at_optimum(best));
    let end = if at_optimum == 1 { "ends" } else { "end" };
    let _ = writeln!(page, "\n{at_optimum} of {starts} {end} at this design");
    for other in best.optima.iter().skip(1) {
        let values = other
            .varied
            .iter()
            .map(|(index, value)| crate::table::assignment(&problem.plan().parameters()[*index], *value));
        let values = values.collect::<Vec<_>>().join(", ");
        let end = if other.starts == 1 { "ends" } else { "end" };
        let goal = six_digits(other.goal);
        let feasible = if other.is_feasible { "" } else { " (infeasible)" };
        let line = format!("  {} {end} at {} = {goal}{feasible}: {values}", other.starts, problem.goal());
        let _ = writeln!(page, "{}", wrapped(&line, 4));
    }
    page
}
