//! Writes files so that no incomplete file remains after an error.

use std::fs::{self, File};
use std::io;
use std::path::Path;

use flap_sweep::files::disk;
use flap_sweep::files::output;
use flap_sweep::files::sidecar::Sidecar;

use crate::console;
use crate::failure::Failure;

/// Writes a file. After an error, no incomplete file remains, and an existing file is replaced only when the
/// new file is complete.
///
/// `write` writes the rows and returns the sidecar of the results. The outer `Result` contains errors from
/// creating the file, and the inner `Result` is the return value of `write`.
pub(crate) fn make<E: From<io::Error>>(
    results: &Path,
    overwrite: bool,
    write: impl FnOnce(File) -> Result<Option<Sidecar>, E>,
) -> Result<Result<(), E>, Failure> {
    // Reserves the name while the rows are written beside it.
    let (file, lock) = output::create(results, overwrite)?;
    let Some(lock) = lock else {
        // A device or a pipe is written directly.
        return Ok(write(file).map(drop));
    };
    if let Some(error) = lock.unlocked() {
        warn_unlocked(results, error);
    }
    // On Windows, an open file cannot be replaced on every file system.
    drop(file);
    let written = output::replace(results, write);
    if written.is_err() && disk::is_empty(results) {
        let _ = fs::remove_file(disk::target(results));
    }
    drop(lock);
    Ok(written)
}

/// Prints a warning that the results cannot be locked, so that another run of flap could write to the same
/// file.
pub(super) fn warn_unlocked(results: &Path, error: &io::Error) {
    console::warn(&format!(
        "{} cannot be locked ({error}): make sure that no other run writes to this file",
        results.display()
    ));
}
