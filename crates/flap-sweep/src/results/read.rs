//! Rows as text out of a file of any format.

use std::fs::File;
use std::io::{self, BufReader, Read};

use csv::StringRecord;

use super::{Bounded, Format};
use crate::csv_sink::cause;

/// The most memory that a compressed file may ask for to be read: 2^27 bytes, which is what the command `zstd` allows.
const WINDOW_LOG_MAX: u32 = 27;

/// Reads the rows of a result file in their order.
pub struct Reader {
    names: Vec<String>,
    rows: Rows,
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
        let source: Box<dyn Read> = match format {
            Format::Csv => Box::new(BufReader::with_capacity(1 << 16, file)),
            Format::CsvZstd => {
                let mut decoder = zstd::Decoder::new(file)?;
                decoder.window_log_max(WINDOW_LOG_MAX)?;
                Box::new(decoder)
            }
            #[cfg(feature = "parquet")]
            Format::Parquet => {
                let rows = super::parquet::ParquetReader::new(file)?;
                return Ok(Reader { names: rows.names(), rows: Rows::Parquet(rows) });
            }
            #[cfg(not(feature = "parquet"))]
            Format::Parquet => return Err(io::Error::other("this flap was built without Parquet")),
        };
        let mut rows = csv::Reader::from_reader(Bounded::new(source));
        let names = rows.headers().map_err(cause)?.iter().map(str::to_owned).collect();
        Ok(Reader { names, rows: Rows::Text(rows) })
    }

    /// The column names.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Reads the next row into `row`; false if there is none left.
    ///
    /// # Errors
    /// What reading says, or that the row does not fit the header.
    pub fn next(&mut self, row: &mut StringRecord) -> io::Result<bool> {
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
