//! Names of the files beside a result file.

use std::path::{Path, PathBuf};

use super::disk;
use crate::table::format::Format;

/// Returns the path of the sidecar: `<results>.meta.toml`.
pub fn sidecar_of(results: &Path) -> PathBuf {
    with_ending(results, ".meta.toml")
}

/// Returns the path of the journal: `<results>.journal`.
pub fn journal_of(results: &Path) -> PathBuf {
    with_ending(results, ".journal")
}

/// Returns the path of the file with the rows of an unfinished Parquet file: `<results>.part`.
pub fn part_of(results: &Path) -> PathBuf {
    with_ending(results, ".part")
}

/// Returns the path of the lock file: `<results>.lock`, or a file beside the target if `results` is a link.
pub fn lock_of(results: &Path) -> PathBuf {
    with_ending(&disk::target(results), ".lock")
}

/// Returns the path of the rows before the results are complete. For a Parquet file, the path is [`part_of`].
pub fn rows_of(results: &Path, format: Format) -> PathBuf {
    if format.is_columnar() { part_of(results) } else { results.to_owned() }
}

/// Returns the paths of the sidecar, the journal, the rows of an unfinished Parquet file, and the lock file.
pub(crate) fn all_of(results: &Path) -> [PathBuf; 4] {
    [sidecar_of(results), journal_of(results), part_of(results), lock_of(results)]
}

fn with_ending(path: &Path, ending: &str) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(ending);
    PathBuf::from(name)
}
