//! The formats of result files.

use std::path::Path;

/// What a result file is written as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Comma-separated values, the one format for what is not named otherwise: `.csv`.
    Csv,
    /// The same, compressed with Zstandard: `.csv.zst`.
    CsvZstd,
    /// Columns with types, units and provenance: `.parquet`.
    Parquet,
}

/// An ending that stands for a format which cannot be written.
#[derive(Debug, thiserror::Error)]
pub enum FormatError {
    /// A format that flap does not know.
    #[error("{name}: rows cannot be written as .{extension}")]
    Unknown {
        /// The file.
        name: String,
        /// Its ending.
        extension: String,
    },
    /// A format that this build leaves out.
    #[error("{name}: this flap was built without Parquet")]
    WithoutParquet {
        /// The file.
        name: String,
    },
}

impl Format {
    /// The endings, for help and messages.
    pub const ENDINGS: &str =
        if cfg!(feature = "parquet") { ".csv, .csv.zst or .parquet" } else { ".csv or .csv.zst" };

    /// The format that the name of a file stands for.
    ///
    /// # Errors
    /// If the ending is one of another well-known format, or of one that this build leaves out.
    pub fn of(path: &Path) -> Result<Format, FormatError> {
        let name = || path.display().to_string();
        let extension = path.extension().and_then(|extension| extension.to_str()).unwrap_or_default();
        match extension.to_ascii_lowercase().as_str() {
            "zst" => Ok(Format::CsvZstd),
            "parquet" if cfg!(feature = "parquet") => Ok(Format::Parquet),
            "parquet" => Err(FormatError::WithoutParquet { name: name() }),
            "gz" | "xz" | "bz2" | "zip" | "xlsx" | "json" | "toml" | "arrow" | "feather" => {
                Err(FormatError::Unknown { name: name(), extension: extension.to_owned() })
            }
            _ => Ok(Format::Csv),
        }
    }
}
