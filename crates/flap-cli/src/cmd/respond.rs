//! `flap respond`: the motions of designs as a parameter rises and falls.

use std::fs::File;
use std::io;
use std::path::Path;
use std::sync::atomic::AtomicBool;

use flap_core::parameter::Parameter;
use flap_core::simulate::Point;
use flap_sweep::files::disk::{self, Durable};
use flap_sweep::files::inputs::Inputs;
use flap_sweep::files::output;
use flap_sweep::notation::text;
use flap_sweep::plan::{ChangeError, Plan};
use flap_sweep::run::RunOptions;
use flap_sweep::study::response::{self, Along, AlongError, Curve, Table, Verdict};

use super::{outputs, point};
use crate::args::RespondArgs;
use crate::console;
use crate::failure::{Exit, Failure};
use crate::job::make;

pub(crate) fn run(args: &RespondArgs) -> Result<Exit, Failure> {
    let plan = point::plan(&args.what)?;
    outputs::check_tables(Inputs::new().add_plan(&plan), [args.out.as_deref()])?;
    let plan = point::with_solver(plan, &args.solver)?;
    if plan.resonance().is_some() {
        let failure = Failure::usage(format!("{} runs each design at its own resonance", args.what));
        return Err(failure.help("give drive_frequency a number, or follow it with --along drive_frequency"));
    }
    let (mut plan, along) = along(args, plan)?;
    for (name, value) in &args.set {
        plan = set(plan, &along, name, value)?;
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
            // Conditions may exclude some of the designs.
            let mut curves = 0_u64;
            into_file(path, args.force, |file| {
                let mut table = begin(&plan, &along, file, path)?;
                response::run(&plan, &along, threads, &never, |curve| {
                    curves += 1;
                    console::results(&(verdicts.line(&curve) + "\n"))?;
                    write(&mut table, &curve, path)
                })?;
                finish(table, path)
            })?;
            console::say(&format!("{curves} curves in {}", path.display()));
        }
        None => response::run(&plan, &along, threads, &never, |curve| {
            console::results(&(verdicts.line(&curve) + "\n")).map_err(Failure::from)
        })?,
    }
    Ok(Exit::Done)
}

/// Hands a file to `write`. New ones show their rows as they come; earlier ones stay until the new rows are complete.
fn into_file(
    path: &Path,
    overwrite: bool,
    write: impl FnOnce(File) -> Result<(), Failure>,
) -> Result<(), Failure> {
    if disk::is_empty(path) {
        return write(output::create(path, overwrite)?);
    }
    let mut failure = None;
    let made = make(path, overwrite, |file| {
        write(file).map_err(|why| {
            failure = Some(why);
            io::Error::other("the rows are not complete")
        })
    });
    match failure {
        Some(failure) => Err(failure),
        None => made?.map_err(|error| refused(path, error)),
    }
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
fn along(args: &RespondArgs, plan: Plan) -> Result<(Plan, Along), Failure> {
    let index = point::find_parameter(plan.parameters(), &args.along)?;
    let parameter = &plan.parameters()[index];
    let number = |option: &str, given: &Option<String>| -> Result<Option<f64>, Failure> {
        given.as_deref().map(|text| point::value(parameter, option, text)).transpose()
    };
    let steps =
        match [number("--from", &args.from)?, number("--to", &args.to)?, number("--step", &args.step)?] {
            [Some(from), Some(to), Some(step)] => Some([from, to, step]),
            [None, None, None] => None,
            _ => {
                let message = format!("how `{}` rises is not known", parameter.name);
                return Err(Failure::usage(message).help("--from, --to and --step go together"));
            }
        };
    let tolerance = number("--tolerance", &args.tolerance)?;
    Along::new(plan, index, steps, tolerance, args.unstable).map_err(|AlongError { message, help }| {
        let failure = Failure::usage(message);
        if help.is_empty() { failure } else { failure.help(help) }
    })
}

/// Sets a parameter of all designs.
fn set(plan: Plan, along: &Along, name: &str, value: &str) -> Result<Plan, Failure> {
    let index = point::find_parameter(plan.parameters(), name)?;
    let twice =
        |how: &str| Failure::usage(format!("`{name}` is set with --set and {how}")).help("keep one of them");
    if index == along.parameter {
        return Err(twice("varied"));
    }
    let value = point::value(&plan.parameters()[index], "--set", value)?;
    plan.with_parameter(index, value).map_err(|error| match error {
        ChangeError::Varied(_) => twice("varied"),
        ChangeError::Derived(_) => twice("derived"),
        other => other.into(),
    })
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
                Failure::usage(format!("the model {} measures no stroke", plan.simulator().name()))
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
        self.plan.axes().varied().map(assignment).collect::<Vec<_>>().join(", ")
    }
}
