//! The data of a page as JSON: the rows, and the first view of the page.

use std::collections::{BTreeMap, HashMap};

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde::Serialize;

use crate::data::columns::{Cells, NO_WORD, Table};
use crate::data::levels::Value;

/// Largest number of rows for which the page contains all digits of numbers. In pages with more rows, numbers
/// have seven digits.
const MOST_EXACT: usize = 20_000;

/// The data of a page of results.
#[derive(Serialize)]
pub(super) struct Data<'a> {
    /// Number of rows in the page.
    rows: usize,
    /// Number of rows of the file that satisfy the conditions.
    of: usize,
    /// The page contains every row of the file with stride 1, every second row with stride 2, and so on.
    stride: usize,
    /// True if the numbers in the page have single precision.
    single: bool,
    /// The column `branch` in results of `flap respond`.
    branch: Option<usize>,
    /// Positions of the columns of varied parameters.
    axes: &'a [usize],
    start: &'a Start,
    columns: Vec<Column<'a>>,
}

/// The first view of a page.
#[derive(Serialize)]
pub(super) struct Start {
    pub(super) kind: Kind,
    pub(super) x: usize,
    pub(super) y: usize,
    pub(super) by: Option<usize>,
    pub(super) color: Option<usize>,
    /// Directions in which x and y are better: 1 for larger values, -1 for smaller values, such as `1,-1`.
    /// Empty for a view without a Pareto front.
    pub(super) best: String,
    /// For each condition `COLUMN=VALUE`, the value of the column.
    #[serde(rename = "where")]
    pub(super) filters: BTreeMap<String, Value>,
}

/// The kind of picture that a page shows.
#[derive(Serialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Kind {
    Line,
    Scatter,
    Map,
}

/// A column with its label and its cells.
#[derive(Serialize)]
struct Column<'a> {
    name: &'a str,
    /// The name of the column in words.
    label: String,
    /// The name of the column in words, with the unit.
    title: String,
    unit: String,
    factor: f64,
    /// The type of the numbers in `data`: `f64`, `f32`, `u8`, `u16` or `u32`.
    #[serde(rename = "type")]
    kind: &'static str,
    /// One number per row, in little-endian bytes that are encoded as base64.
    data: String,
    /// The words that the codes 0, 1, 2, … in `data` stand for. The code after the last word stands for an
    /// empty cell.
    #[serde(skip_serializing_if = "Option::is_none")]
    words: Option<&'a [String]>,
    /// The numbers that the codes 0, 1, 2, … in `data` stand for. The number null stands for an empty cell.
    #[serde(skip_serializing_if = "Option::is_none")]
    values: Option<Vec<f64>>,
}

impl<'a> Data<'a> {
    /// Returns the data of a page with all rows of `table`.
    pub(super) fn new(
        table: &'a Table,
        axes: &'a [usize],
        start: &'a Start,
        branch: Option<usize>,
    ) -> Data<'a> {
        let single = table.rows > MOST_EXACT;
        Data {
            rows: table.rows,
            of: table.of,
            stride: table.of.div_ceil(table.rows.max(1)),
            single,
            branch,
            axes,
            start,
            columns: (0..table.columns.len()).map(|place| Column::new(table, place, single)).collect(),
        }
    }

    /// Returns the data as JSON text.
    pub(super) fn json(&self) -> Result<String, serde_json::Error> {
        serde_json::to_string(self)
    }
}

impl<'a> Column<'a> {
    fn new(table: &'a Table, place: usize, single: bool) -> Column<'a> {
        let column = &table.columns[place];
        let label = table.label(place);
        let (mut words, mut values) = (None, None);
        let (kind, bytes) = match &column.cells {
            Cells::Words { codes, words: list } => {
                words = Some(list.as_slice());
                let code = |&code: &u32| if code == NO_WORD { list.len() } else { code as usize };
                coded(&codes.iter().map(code).collect::<Vec<_>>(), list.len() + 1)
            }
            Cells::Numbers(numbers) => match distinct(numbers) {
                Some((codes, list)) => {
                    let coded = coded(&codes, list.len());
                    values = Some(list);
                    coded
                }
                None if single => {
                    #[expect(clippy::cast_possible_truncation, reason = "seven digits are what is promised")]
                    let bytes = numbers.iter().flat_map(|&number| (number as f32).to_le_bytes()).collect();
                    ("f32", bytes)
                }
                None => ("f64", numbers.iter().flat_map(|number| number.to_le_bytes()).collect()),
            },
            Cells::Unread => ("u8", Vec::new()),
        };
        Column {
            name: &column.name,
            title: label.text(),
            label: label.words,
            unit: label.unit,
            factor: label.factor,
            kind,
            data: STANDARD.encode(bytes),
            words,
            values,
        }
    }
}

/// Returns the codes as bytes, and the smallest integer type that can contain numbers below `count`.
fn coded(codes: &[usize], count: usize) -> (&'static str, Vec<u8>) {
    let (kind, width) = match count {
        0..=0x100 => ("u8", 1),
        0x101..=0x1_0000 => ("u16", 2),
        _ => ("u32", 4),
    };
    (kind, codes.iter().flat_map(|code| code.to_le_bytes().into_iter().take(width)).collect())
}

/// Returns the code of each value, and the list of different values that the codes stand for. The result is
/// `None` if the values have too many different numbers.
fn distinct(values: &[f64]) -> Option<(Vec<usize>, Vec<f64>)> {
    let most = (values.len() / 4).min(1 << 16);
    let mut places = HashMap::new();
    let mut list = Vec::new();
    let mut codes = Vec::with_capacity(values.len());
    for value in values {
        let code = *places.entry(value.to_bits()).or_insert_with(|| {
            list.push(*value);
            list.len() - 1
        });
        if list.len() > most {
            return None;
        }
        codes.push(code);
    }
    Some((codes, list))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_values_have_codes() {
        let values = [1.0, 2.0, 1.0, 1.0, 2.0, f64::NAN, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0];
        let (codes, list) = distinct(&values).unwrap();
        assert_eq!(codes[..6], [0, 1, 0, 0, 1, 2]);
        assert_eq!(list.len(), 3);
        assert!(distinct(&[1.0, 2.0, 3.0, 4.0]).is_none());
    }

    #[test]
    fn codes_have_the_bytes_that_their_number_needs() {
        assert_eq!(coded(&[0, 255], 256), ("u8", vec![0, 255]));
        assert_eq!(coded(&[0, 256], 257), ("u16", vec![0, 0, 0, 1]));
        assert_eq!(coded(&[65_536], 65_537), ("u32", vec![0, 0, 1, 0]));
    }
}
