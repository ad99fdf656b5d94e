//! Prints tables in the format that the user chose: as text, as comma-separated values, or as JSON.

use std::io::{self, Write};

use flap_core::simulate::Trajectory;
use flap_sweep::files::csv_sink;
use flap_sweep::notation::text;
use serde::Serializer as _;
use serde_json::Value;

use crate::args::OutputFormat;
use crate::console;
use crate::failure::Failure;
use crate::table::{Table, six_digits};

/// Prints a table in the given format. For the format `table`, `page` creates the text. For csv and json,
/// `rows` contain the cells with all digits.
pub(crate) fn table(
    format: OutputFormat,
    names: &[impl AsRef<str>],
    rows: &[Vec<String>],
    page: impl FnOnce() -> String,
) -> Result<(), Failure> {
    console::results(&match format {
        OutputFormat::Table => page(),
        OutputFormat::Csv => csv(names, rows)?,
        OutputFormat::Json => objects(names, rows)?,
    })?;
    Ok(())
}

/// Prints a motion over time.
pub(crate) fn motion(format: OutputFormat, motion: &Trajectory) -> Result<(), Failure> {
    let cells = |number: fn(f64) -> String| {
        motion.rows.iter().map(move |row| row.iter().map(|value| number(*value)).collect())
    };
    match format {
        OutputFormat::Table => {
            let mut table = Table::with_names(motion.columns.clone());
            cells(six_digits).for_each(|row: Vec<String>| table.row(row));
            console::results(&table.text_within(console::width()))?;
        }
        OutputFormat::Csv => write_motions(&[Keyed { keys: &[], motion }], io::stdout().lock())?,
        OutputFormat::Json => {
            let rows: Vec<Vec<String>> = cells(text::float).collect();
            console::results(&objects(&motion.columns, &rows)?)?;
        }
    }
    Ok(())
}

/// Returns the rows as comma-separated values below a line with the column names.
fn csv(names: &[impl AsRef<str>], rows: &[Vec<String>]) -> Result<String, Failure> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let names = names.iter().map(AsRef::as_ref);
    let written =
        writer.write_record(names).and_then(|()| rows.iter().try_for_each(|row| writer.write_record(row)));
    let bytes = written.ok().and_then(|()| writer.into_inner().ok());
    let bytes = bytes.ok_or_else(|| Failure::Bug("rows are no comma-separated values".to_owned()))?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

/// Returns the rows as a list of JSON objects.
fn objects(names: &[impl AsRef<str>], rows: &[Vec<String>]) -> Result<String, Failure> {
    let object = |row: &Vec<String>| {
        let mut bytes = Vec::new();
        let cells = names.iter().map(AsRef::as_ref).zip(row.iter().map(|cell| json(cell)));
        serde_json::Serializer::new(&mut bytes).collect_map(cells)?;
        Ok(format!("  {}", String::from_utf8_lossy(&bytes)))
    };
    let objects: Result<Vec<String>, serde_json::Error> = rows.iter().map(object).collect();
    let objects = objects.map_err(|error| Failure::Bug(error.to_string()))?;
    Ok(format!("[\n{}\n]\n", objects.join(",\n")))
}

/// Returns a cell as JSON: null for an empty or infinite cell. Text such as `007` stays text, because JSON
/// has no numbers of this form.
fn json(cell: &str) -> Value {
    match cell {
        "" | "inf" | "-inf" | "NaN" => Value::Null,
        "true" => Value::Bool(true),
        "false" => Value::Bool(false),
        _ if !matches!(serde_json::from_str(cell), Ok(Value::Number(_))) => Value::from(cell),
        _ => {
            // The standard library reads all digits, which serde_json does not.
            let whole = || cell.parse::<u64>().ok().map(Value::from);
            let number = || cell.parse::<f64>().ok().map(Value::from);
            whole().or_else(number).unwrap_or_else(|| Value::from(cell))
        }
    }
}

/// A motion, and the names and values of the key columns that distinguish this motion from other motions in
/// the same table.
pub(crate) struct Keyed<'m> {
    pub(crate) keys: &'m [(String, String)],
    pub(crate) motion: &'m Trajectory,
}

/// Writes several motions into one CSV table, one below the other. All motions must have the same key
/// columns, and only columns that all motions have are written.
pub(crate) fn write_motions(motions: &[Keyed<'_>], target: impl Write) -> io::Result<()> {
    let Some(first) = motions.first() else { return Ok(()) };
    let has_all = |name: &&String| motions.iter().all(|other| other.motion.columns.contains(name));
    let names: Vec<&String> = first.motion.columns.iter().filter(has_all).collect();
    let mut writer = csv::Writer::from_writer(target);
    let keys = first.keys.iter().map(|(name, _)| name);
    writer.write_record(keys.chain(names.iter().copied())).map_err(csv_sink::cause)?;
    for Keyed { keys, motion } in motions {
        let places: Vec<usize> =
            names.iter().filter_map(|name| motion.columns.iter().position(|other| other == *name)).collect();
        for row in &motion.rows {
            let keys = keys.iter().map(|(_, value)| value.clone());
            let cells = keys.chain(places.iter().map(|&place| text::float(row[place])));
            writer.write_record(cells).map_err(csv_sink::cause)?;
        }
    }
    writer.flush()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_become_json() {
        assert_eq!(
            ["12", "", "up", "inf"].map(json),
            [Value::from(12), Value::Null, Value::from("up"), Value::Null]
        );
        assert_eq!(["true", "0.5"].map(json), [Value::from(true), Value::from(0.5)]);
        assert_eq!(["-1.5e-7", "-0"].map(json), [Value::from(-1.5e-7), Value::from(-0.0)]);
        assert_eq!(["007", "nan", "1.", "+1"].map(json), ["007", "nan", "1.", "+1"].map(Value::from));
    }
}
