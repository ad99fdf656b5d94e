//! `flap models`: the models and their presets.

use crate::console;
use crate::failure::{Exit, Failure};
use crate::models;
use crate::table::Table;

pub(crate) fn run() -> Result<Exit, Failure> {
    let mut table = Table::default();
    for model in models::all() {
        table.row([model.name().to_owned(), model.doc().to_owned()]);
        for preset in model.presets() {
            table.row([format!("  {}", preset.name), preset.doc.to_owned()]);
        }
    }
    console::results(&table.text_within(console::width()))?;
    Ok(Exit::Done)
}
