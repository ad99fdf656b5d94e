//! `flap params`: the parameters of a model, and the columns of its rows.

use std::fmt::Write as _;
use std::path::Path;

use flap_core::parameter::{Kind, Parameter, Preset};
use flap_core::simulate::Simulator;
use flap_sweep::notation::text;
use flap_sweep::notation::units::prefixed;
use flap_sweep::resonance;
use flap_sweep::table::layout::fixed_columns;

use super::{listed, point};
use crate::args::{Listing, ParamsArgs};
use crate::console;
use crate::failure::{Exit, Failure};
use crate::models;
use crate::table::Table;

pub(crate) fn run(args: &ParamsArgs) -> Result<Exit, Failure> {
    let subject = subject(&args.what)?;
    let model = subject.model;
    let parameters = parameters(model, subject.values.as_deref());
    let entries: Vec<Entry> = parameters.into_iter().chain(columns(model)).collect();
    let rows = || entries.iter().map(Entry::row).collect::<Vec<_>>();
    let page = match args.format {
        Listing::Table => head(&subject) + &listing(&entries, args.long),
        Listing::Csv => listed::csv(&NAMES.map(str::to_owned), &rows())?,
        Listing::Json => listed::objects(&NAMES.map(str::to_owned), &rows())?,
    };
    console::results(&page)?;
    Ok(Exit::Done)
}

/// A model, perhaps with the values of a design.
struct Subject {
    model: &'static dyn Simulator,
    /// One value per parameter, if there is a design.
    values: Option<Vec<f64>>,
    /// The first line about it.
    about: String,
}

/// The model, the preset, or the device or grid file called `what`.
fn subject(what: &str) -> Result<Subject, Failure> {
    let path = Path::new(what);
    if path.extension().is_some() || path.components().count() > 1 {
        let plan = point::plan(what)?;
        let values = plan.base().iter().map(|value| value.in_point()).collect();
        let about = format!("{what}: from {}", plan.preset());
        return Ok(Subject { model: plan.simulator(), values: Some(values), about });
    }
    let (model, preset) = of_name(what)?;
    let about = match preset {
        Some(preset) => format!("{}: {}", preset.name, preset.doc),
        None => format!("{}: {}", model.name(), model.doc()),
    };
    Ok(Subject { model, values: preset.map(|preset| (preset.values)()), about })
}

/// The model of that name, or that of the preset of that name, with the preset.
pub(super) fn of_name(name: &str) -> Result<(&'static dyn Simulator, Option<&'static Preset>), Failure> {
    let preset = models::preset(name).map(|(model, preset)| (model, Some(preset)));
    let found = preset.or_else(|| models::by_name(name).map(|model| (model, None)));
    found.ok_or_else(|| {
        let names = models::all().iter().map(|model| model.name()).chain(models::presets());
        let failure = Failure::usage(format!("there is no model or preset `{name}`"));
        failure.nearest(name, names, "`flap models` lists models and presets")
    })
}

/// The first lines.
fn head(Subject { model, values, about }: &Subject) -> String {
    let second = if values.is_some() {
        format!("model {}: {}", model.name(), model.doc())
    } else {
        let presets: Vec<&str> = model.presets().iter().map(|preset| preset.name).collect();
        format!("presets: {}", presets.join(", "))
    };
    [about, &second].map(|line| wrapped(line, 0) + "\n").concat() + "\n"
}

/// A parameter, or a column of rows.
struct Entry {
    /// Parameter, or the kind of column.
    kind: &'static str,
    /// The title above it and its like.
    group: &'static str,
    name: String,
    /// The value in the design, in SI units; empty without one.
    value: String,
    /// The same with a prefix and the unit; or the unit, without a design.
    shown: String,
    unit: &'static str,
    symbol: &'static str,
    allowed: String,
    meaning: String,
    /// More about a parameter, in sentences.
    more: String,
}

const NAMES: [&str; 8] = ["kind", "group", "name", "value", "unit", "symbol", "allowed", "meaning"];

impl Entry {
    /// The cells below [`NAMES`].
    fn row(&self) -> Vec<String> {
        let Entry { kind, group, name, value, unit, symbol, allowed, meaning, .. } = self;
        [kind, group, name.as_str(), value, unit, symbol, allowed, meaning].map(str::to_owned).into()
    }
}

fn parameters(model: &dyn Simulator, values: Option<&[f64]>) -> Vec<Entry> {
    let entry = |(place, parameter): (usize, &Parameter)| {
        let value = values.map(|values| values[place]);
        let given = value.filter(|value| !value.is_nan());
        Entry {
            kind: "parameter",
            group: parameter.group,
            name: parameter.name.to_owned(),
            value: given.map_or_else(String::new, |value| text::value(parameter, value)),
            shown: match (value, given) {
                (_, Some(value)) => shown(parameter, value),
                (Some(_), None) => "-".to_owned(),
                (None, None) => parameter.unit.to_owned(),
            },
            unit: parameter.unit,
            symbol: parameter.symbol,
            allowed: allowed(parameter),
            meaning: parameter.doc.to_owned(),
            more: more(parameter),
        }
    };
    model.parameters().iter().enumerate().map(entry).collect()
}

/// A value with a prefix and its unit, or the name of an option.
fn shown(parameter: &Parameter, value: f64) -> String {
    match parameter.kind {
        Kind::Choice(_) => text::value(parameter, value),
        _ => prefixed(value, parameter.unit),
    }
}

/// Symbol, allowed values and history of a parameter.
fn more(parameter: &Parameter) -> String {
    let mut text = String::new();
    if !parameter.symbol.is_empty() {
        let _ = write!(text, ". Symbol: {}", parameter.symbol);
    }
    let _ = write!(text, ". Allowed: {}", allowed(parameter));
    if !parameter.former.is_empty() {
        let _ = write!(text, ". Former name: {}", parameter.former);
    }
    if parameter.is_fitted {
        text += ". The published value is a fit to one vehicle";
    }
    text
}

/// The allowed values, in words.
pub(super) fn allowed(parameter: &Parameter) -> String {
    match parameter.kind {
        Kind::Number(range) => range.describe(),
        Kind::Following(range, follows) => format!("{}; if not set, {follows}", range.describe()),
        Kind::Choice(options) => options.join(" | "),
    }
}

/// The columns of rows: measures, those of designs at their resonance, and those that do not depend on the model.
fn columns(model: &'static dyn Simulator) -> Vec<Entry> {
    let entry = |kind, group, name: String, unit: &'static str, meaning: String| Entry {
        kind,
        group,
        name,
        value: String::new(),
        shown: unit.to_owned(),
        unit,
        symbol: "",
        allowed: String::new(),
        meaning,
        more: String::new(),
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

/// Parameters, then columns, below the titles of their groups, in lines that fit the terminal.
fn listing(entries: &[Entry], long: bool) -> String {
    let is_parameter = |entry: &&Entry| entry.kind == "parameter";
    let has_values = entries.iter().any(|entry| !entry.value.is_empty());
    let second = if has_values { "value" } else { "unit" };
    let parameters = page("parameter", second, entries.iter().filter(is_parameter), long);
    let columns = page("column", "unit", entries.iter().filter(|entry| !is_parameter(entry)), long);
    parameters + "\n" + &columns
}

fn page<'e>(first: &str, second: &str, entries: impl Iterator<Item = &'e Entry>, long: bool) -> String {
    let mut table = Table::with_headings(&[first, second, "meaning"]);
    let mut group = "";
    for entry in entries {
        if entry.group != group {
            group = entry.group;
            table.title(group);
        }
        let meaning = if long {
            entry.meaning.trim_end_matches('.').to_owned() + &entry.more
        } else {
            first_sentence(&entry.meaning).to_owned()
        };
        table.row([entry.name.clone(), entry.shown.clone(), meaning]);
    }
    table.text_within(console::width())
}

/// The text up to the end of its first sentence: a full stop before a capital letter.
fn first_sentence(text: &str) -> &str {
    let ends = text.match_indices(". ").map(|(end, _)| end);
    let mut ends = ends.filter(|end| text[end + 2..].starts_with(char::is_uppercase));
    text[..ends.next().unwrap_or(text.len())].trim_end_matches('.')
}

/// The text in lines that fit the terminal, each but the first behind `indent` blanks.
pub(super) fn wrapped(text: &str, indent: usize) -> String {
    let blanks = " ".repeat(indent);
    console::width().map_or_else(
        || text.to_owned(),
        |width| {
            textwrap::fill(text, textwrap::Options::new(width.max(indent + 20)).subsequent_indent(&blanks))
        },
    )
}
