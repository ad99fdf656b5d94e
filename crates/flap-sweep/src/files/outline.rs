//! Reads the outline of a wing from a CSV file.

use std::path::Path;

use flap_core::aero::{Outline, Station};

use super::record::{other_separator, repeated};
use crate::input::{self, MOST_BYTES};
use crate::notation::{UserError, units};

/// Names of the columns, in the order of the fields of [`Station`].
const COLUMNS: [&str; 3] = ["span", "leading_edge", "trailing_edge"];

const HELP: &str = "the file has the columns span, leading_edge and trailing_edge, each with a unit in brackets: \
     `span [mm],leading_edge [mm],trailing_edge [mm]`, distances from the root, ahead of the hinge's axis, and behind it";

/// Reads the outline of a wing from a CSV file with the columns `span`, `leading_edge` and `trailing_edge`.
/// Each heading ends with the unit of the column in brackets, such as `span [mm]`.
///
/// # Errors
/// Returns an error if the file cannot be read or does not describe an outline.
pub fn read(path: &Path) -> Result<Outline, UserError> {
    let text = input::text(path, MOST_BYTES)
        .map_err(|cause| UserError { message: format!("{}: {cause}", path.display()), help: None })?;
    parse(path, &text)
}

/// Parses the outline of a wing from the text of a CSV file. Messages about mistakes in the file contain its
/// path, `path`.
///
/// # Errors
/// Returns an error if the text does not describe an outline.
pub fn parse(path: &Path, text: &str) -> Result<Outline, UserError> {
    let mut reader =
        csv::ReaderBuilder::new().trim(csv::Trim::All).comment(Some(b'#')).from_reader(text.as_bytes());
    let refused = |message: String| UserError { message, help: Some(HELP.to_owned()) };
    let wrong = |line: u64, reason: String| refused(format!("{}:{line}: {reason}", path.display()));
    let headings = reader.headers().map_err(|error| wrong(1, error.to_string()))?.clone();
    let names: Vec<String> = headings.iter().map(|heading| split(heading).0.to_owned()).collect();
    if let Some(mistake) = other_separator(&headings.iter().map(str::to_owned).collect::<Vec<_>>()) {
        return Err(wrong(1, mistake));
    }
    if let Some(twice) = repeated(&names) {
        return Err(wrong(1, format!("two columns are called {twice}: keep one of them")));
    }
    let columns = COLUMNS.map(|name| find(&headings, name));
    let [Some(span), Some(leading), Some(trailing)] = columns else {
        let missing = COLUMNS.iter().zip(&columns).find(|(_, column)| column.is_none());
        let missing = missing.map_or("", |(name, _)| *name);
        return Err(wrong(1, format!("there is no column `{missing}`")));
    };
    let columns = [span, leading, trailing];
    if let Some((name, _)) = COLUMNS.iter().zip(&columns).find(|(_, (_, unit))| unit.is_empty()) {
        return Err(wrong(1, format!("the column `{name}` has no unit")));
    }
    let [span, leading, trailing] = columns;
    let mut stations = Vec::new();
    for record in reader.records() {
        let record = record
            .map_err(|error| wrong(error.position().map_or(0, csv::Position::line), error.to_string()))?;
        let line = record.position().map_or(0, csv::Position::line);
        let number = |(place, unit): &(usize, String)| {
            let text = record.get(*place).unwrap_or_default();
            units::parse_as(&format!("{text} {unit}"), "m")
                .map_err(|error| wrong(line, error.message(&format!("`{text}` in the column {}", place + 1))))
        };
        stations.push(Station {
            span: number(&span)?,
            leading: number(&leading)?,
            trailing: number(&trailing)?,
        });
    }
    Outline::new(stations).map_err(|cause| refused(format!("{}: {cause}", path.display())))
}

/// Returns the position and the unit of the column called `name`. The unit is empty if the heading has no
/// unit.
fn find(headings: &csv::StringRecord, name: &str) -> Option<(usize, String)> {
    let place = headings.iter().position(|heading| split(heading).0 == name)?;
    Some((place, split(&headings[place]).1.to_owned()))
}

/// Returns the name and the unit in a heading such as `span [mm]`.
fn split(heading: &str) -> (&str, &str) {
    let (name, unit) = heading.split_once('[').unwrap_or((heading, ""));
    (name.trim(), unit.trim_end_matches(']').trim())
}
