//! Rows of one format as those of another.

use std::fs::File;
use std::io;

use super::{Checked, Checksums, Format, Provenance, Reader, RowCheck, RowsError, Writer};

/// Rows that cannot be converted.
#[derive(Debug, thiserror::Error)]
pub enum ConvertError {
    /// They cannot be read, or are not those of the plan.
    #[error(transparent)]
    Rows(#[from] RowsError),
    /// They cannot be written.
    #[error("cannot write rows: {0}")]
    Write(#[from] io::Error),
}

/// The rows and the file that a conversion has written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Converted {
    /// Number of rows.
    pub rows: u64,
    /// Checksums of the rows and of the file.
    pub checksums: Checksums,
}

/// Writes the rows of `from` to `to`, which is empty. Rows of a tolerant reader that fail `check` are left out.
///
/// # Errors
/// - [`ConvertError::Rows`] if `from` cannot be read, has other columns than the plan, or a row that fails `check`
/// - [`ConvertError::Write`] if `to` cannot be written
pub fn convert(
    from: &mut Reader,
    to: (File, Format),
    provenance: &Provenance,
    check: RowCheck,
) -> Result<Converted, ConvertError> {
    let mut from = Checked::new(from, check)?;
    let mut writer = Writer::new(to.0, to.1, provenance)?;
    let mut rows = 0;
    while from.next()?.is_some() {
        writer.row(from.row())?;
        rows += 1;
    }
    Ok(Converted { rows, checksums: writer.finish()? })
}
