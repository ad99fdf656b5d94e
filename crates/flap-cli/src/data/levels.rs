//! The distinct values of a column.

use std::collections::HashMap;

use flap_sweep::notation::text;
use serde::Serialize;

use super::columns::{Cells, NO_WORD, Table};

/// The distinct values of a column, and the value in each row.
pub(crate) struct Levels {
    /// For each row, the index of the row's value among the distinct values.
    pub(crate) codes: Vec<usize>,
    pub(crate) values: Values,
}

/// Distinct values: numbers in rising order, words in the order of the file.
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
    /// Returns the value in the form that users type and files contain.
    pub(crate) fn typed(&self) -> String {
        match self {
            Value::Number(number) => text::float(*number),
            Value::Word(word) => word.clone(),
        }
    }
}

impl Levels {
    /// Returns the distinct values of the column in the given rows. All empty cells count as one value, which is last.
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

    /// Returns true if, in each row, the value in the column `other` determines the value in this column.
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
