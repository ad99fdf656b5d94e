//! Rows of a file, each checked against the plan as it is read.

use std::io;

use csv::StringRecord;

use super::{Reader, RowCheck, RowError};

/// A reader whose rows are checked. If it is tolerant, rows that fail the check are left out.
pub(crate) struct Checked<'a> {
    reader: &'a mut Reader,
    check: RowCheck,
    row: StringRecord,
}

/// Rows that are not those of the plan, or cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum RowsError {
    /// The file cannot be read.
    #[error(transparent)]
    Read(#[from] io::Error),
    /// The file has other columns.
    #[error("its columns differ from those of the grid in its sidecar")]
    Columns,
    /// A row is not the next one of the plan.
    #[error(transparent)]
    Row(#[from] RowError),
}

impl<'a> Checked<'a> {
    /// Checks the rows of `reader`, which is at its first row.
    ///
    /// # Errors
    /// [`RowsError::Columns`] if the file has other columns than the plan.
    pub(crate) fn new(reader: &'a mut Reader, mut check: RowCheck) -> Result<Checked<'a>, RowsError> {
        if !check.has_columns(reader.names()) {
            return Err(RowsError::Columns);
        }
        if reader.is_tolerant() {
            check.allow_gaps();
        }
        Ok(Checked { reader, check, row: StringRecord::new() })
    }

    /// Reads the next row, and gives its point; `None` behind the last one.
    ///
    /// # Errors
    /// - [`RowsError::Read`] if the file cannot be read
    /// - [`RowsError::Row`] if the row is not the next one of the plan, or rows are missing at the end
    pub(crate) fn next(&mut self) -> Result<Option<u64>, RowsError> {
        while self.reader.next(&mut self.row)? {
            match self.check.row(&self.row) {
                Ok(point) => return Ok(Some(point)),
                Err(_) if self.reader.leave_out() => {}
                Err(error) => return Err(error.into()),
            }
        }
        self.check.end()?;
        Ok(None)
    }

    /// The cells of the row that was read last.
    pub(crate) fn row(&self) -> &StringRecord {
        &self.row
    }
}
