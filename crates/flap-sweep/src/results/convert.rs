//! One format into another.

use std::fs::File;
use std::io;

use csv::StringRecord;

use super::{Format, Provenance, Reader, Writer};

/// Why rows cannot be converted.
#[derive(Debug, thiserror::Error)]
pub enum ConvertError {
    /// They cannot be read.
    #[error("cannot read rows: {0}")]
    Read(#[source] io::Error),
    /// Their columns are not those they should have.
    #[error("its columns are not those of the grid that its sidecar holds")]
    Columns,
    /// They cannot be written.
    #[error("cannot write rows: {0}")]
    Write(#[from] io::Error),
}

/// Writes the rows of `from` to `to`, which is empty, and gives their number.
///
/// # Errors
/// If a file cannot be read or written, or the columns are not those of `provenance`.
pub fn convert(
    from: (File, Format),
    to: (File, Format),
    provenance: &Provenance,
) -> Result<u64, ConvertError> {
    let mut reader = Reader::new(from.0, from.1).map_err(ConvertError::Read)?;
    if !reader.names().iter().eq(provenance.columns.iter().map(|column| &column.name)) {
        return Err(ConvertError::Columns);
    }
    let mut writer = Writer::new(to.0, to.1, provenance).map_err(ConvertError::Write)?;
    let mut row = StringRecord::new();
    let mut rows = 0;
    while reader.next(&mut row).map_err(ConvertError::Read)? {
        writer.row(&row).map_err(ConvertError::Write)?;
        rows += 1;
    }
    writer.finish().map_err(ConvertError::Write)?;
    Ok(rows)
}
