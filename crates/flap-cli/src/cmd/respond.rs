//! `flap respond`: the motions of designs as a parameter rises and falls.

use std::fs::File;
use std::io;
use std::path::Path;
use std::sync::atomic::AtomicBool;

use flap_core::parameter::{Kind, Parameter};
use flap_core::simulate::Point;
use flap_sweep::axis::Values;
use flap_sweep::output::{self, Durable};
use flap_sweep::plan::Plan;
use flap_sweep::response::{self, Along, Curve, Table, Verdict};
use flap_sweep::run::RunOptions;
use flap_sweep::text;

use super::point;
use crate::args::RespondArgs;
use crate::console;
use crate::failure::{Exit, Failure};

/// The most values that a parameter takes on the way up.
const MOST_VALUES: f64 = 1e6;

pub(crate) fn run(args: &RespondArgs) -> Result<Exit, Failure> {
    let mut plan = point::plan(&args.what)?;
    point::set_solver(&mut plan.solver, &args.solver);
    if plan.resonance.is_some() {
        let failure = Failure::usage(format!("{} runs each design at its own resonance", args.what));
        return Err(failure.help("give drive_frequency a number, or follow it with --along drive_frequency"));
    }
    let along = along(args, &mut plan)?;
    for (name, value) in &args.set {
        set(&mut plan, &along, name, value)?;
    }
    let never = AtomicBool::new(false);
    let threads = args.threads.unwrap_or(RunOptions::default().threads);
    let verdicts = Verdicts::new(&plan, &along)?;
    match args.out.as_deref() {
        Some(path) if path.as_os_str() == "-" => {
            let mut table = begin(&plan, &along, io::stdout(), path)?;
            response::run(&plan, &along, threads, &never, |curve| {
                console::say(&verdicts.line(&curve));
                write(&mut table, &curve, path)
            })?;
            finish(table, path)?;
        }
        Some(path) => {
            let file: File = output::create(path, args.force)?;
            output::empty(&file).map_err(|error| refused(path, error))?;
            let mut table = begin(&plan, &along, file, path)?;
            // Conditions may exclude some of the designs.
            let mut curves = 0_u64;
            response::run(&plan, &along, threads, &never, |curve| {
                curves += 1;
                console::results(&(verdicts.line(&curve) + "\n"))?;
                write(&mut table, &curve, path)
            })?;
            finish(table, path)?;
            console::say(&format!("{curves} curves in {}", path.display()));
        }
        None => response::run(&plan, &along, threads, &never, |curve| {
            console::results(&(verdicts.line(&curve) + "\n")).map_err(Failure::from)
        })?,
    }
    Ok(Exit::Done)
}

fn begin<W: Durable>(plan: &Plan, along: &Along, target: W, path: &Path) -> Result<Table<W>, Failure> {
    Table::begin(plan, along, target).map_err(|error| refused(path, error))
}

fn write<W: Durable>(table: &mut Table<W>, curve: &Curve, path: &Path) -> Result<(), Failure> {
    table.write(curve).map_err(|error| refused(path, error))
}

fn finish<W: Durable>(table: Table<W>, path: &Path) -> Result<(), Failure> {
    table.finish().map_err(|error| refused(path, error))
}

fn refused(path: &Path, error: io::Error) -> Failure {
    if path.as_os_str() == "-" {
        return error.into();
    }
    Failure::System(format!("cannot write {}: {error}", path.display()), Vec::new())
}

/// The parameter that rises and falls, and its values: those of the command line, or of the grid's axis.
fn along(args: &RespondArgs, plan: &mut Plan) -> Result<Along, Failure> {
    let index = point::find_parameter(plan.parameters(), &args.along)?;
    let parameter = &plan.parameters()[index];
    if let Kind::Choice(_) = parameter.kind {
        return Err(Failure::usage(format!("`{}` is a choice and cannot rise and fall", parameter.name)));
    }
    let axis = plan.take_axis(index);
    if plan.varied().any(|varied| varied == index) {
        let message = format!("`{}` is varied together with other parameters", parameter.name);
        return Err(Failure::usage(message).help("follow a parameter with an axis of its own, or none"));
    }
    let number = |option: &str, given: &Option<String>| -> Result<Option<f64>, Failure> {
        given.as_deref().map(|text| point::value(parameter, option, text)).transpose()
    };
    let ends = [number("--from", &args.from)?, number("--to", &args.to)?, number("--step", &args.step)?];
    let values = match (ends, axis) {
        ([Some(from), Some(to), Some(step)], _) => steps(parameter, from, to, step)?,
        ([None, None, None], Some(axis)) => rising(parameter, &axis)?,
        _ => {
            let message = format!("how `{}` rises is not known", parameter.name);
            let help =
                "give --from, --to and --step, or a grid file with an axis of its own for the parameter";
            return Err(Failure::usage(message).help(help));
        }
    };
    let shortest = values.windows(2).map(|two| two[1] - two[0]).fold(f64::INFINITY, f64::min);
    let tolerance = number("--tolerance", &args.tolerance)?.unwrap_or(shortest / 16.0);
    if tolerance <= 0.0 {
        return Err(Failure::usage("--tolerance must be more than zero"));
    }
    Ok(Along { parameter: index, values, tolerance, unstable: args.unstable })
}

fn steps(parameter: &Parameter, from: f64, to: f64, step: f64) -> Result<Vec<f64>, Failure> {
    // A last step that is short by rounding alone is a step.
    let whole = ((to - from) / step + 1e-9).floor();
    if !(step > 0.0 && (1.0..MOST_VALUES).contains(&whole)) {
        let name = parameter.name;
        let message = format!("there are no steps of {step} in `{name}` from {from} to {to}");
        return Err(
            Failure::usage(message).help("--from less than --to by one step or more, up to a million")
        );
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "1 to a million")]
    let count = whole as u64 + 1;
    let values = Values::Step { from, step, count };
    Ok((0..count).map(|i| values.get(i)).collect())
}

/// The values of an axis by rising value.
fn rising(parameter: &Parameter, axis: &Values) -> Result<Vec<f64>, Failure> {
    let mut values: Vec<f64> = (0..axis.len()).map(|i| axis.get(i)).collect();
    values.sort_by(f64::total_cmp);
    values.dedup();
    if values.len() < 2 {
        let message = format!("the axis of `{}` has one value: nothing rises and falls", parameter.name);
        return Err(Failure::usage(message));
    }
    Ok(values)
}

/// Sets a parameter of all designs.
fn set(plan: &mut Plan, along: &Along, name: &str, value: &str) -> Result<(), Failure> {
    let index = point::find_parameter(plan.parameters(), name)?;
    if index == along.parameter || plan.varied().any(|varied| varied == index) {
        return Err(Failure::usage(format!("`{name}` is set with --set and varied")).help("keep one of them"));
    }
    plan.base[index] = point::value(&plan.parameters()[index], "--set", value)?;
    Ok(())
}

/// Makes the line of each curve.
struct Verdicts<'a> {
    plan: &'a Plan,
    parameter: &'static Parameter,
    /// Index of the stroke's amplitude among the measures.
    stroke: usize,
}

impl<'a> Verdicts<'a> {
    fn new(plan: &'a Plan, along: &Along) -> Result<Verdicts<'a>, Failure> {
        let stroke = plan
            .rows()
            .columns()
            .iter()
            .position(|column| column.name == "stroke_amplitude_deg")
            .ok_or_else(|| {
                Failure::usage(format!("the model {} measures no stroke", plan.simulator.name()))
            })?;
        Ok(Verdicts { plan, parameter: response::parameter(plan, along), stroke })
    }

    fn line(&self, curve: &Curve) -> String {
        let verdict = Verdict::new(curve, self.parameter, self.stroke);
        let design = self.design(&curve.design);
        if design.is_empty() { verdict.to_string() } else { format!("{design}: {verdict}") }
    }

    /// What a design has that others do not.
    fn design(&self, design: &Point) -> String {
        let assignment = |index: usize| {
            let parameter = &self.plan.parameters()[index];
            let value = text::value(parameter, design.values[index]);
            format!("{} = {value} {}", parameter.name, parameter.unit).trim_end().to_owned()
        };
        self.plan.varied().map(assignment).collect::<Vec<_>>().join(", ")
    }
}
