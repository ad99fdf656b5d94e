//! One format into another.

use std::fs::File;
use std::io;

use csv::StringRecord;

use super::{Checksums, Format, Provenance, Reader, Writer};
use crate::files::integrity::RowCheck;

/// Why rows cannot be converted.
#[derive(Debug, thiserror::Error)]
pub enum ConvertError {
    /// They cannot be read.
    #[error("cannot read rows: {0}")]
    Read(#[source] io::Error),
    /// Their columns are not those they should have.
    #[error("its columns are not those of the grid that its sidecar holds")]
    Columns,
    /// They are not the rows they should be.
    #[error("{0}")]
    Rows(String),
    /// They cannot be written.
    #[error("cannot write rows: {0}")]
    Write(#[from] io::Error),
}

/// What has been written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Converted {
    /// Rows.
    pub rows: u64,
    /// What they and their file are.
    pub checksums: Checksums,
}

/// Writes the rows of `from` to `to`, which is empty. Those of a tolerant reader that do not pass `check` are left out.
///
/// # Errors
/// If a file cannot be read or written, the columns are not those of `provenance`, or a row does not pass.
pub fn convert(
    from: &mut Reader,
    to: (File, Format),
    provenance: &Provenance,
    mut check: Option<RowCheck>,
) -> Result<Converted, ConvertError> {
    if !from.names().iter().eq(provenance.columns.iter().map(|column| &column.name)) {
        return Err(ConvertError::Columns);
    }
    if let Some(check) = check.as_mut().filter(|_| from.is_tolerant()) {
        check.allow_gaps();
    }
    let mut writer = Writer::new(to.0, to.1, provenance).map_err(ConvertError::Write)?;
    let mut row = StringRecord::new();
    let mut rows = 0;
    while from.next(&mut row).map_err(ConvertError::Read)? {
        let passed = check.as_mut().map_or(Ok(()), |check| check.row(&row).map(|_| ()));
        match passed {
            Err(_) if from.leave_out() => {}
            Err(reason) => return Err(ConvertError::Rows(reason)),
            Ok(()) => {
                writer.row(&row).map_err(ConvertError::Write)?;
                rows += 1;
            }
        }
    }
    check.map_or(Ok(()), |check| check.end()).map_err(ConvertError::Rows)?;
    let checksums = writer.finish().map_err(ConvertError::Write)?;
    Ok(Converted { rows, checksums })
}
