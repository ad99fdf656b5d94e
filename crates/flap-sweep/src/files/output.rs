//! Opens and locks result files, or replaces whole result files. Existing files are overwritten only at the
//! request of the caller.

use std::fs::{self, File, OpenOptions};
use std::io;
use std::path::{Path, PathBuf};
use std::thread;
use std::time::{Duration, Instant};

use super::beside::{journal_of, lock_of, rows_of, sidecar_of};
pub use super::lock::Lock;
use super::results::Format;
use super::sidecar::{Sidecar, State};
use super::{disk, replacement};

/// Reason why a result file cannot be created.
#[derive(Debug, thiserror::Error)]
pub enum CreateError {
    /// A file with the name of the results exists.
    #[error("{} exists already", .0.display())]
    Exists(PathBuf),
    /// The file is the unfinished result of an interrupted sweep.
    #[error("{} is the unfinished result of an interrupted sweep", .0.display())]
    Unfinished(PathBuf),
    /// flap would overwrite an existing file when it writes a file beside the results, such as the sidecar.
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
    /// The operating system reports an error.
    #[error("cannot write {}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// Error that the operating system reported.
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

/// Opens a result file for writing from the beginning of the file.
///
/// Returns the file and its lock. While the file is locked, other runs cannot write to it. Devices and pipes
/// have no lock.
///
/// If the file has contents and `overwrite` is false, the function returns an error. If the file has contents
/// and `overwrite` is true, the function opens the file and keeps the contents.
///
/// # Errors
/// - [`CreateError::Exists`] if the file has contents and `overwrite` is false.
/// - [`CreateError::Unfinished`] if `overwrite` is false and there is a journal, either of the file or of a
///   new file that will replace the file.
/// - [`CreateError::InTheWay`] if a file of another program has the name of the sidecar or of the lock file.
///   If `overwrite` is false, an existing sidecar causes the same error as a file of another program.
///   However, the sidecar of a run that was killed before its first row causes no error.
/// - [`CreateError::Busy`] if another run has locked the file.
/// - [`CreateError::Io`] if the file cannot be opened.
pub fn create(path: &Path, overwrite: bool) -> Result<(File, Option<Lock>), CreateError> {
    let refused = CreateError::io(path);
    let open = || OpenOptions::new().write(true).create(true).truncate(false).open(path).map_err(&refused);
    if fs::metadata(path).is_ok_and(|metadata| !metadata.is_file()) {
        return Ok((open()?, None));
    }
    let lock = lock(path)?;
    if overwrite {
        check_sidecar(path, replacement::has_sidecar(path))?;
    } else if replacement::has_journal(path).map_err(&refused)? || replacement::unfinished(path).is_some() {
        return Err(CreateError::Unfinished(path.to_owned()));
    } else if !disk::is_empty(path) {
        return Err(CreateError::Exists(path.to_owned()));
    } else {
        // A run that was killed before its first row leaves an empty file and a sidecar in this state.
        let is_begun = |sidecar: Sidecar| path.exists() && sidecar.state == State::Running;
        check_sidecar(path, Sidecar::read(&sidecar_of(path)).is_ok_and(is_begun))?;
    }
    Ok((open()?, Some(lock)))
}

/// Returns an error if a file has the name of the sidecar. If `may` is true, the sidecar may be replaced, so
/// there is no error.
fn check_sidecar(results: &Path, may: bool) -> Result<(), CreateError> {
    let sidecar = sidecar_of(results);
    if may || !disk::is_taken(&sidecar) { Ok(()) } else { Err(CreateError::in_the_way(sidecar, results)) }
}

/// Checks that flap can create the journal and the file of unfinished rows beside the results without
/// overwriting a file.
///
/// # Errors
/// [`CreateError::InTheWay`] if a file with contents has the name of the journal or of the file of unfinished
/// rows.
pub(crate) fn check_beside(results: &Path, format: Format) -> Result<(), CreateError> {
    let rows = rows_of(results, format);
    for path in [journal_of(results), rows] {
        if path != results && !disk::is_free(&path) {
            return Err(CreateError::in_the_way(path, results));
        }
    }
    Ok(())
}

/// Opens a result file that an earlier run has begun, for reading and writing, and locks the file.
///
/// If the file was removed, the function creates the file again.
///
/// # Errors
/// Returns the errors of [`lock`], or [`CreateError::Io`] if the file cannot be opened.
pub(crate) fn reopen(path: &Path) -> Result<(File, Lock), CreateError> {
    let lock = lock(path)?;
    let opened = OpenOptions::new().read(true).write(true).create(true).truncate(false).open(path);
    Ok((opened.map_err(CreateError::io(path))?, lock))
}

/// Time for which [`lock`] waits if another process has locked the results. The lock of a killed process may
/// remain for a moment.
const WAIT: Duration = Duration::from_secs(1);

/// Locks the results at `path` for this process. The results need not exist.
///
/// # Errors
/// - [`CreateError::Busy`] if another run has locked the results.
/// - [`CreateError::InTheWay`] if a file of another program has the name of the lock file.
/// - [`CreateError::Io`] if the lock file cannot be created.
pub(crate) fn lock(path: &Path) -> Result<Lock, CreateError> {
    let lock = lock_of(path);
    let begun = Instant::now();
    let taken = loop {
        match Lock::take(&lock) {
            Ok(None) if begun.elapsed() < WAIT => thread::sleep(WAIT / 50),
            taken => break taken,
        }
    };
    match taken {
        Ok(taken) => taken.ok_or_else(|| CreateError::Busy(path.to_owned())),
        Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {
            Err(CreateError::in_the_way(lock, path))
        }
        Err(error) => Err(CreateError::io(path)(error)),
    }
}

/// Removes the lock files of a killed run: the lock file of the results at `path`, and the lock file of the
/// unfinished new results. If another process uses a lock file, the function keeps the lock file.
pub(crate) fn remove_unused_locks(path: &Path) {
    for results in [path, &replacement::of(path)] {
        let lock = lock_of(results);
        if lock.exists() {
            // A lock file that another run uses stays.
            let _ = Lock::take(&lock);
        }
    }
}

/// Replaces the whole file at `results`, which [`create`] has opened. The earlier file remains until the new
/// file is complete.
///
/// The function `write` writes the new file, and returns the sidecar of the results. After a crash, either
/// the earlier or the new results exist, possibly without a sidecar.
///
/// # Errors
/// Returns the error of `write` or of the operating system.
pub fn replace<E: From<io::Error>>(
    results: &Path,
    write: impl FnOnce(File) -> Result<Option<Sidecar>, E>,
) -> Result<(), E> {
    let rows = disk::Whole::begin(&disk::target(results))?;
    let sidecar = write(rows.file().try_clone()?)?;
    let sidecar = sidecar.map(|sidecar| sidecar.prepare(&sidecar_of(results))).transpose()?;
    rows.file().sync_all()?;
    replacement::discard(results)?;
    remove_unused_locks(results);
    replacement::remove_companions(results)?;
    rows.commit()?;
    Ok(sidecar.map_or(Ok(()), disk::Whole::commit)?)
}
