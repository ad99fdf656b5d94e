//! Result files: opened and locked without overwriting anything unasked.

use std::fs::{File, OpenOptions, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

use crate::files::beside;
use crate::files::disk;
use crate::files::journal;

/// A result file that cannot be made.
#[derive(Debug, thiserror::Error)]
pub enum CreateError {
    /// There is a file of that name.
    #[error("{} exists already", .0.display())]
    Exists(PathBuf),
    /// The file is the unfinished result of an interrupted sweep.
    #[error("{} is the unfinished result of an interrupted sweep", .0.display())]
    Unfinished(PathBuf),
    /// Another process is writing to the file.
    #[error("another run is writing to {}", .0.display())]
    Busy(PathBuf),
    /// The operating system refuses.
    #[error("cannot write {}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// The error of the operating system.
        source: io::Error,
    },
}

/// Opens a result file for writing from its beginning. A file with contents is an error; with `overwrite`, the contents
/// stay until [`empty`](crate::files::disk::empty) is called, so that nothing is lost if the next step fails.
///
/// The file stays locked as long as it is open, so that a second run that writes to it is refused.
/// Devices and pipes hold no results: they are neither refused nor locked.
///
/// # Errors
/// - [`CreateError::Exists`] if the file has contents
/// - [`CreateError::Unfinished`] if it has a journal
/// - [`CreateError::Busy`] if another run has locked it
/// - [`CreateError::Io`] if it cannot be opened
pub fn create(path: &Path, overwrite: bool) -> Result<File, CreateError> {
    let refused = |source| CreateError::Io { path: path.to_owned(), source };
    let opened = OpenOptions::new().write(true).create(true).truncate(false).open(path);
    let file = opened.map_err(refused)?;
    if !file.metadata().map_err(refused)?.is_file() {
        return Ok(file);
    }
    lock(&file, path)?;
    if !overwrite && journal::read(&beside::journal_of(path)).map_err(refused)?.is_some() {
        return Err(CreateError::Unfinished(path.to_owned()));
    }
    if file.metadata().map_err(refused)?.len() > 0 && !overwrite {
        return Err(CreateError::Exists(path.to_owned()));
    }
    Ok(file)
}

/// Opens a result file that an earlier run has begun, for reading and writing from its beginning, and locks it as
/// [`create`] does. Makes the file again if it was removed.
///
/// # Errors
/// - [`CreateError::Busy`] if another run has locked the file
/// - [`CreateError::Io`] if it cannot be opened
pub fn reopen(path: &Path) -> Result<File, CreateError> {
    let file = open_or_make(path).map_err(|source| CreateError::Io { path: path.to_owned(), source })?;
    lock(&file, path)?;
    Ok(file)
}

/// Opens a file for reading and writing from its beginning. Makes it if there is none.
pub(crate) fn open_or_make(path: &Path) -> io::Result<File> {
    OpenOptions::new().read(true).write(true).create(true).truncate(false).open(path)
}

fn lock(file: &File, path: &Path) -> Result<(), CreateError> {
    match file.try_lock() {
        Err(TryLockError::WouldBlock) => Err(CreateError::Busy(path.to_owned())),
        // A file system without locks knows of no other run.
        Ok(()) | Err(TryLockError::Error(_)) => Ok(()),
    }
}

/// Removes the journal and the unfinished rows beside the results at `path`.
///
/// # Errors
/// The error of the operating system if a file cannot be removed.
pub fn forget(path: &Path) -> io::Result<()> {
    disk::remove_if_there(&beside::journal_of(path))?;
    disk::remove_if_there(&beside::part_of(path))
}
