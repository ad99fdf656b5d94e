//! Reference tables.

use std::collections::HashMap;
use std::path::Path;

/// A row of a CSV table, by column.
pub(crate) struct Record {
    pub(crate) name: String,
    columns: HashMap<String, String>,
}

impl Record {
    pub(crate) fn text(&self, column: &str) -> &str {
        self.columns.get(column).unwrap_or_else(|| panic!("no column {column}"))
    }

    pub(crate) fn number(&self, column: &str) -> f64 {
        self.text(column).parse().unwrap_or_else(|_| panic!("{column} is not a number"))
    }
}

/// The rows of a table in `tests/data`.
pub(crate) fn table(path: &str) -> Vec<Record> {
    let full = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/data").join(path);
    let mut reader = csv::Reader::from_path(&full).unwrap_or_else(|error| panic!("{path}: {error}"));
    let header = reader.headers().unwrap().clone();
    let rows: Vec<Record> = reader
        .records()
        .enumerate()
        .map(|(line, record)| Record {
            name: format!("{path}, row {}", line + 1),
            columns: header
                .iter()
                .map(str::to_owned)
                .zip(record.unwrap().iter().map(str::to_owned))
                .collect(),
        })
        .collect();
    assert!(!rows.is_empty(), "{path} is empty");
    rows
}

/// Fails unless the relative difference between `actual` and `expected` is within `tolerance`.
pub(crate) fn assert_close(actual: f64, expected: f64, tolerance: f64, what: &str) {
    let error = (actual - expected).abs() / expected.abs();
    assert!(
        error <= tolerance,
        "{what}: {actual} is not {expected}: relative error {error:.1e} > {tolerance:.0e}"
    );
}
