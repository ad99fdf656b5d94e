//! Result files: opened and locked, or replaced as a whole, without overwriting anything unasked.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

use super::beside::{journal_of, rows_of, sidecar_of};
use super::results::Format;
use super::sidecar::{Sidecar, State};
use super::{disk, replacement};

/// A result file that cannot be made.
#[derive(Debug, thiserror::Error)]
pub enum CreateError {
    /// There is a file of that name.
    #[error("{} exists already", .0.display())]
    Exists(PathBuf),
    /// The file is the unfinished result of an interrupted sweep.
    #[error("{} is the unfinished result of an interrupted sweep", .0.display())]
    Unfinished(PathBuf),
    /// A file has the name of one that is written beside the results.
    #[error("{} exists already: writing {} would overwrite it", path.display(), results.display())]
    InTheWay {
        /// The file.
        path: PathBuf,
        /// The results.
        results: PathBuf,
    },
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

impl CreateError {
    fn io(path: &Path) -> impl Fn(io::Error) -> CreateError {
        move |source| CreateError::Io { path: path.to_owned(), source }
    }

    fn in_the_way(path: PathBuf, results: &Path) -> CreateError {
        CreateError::InTheWay { path, results: results.to_owned() }
    }
}

/// A result file that is open.
#[derive(Debug)]
pub struct LockedFile {
    /// The file, locked for as long as it is open.
    pub file: File,
    /// Reason why the file could not be locked: its file system offers no locks. Another run that writes to it would not be
    /// noticed.
    pub unlocked: Option<io::Error>,
}

/// Opens a result file for writing from its beginning. A file with contents is an error; with `overwrite`, the contents stay.
///
/// The file stays locked as long as it is open, so that a second run that writes to it is refused.
/// Devices and pipes hold no results: they are neither refused nor locked.
///
/// # Errors
/// - [`CreateError::Exists`] if the file has contents
/// - [`CreateError::Unfinished`] if it or its replacement has a journal
/// - [`CreateError::InTheWay`] if there is a sidecar without rows; with `overwrite`, if a file that is no sidecar has its name
/// - [`CreateError::Busy`] if another run has locked it
/// - [`CreateError::Io`] if it cannot be opened
pub fn create(path: &Path, overwrite: bool) -> Result<LockedFile, CreateError> {
    let refused = CreateError::io(path);
    let is_new = !path.exists();
    let opened = OpenOptions::new().write(true).create(true).truncate(false).open(path);
    let file = opened.map_err(&refused)?;
    let metadata = file.metadata().map_err(&refused)?;
    if !metadata.is_file() {
        return Ok(LockedFile { file, unlocked: None });
    }
    let unlocked = lock(&file, path)?;
    let allowed = if overwrite {
        check_sidecar(path, replacement::has_sidecar(path))
    } else if replacement::has_journal(path).map_err(&refused)? || replacement::unfinished(path).is_some() {
        Err(CreateError::Unfinished(path.to_owned()))
    } else if metadata.len() > 0 {
        Err(CreateError::Exists(path.to_owned()))
    } else {
        // A run that was killed before its first row leaves an empty file and such a sidecar.
        let is_begun = |sidecar: Sidecar| !is_new && sidecar.state == State::Running;
        check_sidecar(path, Sidecar::read(&sidecar_of(path)).is_ok_and(is_begun))
    };
    if allowed.is_err() && is_new {
        // The first error is the one to report.
        let _ = fs::remove_file(disk::target(path));
    }
    allowed.map(|()| LockedFile { file, unlocked })
}

/// Checks that there is no sidecar, or one that `may` be replaced.
fn check_sidecar(results: &Path, may: bool) -> Result<(), CreateError> {
    let sidecar = sidecar_of(results);
    if may || !disk::is_taken(&sidecar) { Ok(()) } else { Err(CreateError::in_the_way(sidecar, results)) }
}

/// Checks that a run may write its journal and its waiting rows beside the empty results that [`create`] opened.
///
/// # Errors
/// [`CreateError::InTheWay`] if a file of such a name has contents.
pub(crate) fn check_beside(results: &Path, format: Format) -> Result<(), CreateError> {
    let rows = rows_of(results, format);
    for path in [journal_of(results), rows] {
        if path != results && !disk::is_free(&path) {
            return Err(CreateError::in_the_way(path, results));
        }
    }
    Ok(())
}

/// Opens a result file that an earlier run has begun, for reading and writing from its beginning, and locks it as
/// [`create`] does. Makes the file again if it was removed.
///
/// # Errors
/// - [`CreateError::Busy`] if another run has locked the file
/// - [`CreateError::Io`] if it cannot be opened
pub fn reopen(path: &Path) -> Result<LockedFile, CreateError> {
    let opened = OpenOptions::new().read(true).write(true).create(true).truncate(false).open(path);
    let file = opened.map_err(CreateError::io(path))?;
    let unlocked = lock(&file, path)?;
    Ok(LockedFile { file, unlocked })
}

/// Locks a result file as [`create`] does, if there is one.
///
/// # Errors
/// Those of [`reopen`].
pub(crate) fn hold(path: &Path) -> Result<Option<LockedFile>, CreateError> {
    if path.exists() { reopen(path).map(Some) } else { Ok(None) }
}

/// Locks a file for this process. Gives the reason if its file system has no locks.
fn lock(file: &File, path: &Path) -> Result<Option<io::Error>, CreateError> {
    let unlocked = match file.try_lock() {
        Err(TryLockError::WouldBlock) => return Err(CreateError::Busy(path.to_owned())),
        Err(TryLockError::Error(error)) => Some(error),
        Ok(()) => None,
    };
    // Another run may have replaced the file after it was opened here.
    disk::check_in_place(file, path).map_err(CreateError::io(path))?;
    Ok(unlocked)
}

/// Makes the file at `results`, which [`create`] opened, as a whole: an earlier file stays until the new one is complete.
/// `write` gives the sidecar of results. A crash leaves the earlier results, or the new ones, or one of them without a sidecar.
///
/// # Errors
/// The error of `write` or of the operating system.
pub fn replace<E: From<io::Error>>(
    results: &Path,
    write: impl FnOnce(File) -> Result<Option<Sidecar>, E>,
) -> Result<(), E> {
    let rows = disk::Whole::begin(&disk::target(results))?;
    let sidecar = write(rows.file().try_clone()?)?;
    let sidecar = sidecar.map(|sidecar| sidecar.prepare(&sidecar_of(results))).transpose()?;
    rows.file().sync_all()?;
    replacement::discard(results)?;
    replacement::remove_companions(results)?;
    rows.commit()?;
    Ok(sidecar.map_or(Ok(()), disk::Whole::commit)?)
}
