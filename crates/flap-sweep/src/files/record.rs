//! Measured records: CSV tables of numbers against time.

use std::collections::HashSet;
use std::fs::File;
use std::io;
use std::path::Path;

use crate::files::csv_sink::cause;
use crate::files::results::Bounded;

/// A table of numbers, by column.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    /// The name of the file, for messages.
    name: String,
    headings: Vec<String>,
    columns: Vec<Vec<f64>>,
}

/// A record that cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum RecordError {
    /// The file cannot be read, or is not a table.
    #[error("{name}: {source}")]
    Read {
        /// The file.
        name: String,
        /// The reason.
        source: io::Error,
    },
    /// Two columns have the same heading.
    #[error("{name}: there are two columns {heading}: keep one of them")]
    Twice {
        /// The file.
        name: String,
        /// The heading.
        heading: String,
    },
    /// A column is longer or shorter than the first one.
    #[error("{name}: columns differ in length: {first} has {other} numbers, {heading} has {length}")]
    Lengths {
        /// The record.
        name: String,
        /// The heading of the column.
        heading: String,
        /// Its length.
        length: usize,
        /// The heading of the first column.
        first: String,
        /// The length of the first column.
        other: usize,
    },
    /// A cell is not a finite number.
    #[error("{name}, line {line}, column {heading}: `{cell}` is not a number")]
    Cell {
        /// The file.
        name: String,
        /// Number of the line, from 1; of the row, for a record in memory.
        line: u64,
        /// The heading of the column.
        heading: String,
        /// The cell.
        cell: String,
    },
    /// No column has one of the headings wanted.
    #[error("{name}: there is no column {}; {}", wanted.join(" or "), known(headings))]
    Missing {
        /// The file.
        name: String,
        /// The headings wanted.
        wanted: Vec<String>,
        /// The headings in the file.
        headings: Vec<String>,
    },
    /// Two columns of the same quantity differ.
    #[error("{name}: columns {first} and {second} contradict each other in row {row}: keep one of them")]
    Contradiction {
        /// The file.
        name: String,
        /// The heading of one column.
        first: String,
        /// The heading of the other one.
        second: String,
        /// Number of the row, from 1.
        row: usize,
    },
}

impl Record {
    /// Reads a CSV file with a line of headings. Blanks around headings and numbers are ignored.
    ///
    /// # Errors
    /// - [`RecordError::Read`] if the file cannot be read, or a line has more or fewer cells than there are headings
    /// - [`RecordError::Twice`] if two columns have the same heading
    /// - [`RecordError::Cell`] if a cell is not a finite number
    pub fn read(path: &Path) -> Result<Record, RecordError> {
        let name = path.display().to_string();
        let unreadable = |source: io::Error| RecordError::Read { name: name.clone(), source };
        let fail = |error: csv::Error| unreadable(cause(error));
        let file = File::open(path).map_err(unreadable)?;
        let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(Bounded::new(file));
        let headings: Vec<String> = reader.headers().map_err(fail)?.iter().map(str::to_owned).collect();
        if let Some(twice) = repeated(&headings) {
            return Err(RecordError::Twice { heading: twice.clone(), name });
        }
        let mut columns = vec![Vec::new(); headings.len()];
        let mut row = csv::StringRecord::new();
        while reader.read_record(&mut row).map_err(fail)? {
            reader.get_mut().begin_line();
            let line = row.position().map_or(0, csv::Position::line);
            for ((cell, heading), column) in row.iter().zip(&headings).zip(&mut columns) {
                let number = cell.parse::<f64>().ok().filter(|number| number.is_finite());
                column.push(number.ok_or_else(|| RecordError::Cell {
                    name: name.clone(),
                    line,
                    heading: heading.clone(),
                    cell: cell.to_owned(),
                })?);
            }
        }
        Ok(Record { name, headings, columns })
    }

    /// A record of columns in memory, each of them with a heading; `name` stands for the file in messages.
    ///
    /// # Errors
    /// - [`RecordError::Lengths`] if columns differ in length
    /// - [`RecordError::Cell`] if a number is not finite
    pub fn of(name: &str, columns: Vec<(String, Vec<f64>)>) -> Result<Record, RecordError> {
        let length = columns.first().map_or(0, |(_, numbers)| numbers.len());
        for (heading, numbers) in &columns {
            if numbers.len() != length {
                return Err(RecordError::Lengths {
                    name: name.to_owned(),
                    heading: heading.clone(),
                    length: numbers.len(),
                    first: columns[0].0.clone(),
                    other: length,
                });
            }
            if let Some(row) = numbers.iter().position(|number| !number.is_finite()) {
                let (heading, cell) = (heading.clone(), numbers[row].to_string());
                return Err(RecordError::Cell { name: name.to_owned(), line: row as u64 + 1, heading, cell });
            }
        }
        let (headings, columns) = columns.into_iter().unzip();
        Ok(Record { name: name.to_owned(), headings, columns })
    }

    /// The column that has one of these headings, multiplied by its factor; the first if there are more that agree.
    ///
    /// # Errors
    /// - [`RecordError::Missing`] if there is none
    /// - [`RecordError::Contradiction`] if there are two that differ
    pub fn column(&self, names: &[(&str, f64)]) -> Result<Vec<f64>, RecordError> {
        let mut found = names.iter().filter_map(|(name, factor)| {
            let index = self.headings.iter().position(|heading| heading == name)?;
            Some((*name, self.columns[index].iter().map(|number| number * factor).collect::<Vec<f64>>()))
        });
        let (first, column) = found.next().ok_or_else(|| RecordError::Missing {
            name: self.name.clone(),
            wanted: names.iter().map(|(name, _)| (*name).to_owned()).collect(),
            headings: self.headings.clone(),
        })?;
        for (second, numbers) in found {
            let largest = column.iter().fold(0.0_f64, |largest, number| largest.max(number.abs()));
            let differs = |(a, b): (&f64, &f64)| (a - b).abs() > SAME * largest;
            if let Some(row) = column.iter().zip(&numbers).position(differs) {
                return Err(RecordError::Contradiction {
                    name: self.name.clone(),
                    first: first.to_owned(),
                    second: second.to_owned(),
                    row: row + 1,
                });
            }
        }
        Ok(column)
    }
}

/// Largest difference of the same number in two units, as a share of the column's largest number.
const SAME: f64 = 1e-6;

/// The headings of a file in words.
fn known(headings: &[String]) -> String {
    if headings.iter().all(String::is_empty) {
        "the file has no columns".to_owned()
    } else {
        format!("the file has {}", headings.join(", "))
    }
}

/// The first of the headings that is there twice.
fn repeated(headings: &[String]) -> Option<&String> {
    let mut seen = HashSet::new();
    headings.iter().find(|heading| !heading.is_empty() && !seen.insert(*heading))
}

/// Headings of times, with their factors to seconds.
pub const TIME: &[(&str, f64)] = &[("time_s", 1.0), ("time_ms", 1e-3)];

/// Headings of strokes, with their factors to radians.
pub const STROKE: &[(&str, f64)] = &[("stroke_rad", 1.0), ("stroke_deg", RADIANS)];

/// Headings of pitch angles, with their factors to radians.
pub const PITCH: &[(&str, f64)] = &[("pitch_rad", 1.0), ("pitch_deg", RADIANS)];

/// Headings of waveforms of unit amplitude.
pub const WAVE: &[(&str, f64)] = &[("wave", 1.0)];

const RADIANS: f64 = core::f64::consts::PI / 180.0;
