//! Counts of the words in a column, such as true and false.

use serde::Serialize;

use crate::data::columns::Table;
use crate::data::levels::{Levels, Values};
use crate::failure::Failure;

/// Largest number of different words in a column that flap counts.
const MOST: usize = 100;

/// The words of a column, with the number of rows of each word.
#[derive(Serialize)]
pub(super) struct Words {
    pub(super) column: String,
    pub(super) counts: Vec<WordCount>,
}

/// A word, and the number of rows that contain it.
#[derive(Serialize)]
pub(super) struct WordCount {
    pub(super) value: String,
    pub(super) rows: usize,
}

impl Words {
    /// Counts the words of a column in the given rows. The most frequent word is first.
    pub(super) fn of(table: &Table, column: usize, rows: &[usize]) -> Result<Words, Failure> {
        let name = table.columns[column].name.clone();
        let levels = Levels::of(table, column, rows);
        let Values::Words(words) = &levels.values else {
            return Err(Failure::Bug(format!("column `{name}` contains numbers")));
        };
        if words.len() > MOST {
            let message = format!("column `{name}` holds {} different texts, not numbers", words.len());
            return Err(Failure::usage(message)
                .help("choose columns of numbers, or columns with few different texts"));
        }
        let count = |place: usize| levels.codes.iter().filter(|&&code| code == place).count();
        let counts = words.iter().enumerate();
        let counts = counts.map(|(place, word)| WordCount { value: word.clone(), rows: count(place) });
        let mut counts: Vec<WordCount> = counts.collect();
        counts.sort_by_key(|count| std::cmp::Reverse(count.rows));
        Ok(Words { column: name, counts })
    }
}
