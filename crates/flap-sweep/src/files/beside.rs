//! Names of the files that flap writes beside a result file, such as the sidecar.

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

/// Returns the path of the file that contains the rows of a Parquet file until the Parquet file is complete:
/// `<results>.part`.
pub fn part_of(results: &Path) -> PathBuf {
    with_ending(results, ".part")
}

/// Returns the path of the lock file, `<results>.lock`. If `results` is a link, the lock file is beside the
/// target of the link.
pub fn lock_of(results: &Path) -> PathBuf {
    with_ending(&disk::target(results), ".lock")
}

/// Returns the path of the file that contains the rows of unfinished results. For a Parquet file, this is the
/// path that [`part_of`] returns.
pub fn rows_of(results: &Path, format: Format) -> PathBuf {
    if format.is_columnar() { part_of(results) } else { results.to_owned() }
}

/// Returns the paths of the sidecar, of the journal, of the file `<results>.part`, and of the lock file.
pub(crate) fn all_of(results: &Path) -> [PathBuf; 4] {
    [sidecar_of(results), journal_of(results), part_of(results), lock_of(results)]
}

fn with_ending(path: &Path, ending: &str) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(ending);
    PathBuf::from(name)
}
