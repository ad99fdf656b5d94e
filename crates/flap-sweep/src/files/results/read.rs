//! Rows as text out of a file of any format.

use std::fmt;
use std::fs::File;
use std::io::{self, Read};

use csv::StringRecord;

use super::{Bounded, Format, text};
use crate::files::csv_sink::cause;
use crate::notation::text::count;

/// Reads the rows of a result file in their order.
pub struct Reader {
    names: Vec<String>,
    rows: Rows,
    missed: Option<Missed>,
}

/// The rows that a tolerant reader left out.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Missed {
    /// Number of lines that are no rows.
    pub rows: u64,
    /// Reason why nothing behind the last row can be read.
    pub rest: Option<String>,
}

impl Missed {
    /// True if nothing was left out.
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
            write!(f, "{between}everything behind the last readable row is left out ({reason})")?;
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
    /// Reads from the beginning of `file`.
    ///
    /// # Errors
    /// - [`io::ErrorKind::InvalidData`] if the file is not of this format
    /// - [`io::ErrorKind::Other`] if flap was built without Parquet
    /// - the error of the operating system if the file cannot be read
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

    /// Reads text, plain or compressed.
    pub(crate) fn of_text(source: impl Read + 'static, format: Format) -> io::Result<Reader> {
        let mut rows = csv::Reader::from_reader(Bounded::new(text::decoded(source, format)?));
        let names = rows.headers().map_err(cause)?.iter().map(str::to_owned).collect();
        Ok(Reader { names, rows: Rows::Text(rows), missed: None })
    }

    /// Makes the reader tolerant: from now on it leaves out rows that cannot be read, instead of giving an error.
    pub(crate) fn tolerate(&mut self) {
        self.missed = Some(Missed::default());
    }

    /// True if rows that cannot be read are left out.
    pub fn is_tolerant(&self) -> bool {
        self.missed.is_some()
    }

    /// The rows that were left out, if there are any.
    pub fn missed(&self) -> Option<&Missed> {
        self.missed.as_ref().filter(|missed| !missed.is_none())
    }

    /// Counts the last row among those left out, and returns true; false if the reader is not tolerant.
    pub fn leave_out(&mut self) -> bool {
        self.missed.as_mut().map(|missed| missed.rows += 1).is_some()
    }

    /// The column names.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The metadata of a Parquet file, as keys with their texts: see [`Provenance`](super::Provenance). Empty for other
    /// formats.
    pub fn entries(&self) -> &[(String, String)] {
        match &self.rows {
            Rows::Text(_) => &[],
            #[cfg(feature = "parquet")]
            Rows::Parquet(rows) => &rows.entries,
        }
    }

    /// Reads the next row into `row`; false if there is none left.
    ///
    /// # Errors
    /// - [`io::ErrorKind::InvalidData`] if the row does not fit the header, or is damaged
    /// - the error of the operating system if the file cannot be read
    pub fn next(&mut self, row: &mut StringRecord) -> io::Result<bool> {
        loop {
            match (self.read(row), &mut self.missed) {
                (Err(error), Some(missed)) if error.raw_os_error().is_none() => {
                    // A damaged line is alone; a damaged frame or page hides the lines behind it.
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
