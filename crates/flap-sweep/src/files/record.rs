//! Reads measured data from CSV tables with numbers over time.

use std::collections::HashSet;
use std::io;
use std::path::Path;

use flap_core::drive::{Repeat, Samples};
use flap_core::simulate::Trajectory;
use flap_experiments::tracking::{LeadingEdge, pitch_from_projection, rotation_centre, strokes};

use crate::files::csv_sink::cause;
use crate::input::{self, MOST_BYTES};
use crate::notation::text;

/// A measured quantity, such as the time or the stroke.
#[derive(Clone, Copy, Debug)]
pub struct Quantity<'h> {
    /// Possible headings of the column of this quantity, each with the factor that converts the numbers to SI
    /// units.
    pub headings: &'h [(&'h str, f64)],
    /// Largest accepted magnitude, in SI units. With larger numbers, velocities and forces could overflow.
    pub most: f64,
}

/// A table of numbers, which are stored column by column.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    /// Name of the file, for messages.
    name: String,
    headings: Vec<String>,
    columns: Vec<Vec<f64>>,
}

/// Error in a record.
#[derive(Debug, thiserror::Error)]
pub enum RecordError {
    /// The file cannot be read or is not a table.
    #[error("{name}: {source}")]
    Read {
        /// The file.
        name: String,
        /// The reason.
        source: io::Error,
    },
    /// No column has one of the expected headings. The text contains the message for the user.
    #[error("{0}")]
    Missing(String),
    /// The numbers of the record cannot be used. The text contains the message for the user.
    #[error("{0}")]
    Wrong(String),
}

impl Record {
    /// Reads a CSV file whose first line contains the headings. Blanks around headings and numbers are
    /// ignored.
    ///
    /// # Errors
    /// - [`RecordError::Read`] if the file cannot be read, or if a line has more or fewer cells than the line
    ///   of headings.
    /// - [`RecordError::Wrong`] if two columns have the same heading, or a cell is not a finite number.
    pub fn read(path: &Path) -> Result<Record, RecordError> {
        let name = path.display().to_string();
        match input::text(path, MOST_BYTES) {
            Ok(text) => Record::parse(name, &text),
            Err(error) => Err(RecordError::Read { name, source: error.into() }),
        }
    }

    /// Parses measured data from the text of a CSV file. `name` is the name of the file in messages.
    ///
    /// # Errors
    /// See [`Record::read`].
    pub fn parse(name: String, text: &str) -> Result<Record, RecordError> {
        let fail = |error: csv::Error| RecordError::Read { name: name.clone(), source: cause(error) };
        let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(text.as_bytes());
        let headings: Vec<String> = reader.headers().map_err(fail)?.iter().map(str::to_owned).collect();
        if let Some(mistake) = other_separator(&headings) {
            return Err(RecordError::Wrong(format!("{name}: {mistake}")));
        }
        if let Some(twice) = repeated(&headings) {
            let message = format!("{name}: two columns are called {twice}: keep one of them");
            return Err(RecordError::Wrong(message));
        }
        let mut columns = vec![Vec::new(); headings.len()];
        let mut row = csv::StringRecord::new();
        while reader.read_record(&mut row).map_err(fail)? {
            let line = row.position().map_or(0, csv::Position::line);
            for ((cell, heading), column) in row.iter().zip(&headings).zip(&mut columns) {
                let number = cell.parse::<f64>().ok().filter(|number| number.is_finite());
                column.push(number.ok_or_else(|| not_a_number(&name, line, heading, cell))?);
            }
        }
        Ok(Record { name, headings, columns })
    }

    /// Returns a record with the given columns, each with a heading and numbers. `name` is the name of the
    /// record in messages.
    ///
    /// # Errors
    /// [`RecordError::Wrong`] if columns differ in length, or a number is not finite.
    pub fn of(name: &str, columns: Vec<(String, Vec<f64>)>) -> Result<Record, RecordError> {
        let length = columns.first().map_or(0, |(_, numbers)| numbers.len());
        for (heading, numbers) in &columns {
            if numbers.len() != length {
                return Err(RecordError::Wrong(format!(
                    "{name}: columns differ in length: {} has {length} numbers, {heading} has {}",
                    columns[0].0,
                    numbers.len()
                )));
            }
            if let Some(row) = numbers.iter().position(|number| !number.is_finite()) {
                return Err(not_a_number(name, row as u64 + 1, heading, &numbers[row].to_string()));
            }
        }
        let (headings, columns) = columns.into_iter().unzip();
        Ok(Record { name: name.to_owned(), headings, columns })
    }

    /// Returns the numbers of a quantity in SI units. If several columns contain the quantity, such as
    /// `stroke_rad` and `stroke_deg`, the columns must contain equal values after the conversion to SI
    /// units.
    ///
    /// # Errors
    /// - [`RecordError::Missing`] if no column contains the requested quantity.
    /// - [`RecordError::Wrong`] if a number in the column is too large, or if two columns contain different
    ///   numbers for the quantity.
    pub fn column(&self, quantity: &Quantity<'_>) -> Result<Vec<f64>, RecordError> {
        let found = quantity.headings.iter().filter_map(|(name, factor)| {
            let index = self.headings.iter().position(|heading| heading == name)?;
            Some((*name, *factor, &self.columns[index]))
        });
        let mut found = found.map(|(name, factor, numbers)| {
            if let Some(row) = numbers.iter().position(|number| (number * factor).abs() > quantity.most) {
                let (row, number) = (row + 1, numbers[row]);
                let most = text::float((quantity.most / factor).round());
                let reason = format!("{name} is {number:?} in row {row}, and must be from -{most} to {most}");
                return Err(self.wrong(&reason));
            }
            Ok((name, numbers.iter().map(|number| number * factor).collect::<Vec<f64>>()))
        });
        let (first, column) = found.next().ok_or_else(|| {
            let wanted: Vec<&str> = quantity.headings.iter().map(|(name, _)| *name).collect();
            let known = known(&self.headings);
            RecordError::Missing(format!(
                "{}: there is no column {}; {known}",
                self.name,
                wanted.join(" or ")
            ))
        })??;
        for other in found {
            let (second, numbers) = other?;
            let largest = column.iter().fold(0.0_f64, |largest, number| largest.max(number.abs()));
            let differs = |(a, b): (&f64, &f64)| (a - b).abs() > SAME * largest;
            if let Some(row) = column.iter().zip(&numbers).position(differs) {
                let row = row + 1;
                return Err(self.wrong(&format!(
                    "columns {first} and {second} contradict each other in row {row}: keep one of them"
                )));
            }
        }
        Ok(column)
    }

    /// Returns the coordinates of the tracked point `name` in every image. The columns `NAME_x` and `NAME_y`
    /// contain the coordinates.
    ///
    /// # Errors
    /// See [`Record::column`].
    pub fn points(&self, name: &str) -> Result<Vec<[f64; 2]>, RecordError> {
        let coordinate = |axis: &str| {
            self.column(&Quantity { headings: &[(&format!("{name}_{axis}"), 1.0)], most: COORDINATE })
        };
        Ok(coordinate("x")?.into_iter().zip(coordinate("y")?).map(|(x, y)| [x, y]).collect())
    }

    /// Returns the times of the measured values (s).
    fn times(&self) -> Result<Vec<f64>, RecordError> {
        let times = self.column(&TIME)?;
        let duration = times.last().zip(times.first()).map_or(0.0, |(last, first)| last - first);
        let least = LEAST_STEP * duration.max(1.0);
        let mut steps = times.windows(2).map(|two| two[1] - two[0]).enumerate();
        if let Some((at, step)) = steps.find(|(_, step)| *step < least) {
            let (row, next) = (at + 1, at + 2);
            return Err(self.wrong(&if step > 0.0 {
                format!("rows {row} and {next} are {step:e} s apart, and must be at least {least:e} s")
            } else {
                let [time, before] = [times[at + 1], times[at]];
                format!("times do not increase: row {next} is at {time} s, row {row} at {before} s")
            }));
        }
        Ok(times)
    }

    /// Returns a smooth function of time through the measured values of a quantity.
    ///
    /// # Errors
    /// - [`RecordError::Wrong`] if times do not increase or are too close, or if the measured values do not
    ///   define a smooth function.
    /// - Any error that [`Record::column`] returns for the time or for the quantity.
    pub fn samples(&self, quantity: &Quantity<'_>, repeat: Repeat) -> Result<Samples, RecordError> {
        let (times, values) = (self.times()?, self.column(quantity)?);
        Samples::new(&times, &values, repeat).map_err(|error| self.wrong(&error.to_string()))
    }

    /// Returns a warning if the spline through the measured values leaves the range of these values by more
    /// than 2 % of the range. In the warning, the text `unit` stands after the numbers.
    pub fn overshoot(&self, samples: &Samples, unit: &str) -> Option<String> {
        let ([low, high], [from, to]) = (samples.range(), samples.sample_range());
        ((from - low).max(high - to) > OVERSHOOT * (to - from)).then(|| {
            format!(
                "{}: the spline through the samples lies between {low:.3} and {high:.3}{unit}, but the samples between \
                 {from:.3} and {to:.3}{unit}; add samples where the wave changes quickly",
                self.name
            )
        })
    }

    /// Returns the stroke and the pitch of a filmed wing over time, and the centre of rotation of the wing.
    ///
    /// The record must contain the tracked points `root` and `tip` in every image. To compute the pitch, the
    /// function also needs the point `edge` and the length `chord`, in the unit of the coordinates of the
    /// points.
    ///
    /// # Errors
    /// - [`RecordError::Wrong`] if times do not increase or are too close.
    /// - [`RecordError::Wrong`] if the points have no centre of rotation, or if the chord in an image is longer
    ///   than `chord`.
    /// - The errors of [`Record::column`].
    pub fn tracked(&self, chord: Option<f64>) -> Result<(Trajectory, [f64; 2]), RecordError> {
        let times = self.times()?;
        let edges = self.points("root")?.into_iter().zip(self.points("tip")?);
        let edges: Vec<LeadingEdge> = edges.map(|(root, tip)| LeadingEdge { root, tip }).collect();
        let centre = rotation_centre(&edges).map_err(|invalid| self.wrong(&invalid.to_string()))?;
        let mut columns = vec!["time_s".to_owned(), "stroke_deg".to_owned()];
        let strokes = times.iter().zip(strokes(&edges));
        let mut rows: Vec<Vec<f64>> =
            strokes.map(|(time, stroke)| vec![*time, stroke.to_degrees()]).collect();
        if let Some(chord) = chord {
            columns.push("pitch_deg".to_owned());
            let points = edges.iter().zip(self.points("edge")?);
            for (i, (row, (edge, point))) in rows.iter_mut().zip(points).enumerate() {
                let pitch = pitch_from_projection(edge.distance(point), chord);
                let pitch = pitch.map_err(|invalid| self.wrong(&format!("image {}: {invalid}", i + 1)))?;
                row.push(pitch.to_degrees());
            }
        }
        Ok((Trajectory { columns, rows }, centre))
    }

    fn wrong(&self, reason: &str) -> RecordError {
        RecordError::Wrong(format!("{}: {reason}", self.name))
    }
}

fn not_a_number(name: &str, line: u64, heading: &str, cell: &str) -> RecordError {
    RecordError::Wrong(format!("{name}, line {line}, column {heading}: `{cell}` is not a number"))
}

/// Smallest accepted time between two measured values, relative to the duration of the record. If a record
/// is shorter than 1 s, two measured values must be at least 1e-12 s apart.
const LEAST_STEP: f64 = 1e-12;

/// If the spline leaves the range of the measured values by more than this fraction of the range, flap
/// prints a warning.
const OVERSHOOT: f64 = 0.02;

/// Largest difference between two numbers that count as equal, relative to the largest magnitude in the
/// column.
const SAME: f64 = 1e-6;

/// Returns the part of a message that lists the headings of a file.
fn known(headings: &[String]) -> String {
    if headings.iter().all(String::is_empty) {
        "the file has no columns".to_owned()
    } else {
        format!("the file has {}", text::listed(headings.iter().map(String::as_str), "column"))
    }
}

/// Returns a message if the first line of a file contains another separator than commas.
pub fn other_separator(headings: &[String]) -> Option<String> {
    let [heading] = headings else { return None };
    let mark = [";", "\t", "|"].into_iter().find(|mark| heading.contains(mark))?.escape_default();
    Some(format!(
        "the first line contains `{mark}` instead of commas: separate the cells by commas, and write numbers with a decimal point"
    ))
}

/// Returns the first heading that occurs twice; `None` if all headings differ.
pub(crate) fn repeated(headings: &[String]) -> Option<&String> {
    let mut seen = HashSet::new();
    headings.iter().find(|heading| !heading.is_empty() && !seen.insert(*heading))
}

/// Time (s).
pub const TIME: Quantity<'_> = Quantity { headings: &[("time_s", 1.0), ("time_ms", 1e-3)], most: 1e12 };

/// Stroke (rad).
pub const STROKE: Quantity<'_> =
    Quantity { headings: &[("stroke_rad", 1.0), ("stroke_deg", RADIANS)], most: ANGLE };

/// Pitch (rad).
pub const PITCH: Quantity<'_> =
    Quantity { headings: &[("pitch_rad", 1.0), ("pitch_deg", RADIANS)], most: ANGLE };

/// Waveform of unit amplitude.
pub const WAVE: Quantity<'_> = Quantity { headings: &[("wave", 1.0)], most: 1e6 };

/// Largest accepted coordinate of a point in an image. The unit of the coordinates is arbitrary.
const COORDINATE: f64 = 1e12;

const RADIANS: f64 = core::f64::consts::PI / 180.0;

/// Largest accepted angle (rad): 10,000 turns.
const ANGLE: f64 = 3.6e6 * RADIANS;
