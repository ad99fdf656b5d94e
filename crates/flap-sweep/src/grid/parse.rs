//! Reads whole grid files from a path, a stream or a text.

use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use flap_core::parameter::Parameter;
use flap_core::simulate::{Rows, Simulator};
use flap_core::vehicle::of_all_wings;
use toml::de::DeTable;

use super::designs::{self, Start};
use super::device::{Base, Reader};
use super::diagnostic::{self, Mistakes, Problems};
use super::formula::{self, Names};
use super::lookup::Lookup;
use super::table::{self, Entry};
use super::vehicle::{self, VehicleSettings};
use super::{axes, gradient, output, refine, resonance, sample, solver};
use crate::input::{self, InputError, MOST_BYTES};
use crate::plan::axes::{Axes, Axis};
use crate::plan::formula::{Condition, Derived};
use crate::plan::{Differences, Plan, PointsFile, Robot, Source, Space, Value};
use crate::resonance::AtResonance;
use crate::vehicle::BodyRows;

/// Reads the grid file at `path` and returns its plan. The grid file can name any preset of a model in
/// `models`.
///
/// # Errors
/// Returns an error if the file cannot be read or has mistakes.
pub fn read(path: &Path, models: &[&'static dyn Simulator]) -> Result<Plan, ReadError> {
    let file = input::open(path).map_err(|error| ReadError::Input { path: path.to_owned(), error })?;
    read_from(file, path, models)
}

/// Reads a grid file from a stream, such as stdin, and returns its plan. The grid file can name any preset of
/// a model in `models`.
///
/// `name` is the file name that messages and sidecars contain for the stream. Paths in the grid file are
/// relative to the folder of `name`.
///
/// # Errors
/// Returns an error if the stream cannot be read or the grid has mistakes.
pub fn read_from(
    source: impl io::Read,
    name: &Path,
    models: &[&'static dyn Simulator],
) -> Result<Plan, ReadError> {
    let refused = |error| ReadError::Input { path: name.to_owned(), error };
    let bytes = input::beginning(source, MOST_BYTES).map_err(refused)?;
    if looks_like_results(&bytes) {
        return Err(ReadError::Results(name.to_owned()));
    }
    let text = input::of_bytes(bytes, MOST_BYTES).map_err(refused)?;
    parse(&name.display().to_string(), &text, models).map_err(ReadError::Grid)
}

/// Checks the text of a grid file and returns its plan. The grid file can name any preset of a model in
/// `models`. `name` is the file name in messages.
///
/// # Errors
/// Returns the mistakes in the order of the file. If the file is not valid TOML, only syntax errors are
/// reported.
pub fn parse(name: &str, text: &str, models: &[&'static dyn Simulator]) -> Result<Plan, Mistakes> {
    plan(name, text, Reader { models, recorded: None })
}

/// Returns the plan of a grid file that was recorded with results. The devices of the grid are read from the
/// recorded texts in `devices`, not from files.
///
/// # Errors
/// Returns the mistakes in the order of the file.
pub fn parse_recorded(
    name: &str,
    text: &str,
    devices: &[Source],
    models: &[&'static dyn Simulator],
) -> Result<Plan, Mistakes> {
    plan(name, text, Reader { models, recorded: Some(devices) })
}

/// Reason why flap cannot make a plan from a grid file.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// The file cannot be read as text.
    #[error("{}", located(path, error))]
    Input {
        /// Path of the file.
        path: PathBuf,
        /// The reason.
        #[source]
        error: InputError,
    },
    /// The file contains results.
    #[error("{} contains results and is not a grid file", .0.display())]
    Results(PathBuf),
    /// The text is not a valid grid file. The error contains the mistakes in the order of the file.
    #[error("{}", one_per_line(.0))]
    Grid(Mistakes),
}

impl ReadError {
    /// Returns advice for the user, if there is advice for this mistake.
    pub fn help(&self) -> Option<String> {
        match self {
            ReadError::Results(path) => Some(format!("did you mean `flap plot {}`?", path.display())),
            ReadError::Input { error: InputError::TooLarge(_), .. } => {
                Some("put long lists of points into a CSV file: [sample] with `method = \"file\"`".to_owned())
            }
            _ => None,
        }
    }
}

fn plan(name: &str, text: &str, reader: Reader<'_>) -> Result<Plan, Mistakes> {
    let source = Arc::new(Source { name: name.to_owned(), text: text.to_owned() });
    let mut problems = Problems::new(Arc::clone(&source));
    let (root, errors) = DeTable::parse_recoverable(text);
    if !errors.is_empty() {
        diagnostic::report_syntax(&errors, &mut problems);
        return Err(problems.into_mistakes());
    }

    let document = root.get_ref();
    let root = table::entries(document);
    let designs = designs::read(&root, reader, &mut problems);
    let model = designs.as_ref().map(|designs| designs.bases[0].robot.model());
    let start = designs.and_then(|designs| designs.start(&root, reader, &mut problems));
    report_unknown_keys(&root, model, &mut problems);
    let solver = solver::read(table::find(&root, "solver"), &mut problems);
    let output_entry = table::find(&root, "output");
    // Without a model, parameters and columns cannot be checked.
    let Some((start, settings)) = start else {
        output::read(output_entry, None, &mut problems);
        return Err(problems.into_mistakes());
    };
    let (robot, preset) = (start.base.robot.clone(), start.base.preset);
    let Points {
        base,
        differences,
        axes,
        sample_file,
        resonance,
        body,
        derived,
        conditions,
        unreached,
        mut names,
    } = read_points(&root, start, &robot, settings, reader.models, &mut problems);
    names.are_measured = true;
    let measure_names = formula::read_measures(table::find(&root, "measure"), &mut names, &mut problems);
    let section = table::find(&root, "gradient");
    let at_resonance = resonance.is_some();
    let gradient =
        gradient::read(section, &robot, &names, &derived, at_resonance, body.as_ref(), &mut problems);
    let columns =
        names.columns.iter().map(|column| column.name.clone()).chain(measure_names).collect::<Vec<_>>();
    let output = output::read(output_entry, Some((&robot, &columns)), &mut problems);
    let refine = table::find(&root, "refine").and_then(|section| {
        let rows = refine::Rows { columns: &columns, own: &names.own, output: &output };
        let mut lookup = Lookup { robot: &robot, models: reader.models, problems: &mut problems };
        refine::read(section, &axes, table::find(&root, "sample"), &rows, &mut lookup)
    });

    if !problems.is_empty() {
        return Err(problems.into_mistakes());
    }
    let (axes, spans): (Vec<Axis>, Vec<_>) =
        axes.into_iter().map(|placed| (placed.axis, placed.span)).unzip();
    let axes = Axes::new(axes).map_err(|error| {
        axes::report_too_many_points(&error, &spans, &mut problems);
        problems.into_mistakes()
    })?;
    Ok(Plan::new(Space {
        robot: base.robot,
        resonance,
        body,
        preset: preset.name,
        base: base.values,
        with_units: base.with_units,
        uncertainty: base.uncertainty,
        devices: base.devices,
        differences,
        axes,
        refine,
        points_file: sample_file,
        derived,
        conditions,
        measures: names.own,
        gradient,
        solver,
        output,
        unreached,
        source: (*source).clone(),
    }))
}

/// Contents of all sections that describe the points of a grid file.
struct Points<'n> {
    base: Base,
    differences: Differences,
    axes: Vec<axes::Placed>,
    sample_file: Option<PointsFile>,
    resonance: Option<AtResonance>,
    body: Option<BodyRows>,
    derived: Derived,
    conditions: Vec<Condition>,
    /// Parameters that the grid file sets for all wings without effect, because each wing has its own value.
    unreached: Vec<&'static Parameter<'static>>,
    names: Names<'n>,
}

/// Reads the sections `[params]`, `[resonance]`, `[axes]`, `[[zip]]`, `[sample]`, `[derived]` and `[where]`.
fn read_points<'n>(
    root: &[Entry<'_>],
    start: Start,
    robot: &'n Robot,
    settings: VehicleSettings,
    models: &[&'static dyn Simulator],
    problems: &mut Problems,
) -> Points<'n> {
    let Start { mut base, designs, presets, mut differences, axis } = start;
    let set = base.set(root, models, problems);
    for (parameter, _) in &set {
        differences.remove(*parameter);
    }
    let parameters = robot.parameters();
    let mut lookup = Lookup { robot, models, problems };
    let mut axes: Vec<axes::Placed> = axis.into_iter().collect();
    axes.extend(axes::read(table::find(root, "axes"), &mut lookup));
    axes.extend(axes::read_zip(table::find(root, "zip"), &mut lookup));
    let drafts = formula::derived_drafts(table::find(root, "derived"), &mut lookup);
    let varied = axes.iter().flat_map(|placed| placed.axis.parameters()).map(|(parameter, _)| *parameter);
    let derived = drafts.iter().map(|(parameter, _)| *parameter);
    let moved: Vec<usize> =
        varied.chain(derived).chain(sample::sampled(table::find(root, "sample"), parameters)).collect();
    let means = default_means(&base, parameters, &moved);
    let sample = sample::read(table::find(root, "sample"), &base, &means, &mut lookup);
    let (sampled, sample_file) = sample.map_or((None, None), |(placed, file)| (Some(placed), file));
    axes.extend(sampled);
    axes.sort_by_key(|placed| placed.span.start);
    axes::report_repeats(&axes, &set, &mut lookup);
    formula::report_derived_twice(
        &drafts,
        &axes,
        &[("set under [params]", &set), ("set in [vehicle]", &settings.set)],
        problems,
    );
    for placed in &axes {
        for ((parameter, _), has_units) in placed.axis.parameters().iter().zip(&placed.with_units) {
            base.with_units.note(*parameter, *has_units);
        }
    }
    for (parameter, _) in &drafts {
        base.with_units.note(*parameter, Some(false));
    }
    let moved = axes.iter().flat_map(|placed| placed.axis.parameters()).map(|(parameter, _)| *parameter);
    let varied: Vec<usize> = moved.collect();
    let derived: Vec<usize> = drafts.iter().map(|(parameter, _)| *parameter).collect();
    let moved = [varied.as_slice(), &derived].concat();
    // Standard errors belong to the values of the device, not to the values of formulas.
    for parameter in &derived {
        base.uncertainty.set(*parameter, None);
    }
    let chosen: Vec<usize> =
        set.iter().map(|(parameter, _)| *parameter).chain(moved.iter().copied()).collect();
    let is_set = |parameter: usize| base.values[parameter].given().is_some() || moved.contains(&parameter);
    let body = settings.body_rows(&base, is_set, &varied, &derived, problems);
    settings.report_frequencies(parameters, |parameter| chosen.contains(&parameter), problems);
    let unreached =
        base.robot.vehicle().map_or_else(Vec::new, |vehicle| vehicle::unreached(vehicle, &chosen, is_set));

    let is_vehicle = base.robot.vehicle().is_some();
    let resonance = resonance::read(root, base.robot.model(), is_vehicle, &mut base.values, problems);

    let mut unset: Vec<Option<&str>> = base.values.iter().map(|value| formula::followed(*value)).collect();
    for parameter in moved {
        unset[parameter] = None;
    }
    let preset = presets.into_iter().map(|preset| Value::of_preset(parameters, preset)).collect();
    let device = (!base.devices.is_empty()).then_some(designs);
    let columns = match (&resonance, &body) {
        (Some(resonance), _) => resonance.columns(),
        (None, Some(body)) => body.columns(),
        (None, None) => robot.columns(),
    };
    let columns = columns.to_vec();
    let is_input = |index: &usize| body.as_ref().is_some_and(|body| body.has_input(*index));
    let inputs: Vec<usize> = (0..parameters.len()).filter(is_input).collect();
    let own = Vec::new();
    let names = Names { parameters, preset, device, unset, inputs, columns, are_measured: false, own };
    let derived = formula::read_derived(&drafts, &names, problems);
    let conditions = formula::read_conditions(table::find(root, "where"), &names, problems);
    Points { base, differences, axes, sample_file, resonance, body, derived, conditions, unreached, names }
}

/// Returns the value that each parameter would have if the grid file had no sample. If a normal distribution
/// has no mean in the file, its mean is this value.
///
/// If a parameter of one wing is not set, it has the value of the corresponding parameter of all wings. The
/// value for all wings is not used if the parameter of all wings is in `moved`, the list of varied, sampled
/// and derived parameters.
fn default_means(base: &Base, parameters: &[Parameter<'_>], moved: &[usize]) -> Vec<Value> {
    let mean = |index: usize| {
        let own = base.values[index];
        let shared = of_all_wings(parameters, index);
        let shared = shared.filter(|shared| own.given().is_none() && !moved.contains(shared));
        shared.map_or(own, |shared| base.values[shared])
    };
    (0..base.values.len()).map(mean).collect()
}

fn report_unknown_keys(root: &[Entry<'_>], model: Option<&'static dyn Simulator>, problems: &mut Problems) {
    for entry in root.iter().filter(|entry| !table::KEYS.contains(&entry.key)) {
        let diagnostic =
            table::report_unknown_key(entry, &table::KEYS, "at the top of a grid file", problems);
        if model.is_some_and(|model| Parameter::index(model.parameters(), entry.key).is_some()) {
            diagnostic.help.clear();
            diagnostic.help("parameters go into [params], or into [axes] to vary them");
        }
    }
}

/// Returns true if `bytes` begin like a results file: like compressed data, like a Parquet file, or with the
/// header line of a CSV table.
fn looks_like_results(bytes: &[u8]) -> bool {
    const ZSTD: [u8; 4] = [0x28, 0xb5, 0x2f, 0xfd];
    let header = bytes.split(|byte| *byte == b'\n').next().unwrap_or_default();
    let mut columns = header.split(|byte| *byte == b',');
    let is_table = columns.next() == Some(b"point") && columns.any(|column| column == b"status");
    is_table || bytes.starts_with(&ZSTD) || bytes.starts_with(b"PAR1")
}

/// Returns text that contains the path of the file and then the message of `error`. If the message names a
/// position, the line and column stand after the path, so that terminals show a link.
fn located(path: &Path, error: &InputError) -> String {
    let path = path.display();
    match error {
        InputError::NotUtf8 { byte, line, column } => {
            format!("{path}:{line}:{column}: not UTF-8 text at byte {byte}: save the file as UTF-8")
        }
        _ => format!("{path}: {error}"),
    }
}

fn one_per_line(mistakes: &Mistakes) -> String {
    let mut lines: Vec<String> = mistakes.iter().map(ToString::to_string).collect();
    if mistakes.more() > 0 {
        lines.push(format!("and {} more", mistakes.more()));
    }
    lines.join("\n")
}
