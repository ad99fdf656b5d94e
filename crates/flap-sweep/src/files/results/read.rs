//! Reads rows as text from a result file of any format, and computes the checksums of the rows.

use std::fmt;
use std::fs::File;
use std::io::{self, Read};

use csv::StringRecord;

use super::{Format, TextDigest, text, text_sum};
use crate::files::csv_sink::cause;
use crate::files::record::repeated;
use crate::notation::text::count;

/// Largest number of bytes that are read for one row: 16 MiB. A typical line of results has a few hundred
/// bytes. A line with ten thousand columns has less than 1 MiB.
const LONGEST_LINE: usize = 16 << 20;

/// A reader that returns an error if a line is too long. The limit is necessary, because a few compressed
/// bytes can expand to a line of any length.
pub struct Bounded<R> {
    source: R,
    since_line: usize,
}

impl<R: Read> Bounded<R> {
    /// Returns a reader of `source`.
    pub fn new(source: R) -> Bounded<R> {
        Bounded { source, since_line: 0 }
    }

    /// Begins a new line. Call this function only when the previous line has been read to its end.
    pub fn begin_line(&mut self) {
        self.since_line = 0;
    }
}

impl<R: Read> Read for Bounded<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        if self.since_line > LONGEST_LINE {
            let message =
                format!("a line is longer than {} MiB: this is not a table of numbers", LONGEST_LINE >> 20);
            // An error of this kind ends reading. Readers skip damaged lines only for other kinds.
            return Err(io::Error::other(message));
        }
        let count = self.source.read(buffer)?;
        self.since_line += count;
        Ok(count)
    }
}

/// Reader that returns the rows of a result file one after the other.
pub struct Reader {
    names: Vec<String>,
    rows: Rows,
    missed: Option<Missed>,
}

/// Rows that a tolerant reader has left out because the rows are damaged.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Missed {
    /// Number of lines that were left out because they are not valid rows.
    pub rows: u64,
    /// Reason why the file could not be read to its end; `None` if the file was read to its end.
    pub rest: Option<String>,
}

impl Missed {
    /// Returns true if the reader left out nothing.
    pub fn is_none(&self) -> bool {
        *self == Missed::default()
    }
}

impl fmt::Display for Missed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.rows > 0 {
            let are = if self.rows == 1 { "is not a row and is" } else { "are not rows and are" };
            write!(f, "{} {are} left out", count(self.rows, "line"))?;
        }
        if let Some(reason) = &self.rest {
            let between = if self.rows > 0 { "; " } else { "" };
            write!(f, "{between}everything after the last readable row is left out ({reason})")?;
        }
        Ok(())
    }
}

enum Rows {
    Text(csv::Reader<Bounded<Box<dyn Read>>>),
    #[cfg(feature = "parquet")]
    Parquet(super::parquet::ParquetReader),
}

impl Reader {
    /// Returns a reader at the beginning of `file`.
    ///
    /// # Errors
    /// - [`io::ErrorKind::InvalidData`] if the file does not have the expected format.
    /// - [`io::ErrorKind::Other`] if the file is a Parquet file, but flap was built without support for
    ///   Parquet.
    /// - The error of the operating system if the file cannot be read.
    pub fn new(file: File, format: Format) -> io::Result<Reader> {
        match format {
            #[cfg(feature = "parquet")]
            Format::Parquet => {
                let rows = super::parquet::ParquetReader::new(file)?;
                Ok(Reader { names: rows.names.clone(), rows: Rows::Parquet(rows), missed: None })
            }
            #[cfg(not(feature = "parquet"))]
            Format::Parquet => Err(io::Error::other("this flap was built without Parquet")),
            _ => Reader::of_text(file, format),
        }
    }

    /// Returns a reader of the CSV text in `source`, which may be compressed.
    pub(crate) fn of_text(source: impl Read + 'static, format: Format) -> io::Result<Reader> {
        let mut rows = csv::Reader::from_reader(Bounded::new(text::decoded(source, format)?));
        let names: Vec<String> = rows.headers().map_err(cause)?.iter().map(str::to_owned).collect();
        if let Some(name) = repeated(&names) {
            let message = format!("two columns are named {name}: rename one column");
            return Err(io::Error::new(io::ErrorKind::InvalidData, message));
        }
        Ok(Reader { names, rows: Rows::Text(rows), missed: None })
    }

    /// Makes the reader tolerant: after this call, the reader leaves out unreadable rows instead of returning an error.
    pub(crate) fn tolerate(&mut self) {
        self.missed = Some(Missed::default());
    }

    /// Returns true if the reader leaves out unreadable rows.
    pub fn is_tolerant(&self) -> bool {
        self.missed.is_some()
    }

    /// Returns the rows that the reader left out, or `None` if the reader left out nothing.
    pub fn missed(&self) -> Option<&Missed> {
        self.missed.as_ref().filter(|missed| !missed.is_none())
    }

    /// If the reader is tolerant, adds the last row to the number of left-out rows, and returns true.
    /// Otherwise returns false.
    pub fn leave_out(&mut self) -> bool {
        self.missed.as_mut().map(|missed| missed.rows += 1).is_some()
    }

    /// Returns the column names.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Returns the metadata of a Parquet file, as pairs of a key and a text: see
    /// [`Provenance`](super::Provenance). The list is empty for all formats except Parquet.
    pub fn entries(&self) -> &[(String, String)] {
        match &self.rows {
            Rows::Text(_) => &[],
            #[cfg(feature = "parquet")]
            Rows::Parquet(rows) => &rows.entries,
        }
    }

    /// Reads the next row into `row`. Returns false after the last row.
    ///
    /// # Errors
    /// - [`io::ErrorKind::InvalidData`] if the row is damaged, or if the row and the header have different
    ///   numbers of cells.
    /// - The error of the operating system if the file cannot be read.
    pub fn next(&mut self, row: &mut StringRecord) -> io::Result<bool> {
        loop {
            match (self.read(row), &mut self.missed) {
                (Err(error), Some(missed)) if error.raw_os_error().is_none() => {
                    // After a damaged line, the next line can be read. After a damaged frame or page, nothing can.
                    if matches!(self.rows, Rows::Text(_)) && error.kind() == io::ErrorKind::InvalidData {
                        missed.rows += 1;
                    } else {
                        missed.rest = Some(error.to_string());
                        return Ok(false);
                    }
                }
                (outcome, _) => return outcome,
            }
        }
    }

    fn read(&mut self, row: &mut StringRecord) -> io::Result<bool> {
        match &mut self.rows {
            Rows::Text(rows) => {
                let found = rows.read_record(row).map_err(cause)?;
                rows.get_mut().begin_line();
                Ok(found)
            }
            #[cfg(feature = "parquet")]
            Rows::Parquet(rows) => rows.next(row),
        }
    }
}

/// Returns the checksums of the rows in `file` as CSV text. If the file cannot be decoded to its end, the
/// function also returns an error. After this error, the checksums cover only the rows that were decoded.
pub(crate) fn sum_up(file: File, format: Format) -> (TextDigest, io::Result<()>) {
    match format {
        #[cfg(feature = "parquet")]
        Format::Parquet => super::parquet::sum_up(file),
        _ => text_sum(file, format),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_endless_line_is_refused_and_many_lines_are_not() {
        let mut endless = csv::Reader::from_reader(Bounded::new(io::repeat(b'1')));
        let error = endless.headers().unwrap_err().to_string();
        assert!(error.contains("a line is longer than 16 MiB"), "{error}");

        let lines = "1,2\n".repeat(100_000);
        let parts = (0..100)
            .fold(Box::new(io::empty()) as Box<dyn Read>, |all, _| Box::new(all.chain(lines.as_bytes())));
        let mut reader = csv::Reader::from_reader(Bounded::new(parts));
        let mut row = csv::StringRecord::new();
        let mut rows = 0;
        while reader.read_record(&mut row).unwrap() {
            reader.get_mut().begin_line();
            rows += 1;
        }
        assert_eq!(rows, 100 * 100_000 - 1);
    }
}
