//! Rows as text out of a file of any format.

use std::fmt;
use std::fs::File;
use std::io::{self, Read};

use csv::StringRecord;

use super::{Bounded, Format, text};
use crate::files::csv_sink::cause;

/// Reads the rows of a result file in their order.
pub struct Reader {
    names: Vec<String>,
    rows: Rows,
    missed: Option<Missed>,
}

/// What a tolerant reader did not give.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Missed {
    /// Rows that are none.
    pub rows: u64,
    /// Why those after the last one cannot be read.
    pub rest: Option<String>,
}

impl Missed {
    /// Whether everything was given.
    pub fn is_none(&self) -> bool {
        *self == Missed::default()
    }
}

/// What is missing, in words.
impl fmt::Display for Missed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.rows > 0 {
            write!(f, "{} lines are no rows, and are left out", self.rows)?;
        }
        if let Some(reason) = &self.rest {
            let between = if self.rows > 0 { "; " } else { "" };
            write!(f, "{between}what follows the last row that was read is left out ({reason})")?;
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
    /// What reading says, or that the file is not of this format.
    pub fn new(file: File, format: Format) -> io::Result<Reader> {
        match format {
            Format::Csv | Format::CsvZstd => Reader::of_text(file, format),
            #[cfg(feature = "parquet")]
            Format::Parquet => {
                let rows = super::parquet::ParquetReader::new(file)?;
                Ok(Reader { names: rows.names(), rows: Rows::Parquet(rows), missed: None })
            }
            #[cfg(not(feature = "parquet"))]
            Format::Parquet => Err(io::Error::other("this flap was built without Parquet")),
        }
    }

    /// Reads text, plain or compressed.
    pub(crate) fn of_text(source: impl Read + 'static, format: Format) -> io::Result<Reader> {
        let mut rows = csv::Reader::from_reader(Bounded::new(text::decoded(source, format)?));
        let names = rows.headers().map_err(cause)?.iter().map(str::to_owned).collect();
        Ok(Reader { names, rows: Rows::Text(rows), missed: None })
    }

    /// From now on leaves out what cannot be read, instead of giving an error.
    pub(crate) fn tolerate(&mut self) {
        self.missed = Some(Missed::default());
    }

    /// Whether what cannot be read is left out.
    pub fn is_tolerant(&self) -> bool {
        self.missed.is_some()
    }

    /// What has been left out, if something was.
    pub fn missed(&self) -> Option<&Missed> {
        self.missed.as_ref().filter(|missed| !missed.is_none())
    }

    /// Counts the last row among those left out, if the reader is tolerant; false if it is not.
    pub fn leave_out(&mut self) -> bool {
        self.missed.as_mut().map(|missed| missed.rows += 1).is_some()
    }

    /// The column names.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// What the file says of where its rows come from, as keys with their texts: see
    /// [`Provenance`](super::Provenance). Nothing but in Parquet.
    pub fn entries(&self) -> &[(String, String)] {
        match &self.rows {
            Rows::Text(_) => &[],
            #[cfg(feature = "parquet")]
            Rows::Parquet(rows) => rows.entries(),
        }
    }

    /// Reads the next row into `row`; false if there is none left.
    ///
    /// # Errors
    /// What reading says, or that the row does not fit the header.
    pub fn next(&mut self, row: &mut StringRecord) -> io::Result<bool> {
        loop {
            match (self.read(row), &mut self.missed) {
                (Err(error), Some(missed)) if error.raw_os_error().is_none() => {
                    // A line is wrong alone; what is wrong with a frame or a page hides those behind it.
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
