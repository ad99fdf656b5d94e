//! Lists the parameters of a model and the columns of its rows.

use std::fmt::Write as _;
use std::path::Path;

use flap_core::parameter::{Parameter, Preset};
use flap_core::simulate::Simulator;
use flap_sweep::notation::text;
use flap_sweep::plan::Robot;
use flap_sweep::resonance;
use flap_sweep::table::layout::fixed_columns;

use crate::args::ModelsArgs;
use crate::cmd::point;
use crate::console;
use crate::failure::Failure;
use crate::models;
use crate::print;
use crate::table::{Table, wrapped};

/// Returns true if `what` is the name of a model, a preset or a file. For a model, a preset or a file, flap
/// lists parameters.
pub(super) fn is_listed(what: &str) -> bool {
    let path = Path::new(what);
    models::preset(what).is_some()
        || models::by_name(what).is_some()
        || path.extension().is_some()
        || path.is_file()
}

/// Prints the parameters and columns of a model. If `what` is a preset or a file, flap also prints the values
/// of the parameters.
pub(super) fn list(what: &str, args: &ModelsArgs) -> Result<(), Failure> {
    let values = Values::of(what)?;
    let entries: Vec<Entry> = parameters(&values).into_iter().chain(columns(&*values.robot)).collect();
    let rows: Vec<Vec<String>> = entries.iter().map(Entry::row).collect();
    print::table(args.format, &NAMES, &rows, || head(&values.lines) + &listing(&entries, args.long))
}

/// Returns the model called `name`, or the preset called `name` with its model.
pub(super) fn of_name(name: &str) -> Result<(&'static dyn Simulator, Option<&'static Preset>), Failure> {
    let preset = models::preset(name).map(|(model, preset)| (model, Some(preset)));
    let found = preset.or_else(|| models::by_name(name).map(|model| (model, None)));
    found.ok_or_else(|| {
        let names = models::all().iter().map(|model| model.name()).chain(models::presets());
        let failure = Failure::usage(format!("there is no model or preset `{name}`"));
        failure.nearest(name, names, "`flap models` lists models and presets")
    })
}

/// A model, and the values of its parameters if they come from a preset or a file.
struct Values {
    robot: Robot,
    /// The two lines that flap prints above the list.
    lines: [String; 2],
    /// Values of the parameters in SI units, with NaN for a parameter that is not set. `None` if the user
    /// named only a model.
    numbers: Option<Vec<f64>>,
    /// Indices of the parameters that have a standard error, and their standard errors.
    errors: Vec<(usize, f64)>,
}

impl Values {
    /// Returns the model and the parameter values of a preset, a device file, or the first point of a grid
    /// file. For the name of a model, the values are `None`.
    fn of(what: &str) -> Result<Values, Failure> {
        if models::preset(what).is_none() && models::by_name(what).is_none() {
            let plan = point::plan(what)?;
            let robot = plan.robot().clone();
            let lines = [format!("{what}: based on {}", plan.preset()), of_model(&*robot)];
            // The standard errors of the device do not belong to the values of axes.
            let is_fixed = |(index, _): &(usize, f64)| plan.axes().varied().all(|varied| varied != *index);
            let errors = plan.uncertainty().errors().iter().copied().filter(is_fixed).collect();
            return Ok(Values { robot, lines, numbers: Some(plan.point(0).values), errors });
        }
        let (model, preset) = of_name(what)?;
        let lines = if let Some(preset) = preset {
            [format!("{}: {}", preset.name, preset.doc), of_model(model)]
        } else {
            let presets: Vec<&str> = model.presets().iter().map(|preset| preset.name).collect();
            [format!("{}: {}", model.name(), model.doc()), format!("presets: {}", presets.join(", "))]
        };
        Ok(Values {
            robot: Robot::of_wing(model),
            lines,
            numbers: preset.map(|preset| (preset.values)()),
            errors: Vec::new(),
        })
    }

    /// Returns true if the parameter has the value `value` in a preset of the model.
    fn is_published(&self, parameter: usize, value: f64) -> bool {
        self.robot.presets().iter().any(|preset| (preset.values)().get(parameter) == Some(&value))
    }

    /// Returns the standard error of a parameter, if the device contains a standard error.
    fn error(&self, parameter: usize) -> Option<f64> {
        self.errors.iter().find(|(index, _)| *index == parameter).map(|(_, error)| *error)
    }
}

fn of_model(model: &dyn Simulator) -> String {
    format!("model {}: {}", model.name(), model.doc())
}

/// Returns the lines above the list, wrapped to the width of the terminal.
fn head(lines: &[String; 2]) -> String {
    lines.iter().map(|line| wrapped(line, 0) + "\n").collect::<String>() + "\n"
}

/// A parameter or a column in the printed list.
struct Entry {
    /// The word `parameter`, or the kind of the column, such as `measure`.
    kind: &'static str,
    /// Title of the group to which the parameter or column belongs.
    group: String,
    name: String,
    /// Value of a parameter in the preset or file, in SI units. Empty without a value.
    value: String,
    /// Value with a unit prefix and the standard error, such as `1.52 uN*m/rad ± 0.05 uN*m/rad`. If the list
    /// contains no values, the text is only the unit.
    shown: String,
    unit: &'static str,
    symbol: &'static str,
    allowed: String,
    meaning: String,
    /// Sentences about the symbol and the allowed values of a parameter, which flap prints with `--long`.
    more: String,
    /// True if the value is a published value that was fitted to one vehicle.
    is_fit: bool,
}

const NAMES: [&str; 8] = ["kind", "group", "name", "value", "unit", "symbol", "allowed", "meaning"];

impl Entry {
    /// Returns the cells in the columns [`NAMES`].
    fn row(&self) -> Vec<String> {
        let Entry { kind, group, name, value, unit, symbol, allowed, meaning, .. } = self;
        [kind, group.as_str(), name.as_str(), value, unit, symbol, allowed, meaning].map(str::to_owned).into()
    }
}

fn parameters(of: &Values) -> Vec<Entry> {
    let entry = |(place, parameter): (usize, &Parameter)| {
        let value = of.numbers.as_ref().map(|numbers| numbers[place]);
        let error = of.error(place).map(|error| text::shown(parameter, error));
        let given = value.filter(|value| !value.is_nan());
        Entry {
            kind: "parameter",
            group: parameter.group.to_owned(),
            name: parameter.name.to_owned(),
            value: given.map_or_else(String::new, |value| text::value(parameter, value)),
            shown: match (value, given) {
                (_, Some(value)) => match &error {
                    Some(error) => format!("{} ± {error}", text::shown(parameter, value)),
                    None => text::shown(parameter, value),
                },
                (Some(_), None) => "-".to_owned(),
                (None, None) => parameter.unit.to_owned(),
            },
            unit: parameter.unit,
            symbol: parameter.symbol,
            allowed: parameter.kind.describe(),
            meaning: parameter.doc.to_owned(),
            more: more(parameter),
            is_fit: parameter.is_fitted && given.is_some_and(|value| of.is_published(place, value)),
        }
    };
    of.robot.parameters().iter().enumerate().map(entry).collect()
}

/// Returns sentences about the symbol and the allowed values of a parameter.
fn more(parameter: &Parameter) -> String {
    let mut text = String::new();
    if !parameter.symbol.is_empty() {
        let _ = write!(text, ". Symbol: {}", parameter.symbol);
    }
    let _ = write!(text, ". Allowed: {}", parameter.kind.describe());
    if parameter.is_fitted {
        text += ". The published value was fitted to one vehicle";
    }
    text
}

/// Returns the columns of a sweep's rows: measures, columns of sweeps with `drive_frequency = "resonance"`,
/// and columns that every model has.
fn columns(model: &dyn Simulator) -> Vec<Entry> {
    let entry = |kind, group: &str, name: String, unit: &'static str, meaning: String| Entry {
        kind,
        group: group.to_owned(),
        name,
        value: String::new(),
        shown: unit.to_owned(),
        unit,
        symbol: "",
        allowed: String::new(),
        meaning,
        more: String::new(),
        is_fit: false,
    };
    let own = model.columns().len();
    let measures = resonance::measures(model).into_iter().enumerate().map(|(place, column)| {
        let (kind, group) = if place < own {
            ("measure", "measures")
        } else {
            ("resonance", "measures with drive_frequency = \"resonance\"")
        };
        entry(kind, group, column.name, column.unit, column.doc)
    });
    let run = fixed_columns();
    let run =
        run.into_iter().map(|column| entry("run", "columns of every model", column.name, "", column.doc));
    measures.chain(run).collect()
}

/// Mark after a value that was fitted to one vehicle. The constant `FITS` explains the mark below the list.
const FIT: &str = " *";
const FITS: &str = "* This value was fitted to one vehicle. Measure or fit it for other vehicles.";

/// Returns the printed list: the parameters and then the columns, in groups with titles. The lines fit the
/// terminal.
fn listing(entries: &[Entry], long: bool) -> String {
    let is_parameter = |entry: &&Entry| entry.kind == "parameter";
    let has_values = entries.iter().any(|entry| !entry.value.is_empty());
    let second = if has_values { "value" } else { "unit" };
    let mut parameters = page("parameter", second, entries.iter().filter(is_parameter), long);
    if !long && entries.iter().any(|entry| entry.is_fit) {
        let _ = writeln!(parameters, "\n{}", wrapped(FITS, 2));
    }
    let columns = page("column", "unit", entries.iter().filter(|entry| !is_parameter(entry)), long);
    parameters + "\n" + &columns
}

fn page<'e>(first: &str, second: &str, entries: impl Iterator<Item = &'e Entry>, long: bool) -> String {
    let mut table = Table::with_headings(&[first, second, "meaning"]);
    let mut group = "";
    for entry in entries {
        if entry.group != group {
            group = &entry.group;
            table.title(group);
        }
        let meaning = if long {
            entry.meaning.trim_end_matches('.').to_owned() + &entry.more
        } else {
            first_sentence(&entry.meaning).to_owned()
        };
        // With --long, the meaning includes this note.
        let mark = if entry.is_fit && !long { FIT } else { "" };
        table.row([entry.name.clone(), format!("{}{mark}", entry.shown), meaning]);
    }
    table.text_within(console::width())
}

/// Returns the first sentence of a text. The sentence ends at a full stop and a blank before a capital
/// letter.
fn first_sentence(text: &str) -> &str {
    let ends = text.match_indices(". ").map(|(end, _)| end);
    let mut ends = ends.filter(|end| text[end + 2..].starts_with(char::is_uppercase));
    text[..ends.next().unwrap_or(text.len())].trim_end_matches('.')
}
