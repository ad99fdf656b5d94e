//! Rows as text into a file of any format.

use std::fs::File;
use std::io;

use csv::StringRecord;

use super::{Checksums, Format, Provenance, TextRows};
use crate::files::disk::Durable as _;

/// A file of any format that takes rows as text.
pub struct Writer(Rows);

enum Rows {
    Text(Box<TextRows>),
    #[cfg(feature = "parquet")]
    Parquet(Box<super::parquet::ParquetRows>),
}

impl Writer {
    /// Begins an empty file.
    ///
    /// # Errors
    /// The error of the operating system if the file cannot be written.
    pub fn new(file: File, format: Format, provenance: &Provenance) -> io::Result<Writer> {
        match format {
            #[cfg(feature = "parquet")]
            Format::Parquet => {
                let rows = super::parquet::ParquetRows::new(file, provenance)?;
                Ok(Writer(Rows::Parquet(Box::new(rows))))
            }
            _ => {
                let mut rows = TextRows::new(file, format)?;
                rows.header(provenance.columns.iter().map(|column| &column.name))?;
                Ok(Writer(Rows::Text(Box::new(rows))))
            }
        }
    }

    /// Writes a row.
    ///
    /// # Errors
    /// - [`io::ErrorKind::InvalidData`] if a cell does not fit its column
    /// - the error of the operating system if the file cannot be written
    pub fn row(&mut self, cells: &StringRecord) -> io::Result<()> {
        match &mut self.0 {
            Rows::Text(rows) => rows.row(cells),
            #[cfg(feature = "parquet")]
            Rows::Parquet(rows) => rows.row(cells),
        }
    }

    /// Completes the file, makes it durable, and gives its checksums.
    ///
    /// # Errors
    /// The error of the operating system if the file cannot be written.
    pub fn finish(self) -> io::Result<Checksums> {
        match self.0 {
            Rows::Text(mut rows) => {
                rows.finish()?;
                rows.file().sync()?;
                Ok(rows.checksums(None))
            }
            #[cfg(feature = "parquet")]
            Rows::Parquet(rows) => rows.finish(),
        }
    }
}
