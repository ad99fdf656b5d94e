//! Reads a sample from a file. The file is a CSV table with one point per line, and its headings are names of
//! parameters.

use std::ops::Range;
use std::sync::Arc;

use csv::ByteRecord;
use flap_core::parameter::Parameter;

use crate::grid::axes::Placed;
use crate::grid::lookup::Lookup;
use crate::grid::table::{self, Entry};
use crate::grid::value::text as text_of;
use crate::input::{self, MOST_LISTED};
use crate::notation::units;
use crate::notation::value::{self, UnitOf};
use crate::plan::axes::{Axis, Values};
use crate::plan::{PointsFile, Source};

/// Largest number of wrong cells and lines that are reported. If a file has more wrong cells and lines than
/// this number, its columns are probably wrong.
const MOST_CELLS: usize = 10;

/// Largest allowed number of bytes in a line of the file. A typical line is much shorter than this limit.
const LONGEST_LINE: usize = 1 << 20;

/// Returns the points in the file that the section `[sample]` names.
pub(super) fn read(
    section: &Entry<'_>,
    entries: &[Entry<'_>],
    lookup: &mut Lookup<'_>,
) -> Option<(Placed, PointsFile)> {
    let Some(entry) = table::find(entries, "path") else {
        lookup
            .report(section.key_span.clone(), "the sample has no `path`")
            .help("name the file of points: write `path = \"points.csv\"`");
        return None;
    };
    let path = text_of("path", entry.value, lookup.problems)?;
    let path = lookup.problems.beside(path);
    let text = match input::text(&path, MOST_LISTED) {
        Ok(text) => text,
        Err(reason) => {
            lookup
                .report(entry.value.span(), format!("{}: {reason}", path.display()))
                .note("the path is relative to the folder of the grid file");
            return None;
        }
    };
    let file = PointsFile { path: path.clone(), xxh3: xxhash_rust::xxh3::xxh3_64(text.as_bytes()) };
    let source = Arc::new(Source { name: path.display().to_string(), text });
    let (columns, is_sound) = columns(&source, lookup);
    let keys = columns.iter().map(|_| entry.key_span.clone()).collect();
    let with_units = columns.iter().map(|(.., has_unit)| Some(*has_unit)).collect();
    let axis = Axis::new(columns.into_iter().map(|(index, values, _)| (index, values)).collect());
    if is_sound && axis.is_empty() {
        lookup.report(entry.value.span(), format!("{}: the file has no points", path.display()));
    }
    Some((Placed { axis, span: section.key_span.clone(), keys, with_units }, file))
}

/// A column of the file that lists the points of the sample.
struct Column<'t, 'p> {
    index: usize,
    parameter: &'p Parameter<'p>,
    /// Unit in the heading of the column. The numbers in the cells of the column are in the unit of the
    /// heading.
    unit: Option<&'t str>,
}

/// For each column, returns the index of the parameter, the values, and true if the heading of the column has
/// a unit. The second part of the result is true if the file has no mistakes.
fn columns(source: &Arc<Source>, lookup: &mut Lookup<'_>) -> (Vec<(usize, Values, bool)>, bool) {
    if let Some(line) = source.text.lines().find(|line| line.len() > LONGEST_LINE) {
        let begin = line.as_ptr().addr() - source.text.as_ptr().addr();
        let message =
            format!("the line has {} bytes: a line of points has at most {LONGEST_LINE}", line.len());
        lookup.problems.report_in(source, begin..begin, message);
        return (Vec::new(), false);
    }
    let mut lines = lines(&source.text);
    let Some(headings) = lines.next() else {
        lookup.problems.report_in(source, 0..0, "the file of points is empty".to_owned());
        return (Vec::new(), false);
    };
    let found: Vec<Option<Column<'_, '_>>> =
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
    let columns = columns.map(|(column, values)| (column.index, Values::List(values), column.unit.is_some()));
    (columns.collect(), mistakes == 0)
}

/// Returns the column that a heading such as `wing_area` or `wing_area [mm^2]` describes.
fn heading<'t, 'p>(
    text: &'t str,
    span: &Range<usize>,
    source: &Arc<Source>,
    lookup: &mut Lookup<'p>,
) -> Option<Column<'t, 'p>> {
    let Some((name, unit)) = split_unit(text) else {
        let message = format!("the brackets in the heading `{text}` do not enclose a unit");
        let help = "write the name, then the unit in brackets: `wing_area [mm^2]`";
        lookup.problems.report_in(source, span.clone(), message).help(help);
        return None;
    };
    let known = lookup.robot.parameters();
    let Some(index) = Parameter::index(known, name) else {
        let message = format!("model `{}` has no parameter `{name}`", lookup.robot.name());
        let diagnostic = lookup.problems.report_in(source, span.clone(), message);
        if diagnostic.did_you_mean(name, known.iter().map(|parameter| parameter.name)).help.is_empty() {
            diagnostic.help("the first line names the parameters; `flap models` lists them");
        }
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

/// Splits a heading into the name and the unit in brackets. If the brackets do not enclose a unit at the end
/// of the heading, returns `None`.
fn split_unit(heading: &str) -> Option<(&str, Option<&str>)> {
    let Some((name, rest)) = heading.split_once('[') else {
        return (!heading.contains(']')).then_some((heading, None));
    };
    let unit = rest.trim_end().strip_suffix(']')?;
    (!name.contains(']') && !unit.contains(['[', ']'])).then(|| (name.trim(), Some(unit.trim())))
}

/// Returns the value of a cell. If the cell is wrong, returns a message about the mistake, and advice.
fn value(column: &Column<'_, '_>, text: &str) -> Result<f64, (String, Option<String>)> {
    let unit = column.unit.map_or(UnitOf::TextOrSi, UnitOf::Column);
    value::of_text(column.parameter, text, unit)
        .map_err(|error| (error.message(column.parameter.name, text), error.help()))
}

/// A cell of the table: the text without surrounding blanks and quotes, and the position of its bytes in the
/// file.
type Cell<'t> = (&'t str, Range<usize>);

/// Returns the cells of each line of a CSV file, without blank lines.
///
/// Numbers, units and options contain no commas, so a comma always ends a cell, even between quotes. The
/// function therefore computes the position of each cell in the file from the lengths of the preceding cells.
fn lines(text: &str) -> impl Iterator<Item = Vec<Cell<'_>>> {
    let reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .quoting(false)
        .from_reader(text.as_bytes());
    let records = reader.into_byte_records().map_while(Result::ok);
    records.map(|record| cells(text, &record)).filter(|cells| cells.len() > 1 || !cells[0].1.is_empty())
}

/// Returns the cells of one line of the CSV file `text`. `record` is this line as the CSV reader returned it.
fn cells<'t>(text: &'t str, record: &ByteRecord) -> Vec<Cell<'t>> {
    let position =
        record.position().and_then(|position| usize::try_from(position.byte()).ok()).unwrap_or_default();
    // The reader skips a byte order mark, and line ends before a record.
    let rest = &text[position..];
    let rest = if position == 0 { rest.strip_prefix('\u{feff}').unwrap_or(rest) } else { rest };
    let rest = rest.trim_start_matches(['\r', '\n']);
    let mut at = text.len() - rest.len();
    let mut cells = Vec::with_capacity(record.len());
    for field in record {
        let field = &text[at..at + field.len()];
        let begin = at + field.len() - field.trim_start().len();
        let cell = field.trim();
        at += field.len() + 1;
        let unquoted = cell.strip_prefix('"').and_then(|cell| cell.strip_suffix('"'));
        cells.push((unquoted.unwrap_or(cell).trim(), begin..begin + cell.len()));
    }
    cells
}
