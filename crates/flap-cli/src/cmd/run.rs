//! `flap run`: one point, on the scalar path.

use std::fmt::Write as _;
use std::io;
use std::path::Path;

use flap_core::drive::Repeat;
use flap_core::num::InstructionSet;
use flap_core::parameter::{Kind, Parameter};
use flap_core::simulate::{self, ChirpRequest, Row, Simulator, SolverSettings, Status, TrajectoryRequest};
use flap_sweep::diagnostic::nearest;
use flap_sweep::plan::Plan;
use flap_sweep::{record, spec, text, units};

use super::motion_file;
use crate::args::{Drive, RunArgs};
use crate::console;
use crate::failure::{Exit, Failure};
use crate::table::Table;

pub(crate) fn run(args: &RunArgs) -> Result<Exit, Failure> {
    let mut plan = plan(&args.what)?;
    set_solver(&mut plan.solver, args);
    if args.point >= plan.len() {
        let message =
            format!("there is no point {}: {} has points 0 to {}", args.point, args.what, plan.len() - 1);
        return Err(Failure::usage(message));
    }
    let mut values = plan.point(args.point).values;
    for (name, value) in &args.set {
        set_parameter(plan.parameters(), &mut values, name, value)?;
    }

    let sampled = sampled(&plan, args, &mut values)?;
    let simulator = sampled.as_deref().unwrap_or(plan.simulator);
    if args.drive == Drive::Chirp {
        return chirp(&plan, args, &values);
    }
    if args.envelope.is_some() {
        return Err(Failure::usage("--envelope goes with --drive chirp"));
    }

    let set = InstructionSet::best();
    if let Some(path) = &args.trajectory {
        check_length(args)?;
        let request = TrajectoryRequest {
            cycles: if args.once { 1 } else { args.cycles },
            samples_per_cycle: args.samples,
            settled: !args.from_rest && !args.once,
        };
        let motion = simulator.trajectory(set, &plan.solver, &values, &request);
        let motion = motion.map_err(|invalid| Failure::usage(invalid.to_string()))?;
        if path.as_os_str() == "-" {
            motion_file::write_csv(&motion, io::stdout().lock())?;
            return Ok(Exit::Done);
        }
        motion_file::write(&motion, path, args.force)?;
        console::say(&format!("{} samples in {}", motion.rows.len(), path.display()));
        if args.once {
            return Ok(Exit::Done);
        }
    }

    let row = simulator.run_point(set, &plan.solver, &values);
    if let (Status::Invalid, Some(reason)) = (row.status, &row.reason) {
        return Err(Failure::usage(format!("the parameters are impossible together: {reason}")));
    }
    console::results(&page(&plan, args, &row))?;
    Ok(Exit::Done)
}

/// The model with the waveform or the stroke of a file, if one is given; its period goes into `values`.
fn sampled(plan: &Plan, args: &RunArgs, values: &mut [f64]) -> Result<Option<Box<dyn Simulator>>, Failure> {
    let repeat = if args.once { Repeat::Once } else { Repeat::Periodic };
    let (path, wave) = match (&args.waveform, &args.stroke) {
        (Some(path), _) => (path, record::WAVE),
        (None, Some(path)) => (path, record::STROKE),
        (None, None) if args.once => {
            return Err(Failure::usage("--once goes with --waveform or --stroke"));
        }
        (None, None) => return Ok(None),
    };
    if args.drive == Drive::Chirp {
        return Err(Failure::usage("a chirp has a waveform of its own: leave out --waveform and --stroke"));
    }
    let samples = motion_file::samples(path, wave, repeat)?;
    let mut put = |name: &str, value: f64| {
        let index = plan.parameters().iter().position(|parameter| parameter.name == name);
        if let Some(index) = index {
            values[index] = value;
        }
        index.is_some()
    };
    if args.set.iter().all(|(name, _)| name != "drive_frequency") {
        put("drive_frequency", 1.0 / samples.duration());
    }
    if args.stroke.is_some() && !(put("stroke_mode", 1.0) && put("stroke_amplitude", 1.0)) {
        let message = format!("the stroke of the model {} cannot be prescribed", plan.simulator.name());
        return Err(Failure::usage(message).help("models with a parameter stroke_mode can"));
    }
    Ok(Some(plan.simulator.with_samples(samples)))
}

/// The most samples of one trajectory: they are held in memory.
const SAMPLES_MAX: u64 = 5_000_000;

fn check_length(args: &RunArgs) -> Result<(), Failure> {
    let samples = u64::from(args.cycles) * u64::from(args.samples);
    if samples <= SAMPLES_MAX {
        return Ok(());
    }
    let message = format!("{samples} samples are too many: --cycles times --samples may be {SAMPLES_MAX}");
    Err(Failure::usage(message))
}

/// Sweeps the frequency: rows per cycle to stdout or a file, the motion to a file.
fn chirp(plan: &Plan, args: &RunArgs, values: &[f64]) -> Result<Exit, Failure> {
    let parameters = plan.parameters();
    let frequency = parameters.iter().position(|parameter| parameter.name == "drive_frequency");
    let request = ChirpRequest {
        from: args.chirp_from,
        to: args.chirp_to.or(frequency.map(|index| 2.0 * values[index])).unwrap_or(args.chirp_from),
        rate: args.chirp_rate,
        samples_per_cycle: if args.trajectory.is_some() { args.samples } else { 0 },
    };
    let response = plan.simulator.chirp(InstructionSet::best(), &plan.solver, values, &request);
    let response = response.map_err(|invalid| Failure::usage(invalid.to_string()))?;
    if let Some(path) = &args.trajectory {
        motion_file::write(&response.motion, path, args.force)?;
        console::say(&format!("{} samples in {}", response.motion.rows.len(), path.display()));
    }
    match &args.envelope {
        Some(path) => {
            motion_file::write(&response.envelope, path, args.force)?;
            console::say(&format!("{} cycles in {}", response.envelope.rows.len(), path.display()));
        }
        None => motion_file::write_csv(&response.envelope, io::stdout().lock())?,
    }
    Ok(Exit::Done)
}

/// The plan of a preset or a grid file.
pub(super) fn plan(what: &str) -> Result<Plan, Failure> {
    if simulate::preset(what).is_some() {
        let grid = format!("preset = \"{what}\"\n");
        return spec::parse(what, &grid, simulate::all()).map_err(Failure::Grid);
    }
    let path = Path::new(what);
    let looks_like_a_file = path.extension().is_some() || path.components().count() > 1;
    if looks_like_a_file || path.exists() {
        return Ok(spec::read(path)?);
    }
    let presets = simulate::all().iter().flat_map(|model| model.presets()).map(|preset| preset.name);
    let failure = Failure::usage(format!("there is no preset and no file `{what}`"));
    Err(match nearest(what, presets) {
        Some(nearest) => failure.help(format!("did you mean `{nearest}`?")),
        None => failure.help("`flap models` lists models and presets"),
    })
}

fn set_solver(settings: &mut SolverSettings, args: &RunArgs) {
    if let Some(rtol) = args.rtol {
        settings.rtol = rtol;
        settings.atol = rtol / 100.0;
    }
    settings.settle_tol = args.settle_tol.unwrap_or(settings.settle_tol);
    settings.max_cycles = args.max_cycles.unwrap_or(settings.max_cycles);
}

/// Sets the parameter called `name` from text.
pub(super) fn set_parameter(
    parameters: &[Parameter],
    values: &mut [f64],
    name: &str,
    text: &str,
) -> Result<(), Failure> {
    let Some(index) = parameters.iter().position(|parameter| parameter.name == name) else {
        let failure = Failure::usage(format!("there is no parameter `{name}`"));
        return Err(match nearest(name, parameters.iter().map(|parameter| parameter.name)) {
            Some(nearest) => failure.help(format!("did you mean `{nearest}`?")),
            None => failure.help("`flap params` lists the parameters of a model"),
        });
    };
    values[index] = value(&parameters[index], text)?;
    Ok(())
}

fn value(parameter: &Parameter, text: &str) -> Result<f64, Failure> {
    let name = parameter.name;
    match parameter.kind {
        Kind::Choice(options) => {
            let index = (0_u32..).zip(options).find(|(_, option)| **option == text).map(|(index, _)| index);
            let failure = || {
                let message = format!("`{name}` has no option `{text}`");
                Failure::usage(message).help(format!("options: {}", options.join(", ")))
            };
            index.map(f64::from).ok_or_else(failure)
        }
        Kind::Number(range) | Kind::Following(range, _) => {
            // A bare number is in SI units, as in a grid file.
            let number = units::parse_as(text, "").or_else(|_| units::parse_as(text, parameter.unit));
            let number = number.map_err(|error| {
                let failure = Failure::usage(format!("--set {name}={text}: {}", error.message("the value")));
                error.help().into_iter().fold(failure, Failure::help)
            })?;
            if range.contains(number) {
                return Ok(number);
            }
            Err(Failure::usage(format!("`{name}` must be {}, not {text}", range.describe())))
        }
    }
}

/// The summary of a run.
fn page(plan: &Plan, args: &RunArgs, row: &Row) -> String {
    let mut page = format!("{} from {}", plan.simulator.name(), plan.preset);
    if plan.len() > 1 {
        let _ = write!(page, ", point {} of {}", args.point, plan.len());
    }
    let residual = if row.residual.is_nan() { "none".to_owned() } else { six_digits(row.residual) };
    let Row { cycles, period, rhs_evals, .. } = row;
    let _ = write!(page, "\nstatus = {}, cycles = {cycles}, residual = {residual}, ", row.status.name());
    let _ = writeln!(page, "period = {period}, rhs_evals = {rhs_evals}");
    if !row.measures.is_empty() {
        let mut table = Table::with_headings(&["column", "value", "unit", "meaning"]);
        for (column, &measure) in plan.simulator.columns().iter().zip(&row.measures) {
            table.row([column.name.clone(), six_digits(measure), column.unit.to_owned(), column.doc.clone()]);
        }
        page += "\n";
        page += &table.text();
    }
    page
}

/// The number to six digits.
pub(super) fn six_digits(number: f64) -> String {
    format!("{number:.5e}").parse().map_or_else(|_| String::new(), text::float)
}
