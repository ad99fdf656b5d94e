//! `flap run`: one design point.

use std::fmt::Write as _;
use std::io;

use flap_core::simulate::{Row, Status, TrajectoryRequest};
use flap_sweep::files::inputs::Inputs;
use flap_sweep::notation::expression::Kind;
use flap_sweep::notation::text::{self, count};
use flap_sweep::study::deviation;
use flap_sweep::table::layout::fixed_columns;

use super::gradient::{self, Gradient};
use super::motion::write_file;
use super::point::{Chosen, check_one_wing};
use super::{far, outputs, samples};
use crate::args::{OutputFormat, PointArgs, RunArgs};
use crate::console::{self, shell_word};
use crate::failure::{Exit, Failure};
use crate::print::{self, write_csv};
use crate::table::{Table, six_digits, wrapped};

pub(crate) fn run(args: &RunArgs) -> Result<Exit, Failure> {
    let mut chosen = Chosen::new(&args.point, &args.solver)?;
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
    outputs::check_tables(&inputs, [args.trajectory.as_deref()])?;
    samples::apply(&mut chosen, args)?;
    settle(&chosen, args, measure)
}

/// Returns an option of the command line that requires a single wing, if the user gave such an option.
fn of_one_wing(args: &RunArgs) -> Option<&'static str> {
    let options = [
        (args.trajectory.is_some(), "--trajectory"),
        (args.waveform.is_some(), "--waveform"),
        (args.stroke.is_some(), "--stroke"),
    ];
    options.into_iter().find_map(|(is_given, option)| is_given.then_some(option))
}

/// Runs the point until its motion settles, and prints its row.
fn settle(chosen: &Chosen, args: &RunArgs, measure: Option<usize>) -> Result<Exit, Failure> {
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
        return Err(Failure::usage(format!("the combination of parameter values is impossible: {reason}")));
    }
    let gradient = measure.map(|measure| Gradient::of(chosen, &row, measure)).transpose()?;
    match gradient {
        Some(gradient) if args.format != OutputFormat::Table => gradient.print(args.format)?,
        gradient => {
            print::table(args.format, &NAMES, &cells(chosen, &row), || page(chosen, &row))?;
            if let Some(gradient) = gradient {
                console::results(&format!("\n{}", gradient.page()))?;
            }
        }
    }
    if row.status == Status::Unsettled {
        console::say(&longer(chosen, args));
    }
    Ok(Exit::Done)
}

/// Returns a line with a command that runs an unsettled point for more drive periods.
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
        "the point did not settle within {periods}. To run it longer: {command} --max-cycles {longer}. \
         If the residual does not fall with more periods, lower --rtol or raise --settle-tol"
    )
}

/// Largest number of samples in a trajectory, which is held in memory.
const SAMPLES_MAX: u64 = 5_000_000;

fn check_length(args: &RunArgs) -> Result<(), Failure> {
    let samples = u64::from(args.cycles) * u64::from(args.samples);
    if samples <= SAMPLES_MAX {
        return Ok(());
    }
    let message =
        format!("{samples} samples are too many: --cycles times --samples must be at most {SAMPLES_MAX}");
    Err(Failure::usage(message))
}

/// Columns of a row in csv and json.
const NAMES: [&str; 4] = ["column", "value", "unit", "meaning"];

/// Returns the row as text for a terminal: status and numbers of the run, and a table of the measures.
fn page(chosen: &Chosen, row: &Row) -> String {
    let course = course(row, six_digits).into_iter();
    let course = course.filter(|(name, value)| !(*name == "error_estimate" && value.is_empty()));
    let course =
        course.map(|(name, value)| format!("{name} = {}", if value.is_empty() { "none" } else { &value }));
    let mut page = format!("{}\n{}\n", chosen.title(), wrapped(&course.collect::<Vec<_>>().join(", "), 0));
    if !row.measures.is_empty() {
        page += "\n";
        page += &Table::of(&NAMES, measures(chosen, row, six_digits)).text_within(console::width());
    }
    page
}

/// Returns the row in the columns [`NAMES`], with all digits.
fn cells(chosen: &Chosen, row: &Row) -> Vec<Vec<String>> {
    let columns = fixed_columns();
    let meaning =
        |name: &str| columns.iter().find(|column| column.name == name).map(|column| column.doc.clone());
    let course = course(row, text::float)
        .into_iter()
        .map(|(name, value)| vec![name.to_owned(), value, String::new(), meaning(name).unwrap_or_default()]);
    course.chain(measures(chosen, row, text::float)).collect()
}

/// Returns status and numbers of a run, with the names of their columns. A number that does not apply to the run is
/// empty.
fn course(row: &Row, number: fn(f64) -> String) -> [(&'static str, String); 8] {
    let number = |value: f64| if value.is_nan() { String::new() } else { number(value) };
    [
        ("status", row.status.name().to_owned()),
        ("cycles", row.cycles.to_string()),
        ("residual", number(row.residual)),
        ("period", row.period.to_string()),
        ("floquet_max", number(row.floquet_max)),
        ("stable", row.stable().map_or_else(String::new, |stable| stable.to_string())),
        ("error_estimate", number(row.error_estimate)),
        ("rhs_evals", row.rhs_evals.to_string()),
    ]
}

/// Returns the measures in the columns [`NAMES`]; empty if the row has no measures.
fn measures(chosen: &Chosen, row: &Row, number: fn(f64) -> String) -> Vec<Vec<String>> {
    let columns = chosen.plan.simulator().columns();
    let of_model = columns.iter().zip(&row.measures).map(|(column, &measure)| {
        vec![column.name.clone(), number(measure), column.unit.to_owned(), column.doc.clone()]
    });
    let own = chosen.plan.measures().iter().zip(row.measures.iter().skip(columns.len()));
    let own = own.map(|(own, &measure)| {
        let value = match own.kind() {
            Kind::Number => number(measure),
            Kind::Condition => text::truth(measure),
        };
        vec![
            own.name.clone(),
            value,
            String::new(),
            "measure of the table [measure] in the grid file".to_owned(),
        ]
    });
    of_model.chain(own).collect()
}
