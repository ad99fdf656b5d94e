//! `flap run`: runs one or several design points.

use std::fmt::Write as _;
use std::path::Path;

use flap_core::parameter::Parameter;
use flap_core::simulate::{Row, Status, Trajectory, TrajectoryRequest};
use flap_sweep::files::inputs::Inputs;
use flap_sweep::notation::expression::Kind;
use flap_sweep::notation::text::{self, count};
use flap_sweep::study::deviation;
use flap_sweep::table::layout::fixed_columns;

use super::gradient::{self, Gradient};
use super::grid::is_stdin;
use super::motion::write_motions_file;
use super::point::{Chosen, check_one_wing, find_parameter};
use super::samples::{self, DriveRecord};
use super::{deviations, outputs};
use crate::args::{OutputFormat, PointArgs, RunArgs, SolverArgs};
use crate::console::{self, shell_word};
use crate::failure::{Exit, Failure};
use crate::print::{self, Keyed};
use crate::table::{self, Table, six_digits, wrapped};

pub(crate) fn run(args: &RunArgs) -> Result<Exit, Failure> {
    let points = args.designs();
    check_designs(&points, args)?;
    let mut inputs = Inputs::new();
    for record in args.waveform.iter().chain(&args.stroke) {
        inputs.add("the record", record);
    }
    outputs::check_tables(&inputs, [args.trajectory.as_deref()])?;
    let record = samples::read(args)?;
    let designs = points.iter().map(|point| Design::of(point, record.as_ref(), args));
    let designs = designs.collect::<Result<Vec<Design>, Failure>>()?;
    for design in &designs {
        inputs.add_plan(&design.chosen.plan);
    }
    outputs::check_tables(&inputs, [args.trajectory.as_deref()])?;
    if let Some(path) = &args.trajectory {
        trajectories(&designs, path, args)?;
        if args.once || console::is_stdout(path) {
            return Ok(Exit::Done);
        }
    }
    settle(&designs, args)
}

/// Returns an error if the designs of the command line are too many or repeated, or if an option requires one
/// design.
fn check_designs(points: &[PointArgs], args: &RunArgs) -> Result<(), Failure> {
    if points.len() > MOST_DESIGNS {
        let message =
            format!("{} designs are too many for `flap run`, which takes up to {MOST_DESIGNS}", points.len());
        return Err(Failure::usage(message).help("sweep many designs with `flap sweep`"));
    }
    if points.len() > 1 && points.iter().any(|point| is_stdin(Path::new(&point.what))) {
        let message = "several designs require grid files with names, because stdin is read once";
        return Err(Failure::usage(message).help("save the grid in a file"));
    }
    if points.len() > 1 && args.gradient.is_some() {
        let message = "--gradient requires one design, but the command line gives several";
        return Err(
            Failure::usage(message).help("sweep derivatives of many designs with [gradient] in a grid file")
        );
    }
    let is_repeated = |place: usize| points[..place].iter().any(|other| *other == points[place]);
    if let Some(place) = (0..points.len()).find(|&place| is_repeated(place)) {
        return Err(Failure::usage(format!(
            "the command line gives the same design of {} twice",
            points[place].what
        )));
    }
    for (place, (name, _)) in args.each.iter().enumerate() {
        let is_twice = args.each[..place].iter().any(|(other, _)| other == name);
        let is_set = points.iter().any(|point| point.changes.set.iter().any(|(other, _)| other == name));
        if is_twice || is_set {
            return Err(Failure::usage(format!("the command line sets {name} twice"))
                .help("remove --set or one --each"));
        }
    }
    Ok(())
}

/// Largest number of designs in one call of `flap run`, which runs the designs one after another.
const MOST_DESIGNS: usize = 1000;

/// One of the designs that the command line gives.
struct Design {
    chosen: Chosen,
    point: PointArgs,
    /// Index of the measure that `--gradient` names.
    measure: Option<usize>,
    /// Names and values of the columns that distinguish this design from the other designs of the command
    /// line.
    keys: Vec<(String, String)>,
}

impl Design {
    fn of(point: &PointArgs, record: Option<&DriveRecord>, args: &RunArgs) -> Result<Design, Failure> {
        let chosen = Chosen::driven_by(record, point, &args.solver)?;
        if let Some(option) = one_wing_option(args) {
            check_one_wing(&chosen.plan, &point.what, &format!("`flap run` with {option}"))?;
        }
        deviations::warn(&deviation::of_point(&chosen.plan, &chosen.values, |parameter| {
            chosen.has_unit(parameter)
        }));
        let measure =
            args.gradient.as_deref().map(|column| gradient::measure(&chosen, column)).transpose()?;
        let name = args.name(&point.what).map(|name| ("design".to_owned(), name));
        let mut keys: Vec<(String, String)> = name.into_iter().collect();
        for (name, _) in &args.each {
            let parameters = chosen.plan.parameters();
            let index = find_parameter(parameters, name)?;
            keys.push((name.clone(), text::value(&parameters[index], chosen.values[index])));
        }
        Ok(Design { chosen, point: point.clone(), measure, keys })
    }

    /// Returns a line that describes the design: its model, its preset, and the values of the parameters of
    /// `--each`.
    fn title(&self) -> String {
        let parameters = self.chosen.plan.parameters();
        let values = self.keys.iter().filter_map(|(name, _)| {
            let index = Parameter::index(parameters, name)?;
            Some(format!(", {}", table::assignment(&parameters[index], self.chosen.values[index])))
        });
        self.chosen.title() + &values.collect::<String>()
    }
}

/// Writes the motions of the designs over time to the file `path`.
fn trajectories(designs: &[Design], path: &Path, args: &RunArgs) -> Result<(), Failure> {
    check_length(designs.len(), args)?;
    let request = TrajectoryRequest {
        cycles: if args.once { 1 } else { args.cycles },
        samples_per_cycle: args.samples,
        settled: !args.from_rest && !args.once,
    };
    let motions = designs.iter().map(|Design { chosen, .. }| {
        Ok(chosen.simulator().motions()?.trajectory(&chosen.run(), &request)?)
    });
    let motions = motions.collect::<Result<Vec<Trajectory>, Failure>>()?;
    let keyed = designs.iter().zip(&motions).map(|(design, motion)| Keyed { keys: &design.keys, motion });
    let keyed: Vec<Keyed> = keyed.collect();
    write_motions_file(&keyed, path, args.overwrite.force, "sample")
}

/// If the user gave an option that does not support vehicles, returns this option.
fn one_wing_option(args: &RunArgs) -> Option<&'static str> {
    let options = [
        (args.trajectory.is_some(), "--trajectory"),
        (args.waveform.is_some(), "--waveform"),
        (args.stroke.is_some(), "--stroke"),
    ];
    options.into_iter().find_map(|(is_given, option)| is_given.then_some(option))
}

/// Computes the settled motions of the designs, and prints their rows.
fn settle(designs: &[Design], args: &RunArgs) -> Result<Exit, Failure> {
    let mut rows = Vec::new();
    for Design { chosen, .. } in designs {
        let mut row = chosen.row();
        chosen.plan.add_own_measures(&chosen.values, &mut row.measures);
        if let (Status::Invalid, Some(reason)) = (row.status, &row.reason) {
            return Err(Failure::usage(format!("the parameters are impossible together: {reason}")));
        }
        rows.push(row);
    }
    let gradient = match (designs, rows.as_slice()) {
        ([Design { chosen, measure: Some(measure), .. }], [row]) => {
            Some(Gradient::of(chosen, row, *measure)?)
        }
        _ => None,
    };
    match gradient {
        Some(gradient) if args.format != OutputFormat::Table => gradient.print(args.format)?,
        gradient => {
            print_rows(designs, &rows, args.format)?;
            if let Some(gradient) = gradient {
                console::results(&format!("\n{}", gradient.page()))?;
            }
        }
    }
    for (design, _) in designs.iter().zip(&rows).filter(|(_, row)| row.status == Status::Unsettled) {
        console::say(&longer_run(design, args));
    }
    Ok(Exit::Done)
}

/// Prints the rows of the designs. For several designs, the first columns in csv and json identify the
/// design.
fn print_rows(designs: &[Design], rows: &[Row], format: OutputFormat) -> Result<(), Failure> {
    let keys = designs.iter().flat_map(|design| &design.keys).map(|(name, _)| name.as_str());
    let keys = keys.take(designs.first().map_or(0, |design| design.keys.len()));
    let names: Vec<&str> = keys.chain(NAMES).collect();
    let all = designs.iter().zip(rows).flat_map(|(design, row)| {
        let keys = design.keys.iter().map(|(_, value)| value.clone()).collect::<Vec<String>>();
        cells(&design.chosen, row).into_iter().map(move |cells| [keys.clone(), cells].concat())
    });
    print::table(format, &names, &all.collect::<Vec<_>>(), || {
        let pages = designs.iter().zip(rows).map(|(design, row)| page(design, row));
        pages.collect::<Vec<String>>().join("\n")
    })
}

/// Returns a message that a point did not settle, with a command that runs the point longer.
fn longer_run(design: &Design, args: &RunArgs) -> String {
    let cycles = design.chosen.plan.solver().max_cycles;
    let PointArgs { what, point, changes } = &design.point;
    let mut command = format!("flap run {}", shell_word(what));
    if *point > 0 {
        let _ = write!(command, " --point {point}");
    }
    for (_, name, value) in changes.all() {
        let _ = write!(command, " --set {}", shell_word(&format!("{name}={value}")));
    }
    for (option, path) in [("waveform", &args.waveform), ("stroke", &args.stroke)] {
        if let Some(path) = path {
            let _ = write!(command, " --{option} {}", shell_word(&path.display().to_string()));
        }
    }
    let SolverArgs { rtol, accuracy, settle_tol, .. } = args.solver;
    for (option, value) in [("rtol", rtol), ("accuracy", accuracy), ("settle-tol", settle_tol)] {
        if let Some(value) = value {
            let _ = write!(command, " --{option} {}", text::float(value));
        }
    }
    let periods = count(cycles.into(), "drive period");
    let longer = cycles.saturating_mul(10);
    format!(
        "the point did not settle within {periods}. To run it longer: {command} --max-cycles {longer}. \
         If the residual does not fall with more periods, lower --rtol or raise --settle-tol"
    )
}

/// Largest number of samples in the motions of one command, because flap stores these motions in memory.
const SAMPLES_MAX: u64 = 5_000_000;

fn check_length(designs: usize, args: &RunArgs) -> Result<(), Failure> {
    let cycles = if args.once { 1 } else { args.cycles };
    let samples = designs as u64 * u64::from(cycles) * u64::from(args.samples);
    if samples <= SAMPLES_MAX {
        return Ok(());
    }
    let designs = (designs > 1).then_some("the number of designs");
    let cycles = (!args.once).then_some("--cycles");
    let factors: Vec<&str> = designs.into_iter().chain(cycles).chain(["--samples"]).collect();
    let product = factors.join(" times ");
    let message = format!("{samples} samples are too many: {product} must be at most {SAMPLES_MAX}");
    Err(Failure::usage(message))
}

/// Columns of a row in csv and json.
const NAMES: [&str; 4] = ["column", "value", "unit", "meaning"];

/// Returns the row of a design as text for a terminal: the status, numbers about the computation, and a table
/// of the measures.
fn page(design: &Design, row: &Row) -> String {
    let chosen = &design.chosen;
    let run_values = run_values(row, six_digits).into_iter();
    let run_values = run_values.filter(|(name, value)| !(*name == "error_estimate" && value.is_empty()));
    let run_values = run_values
        .map(|(name, value)| format!("{name} = {}", if value.is_empty() { "none" } else { &value }));
    let mut page =
        format!("{}\n{}\n", design.title(), wrapped(&run_values.collect::<Vec<_>>().join(", "), 0));
    if !row.measures.is_empty() {
        page += "\n";
        page += &Table::of(&NAMES, measures(chosen, row, six_digits)).text_within(console::width());
    }
    page
}

/// Returns the row of a design for csv and json, in the columns [`NAMES`] and with all digits.
fn cells(chosen: &Chosen, row: &Row) -> Vec<Vec<String>> {
    let columns = fixed_columns();
    let meaning =
        |name: &str| columns.iter().find(|column| column.name == name).map(|column| column.doc.clone());
    let run_values = run_values(row, text::float)
        .into_iter()
        .map(|(name, value)| vec![name.to_owned(), value, String::new(), meaning(name).unwrap_or_default()]);
    run_values.chain(measures(chosen, row, text::float)).collect()
}

/// Returns the status of a row and numbers about its computation, such as `cycles`, with the names of their
/// columns. If the row does not have one of the numbers, the cell for this number is empty.
fn run_values(row: &Row, number: fn(f64) -> String) -> [(&'static str, String); 8] {
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

/// Returns the measures of a row in the columns [`NAMES`]. The list is empty if the row has no measures.
fn measures(chosen: &Chosen, row: &Row, number: fn(f64) -> String) -> Vec<Vec<String>> {
    let columns = chosen.columns();
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
