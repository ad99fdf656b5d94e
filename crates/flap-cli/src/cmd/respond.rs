//! `flap respond`: follows the motions of designs while a parameter rises and falls.

mod basins;
mod edges;

use std::io;

use flap_core::parameter::Parameter;
use flap_sweep::notation::units;
use flap_sweep::plan::{Along, ChangeError, Plan};
use flap_sweep::run::{RunOptions, Sink, Summary};
use flap_sweep::study::response::{EdgeRange, Starts};
use flap_sweep::table::layout::Cell;

use super::point;
use crate::args::{OutputFormat, RespondArgs};
use crate::console::{self, is_stdout};
use crate::failure::{Exit, Failure};
use crate::job::{self, Lines, Verdicts};
use crate::print;

pub(crate) fn run(args: &RespondArgs) -> Result<Exit, Failure> {
    let plan = point::plan(&args.what)?;
    point::check_one_wing(&plan, &args.what, "`flap respond`")?;
    let plan = point::with_solver(plan, &args.solver)?;
    if plan.resonance().is_some() {
        let failure = Failure::usage(format!(
            "{} sets drive_frequency to the resonance of each design, which `flap respond` cannot follow",
            args.what
        ));
        return Err(
            failure.help("set drive_frequency to a number, or follow it with --along drive_frequency")
        );
    }
    let (mut plan, along) = along(args, plan)?;
    for (place, (name, value)) in args.changes.set.iter().enumerate() {
        if args.changes.set[..place].iter().any(|(other, _)| other == name) {
            return Err(point::twice("--set", name));
        }
        plan = set(plan, &along, name, value)?;
    }
    if let Some(edge) = &args.edge {
        let second = edge_range(args, &plan, &along, edge)?;
        return edges::run(&plan.following(along), &second, args);
    }
    if let Some(count) = args.basins {
        return basins::run(&plan.following(along), Starts { count, seed: args.seed }, args);
    }
    let plan = plan.following(along);
    let Some(verdicts) = Verdicts::of(&plan, args.format, Lines::Stdout) else {
        return Err(Failure::usage(format!(
            "the model {} does not measure the stroke",
            plan.simulator().name()
        )));
    };
    match &args.out {
        Some(out) if args.format != OutputFormat::Table && is_stdout(out) => {
            Err(Failure::usage("--format cannot be used with --out -: stdout already has the rows"))
        }
        Some(out) => {
            let on_existing = args.begin.on_existing();
            job::run_and_summarize(&plan, out.clone(), on_existing, &args.begin.work, None, args.format)
        }
        None => without_rows(&plan, args, verdicts),
    }
}

/// Computes the response curves and prints a summary of each curve, but writes no rows.
fn without_rows(plan: &Plan, args: &RespondArgs, mut verdicts: Verdicts<'_>) -> Result<Exit, Failure> {
    let options = RunOptions::with_threads(args.begin.work.threads);
    let summary =
        job::run_with_progress(plan, &options, Summary::default(), &mut NoOutput, Some(&mut verdicts))?;
    if args.format != OutputFormat::Table {
        print::table(args.format, &verdicts.names(), &verdicts.rows, String::new)?;
    }
    if summary.is_interrupted() {
        let (done, designs) = (summary.done(), summary.points);
        console::say(&format!("interrupted: {done} of {designs} designs are done"));
        return Ok(Exit::Interrupted);
    }
    Ok(job::exit_code(&summary, &args.begin.work))
}

/// An output that discards all rows.
struct NoOutput;

impl Sink for NoOutput {
    fn write(&mut self, _cells: &[Cell]) -> io::Result<()> {
        Ok(())
    }
}

/// Returns the plan, and the values of the followed parameter, which rises and falls. The values come from
/// the command line or from an axis of the grid file.
fn along(args: &RespondArgs, plan: Plan) -> Result<(Plan, Along), Failure> {
    let index = point::find_parameter(plan.parameters(), &args.along)?;
    let parameter = &plan.parameters()[index];
    let number = |option: &str, given: &Option<String>| -> Result<Option<f64>, Failure> {
        given.as_deref().map(|text| point::value(parameter, option, text)).transpose()
    };
    // A step may be smaller than the smallest allowed value.
    let amount = |option: &str, given: &Option<String>| -> Result<Option<f64>, Failure> {
        given.as_deref().map(|text| positive_step(parameter, option, text)).transpose()
    };
    let steps =
        match [number("--from", &args.from)?, number("--to", &args.to)?, amount("--step", &args.step)?] {
            [Some(from), Some(to), Some(step)] => Some([from, to, step]),
            [None, None, None] => None,
            _ => {
                let message = format!("the values of `{}` are incomplete", parameter.name);
                return Err(Failure::usage(message).help("--from, --to and --step are required together"));
            }
        };
    let tolerance = amount("--tolerance", &args.tolerance)?;
    Ok(Along::new(plan, index, steps, tolerance, args.unstable)?)
}

/// Returns the parameter of `--edge`, with its range and step from the command line.
fn edge_range(args: &RespondArgs, plan: &Plan, along: &Along, name: &str) -> Result<EdgeRange, Failure> {
    let index = point::find_parameter(plan.parameters(), name)?;
    let parameter = &plan.parameters()[index];
    let limit = |option: &str, given: &Option<String>| {
        let given = given.as_deref().ok_or_else(|| Failure::usage(format!("{option} is missing")))?;
        point::value(parameter, option, given)
    };
    let range = [limit("--edge-from", &args.edge_from)?, limit("--edge-to", &args.edge_to)?];
    let step =
        args.edge_step.as_deref().map(|text| positive_step(parameter, "--edge-step", text)).transpose()?;
    Ok(EdgeRange::new(plan, along, index, range, step)?)
}

/// Parses a step of a parameter. The step must be more than zero.
fn positive_step(parameter: &Parameter, option: &str, text: &str) -> Result<f64, Failure> {
    let number = units::parse_or_si(text, parameter.unit).map_err(|error| {
        let failure = Failure::usage(format!("{option} {text}: {}", error.message("the value")));
        failure.helps(error.help())
    })?;
    if number > 0.0 {
        return Ok(number);
    }
    let failure = Failure::usage(format!("{option} {text}: must be more than zero"));
    let help = "values rise from --from to --to, then fall by the same steps";
    Err(failure.helps((option == "--step").then_some(help)))
}

/// Sets a parameter of the plan to a value of `--set`, for all designs.
fn set(plan: Plan, along: &Along, name: &str, value: &str) -> Result<Plan, Failure> {
    let index = point::find_parameter(plan.parameters(), name)?;
    let twice =
        |how: &str| Failure::usage(format!("`{name}` is set with --set and {how}")).help("keep one of them");
    if index == along.parameter {
        return Err(twice("varied"));
    }
    let value = point::value(&plan.parameters()[index], &format!("--set {name}="), value)?;
    plan.with_parameter(index, value).map_err(|error| match error {
        ChangeError::Varied(_) => twice("varied"),
        ChangeError::Derived(_) => twice("derived"),
        other => other.into(),
    })
}
