//! Writes rows as text into a file of any format, and converts files from one format to another.

use std::fs::File;
use std::io;

use csv::StringRecord;

use super::{Checked, Checksums, Format, Provenance, Reader, RowCheck, RowsError, TextRows};
use crate::files::disk;

/// Writes rows, which are given as text, into a file of any format.
pub struct Writer(Rows);

enum Rows {
    Text(Box<TextRows>),
    #[cfg(feature = "parquet")]
    Parquet(Box<super::parquet::ParquetRows>),
}

impl Writer {
    /// Creates an empty file.
    ///
    /// # Errors
    /// Returns the error of the operating system if the file cannot be written.
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
    /// - [`io::ErrorKind::InvalidData`] if a cell does not match the type of its column.
    /// - The error of the operating system if the file cannot be written.
    pub fn row(&mut self, cells: &StringRecord) -> io::Result<()> {
        match &mut self.0 {
            Rows::Text(rows) => rows.row(cells),
            #[cfg(feature = "parquet")]
            Rows::Parquet(rows) => rows.row(cells),
        }
    }

    /// Completes the file, waits until the file is safe on disk, and returns the checksums of the file.
    ///
    /// # Errors
    /// Returns the error of the operating system if the file cannot be written.
    pub fn finish(self) -> io::Result<Checksums> {
        match self.0 {
            Rows::Text(mut rows) => {
                rows.finish()?;
                disk::sync(rows.file())?;
                Ok(rows.checksums(None))
            }
            #[cfg(feature = "parquet")]
            Rows::Parquet(rows) => rows.finish(),
        }
    }
}

/// Reason why rows cannot be converted into a different format.
#[derive(Debug, thiserror::Error)]
pub enum ConvertError {
    /// The rows cannot be read, or are not the rows of the plan.
    #[error(transparent)]
    Rows(#[from] RowsError),
    /// The rows cannot be written.
    #[error("cannot write rows: {0}")]
    Write(#[from] io::Error),
}

/// Writes the rows of `from` into the empty file `to`. If `from` is tolerant, rows that fail `check` are left
/// out. Returns the number of rows, and the checksums of the rows and of the file.
///
/// # Errors
/// - [`ConvertError::Rows`] if `from` cannot be read, if its columns differ from the plan's columns, or if a
///   row fails `check`.
/// - [`ConvertError::Write`] if `to` cannot be written.
pub fn convert(
    from: &mut Reader,
    to: (File, Format),
    provenance: &Provenance,
    check: RowCheck,
) -> Result<(u64, Checksums), ConvertError> {
    let mut from = Checked::new(from, check)?;
    let mut writer = Writer::new(to.0, to.1, provenance)?;
    let mut rows = 0;
    while from.next()?.is_some() {
        writer.row(from.row())?;
        rows += 1;
    }
    Ok((rows, writer.finish()?))
}
