//! A sample from a file: a CSV table of points, with the names of parameters as headings.

use std::fs;
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use flap_core::parameter::{Kind, Parameter};

use super::super::axes::Placed;
use super::super::params::Lookup;
use super::super::table::{self, Entry};
use super::super::value;
use super::Sample;
use crate::grid::diagnostic::Diagnostic;
use crate::notation::nearest;
use crate::notation::units;
use crate::plan::axis::{Axis, Values};
use crate::plan::{PointsFile, Source};

/// Mistakes in cells that are reported; a file with more has the wrong columns.
const MOST_CELLS: usize = 10;

/// The points of the file that the section names.
pub(super) fn read(section: &Entry<'_>, entries: &[Entry<'_>], lookup: &mut Lookup<'_>) -> Option<Sample> {
    let Some(entry) = table::find(entries, "path") else {
        lookup
            .problems
            .report(section.key_span.clone(), "the sample has no `path`")
            .help("name the file of points: write `path = \"points.csv\"`");
        return None;
    };
    let path = value::text("path", entry.value, lookup.problems)?;
    let path = lookup.problems.beside(path);
    let text = match text(&path) {
        Ok(text) => text,
        Err(reason) => {
            lookup
                .problems
                .report(entry.value.span(), format!("{}: {reason}", path.display()))
                .note("the path is relative to the folder of the grid file");
            return None;
        }
    };
    let file = PointsFile { path: path.clone(), xxh3: xxhash_rust::xxh3::xxh3_64(text.as_bytes()) };
    let source = Arc::new(Source { name: path.display().to_string(), text });
    let (columns, is_sound) = columns(&source, lookup);
    let keys = columns.iter().map(|_| entry.key_span.clone()).collect();
    let axis = Axis { parameters: columns };
    if is_sound && axis.is_empty() {
        lookup.problems.report(entry.value.span(), format!("{}: the file has no points", path.display()));
    }
    Some(Sample { placed: Placed { axis, span: section.key_span.clone(), keys }, file: Some(file) })
}

/// The text of the file, or why there is none.
fn text(path: &Path) -> Result<String, String> {
    let metadata = fs::metadata(path).map_err(|error| error.to_string())?;
    // A device or a pipe may never end.
    if !metadata.is_file() {
        return Err("this is not a file".to_owned());
    }
    let bytes = fs::read(path).map_err(|error| error.to_string())?;
    String::from_utf8(bytes).map_err(|_| "the file is not UTF-8 text".to_owned())
}

/// A column of the file.
struct Column<'t> {
    index: usize,
    parameter: &'static Parameter,
    /// The unit in the heading; numbers in cells are in it.
    unit: Option<&'t str>,
}

/// The values of the parameters, and whether there was nothing to report.
fn columns(source: &Arc<Source>, lookup: &mut Lookup<'_>) -> (Vec<(usize, Values)>, bool) {
    let mut lines = Lines::new(&source.text);
    let Some(headings) = lines.next() else {
        lookup.problems.report_in(source, 0..0, "the file of points is empty".to_owned());
        return (Vec::new(), false);
    };
    let found: Vec<Option<Column<'_>>> =
        headings.iter().map(|(text, span)| heading(text, span, source, lookup)).collect();
    let Some(found) = found.into_iter().collect::<Option<Vec<_>>>() else {
        return (Vec::new(), false);
    };
    for (place, column) in found.iter().enumerate() {
        if found[..place].iter().any(|other| other.index == column.index) {
            let message = format!("`{}` has two columns", column.parameter.name);
            lookup.problems.report_in(source, headings[place].1.clone(), message);
            return (Vec::new(), false);
        }
    }
    let mut values: Vec<Vec<f64>> = vec![Vec::new(); found.len()];
    let mut mistakes = 0;
    for cells in lines {
        if cells.len() == found.len() {
            for ((column, (text, span)), values) in found.iter().zip(&cells).zip(&mut values) {
                match value(column, text) {
                    Ok(number) => values.push(number),
                    Err((message, help)) => {
                        let diagnostic = lookup.problems.report_in(source, span.clone(), message);
                        diagnostic.help.extend(help);
                        mistakes += 1;
                    }
                }
            }
        } else {
            let (first, last) = (&cells[0].1, &cells[cells.len() - 1].1);
            let message =
                format!("the line has {} cells, but there are {} headings", cells.len(), found.len());
            lookup.problems.report_in(source, first.start..last.end, message);
            mistakes += 1;
        }
        if mistakes >= MOST_CELLS {
            break;
        }
    }
    let columns = found.iter().zip(values);
    (columns.map(|(column, values)| (column.index, Values::List(values))).collect(), mistakes == 0)
}

/// The parameter that a heading names, with or without a unit: `wing_area` or `wing_area [mm^2]`.
fn heading<'t>(
    text: &'t str,
    span: &Range<usize>,
    source: &Arc<Source>,
    lookup: &mut Lookup<'_>,
) -> Option<Column<'t>> {
    let Some((name, unit)) = split_unit(text) else {
        let message = format!("the brackets in the heading `{text}` do not enclose a unit");
        let help = "write the name, then the unit in brackets: `wing_area [mm^2]`";
        lookup.problems.report_in(source, span.clone(), message).help(help);
        return None;
    };
    let known = lookup.simulator.parameters();
    let Some(index) = known.iter().position(|parameter| parameter.name == name) else {
        let message = format!("model `{}` has no parameter `{name}`", lookup.simulator.name());
        let diagnostic: &mut Diagnostic = lookup.problems.report_in(source, span.clone(), message);
        match nearest(name, known.iter().map(|parameter| parameter.name)) {
            Some(nearest) => diagnostic.help(format!("did you mean `{nearest}`?")),
            None => diagnostic.help("the first line names the parameters; `flap params` lists them"),
        };
        return None;
    };
    let parameter = &known[index];
    if let Some(unit) = unit
        && let Err(error) = units::parse_as(&format!("1 {unit}"), parameter.unit)
    {
        let message = error.message(&format!("`{name}`"));
        lookup.problems.report_in(source, span.clone(), message).help.extend(error.help());
        return None;
    }
    Some(Column { index, parameter, unit })
}

/// The name in a heading, and the unit in brackets behind it; `None` if the brackets are not a pair at the end.
fn split_unit(heading: &str) -> Option<(&str, Option<&str>)> {
    let Some((name, rest)) = heading.split_once('[') else {
        return (!heading.contains(']')).then_some((heading, None));
    };
    let unit = rest.trim_end().strip_suffix(']')?;
    (!name.contains(']') && !unit.contains(['[', ']'])).then(|| (name.trim(), Some(unit.trim())))
}

/// The value of a cell, or what is wrong with it and what to do.
fn value(column: &Column<'_>, text: &str) -> Result<f64, (String, Option<String>)> {
    let Column { parameter, unit, .. } = column;
    let name = parameter.name;
    let range = match parameter.kind {
        Kind::Number(range) | Kind::Following(range, _) => range,
        Kind::Choice(options) => {
            let index = options.iter().position(|option| *option == text).map(|index| index as f64);
            let help = || Some(format!("options: {}", options.join(", ")));
            return index.ok_or_else(|| (format!("`{name}` has no option `{text}`"), help()));
        }
    };
    let number = match unit {
        Some(unit) => units::parse_as(&format!("{text} {unit}"), parameter.unit),
        // A bare number is in SI units, as in the grid file.
        None => units::parse_as(text, "").or_else(|_| units::parse_as(text, parameter.unit)),
    };
    let number = number.map_err(|error| (error.message(&format!("`{name}`")), error.help()))?;
    if range.contains(number) {
        return Ok(number);
    }
    Err((format!("`{name}` must be {}, not {text}", range.describe()), None))
}

/// The lines of a CSV file that are not empty: cells without the blanks around them, with their bytes.
struct Lines<'t> {
    text: &'t str,
    at: usize,
}

impl<'t> Lines<'t> {
    fn new(text: &'t str) -> Lines<'t> {
        // A byte order mark is no part of the first heading.
        Lines { text, at: if text.starts_with('\u{feff}') { 3 } else { 0 } }
    }
}

impl<'t> Iterator for Lines<'t> {
    type Item = Vec<(&'t str, Range<usize>)>;

    fn next(&mut self) -> Option<Self::Item> {
        while self.at < self.text.len() {
            let start = self.at;
            let line = self.text[start..].lines().next().unwrap_or_default();
            let length = self.text[start..].find('\n').map_or(self.text.len() - start, |newline| newline + 1);
            self.at += length;
            if line.trim().is_empty() {
                continue;
            }
            let mut at = start;
            let cell = |text: &'t str| {
                let begin = at + text.len() - text.trim_start().len();
                let cell = text.trim();
                at += text.len() + 1;
                let quoted = cell.strip_prefix('"').and_then(|cell| cell.strip_suffix('"'));
                (quoted.unwrap_or(cell).trim(), begin..begin + cell.len())
            };
            // Neither numbers nor units nor options have commas.
            return Some(line.split(',').map(cell).collect());
        }
        None
    }
}
