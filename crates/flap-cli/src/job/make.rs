//! Writes files that are complete or absent.

use std::fs::{self, File};
use std::io;
use std::path::Path;

use flap_sweep::files::disk;
use flap_sweep::files::output::{self, LockedFile};
use flap_sweep::files::sidecar::Sidecar;

use crate::console;
use crate::failure::Failure;

/// Writes a file all or nothing. An earlier file remains until the new one is complete.
///
/// `write` returns the sidecar of results. The inner result comes from `write`.
pub(crate) fn make<E: From<io::Error>>(
    results: &Path,
    overwrite: bool,
    write: impl FnOnce(File) -> Result<Option<Sidecar>, E>,
) -> Result<Result<(), E>, Failure> {
    // Reserves the name while the rows are written beside it.
    let LockedFile { file: locked, unlocked } = output::create(results, overwrite)?;
    // A device or a pipe is written directly.
    if !locked.metadata().is_ok_and(|metadata| metadata.is_file()) {
        return Ok(write(locked).map(drop));
    }
    if let Some(error) = &unlocked {
        warn_unlocked(results, error);
    }
    let written = output::replace(results, write);
    if written.is_err() && disk::is_empty(results) {
        let _ = fs::remove_file(disk::target(results));
    }
    drop(locked);
    Ok(written)
}

/// Warns that another run could write to the same results.
pub(super) fn warn_unlocked(results: &Path, error: &io::Error) {
    console::warn(&format!(
        "{} cannot be locked ({error}): make sure that no other run writes to this file",
        results.display()
    ));
}
