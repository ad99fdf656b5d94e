//! `flap explain`: the meaning of parameters, columns and statuses.

use std::fmt::Write as _;

use flap_core::parameter::Parameter;
use flap_core::simulate::{Simulator, Status};
use flap_sweep::notation::text;
use flap_sweep::resonance::measures;
use flap_sweep::table::layout::fixed_columns;

use super::params::{allowed, of_name, wrapped};
use crate::args::ExplainArgs;
use crate::console;
use crate::failure::{Exit, Failure};
use crate::models;

pub(crate) fn run(args: &ExplainArgs) -> Result<Exit, Failure> {
    let models = match &args.model {
        None => models::all().to_vec(),
        Some(name) => vec![of_name(name)?.0],
    };
    let pages =
        args.names.iter().map(|name| page(name, &models)).collect::<Result<Vec<String>, Failure>>()?;
    console::results(&pages.join("\n"))?;
    Ok(Exit::Done)
}

/// All that is known of a name: it may be a parameter of several models, and a column of others.
fn page(name: &str, models: &[&'static dyn Simulator]) -> Result<String, Failure> {
    let mut page = String::new();
    for entry in entries(models).into_iter().filter(|entry| entry.name == name) {
        let _ = writeln!(page, "{name}: {}", entry.kind);
        for line in entry.text.lines() {
            let _ = writeln!(page, "{}", wrapped(line, line.len() - line.trim_start().len()));
        }
    }
    if page.is_empty() {
        if models.len() < models::all().len() && self::page(name, models::all()).is_ok() {
            let failure = Failure::usage(format!("the model {} has no `{name}`", models[0].name()));
            return Err(failure.help(format!("other models have it: `flap explain {name}`")));
        }
        let entries = entries(models);
        let failure = Failure::usage(format!("there is no parameter, column or status `{name}`"));
        let names = entries.iter().map(|entry| entry.name.as_str());
        return Err(failure.nearest(name, names, "`flap params MODEL` lists parameters and columns"));
    }
    Ok(page)
}

/// A name and its meaning.
struct Entry {
    name: String,
    /// Whatever it names, with the models that have it.
    kind: String,
    /// Indented lines.
    text: String,
}

/// Everything that can be explained of these models.
fn entries(models: &[&'static dyn Simulator]) -> Vec<Entry> {
    let statuses = Status::ALL.map(|status| Entry {
        name: status.name().to_owned(),
        kind: "a status of rows".to_owned(),
        text: format!("  {}\n", status.describe()),
    });
    let fixed = fixed_columns().into_iter().map(|column| Entry {
        name: column.name,
        kind: "a column of the rows of every model".to_owned(),
        text: format!("  {}\n", column.doc),
    });
    let models = models.iter().flat_map(|&model| of_model(model));
    statuses.into_iter().chain(fixed).chain(models).collect()
}

/// The parameters and columns of a model.
fn of_model(model: &'static dyn Simulator) -> impl Iterator<Item = Entry> {
    let table = || model.parameters().iter().enumerate();
    let parameters = table().map(move |(index, parameter)| Entry {
        name: parameter.name.to_owned(),
        kind: format!("a parameter of {}", model.name()),
        text: of_parameter(model, index, parameter),
    });
    let renamed = table().filter(|(_, parameter)| !parameter.former.is_empty());
    let renamed = renamed.map(move |(index, parameter)| Entry {
        name: parameter.former.to_owned(),
        kind: format!("the former name of {}, a parameter of {}", parameter.name, model.name()),
        text: of_parameter(model, index, parameter),
    });
    let own = model.columns().len();
    let columns = measures(model).into_iter().enumerate().map(move |(place, column)| {
        let when = if place < own { "" } else { " with drive_frequency = \"resonance\"" };
        let unit =
            if column.unit.is_empty() { String::new() } else { format!("  unit      {}\n", column.unit) };
        Entry {
            kind: format!("a measure of {}{when}", model.name()),
            text: format!("  {}\n{unit}", column.doc),
            name: column.name,
        }
    });
    parameters.chain(renamed).chain(columns)
}

/// Meaning, unit, symbol, range and published values of a parameter.
fn of_parameter(model: &dyn Simulator, index: usize, parameter: &Parameter) -> String {
    let mut page = format!("  {}\n", parameter.doc);
    for (what, value) in
        [("unit", parameter.unit), ("symbol", parameter.symbol), ("allowed", allowed(parameter).as_str())]
    {
        if !value.is_empty() {
            let _ = writeln!(page, "  {what:<8}  {value}");
        }
    }
    if !parameter.group.is_empty() {
        let _ = writeln!(page, "  group     {}", parameter.group);
    }
    if parameter.is_fitted {
        page += "  The published value is a fit to one vehicle: measure or fit it for another.\n";
    }
    for preset in model.presets() {
        let value = (preset.values)()[index];
        let value = if value.is_nan() { "not set".to_owned() } else { text::value(parameter, value) };
        let _ = writeln!(page, "  {value} in {}", preset.name);
    }
    page
}
