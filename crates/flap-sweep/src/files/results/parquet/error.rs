//! Errors of the parquet crate as errors of reading and writing.

use std::io;

use parquet::errors::ParquetError;

/// The error of the operating system, or [`io::ErrorKind::InvalidData`] with the mistake in the file.
pub(super) fn io_error(error: ParquetError) -> io::Error {
    match error {
        ParquetError::External(cause) => match cause.downcast::<io::Error>() {
            Ok(cause) => *cause,
            Err(cause) => io::Error::other(cause),
        },
        other => io::Error::new(io::ErrorKind::InvalidData, other),
    }
}
