//! Rows as comma-separated values.

use std::io::{self, Write};

use flap_core::simulate::{Point, Row};

use crate::layout::{Cell, Layout};
use crate::output::Durable;
use crate::sink::Sink;

/// Writes one plain header line, then one line per row.
///
/// Numbers are written as [`crate::text::float`] does, choices by the name of their option;
/// cells of what is not known are empty.
pub struct CsvSink<W: Durable> {
    layout: Layout,
    writer: csv::Writer<W>,
}

impl<W: Durable> CsvSink<W> {
    /// Writes the columns of `layout` to `target`.
    pub fn new(layout: Layout, target: W) -> CsvSink<W> {
        // One system call takes some hundred rows.
        let writer = csv::WriterBuilder::new().buffer_capacity(1 << 16).from_writer(target);
        CsvSink { layout, writer }
    }

    /// What has been written to; complete after [`Sink::flush`] or [`Sink::finish`].
    pub fn target(&self) -> &W {
        self.writer.get_ref()
    }
}

impl<W: Durable> Sink for CsvSink<W> {
    fn begin(&mut self) -> io::Result<()> {
        self.writer.write_record(self.layout.names()).map_err(cause)
    }

    fn write(&mut self, point: &Point, row: &Row) -> io::Result<()> {
        write_cells(&mut self.writer, &self.layout.cells(point, row)).map_err(cause)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.writer.flush()
    }

    fn finish(&mut self) -> io::Result<()> {
        self.writer.flush()?;
        self.writer.get_ref().sync()
    }
}

/// Writes a row of cells, each by way of the same buffer.
pub(crate) fn write_cells<W: Write>(writer: &mut csv::Writer<W>, cells: &[Cell]) -> csv::Result<()> {
    let mut text = String::new();
    for cell in cells {
        text.clear();
        cell.push_text(&mut text);
        writer.write_field(&text)?;
    }
    writer.write_record(None::<&[u8]>)
}

/// What the operating system said, which the conversion of the csv crate would hide, and a closed pipe with it; or what is
/// wrong with the table.
pub fn cause(error: csv::Error) -> io::Error {
    let wrong = |place: Option<csv::Position>, what: String| {
        let line = place.map_or_else(String::new, |place| format!("line {}: ", place.line()));
        io::Error::new(io::ErrorKind::InvalidData, line + &what)
    };
    match error.into_kind() {
        csv::ErrorKind::Io(cause) => cause,
        csv::ErrorKind::UnequalLengths { pos, expected_len, len } => {
            wrong(pos, format!("{len} cells under {expected_len} headings"))
        }
        csv::ErrorKind::Utf8 { pos, .. } => wrong(pos, "not UTF-8 text".to_owned()),
        other => io::Error::other(format!("{other:?}")),
    }
}
