//! Result files: made without overwriting anything unasked, and made durable at the end.

use std::fs::{File, OpenOptions, TryLockError};
use std::io::{self, Stdout, Write};
use std::path::{Path, PathBuf};

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
/// If the file holds something, is being written by another run, or cannot be made.
pub fn create(path: &Path, overwrite: bool) -> Result<File, CreateError> {
    let refused = |source| CreateError::Io { path: path.to_owned(), source };
    let opened = OpenOptions::new().write(true).create(true).truncate(false).open(path);
    let file = opened.map_err(refused)?;
    if !file.metadata().map_err(refused)?.is_file() {
        return Ok(file);
    }
    // Where files cannot be locked at all, there is no other run to know of.
    if let Err(TryLockError::WouldBlock) = file.try_lock() {
        return Err(CreateError::Busy { path: path.to_owned() });
    }
    if file.metadata().map_err(refused)?.len() > 0 && !overwrite {
        return Err(CreateError::Exists { path: path.to_owned() });
    }
    Ok(file)
}

/// Drops what a file holds.
///
/// # Errors
/// What the operating system says.
pub fn empty(file: &File) -> io::Result<()> {
    if file.metadata()?.is_file() { file.set_len(0) } else { Ok(()) }
}
