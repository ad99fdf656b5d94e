//! `flap models`: models and presets, their parameters and columns, and the meanings of names.

mod explain;
mod parameters;

use crate::args::{ModelsArgs, OutputFormat};
use crate::console;
use crate::failure::{Exit, Failure};
use crate::models;
use crate::print;
use crate::table::Table;

pub(crate) fn run(args: &ModelsArgs) -> Result<Exit, Failure> {
    if args.names.is_empty() {
        list(args)?;
        return Ok(Exit::Done);
    }
    let (listed, explained): (Vec<&str>, Vec<&str>) =
        args.names.iter().map(String::as_str).partition(|name| parameters::is_listed(name));
    let tables = listed.len() + usize::from(!explained.is_empty());
    if args.format != OutputFormat::Table && tables > 1 {
        let failure =
            Failure::usage("csv and json contain one table: list only one model, or only explain names");
        return Err(failure.help("run the command once for each model, preset or file"));
    }
    for (place, what) in listed.iter().enumerate() {
        if place > 0 {
            console::results("\n")?;
        }
        parameters::list(what, args)?;
    }
    if !explained.is_empty() {
        if !listed.is_empty() {
            console::results("\n")?;
        }
        explain::explain(&explained, args)?;
    }
    Ok(Exit::Done)
}

/// Prints the models and their presets.
fn list(args: &ModelsArgs) -> Result<(), Failure> {
    let mut rows = Vec::new();
    for model in models::all() {
        let row =
            |kind: &str, name: &str, doc: &str| [kind, name, model.name(), doc].map(str::to_owned).to_vec();
        rows.push(row("model", model.name(), model.doc()));
        rows.extend(model.presets().iter().map(|preset| row("preset", preset.name, preset.doc)));
    }
    print::table(args.format, &["kind", "name", "model", "meaning"], &rows, || {
        let mut table = Table::default();
        for row in &rows {
            let indent = if row[0] == "preset" { "  " } else { "" };
            table.row([format!("{indent}{}", row[1]), row[3].clone()]);
        }
        table.text_within(console::width())
    })
}
