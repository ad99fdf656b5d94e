//! Result files: made without overwriting anything unasked, and made durable at the end.

use std::fs::{self, File, Metadata, OpenOptions, TryLockError};
use std::io::{self, Stdout, Write};
use std::path::{Path, PathBuf};

use crate::files::journal;

/// A place to write to that can be made durable.
pub trait Durable: Write {
    /// Waits until what has been written is safe from a crash of the machine, where that means anything.
    ///
    /// # Errors
    /// What the operating system says.
    fn sync(&self) -> io::Result<()>;
}

impl Durable for File {
    fn sync(&self) -> io::Result<()> {
        // Devices and pipes may refuse to be synchronised, and have nothing to lose.
        if self.metadata()?.is_file() { self.sync_all() } else { Ok(()) }
    }
}

impl Durable for Stdout {
    fn sync(&self) -> io::Result<()> {
        Ok(())
    }
}

impl Durable for Vec<u8> {
    fn sync(&self) -> io::Result<()> {
        Ok(())
    }
}

/// Why a result file cannot be made.
#[derive(Debug, thiserror::Error)]
pub enum CreateError {
    /// There is a file of that name.
    #[error("{} exists already", path.display())]
    Exists {
        /// The file.
        path: PathBuf,
    },
    /// It is what an interrupted sweep has written so far.
    #[error("{} is the unfinished result of an interrupted sweep", path.display())]
    Unfinished {
        /// The file.
        path: PathBuf,
    },
    /// Another process is writing to the file.
    #[error("another run is writing to {}", path.display())]
    Busy {
        /// The file.
        path: PathBuf,
    },
    /// The operating system refuses.
    #[error("cannot write {}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
}

/// Opens a result file for writing from its beginning. What it holds is an error, or with `overwrite` stays until
/// [`empty`] is called: so that nothing is lost if what follows fails.
///
/// The file stays locked as long as it is open, so that a second run that writes to it is refused.
/// Devices and pipes hold no results: they are neither refused nor locked.
///
/// # Errors
/// If the file holds something, is unfinished, is being written by another run, or cannot be made.
pub fn create(path: &Path, overwrite: bool) -> Result<File, CreateError> {
    let refused = |source| CreateError::Io { path: path.to_owned(), source };
    let opened = OpenOptions::new().write(true).create(true).truncate(false).open(path);
    let file = opened.map_err(refused)?;
    if !file.metadata().map_err(refused)?.is_file() {
        return Ok(file);
    }
    lock(&file, path)?;
    if !overwrite && journal::read(&journal::path_of(path)).map_err(refused)?.is_some() {
        return Err(CreateError::Unfinished { path: path.to_owned() });
    }
    if file.metadata().map_err(refused)?.len() > 0 && !overwrite {
        return Err(CreateError::Exists { path: path.to_owned() });
    }
    Ok(file)
}

/// Opens a result file that an earlier run has begun, for reading and writing from its beginning, and locks it as
/// [`create`] does. Makes it again if it was removed.
///
/// # Errors
/// If the file is being written by another run or cannot be opened.
pub fn reopen(path: &Path) -> Result<File, CreateError> {
    let opened = OpenOptions::new().read(true).write(true).create(true).truncate(false).open(path);
    let file = opened.map_err(|source| CreateError::Io { path: path.to_owned(), source })?;
    lock(&file, path)?;
    Ok(file)
}

fn lock(file: &File, path: &Path) -> Result<(), CreateError> {
    match file.try_lock() {
        Err(TryLockError::WouldBlock) => Err(CreateError::Busy { path: path.to_owned() }),
        // Where files cannot be locked at all, there is no other run to know of.
        Ok(()) | Err(TryLockError::Error(_)) => Ok(()),
    }
}

/// Checks that what is written to `file` still arrives at `path`, where it was opened.
///
/// # Errors
/// If there is no file at `path` any more, or another one.
pub fn check_in_place(file: &File, path: &Path) -> io::Result<()> {
    let gone = || io::Error::other(format!("{} was removed or replaced meanwhile", path.display()));
    let there = fs::metadata(path).map_err(|error| match error.kind() {
        io::ErrorKind::NotFound => gone(),
        _ => error,
    })?;
    // Elsewhere than on Unix, a file that is open can neither be removed nor replaced.
    if !cfg!(unix) || is_same((path, &file.metadata()?), (path, &there)) { Ok(()) } else { Err(gone()) }
}

/// Whether two files are one: by device and inode where there are such numbers, elsewhere by the full path.
#[cfg(unix)]
pub(crate) fn is_same((_, a): (&Path, &Metadata), (_, b): (&Path, &Metadata)) -> bool {
    use std::os::unix::fs::MetadataExt;
    (a.dev(), a.ino()) == (b.dev(), b.ino())
}

#[cfg(not(unix))]
pub(crate) fn is_same((a, _): (&Path, &Metadata), (b, _): (&Path, &Metadata)) -> bool {
    matches!((fs::canonicalize(a), fs::canonicalize(b)), (Ok(a), Ok(b)) if a == b)
}

/// Where the bytes of a file wait until they are complete.
pub(crate) fn temporary_of(path: &Path) -> PathBuf {
    let mut temporary = path.as_os_str().to_owned();
    temporary.push(".tmp");
    PathBuf::from(temporary)
}

/// Makes the file at `path`, in place of an earlier one, once `write` has written all of it and it is durable.
///
/// # Errors
/// What `write` or the operating system says. Then an earlier file is as it was.
pub fn replace<E: From<io::Error>>(path: &Path, write: impl FnOnce(File) -> Result<(), E>) -> Result<(), E> {
    let temporary = temporary_of(path);
    let written = File::create(&temporary).map_err(E::from).and_then(|file| {
        write(file.try_clone()?)?;
        file.sync_all()?;
        Ok(fs::rename(&temporary, path)?)
    });
    if written.is_err() {
        // The error tells what went wrong; half a file would be of no use.
        let _ = fs::remove_file(&temporary);
    }
    written
}

/// Drops what a file holds.
///
/// # Errors
/// What the operating system says.
pub fn empty(file: &File) -> io::Result<()> {
    if file.metadata()?.is_file() { file.set_len(0) } else { Ok(()) }
}
