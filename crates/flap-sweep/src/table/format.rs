//! The formats of result files.

use std::fs;
use std::path::Path;

/// The format of a result file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Comma-separated values: `.csv`.
    Csv,
    /// The same, compressed with Zstandard: `.csv.zst`.
    CsvZstd,
    /// Columns with types, units and provenance: `.parquet`.
    Parquet,
}

/// The endings of names, and the formats that they stand for.
const NAMED: [(&str, Format); 3] =
    [(".csv", Format::Csv), (".csv.zst", Format::CsvZstd), (".parquet", Format::Parquet)];

impl Format {
    /// The endings, for help and messages.
    pub const ENDINGS: &str =
        if cfg!(feature = "parquet") { ".csv, .csv.zst or .parquet" } else { ".csv or .csv.zst" };

    /// The format that the ending of a file's name stands for, in capital letters or small ones. Devices and pipes are CSV,
    /// whatever they are called.
    ///
    /// # Errors
    /// If the ending stands for no format, or for one that this build leaves out.
    pub fn of(path: &Path) -> Result<Format, FormatError> {
        match Format::named(path) {
            Some(Format::Parquet) if !cfg!(feature = "parquet") => {
                Err(FormatError::WithoutParquet(path.display().to_string()))
            }
            Some(format) => Ok(format),
            None if is_stream(path) => Ok(Format::Csv),
            None => Err(unknown(path, Format::ENDINGS)),
        }
    }

    /// True if a file holds whole columns. Its rows wait beside it, as compressed text, until all are there.
    pub fn is_columnar(self) -> bool {
        self == Format::Parquet
    }

    /// Checks the name of a table that is written as CSV and in no other format.
    ///
    /// # Errors
    /// If the ending is not `.csv`.
    pub fn require_csv(path: &Path) -> Result<(), FormatError> {
        let is_csv = Format::named(path) == Some(Format::Csv) || is_stream(path);
        if is_csv { Ok(()) } else { Err(unknown(path, ".csv")) }
    }

    /// The name of a file without the ending that says its format, and that ending.
    pub fn split_ending(name: &str) -> (&str, &str) {
        let found = NAMED.iter().find(|(ending, _)| name.to_ascii_lowercase().ends_with(ending));
        // The endings are ASCII, so that they have as many bytes in the name.
        name.split_at(name.len() - found.map_or(0, |(ending, _)| ending.len()))
    }

    fn named(path: &Path) -> Option<Format> {
        let (_, ending) = Format::split_ending(path.file_name()?.to_str()?);
        NAMED.iter().find(|(known, _)| ending.eq_ignore_ascii_case(known)).map(|(_, format)| *format)
    }
}

/// A name that stands for no format.
#[derive(Debug, thiserror::Error)]
pub enum FormatError {
    /// It ends in something else, or has no ending.
    #[error("{name}: the file name must end in {allowed}")]
    Unknown {
        /// The file.
        name: String,
        /// The endings that do.
        allowed: &'static str,
    },
    /// A format that this build leaves out.
    #[error("{0}: this flap was built without Parquet")]
    WithoutParquet(String),
}

fn unknown(path: &Path, allowed: &'static str) -> FormatError {
    FormatError::Unknown { name: path.display().to_string(), allowed }
}

/// True if there is something else than a file at `path`, such as a device or a pipe.
fn is_stream(path: &Path) -> bool {
    fs::metadata(path).is_ok_and(|metadata| !metadata.is_file())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn endings_choose_the_format() {
        let format = |name: &str| Format::of(Path::new(name)).ok();
        for name in ["a.csv", "A.CSV", "folder.zst/a.b.Csv"] {
            assert_eq!(format(name), Some(Format::Csv), "{name}");
        }
        for name in ["a.csv.zst", "A.CSV.ZST"] {
            assert_eq!(format(name), Some(Format::CsvZstd), "{name}");
        }
        for name in [
            "a",
            "a.zst",
            "a.gz",
            "a.csv.gz",
            "a.tsv",
            "a.xlsx",
            "a.json",
            "csv",
            "a.csvx",
            "a.csv.meta.toml",
        ] {
            let error = Format::of(Path::new(name)).unwrap_err().to_string();
            let rule = "the file name must end in";
            assert_eq!(error, format!("{name}: {rule} {}", Format::ENDINGS));
        }
        assert!(Format::require_csv(Path::new("a.CSV")).is_ok());
        assert!(Format::require_csv(Path::new("a.csv.zst")).is_err());
    }

    #[test]
    #[cfg(unix)]
    fn devices_are_csv() {
        assert_eq!(Format::of(Path::new("/dev/null")).ok(), Some(Format::Csv));
    }
}
