//! Waiting rows turned into a Parquet file.

use std::fs::File;
use std::io;
use std::path::Path;

use csv::StringRecord;

use crate::files::results::{Checksums, Format, Provenance, Reader, Writer};

/// Writes the rows that wait in `part` to the empty file `results`, and gives its checksums.
///
/// # Errors
/// - [`io::ErrorKind::Other`] if the rows do not have the checksum `text`
/// - the error of the operating system if a file cannot be read or written
pub(super) fn assemble(
    part: &Path,
    results: File,
    provenance: &Provenance,
    text: &str,
) -> io::Result<Checksums> {
    let mut rows = Reader::new(File::open(part)?, Format::CsvZstd)?;
    let mut writer = Writer::new(results, Format::Parquet, provenance)?;
    let mut row = StringRecord::new();
    while rows.next(&mut row)? {
        writer.row(&row)?;
    }
    let checksums = writer.finish()?;
    if checksums.text != text {
        return Err(io::Error::other(format!(
            "the rows in {} have changed since they were written",
            part.display()
        )));
    }
    Ok(checksums)
}
