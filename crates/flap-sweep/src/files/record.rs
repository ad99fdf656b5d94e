//! Measured records: CSV tables of numbers against time.

use std::collections::HashSet;
use std::fs::File;
use std::path::Path;

use crate::files::csv_sink::cause;
use crate::files::results::Bounded;

/// A table of numbers, by column.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    /// The file, for messages.
    name: String,
    headings: Vec<String>,
    columns: Vec<Vec<f64>>,
}

/// Why a record cannot be used: the file, the line and the column where that helps, and what is expected.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct RecordError(String);

impl Record {
    /// Reads a CSV file with a line of headings. Blanks around headings and numbers do not count.
    ///
    /// # Errors
    /// If the file cannot be read, a line has another number of cells than the headings, or a cell is not a finite
    /// number.
    pub fn read(path: &Path) -> Result<Record, RecordError> {
        let name = path.display().to_string();
        let fail = |error: csv::Error| RecordError(format!("{name}: {}", cause(error)));
        let file = File::open(path).map_err(|error| RecordError(format!("{name}: {error}")))?;
        let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(Bounded::new(file));
        let headings: Vec<String> = reader.headers().map_err(fail)?.iter().map(str::to_owned).collect();
        if let Some(twice) = repeated(&headings) {
            return Err(RecordError(format!("{name}: there are two columns {twice}: keep one of them")));
        }
        let mut columns = vec![Vec::new(); headings.len()];
        let mut row = csv::StringRecord::new();
        while reader.read_record(&mut row).map_err(fail)? {
            reader.get_mut().begin_line();
            let line = row.position().map_or(0, csv::Position::line);
            for ((cell, heading), column) in row.iter().zip(&headings).zip(&mut columns) {
                let number = cell.parse::<f64>().ok().filter(|number| number.is_finite());
                column.push(number.ok_or_else(|| {
                    RecordError(format!("{name}, line {line}, column {heading}: `{cell}` is not a number"))
                })?);
            }
        }
        Ok(Record { name, headings, columns })
    }

    /// The column that has one of these headings, multiplied by its factor; the first if there are more that agree.
    ///
    /// # Errors
    /// If there is none: which headings are expected, and which the file has. If there are two that contradict each
    /// other: in which row.
    pub fn column(&self, names: &[(&str, f64)]) -> Result<Vec<f64>, RecordError> {
        let mut found = names.iter().filter_map(|(name, factor)| {
            let index = self.headings.iter().position(|heading| heading == name)?;
            Some((*name, self.columns[index].iter().map(|number| number * factor).collect::<Vec<f64>>()))
        });
        let (name, column) = found.next().ok_or_else(|| {
            let wanted: Vec<&str> = names.iter().map(|(name, _)| *name).collect();
            RecordError(format!(
                "{}: there is no column {}; the file has {}",
                self.name,
                wanted.join(" or "),
                self.headings.join(", ")
            ))
        })?;
        for (other, numbers) in found {
            let largest = column.iter().fold(0.0_f64, |largest, number| largest.max(number.abs()));
            let differs = |(a, b): (&f64, &f64)| (a - b).abs() > SAME * largest;
            if let Some(row) = column.iter().zip(&numbers).position(differs) {
                return Err(RecordError(format!(
                    "{}: columns {name} and {other} contradict each other in row {}: keep one of them",
                    self.name,
                    row + 1
                )));
            }
        }
        Ok(column)
    }
}

/// Numbers in two units that differ by less than this share of the largest are the same, rounded.
const SAME: f64 = 1e-6;

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
