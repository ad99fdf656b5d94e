//! Formats of result files.

use std::fs;
use std::path::{Path, PathBuf};

/// Format of a result file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Comma-separated values: `.csv`.
    Csv,
    /// Comma-separated values, compressed with Zstandard: `.csv.zst`.
    CsvZstd,
    /// Parquet file with types and units of columns, and with the origin of the rows: `.parquet`.
    Parquet,
}

/// Endings of file names, each with its format.
const NAMED: [(&str, Format); 3] =
    [(".csv", Format::Csv), (".csv.zst", Format::CsvZstd), (".parquet", Format::Parquet)];

impl Format {
    /// Endings of all formats, as text for help and messages.
    pub const ENDINGS: &str =
        if cfg!(feature = "parquet") { ".csv, .csv.zst or .parquet" } else { ".csv or .csv.zst" };

    /// Returns the format that the ending of a file name determines. The ending may be in upper or lower
    /// case. For a device or a pipe whose name has no known ending, the format is CSV.
    ///
    /// # Errors
    /// Returns an error if the file name has no known ending, or if this build of flap does not support the
    /// format.
    pub fn of(path: &Path) -> Result<Format, FormatError> {
        match Format::named(path) {
            Some(Format::Parquet) if !cfg!(feature = "parquet") => {
                Err(FormatError(format!("{}: this flap was built without Parquet", path.display())))
            }
            Some(format) => Ok(format),
            None if is_no_regular_file(path) => Ok(Format::Csv),
            None => Err(unknown(path, Format::ENDINGS)),
        }
    }

    /// Returns true if the format stores a table column by column, as Parquet does. Until all rows of a
    /// Parquet file are computed, flap stores the rows as compressed text in a separate file.
    pub fn is_columnar(self) -> bool {
        self == Format::Parquet
    }

    /// Checks the name of a table that can only be written as CSV.
    ///
    /// # Errors
    /// Returns an error if the file name does not end in `.csv`.
    pub fn require_csv(path: &Path) -> Result<(), FormatError> {
        let is_csv = Format::named(path) == Some(Format::Csv) || is_no_regular_file(path);
        if is_csv { Ok(()) } else { Err(unknown(path, ".csv")) }
    }

    /// Splits the name of a file into the part before the ending of the format and the ending, such as `rows`
    /// and `.csv`.
    pub fn split_ending(name: &str) -> (&str, &str) {
        let found = NAMED.iter().find(|(ending, _)| name.to_ascii_lowercase().ends_with(ending));
        // The endings are ASCII, so they have as many bytes in the name.
        name.split_at(name.len() - found.map_or(0, |(ending, _)| ending.len()))
    }

    /// Inserts a word before the ending of the format: for example, `rows.csv` becomes `rows.new.csv`.
    pub fn with_word(path: &Path, word: &str) -> PathBuf {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let (stem, ending) = Format::split_ending(&name);
        path.with_file_name(format!("{stem}.{word}{ending}"))
    }

    fn named(path: &Path) -> Option<Format> {
        let (_, ending) = Format::split_ending(path.file_name()?.to_str()?);
        NAMED.iter().find(|(known, _)| ending.eq_ignore_ascii_case(known)).map(|(_, format)| *format)
    }
}

/// Error if a file name has no supported ending, such as `.csv`. The error contains the message.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct FormatError(String);

fn unknown(path: &Path, allowed: &str) -> FormatError {
    FormatError(format!("{}: the file name must end in {allowed}", path.display()))
}

/// Returns true if `path` exists but is not a regular file, for example a device or a pipe.
fn is_no_regular_file(path: &Path) -> bool {
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
