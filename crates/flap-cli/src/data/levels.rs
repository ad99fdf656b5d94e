//! The distinct values of a column.

use std::collections::HashMap;

use flap_sweep::notation::text;
use serde::Serialize;

use super::columns::{Cells, NO_WORD, Table};

/// The distinct values of a column, and for each row the index of its value.
pub(crate) struct Levels {
    /// For each row, the index in `values` of the value in this row.
    pub(crate) codes: Vec<usize>,
    pub(crate) values: Values,
}

/// Distinct values of a column. Numbers are in rising order, and words are in the order of their first row in
/// the file.
pub(crate) enum Values {
    Numbers(Vec<f64>),
    Words(Vec<String>),
}

/// One value of a column.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub(crate) enum Value {
    Number(f64),
    Word(String),
}

impl Value {
    /// Returns the value as text, in the form that a user types and a results file contains.
    pub(crate) fn typed(&self) -> String {
        match self {
            Value::Number(number) => text::float(*number),
            Value::Word(word) => word.clone(),
        }
    }
}

impl Levels {
    /// Returns the distinct values of the column in the given rows. All empty cells count as one value, the
    /// last in the list.
    pub(crate) fn of(table: &Table, column: usize, rows: &[usize]) -> Levels {
        match &table.columns[column].cells {
            Cells::Numbers(values) => {
                let mut distinct: Vec<f64> = rows.iter().map(|&row| values[row]).collect();
                distinct.sort_by(f64::total_cmp);
                distinct.dedup_by(|a, b| a.to_bits() == b.to_bits());
                let places: HashMap<u64, usize> =
                    distinct.iter().enumerate().map(|(place, value)| (value.to_bits(), place)).collect();
                let codes = rows.iter().map(|&row| places[&values[row].to_bits()]).collect();
                Levels { codes, values: Values::Numbers(distinct) }
            }
            Cells::Words { codes, words } => {
                let mut present: Vec<u32> = rows.iter().map(|&row| codes[row]).collect();
                present.sort_unstable();
                present.dedup();
                let text = |code: u32| {
                    let word = if code == NO_WORD { None } else { words.get(code as usize) };
                    word.map_or_else(|| "none".to_owned(), String::clone)
                };
                let places: HashMap<u32, usize> =
                    present.iter().enumerate().map(|(place, code)| (*code, place)).collect();
                Levels {
                    codes: rows.iter().map(|&row| places[&codes[row]]).collect(),
                    values: Values::Words(present.into_iter().map(text).collect()),
                }
            }
            Cells::Unread => {
                Levels { codes: vec![0; rows.len()], values: Values::Words(vec![String::new()]) }
            }
        }
    }

    pub(crate) fn len(&self) -> usize {
        match &self.values {
            Values::Numbers(values) => values.len(),
            Values::Words(words) => words.len(),
        }
    }

    /// Returns value number `place`.
    pub(crate) fn value(&self, place: usize) -> Value {
        match &self.values {
            Values::Numbers(values) => Value::Number(values[place]),
            Values::Words(words) => Value::Word(words[place].clone()),
        }
    }

    /// Returns true if rows with equal values in the column `other` always have equal values in this column.
    pub(crate) fn is_determined_by(&self, other: &Levels) -> bool {
        let mut image = vec![usize::MAX; other.len()];
        self.codes.iter().zip(&other.codes).all(|(&mine, &theirs)| {
            let first = image[theirs] == usize::MAX;
            if first {
                image[theirs] = mine;
            }
            image[theirs] == mine
        })
    }
}
