//! The digest of the rows in a file of any format.

use std::fs::File;
use std::io;

use super::{Format, TextDigest, text_sum};

/// The digest of the rows in `file` as text; with an error if that ends where the file cannot be decoded.
pub(crate) fn sum_up(file: File, format: Format) -> (TextDigest, io::Result<()>) {
    match format {
        #[cfg(feature = "parquet")]
        Format::Parquet => super::parquet::sum_up(file),
        _ => text_sum(file, format),
    }
}
