//! Files that commands make.

use std::fs::File;
use std::io;
use std::path::Path;

use flap_sweep::files::{disk, output};

use crate::failure::Failure;

/// Stdout as a file.
pub(crate) fn stdout() -> io::Result<File> {
    #[cfg(unix)]
    let owned = std::os::fd::AsFd::as_fd(&io::stdout()).try_clone_to_owned();
    #[cfg(windows)]
    let owned = std::os::windows::io::AsHandle::as_handle(&io::stdout()).try_clone_to_owned();
    owned.map(File::from)
}

/// Makes a file as a whole: it is complete, or not there. An earlier file stays until then. The inner result is that of
/// `write`.
pub(crate) fn make<E: From<io::Error>>(
    results: &Path,
    overwrite: bool,
    write: impl FnOnce(File) -> Result<(), E>,
) -> Result<Result<(), E>, Failure> {
    // Holds the name while the rows are written beside it.
    let locked = output::create(results, overwrite)?;
    // A device or a pipe is written directly.
    if !locked.metadata().is_ok_and(|metadata| metadata.is_file()) {
        return Ok(write(locked));
    }
    let written = disk::replace(results, write);
    if written.is_ok() {
        output::forget(results).map_err(|error| Failure::cannot_write(results, &error))?;
    } else if disk::is_empty(results) {
        let _ = std::fs::remove_file(results);
    }
    drop(locked);
    Ok(written)
}
