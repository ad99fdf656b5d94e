//! Rows as comma-separated values.

use std::io::{self, Write};

use crate::run::Sink;
use crate::table::layout::Cell;
use crate::table::lines::Lines;

/// Writer of uncompressed CSV text: one header line, then one line per row.
///
/// Numbers have the format of [`crate::notation::text::float`]. The cell of a choice contains the name of the
/// chosen option. The cell of an unknown value is empty.
pub struct CsvSink<W: Write> {
    names: Vec<String>,
    lines: Lines<W>,
}

impl<W: Write> CsvSink<W> {
    /// Returns a sink that writes rows to `target`. `names` contains the names of the columns.
    pub fn new(names: Vec<String>, target: W) -> CsvSink<W> {
        CsvSink { names, lines: Lines::new(target) }
    }

    /// Returns the target. After [`Sink::flush`] or [`Sink::finish`], the target contains all rows that
    /// were written to the sink.
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

/// Converts an error of the csv crate into an I/O error. If the table has a mistake, such as a missing cell,
/// the result is [`io::ErrorKind::InvalidData`] with the number of the line. An error of the operating
/// system, such as a closed pipe, is returned unchanged.
///
/// The conversion that the csv crate provides would hide the error of the operating system.
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
