//! `flap run`: one design point.

use std::fmt::Write as _;
use std::io;

use flap_core::simulate::{ChirpRequest, Row, Status, TrajectoryRequest};
use flap_sweep::files::inputs::Inputs;
use flap_sweep::notation::expression::Kind;
use flap_sweep::notation::text::{self, count};
use flap_sweep::study::{deviation, experiment};

use super::motion::{write_csv, write_file};
use super::outputs::is_stdout;
use super::params::wrapped;
use super::point::{Chosen, check_one_wing};
use super::{far, gradient, impulse, outputs, samples};
use crate::args::{Drive, PointArgs, RunArgs};
use crate::console::{self, shell_word};
use crate::failure::{Exit, Failure};
use crate::table::{Table, six_digits};

pub(crate) fn run(args: &RunArgs) -> Result<Exit, Failure> {
    let mut chosen = Chosen::new(&args.point, &args.solver)?;
    refuse_strays(args)?;
    if let Some(option) = of_one_wing(args) {
        check_one_wing(&chosen.plan, &args.point.what, &format!("`flap run` with {option}"))?;
    }
    far::warn(&deviation::of_point(&chosen.plan, &chosen.values, |parameter| chosen.has_unit(parameter)));
    let mut inputs = Inputs::new();
    inputs.add_plan(&chosen.plan);
    for record in args.waveform.iter().chain(&args.stroke) {
        inputs.add("the record", record);
    }
    let measure = args.gradient.as_deref().map(|column| gradient::measure(&chosen, column)).transpose()?;
    outputs::check_tables(&inputs, [args.trajectory.as_deref(), args.envelope.as_deref()])?;
    samples::apply(&mut chosen, args)?;
    match args.drive {
        Drive::Steady => steady(&chosen, args, measure),
        Drive::Chirp => chirp(&chosen, args),
        Drive::Impulse => impulse::run(&chosen, args),
    }
}

/// The option that follows the motion of a wing, if there is one.
fn of_one_wing(args: &RunArgs) -> Option<&'static str> {
    let options = [
        (args.drive == Drive::Chirp, "--drive chirp"),
        (args.drive == Drive::Impulse, "--drive impulse"),
        (args.trajectory.is_some(), "--trajectory"),
        (args.waveform.is_some(), "--waveform"),
        (args.stroke.is_some(), "--stroke"),
    ];
    options.into_iter().find_map(|(is_given, option)| is_given.then_some(option))
}

/// Refuses options of another drive.
fn refuse_strays(args: &RunArgs) -> Result<(), Failure> {
    let stray = |option: &str, drive: &str| Err(Failure::usage(format!("{option} needs --drive {drive}")));
    match args.drive {
        Drive::Steady | Drive::Impulse if args.envelope.is_some() => stray("--envelope", "chirp"),
        Drive::Steady | Drive::Impulse if args.chirp_from.is_some() => stray("--chirp-from", "chirp"),
        Drive::Steady | Drive::Impulse if args.chirp_to.is_some() => stray("--chirp-to", "chirp"),
        Drive::Steady | Drive::Impulse if args.chirp_rate.is_some() => stray("--chirp-rate", "chirp"),
        Drive::Steady | Drive::Chirp if args.impulse.is_some() => stray("--impulse", "impulse"),
        Drive::Steady | Drive::Chirp if args.duration.is_some() => stray("--duration", "impulse"),
        Drive::Chirp | Drive::Impulse if args.from_rest => stray("--from-rest", "steady"),
        Drive::Chirp | Drive::Impulse if args.gradient.is_some() => stray("--gradient", "steady"),
        Drive::Chirp | Drive::Impulse if args.waveform.is_some() => stray("--waveform", "steady"),
        Drive::Chirp | Drive::Impulse if args.stroke.is_some() => stray("--stroke", "steady"),
        _ => Ok(()),
    }
}

/// Runs the point's own drive until the motion settles.
fn steady(chosen: &Chosen, args: &RunArgs, measure: Option<usize>) -> Result<Exit, Failure> {
    let Chosen { plan, values, .. } = chosen;
    if let Some(path) = &args.trajectory {
        check_length(args)?;
        let request = TrajectoryRequest {
            cycles: if args.once { 1 } else { args.cycles },
            samples_per_cycle: args.samples,
            settled: !args.from_rest && !args.once,
        };
        let motion = chosen.simulator().motions()?.trajectory(&chosen.run(), &request)?;
        if path.as_os_str() == "-" {
            write_csv(&motion, io::stdout().lock())?;
            return Ok(Exit::Done);
        }
        write_file(&motion, path, args.overwrite.force, "sample")?;
        if args.once {
            return Ok(Exit::Done);
        }
    }

    let mut row = chosen.simulator().run_point(&chosen.run(), None);
    plan.add_own_measures(values, &mut row.measures);
    if let (Status::Invalid, Some(reason)) = (row.status, &row.reason) {
        return Err(Failure::usage(format!("the parameters are impossible together: {reason}")));
    }
    console::results(&page(chosen, &row))?;
    if let Some(measure) = measure {
        console::results(&format!("\n{}", gradient::strongest(chosen, &row, measure)?))?;
    }
    if row.status == Status::Unsettled {
        console::say(&longer(chosen, args));
    }
    Ok(Exit::Done)
}

/// The line with the command that runs an unsettled point longer.
fn longer(chosen: &Chosen, args: &RunArgs) -> String {
    let cycles = chosen.plan.solver().max_cycles;
    let PointArgs { what, point, set } = &args.point;
    let mut command = format!("flap run {}", shell_word(what));
    if *point > 0 {
        let _ = write!(command, " --point {point}");
    }
    for (name, value) in set {
        let _ = write!(command, " --set {}", shell_word(&format!("{name}={value}")));
    }
    let periods = count(cycles.into(), "drive period");
    let longer = cycles.saturating_mul(10);
    format!(
        "the point did not settle within {periods}. This command runs it longer: {command} --max-cycles {longer}. \
         If the residual does not fall with more periods, lower --rtol or raise --settle-tol"
    )
}

/// Most samples of one trajectory: they are held in memory.
const SAMPLES_MAX: u64 = 5_000_000;

fn check_length(args: &RunArgs) -> Result<(), Failure> {
    let samples = u64::from(args.cycles) * u64::from(args.samples);
    if samples <= SAMPLES_MAX {
        return Ok(());
    }
    let message = format!("{samples} samples are too many: --cycles times --samples may be {SAMPLES_MAX}");
    Err(Failure::usage(message))
}

/// The default frequency at which a chirp begins (Hz).
const CHIRP_FROM: f64 = 1.0;

/// The default rate of a chirp's frequency (Hz/s).
const CHIRP_RATE: f64 = 15.0;

/// Sweeps the frequency: rows per cycle to stdout or a file, the motion to a file.
fn chirp(chosen: &Chosen, args: &RunArgs) -> Result<Exit, Failure> {
    let Chosen { plan, values, .. } = chosen;
    let parameters = plan.parameters();
    let frequency = parameters.iter().position(|parameter| parameter.name == "drive_frequency");
    let from = args.chirp_from.unwrap_or(CHIRP_FROM);
    let request = ChirpRequest {
        from,
        to: args.chirp_to.or(frequency.map(|index| 2.0 * values[index])).unwrap_or(from),
        rate: args.chirp_rate.unwrap_or(CHIRP_RATE),
        samples_per_cycle: if args.trajectory.is_some() { args.samples } else { 0 },
    };
    let response = experiment::chirp(plan.simulator().experiments()?, &chosen.run(), &request)?;
    if let Some(path) = args.trajectory.as_deref().filter(|path| !is_stdout(path)) {
        write_file(&response.motion, path, args.overwrite.force, "sample")?;
    }
    if let Some(path) = args.envelope.as_deref().filter(|path| !is_stdout(path)) {
        write_file(&response.envelope, path, args.overwrite.force, "cycle")?;
    }
    if args.trajectory.as_deref().is_some_and(is_stdout) {
        write_csv(&response.motion, io::stdout().lock())?;
    } else if args.envelope.as_deref().is_none_or(is_stdout) {
        write_csv(&response.envelope, io::stdout().lock())?;
    }
    Ok(Exit::Done)
}

/// The summary of a run.
fn page(chosen: &Chosen, row: &Row) -> String {
    let mut page = chosen.title();
    let residual = if row.residual.is_nan() { "none".to_owned() } else { six_digits(row.residual) };
    let Row { cycles, period, rhs_evals, .. } = row;
    let multiplier = if row.floquet_max.is_nan() { "none".to_owned() } else { six_digits(row.floquet_max) };
    let mut course = format!("status = {}, cycles = {cycles}, residual = {residual}, ", row.status.name());
    let stable = row.stable().map_or_else(|| "none".to_owned(), |stable| stable.to_string());
    let _ = write!(course, "period = {period}, floquet_max = {multiplier}, stable = {stable}, ");
    if !row.error_estimate.is_nan() {
        let _ = write!(course, "error_estimate = {}, ", six_digits(row.error_estimate));
    }
    let _ = write!(course, "rhs_evals = {rhs_evals}");
    let _ = writeln!(page, "\n{}", wrapped(&course, 0));
    if !row.measures.is_empty() {
        let mut table = Table::with_headings(&["column", "value", "unit", "meaning"]);
        let columns = chosen.plan.simulator().columns();
        for (column, &measure) in columns.iter().zip(&row.measures) {
            table.row([column.name.clone(), six_digits(measure), column.unit.to_owned(), column.doc.clone()]);
        }
        for (own, &measure) in chosen.plan.measures().iter().zip(&row.measures[columns.len()..]) {
            let value = match own.kind() {
                Kind::Number => six_digits(measure),
                Kind::Condition => text::truth(measure),
            };
            table.row([own.name.clone(), value, String::new(), "[measure] in the grid file".to_owned()]);
        }
        page += "\n";
        page += &table.text_within(console::width());
    }
    page
}
