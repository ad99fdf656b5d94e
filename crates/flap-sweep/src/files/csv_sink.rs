//! Rows as comma-separated values.

use std::io::{self, Write};

use crate::run::Sink;
use crate::table::layout::Cell;
use crate::table::lines::Lines;

/// Sink that writes one header line and one line per row, uncompressed.
///
/// Numbers are written by [`crate::notation::text::float`], choices by the name of their option. The cell of an
/// unknown value is empty.
pub struct CsvSink<W: Write> {
    names: Vec<String>,
    lines: Lines<W>,
}

impl<W: Write> CsvSink<W> {
    /// Returns a sink that writes to `target` rows with the columns `names`.
    pub fn new(names: Vec<String>, target: W) -> CsvSink<W> {
        CsvSink { names, lines: Lines::new(target) }
    }

    /// Returns the target. After [`Sink::flush`] or [`Sink::finish`], the target contains all rows.
    pub fn target(&self) -> &W {
        self.lines.target()
    }
}

impl<W: Write> Sink for CsvSink<W> {
    fn begin(&mut self) -> io::Result<()> {
        self.lines.texts(&self.names)
    }

    fn write(&mut self, cells: &[Cell]) -> io::Result<()> {
        self.lines.cells(cells)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.lines.flush()
    }
}

/// Returns the error of the operating system, such as a closed pipe, or [`io::ErrorKind::InvalidData`] with the
/// mistake in the table.
///
/// The conversion of the csv crate would hide the error of the operating system.
pub fn cause(error: csv::Error) -> io::Error {
    let wrong = |place: Option<csv::Position>, what: String| {
        let line = place.map_or_else(String::new, |place| format!("line {}: ", place.line()));
        io::Error::new(io::ErrorKind::InvalidData, line + &what)
    };
    match error.into_kind() {
        csv::ErrorKind::Io(cause) => cause,
        csv::ErrorKind::UnequalLengths { pos, expected_len, len } => {
            wrong(pos, format!("{len} cells, but {expected_len} headings"))
        }
        csv::ErrorKind::Utf8 { pos, .. } => wrong(pos, "not UTF-8 text".to_owned()),
        other => io::Error::other(format!("{other:?}")),
    }
}
