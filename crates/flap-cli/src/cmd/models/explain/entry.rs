//! A name, such as a parameter or a column, and its meaning.

use std::fmt::Write as _;

use flap_core::parameter::Parameter;
use flap_core::simulate::{Column, Simulator};
use flap_sweep::notation::text;

/// A name, such as a parameter or a column, and its meaning.
#[derive(Clone)]
pub(super) struct Entry {
    pub(super) name: String,
    /// The kind of the name, such as `a measure` or `a column of motions`.
    what: String,
    /// The models in which the name has the meaning of this entry. Empty if the name has the same meaning in
    /// all models.
    models: Vec<&'static str>,
    /// Text that flap prints after the list of models.
    rest: String,
    /// The meaning of the name, as indented lines.
    pub(super) text: String,
}

impl Entry {
    /// Returns an entry for a name that has the same meaning in all models.
    pub(super) fn new(name: impl Into<String>, what: impl Into<String>, text: String) -> Entry {
        let (name, what) = (name.into(), what.into());
        Entry { name, what, models: Vec::new(), rest: String::new(), text }
    }

    /// Returns an entry for a name of one model.
    pub(super) fn of(
        model: &'static str,
        name: impl Into<String>,
        what: impl Into<String>,
        text: String,
    ) -> Entry {
        Entry { models: vec![model], ..Entry::new(name, what, text) }
    }

    /// Returns the entry with a text that flap prints after the list of models.
    pub(super) fn with_rest(self, rest: impl Into<String>) -> Entry {
        Entry { rest: rest.into(), ..self }
    }

    /// Returns a text with the kind of the name and the models that have this name.
    pub(super) fn kind(&self) -> String {
        let Entry { what, models, rest, .. } = self;
        let of = match models.as_slice() {
            [] => String::new(),
            [model] => format!(" of {model}"),
            [first @ .., last] => format!(" of the models {} and {last}", first.join(", ")),
        };
        format!("{what}{of}{rest}")
    }

    /// Returns the name, its kind, the models and the meaning as a row of a table.
    pub(super) fn row(&self) -> Vec<String> {
        let Entry { name, what, models, rest, text, .. } = self;
        let lines: Vec<&str> = text.lines().map(str::trim).collect();
        vec![name.clone(), format!("{what}{rest}"), models.join(", "), lines.join("\n")]
    }

    /// Adds the entry to `others`. If `others` already contains an entry with this name and meaning, the
    /// function only adds the models to the existing entry.
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

/// Returns a text with the meaning and the unit of a column.
pub(super) fn of_column(doc: &str, unit: &str) -> String {
    let unit = if unit.is_empty() { String::new() } else { format!("  unit      {unit}\n") };
    format!("  {doc}\n{unit}")
}

/// Returns a text with the meaning and the unit of a measure.
pub(super) fn of_measure(column: &Column) -> String {
    of_column(&column.doc, column.unit)
}

/// Returns a text about a parameter: its meaning, unit, symbol and range, and its values in the presets.
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

/// Returns a text about a parameter: its meaning, unit, symbol, range and group.
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
