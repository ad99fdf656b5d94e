//! Translates a grid file into lines of Python.

use flap_sweep::notation::text;
use toml_edit::{DocumentMut, Item, TableLike, Value};

use crate::request::Refused;

/// Returns the lines that sweep a grid.
pub(super) fn sweep(grid: &str) -> Result<String, Refused> {
    Ok(format!("import flapwing\n\ntable = flapwing.sweep({})\n", dictionary(grid)?))
}

/// Returns the lines that follow the response of a grid along its axis `along`.
pub(super) fn respond(grid: &str, along: &str) -> Result<String, Refused> {
    let (grid, along) = (dictionary(grid)?, quoted(along));
    Ok(format!("import flapwing\n\ncurve = flapwing.respond({grid}, {along})\n"))
}

fn dictionary(grid: &str) -> Result<String, Refused> {
    let document: DocumentMut = grid.parse().map_err(|_| Refused::Fault("a grid is not TOML".to_owned()))?;
    Ok(table(document.as_table()))
}

fn table(table: &dyn TableLike) -> String {
    // Empty tables are left out.
    let is_written = |item: &Item| item.as_table_like().is_none_or(|inner| !inner.is_empty());
    let entries = table.iter().filter(|(_, item)| is_written(item));
    let entries = entries.map(|(key, entry)| format!("{}: {}", quoted(key), item(entry)));
    format!("{{{}}}", entries.collect::<Vec<_>>().join(", "))
}

fn item(item: &Item) -> String {
    match item {
        Item::Value(inner) => value(inner),
        Item::ArrayOfTables(tables) => {
            let tables: Vec<String> = tables.iter().map(|inner| table(inner)).collect();
            format!("[{}]", tables.join(", "))
        }
        other => other.as_table_like().map_or_else(|| "None".to_owned(), table),
    }
}

fn value(value: &Value) -> String {
    match value {
        Value::String(text) => quoted(text.value()),
        Value::Integer(number) => number.value().to_string(),
        Value::Float(number) => text::float(*number.value()),
        Value::Boolean(flag) => if *flag.value() { "True" } else { "False" }.to_owned(),
        Value::Datetime(time) => quoted(&time.value().to_string()),
        Value::Array(values) => {
            let values: Vec<String> = values.iter().map(self::value).collect();
            format!("[{}]", values.join(", "))
        }
        Value::InlineTable(inner) => table(inner),
    }
}

/// Returns a text as a literal of Python, which has the same escapes as JSON.
fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_grid_becomes_a_dictionary() {
        let grid = "preset = \"a\"\n[solver]\nnewton = false\n[params]\n[axes]\nv = [1.0, 2e-9]\nf = { from = 1.0, n = 3 }\n";
        let line = sweep(grid).unwrap();
        let dictionary = r#"{"preset": "a", "solver": {"newton": False}, "axes": {"v": [1.0, 2e-9], "f": {"from": 1.0, "n": 3}}}"#;
        assert_eq!(line, format!("import flapwing\n\ntable = flapwing.sweep({dictionary})\n"));
        let line = respond(grid, "f").unwrap();
        assert_eq!(line, format!("import flapwing\n\ncurve = flapwing.respond({dictionary}, \"f\")\n"));
    }
}
