//! `flap params`: the parameters and the output columns of a model.

use flap_core::parameter::{Kind, Parameter};
use flap_core::simulate::Simulator;
use flap_sweep::notation::text;

use crate::args::ParamsArgs;
use crate::console;
use crate::failure::{Exit, Failure};
use crate::models;
use crate::table::Table;

pub(crate) fn run(args: &ParamsArgs) -> Result<Exit, Failure> {
    let page = if let Some((model, preset)) = models::preset(&args.what) {
        let head = format!("{}: {}\nmodel {}: {}\n", preset.name, preset.doc, model.name(), model.doc());
        head + "\n" + &values(model, &(preset.values)()) + "\n" + &columns(model)
    } else if let Some(model) = models::by_name(&args.what) {
        let presets: Vec<&str> = model.presets().iter().map(|preset| preset.name).collect();
        let head = format!("{}: {}\npresets: {}\n", model.name(), model.doc(), presets.join(", "));
        head + "\n" + &parameters(model) + "\n" + &columns(model)
    } else {
        return Err(unknown(&args.what));
    };
    console::results(&page)?;
    Ok(Exit::Done)
}

/// The parameter table with the values of a preset.
fn values(model: &dyn Simulator, values: &[f64]) -> String {
    let mut table = Table::with_headings(&["parameter", "value", "unit", "symbol", "meaning", "allowed"]);
    for (parameter, &value) in model.parameters().iter().zip(values) {
        let value = if value.is_nan() { "-".to_owned() } else { text::value(parameter, value) };
        let [name, unit, symbol, doc, allowed] = cells(parameter);
        table.row([name, value, unit, symbol, doc, allowed]);
    }
    table.text()
}

/// The parameter table without values.
fn parameters(model: &dyn Simulator) -> String {
    let mut table = Table::with_headings(&["parameter", "unit", "symbol", "meaning", "allowed"]);
    for parameter in model.parameters() {
        table.row(cells(parameter));
    }
    table.text()
}

fn cells(parameter: &Parameter) -> [String; 5] {
    [parameter.name, parameter.unit, parameter.symbol, parameter.doc, &allowed(parameter)]
        .map(ToOwned::to_owned)
}

/// The allowed values, in words.
pub(super) fn allowed(parameter: &Parameter) -> String {
    match parameter.kind {
        Kind::Number(range) => range.describe(),
        Kind::Following(range, follows) => format!("{}; if not set, {follows}", range.describe()),
        Kind::Choice(options) => options.join(" | "),
    }
}

/// The output columns.
fn columns(model: &dyn Simulator) -> String {
    let mut table = Table::with_headings(&["column", "unit", "meaning"]);
    for column in model.columns() {
        table.row([column.name.clone(), column.unit.to_owned(), column.doc.clone()]);
    }
    table.text()
}

fn unknown(name: &str) -> Failure {
    let names = models::all().iter().map(|model| model.name()).chain(models::presets());
    let failure = Failure::usage(format!("there is no model or preset `{name}`"));
    failure.nearest(name, names, "`flap models` lists models and presets")
}
