//! A name and its meaning.

use std::fmt::Write as _;

use flap_core::parameter::Parameter;
use flap_core::simulate::{Column, Simulator};
use flap_sweep::notation::text;

/// A name and its meaning.
#[derive(Clone)]
pub(super) struct Entry {
    pub(super) name: String,
    /// The kind of the name, such as `a column of trajectories of`.
    what: String,
    /// Models with this name; empty if the name does not depend on the model.
    models: Vec<&'static str>,
    /// Text that follows the list of models.
    rest: String,
    /// The meaning of the name, which is printed as indented lines.
    pub(super) text: String,
}

impl Entry {
    /// Returns an entry for a name that is the same in all models.
    pub(super) fn new(name: impl Into<String>, what: impl Into<String>, text: String) -> Entry {
        let (name, what) = (name.into(), what.into());
        Entry { name, what, models: Vec::new(), rest: String::new(), text }
    }

    /// Returns an entry for a name of a model.
    pub(super) fn of(
        model: &'static str,
        name: impl Into<String>,
        what: impl Into<String>,
        text: String,
    ) -> Entry {
        Entry { models: vec![model], ..Entry::new(name, what, text) }
    }

    /// Returns the entry with a text that follows the list of models.
    pub(super) fn with_rest(self, rest: impl Into<String>) -> Entry {
        Entry { rest: rest.into(), ..self }
    }

    /// Returns the kind of the name, with the models that have the name.
    pub(super) fn kind(&self) -> String {
        let Entry { what, models, rest, .. } = self;
        let of = match models.as_slice() {
            [] => String::new(),
            [model] => format!(" of {model}"),
            [first @ .., last] => format!(" of the models {} and {last}", first.join(", ")),
        };
        format!("{what}{of}{rest}")
    }

    /// Returns name, kind, models and text, as a row of a table.
    pub(super) fn row(&self) -> Vec<String> {
        let Entry { name, what, models, rest, text, .. } = self;
        let lines: Vec<&str> = text.lines().map(str::trim).collect();
        vec![name.clone(), format!("{what}{rest}"), models.join(", "), lines.join("\n")]
    }

    /// Adds the entry to `others`. If an entry with the same meaning exists, the models are added to the existing
    /// entry.
    pub(super) fn add(self, others: &mut Vec<Entry>) {
        let same = |other: &&mut Entry| {
            (&other.name, &other.what, &other.rest, &other.text)
                == (&self.name, &self.what, &self.rest, &self.text)
        };
        match others.iter_mut().find(same) {
            Some(other) => other.models.extend(self.models),
            None => others.push(self),
        }
    }
}

/// Returns meaning and unit of a column.
pub(super) fn of_column(doc: &str, unit: &str) -> String {
    let unit = if unit.is_empty() { String::new() } else { format!("  unit      {unit}\n") };
    format!("  {doc}\n{unit}")
}

/// Returns meaning and unit of a measured column.
pub(super) fn of_measure(column: &Column) -> String {
    of_column(&column.doc, column.unit)
}

/// Returns meaning, unit, symbol, range and published values of a parameter.
pub(super) fn of_parameter(model: &dyn Simulator, index: usize, parameter: &Parameter) -> String {
    let mut page = of_table(parameter);
    if parameter.is_fitted {
        page += "  The published value was fitted to one vehicle. Measure or fit it for other vehicles.\n";
    }
    for preset in model.presets() {
        let value = (preset.values)()[index];
        let value = if value.is_nan() { "not set".to_owned() } else { text::shown(parameter, value) };
        let _ = writeln!(page, "  {value} in {}", preset.name);
    }
    page
}

/// Returns meaning, unit, symbol, range and group of a parameter.
pub(super) fn of_table(parameter: &Parameter) -> String {
    let mut page = format!("  {}\n", parameter.doc);
    let allowed = parameter.kind.describe();
    for (what, value) in [
        ("unit", parameter.unit),
        ("symbol", parameter.symbol),
        ("allowed", allowed.as_str()),
        ("group", parameter.group),
    ] {
        if !value.is_empty() {
            let _ = writeln!(page, "  {what:<8}  {value}");
        }
    }
    let powers: Vec<String> = (parameter.scales_with.iter())
        .map(|(name, power)| if *power == 1.0 { (*name).to_owned() } else { format!("{name}^{power}") })
        .collect();
    if !powers.is_empty() {
        let _ = writeln!(page, "  {:<8}  usually with {}; see `flap check`", "scales", powers.join(" * "));
    }
    page
}
