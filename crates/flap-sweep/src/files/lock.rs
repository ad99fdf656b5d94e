//! Locks result files, so that only one process writes to a result file.
//!
//! flap locks an empty file beside the results with a file lock of the operating system. The operating system
//! releases the lock when the process ends. If a process is killed, its lock file remains, but the lock file
//! is not locked.
//!
//! The results themselves are not locked. On Windows, a locked file cannot be read or written through other
//! file handles. Some file systems cannot replace an open file.

use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

use super::disk;

/// A lock that this process has on a result file. When the lock is dropped, the lock file is removed.
#[derive(Debug)]
pub struct Lock {
    file: File,
    path: PathBuf,
    unlocked: Option<io::Error>,
}

impl Lock {
    /// Locks the file at `path`. If the file is missing, the function creates it. Returns `None` if another
    /// process has locked the file.
    ///
    /// # Errors
    /// - [`io::ErrorKind::AlreadyExists`] if a file with contents, a folder or a link has this name: see
    ///   [`disk::is_free`].
    /// - The error of the operating system if the file cannot be created.
    pub(crate) fn take(path: &Path) -> io::Result<Option<Lock>> {
        loop {
            if disk::is_taken(path) && !disk::is_free(path) {
                return Err(io::ErrorKind::AlreadyExists.into());
            }
            let file = File::options().read(true).write(true).create(true).truncate(false).open(path)?;
            let unlocked = match file.try_lock() {
                Err(TryLockError::WouldBlock) => return Ok(None),
                Err(TryLockError::Error(error)) => Some(error),
                Ok(()) => None,
            };
            // The earlier holder may have removed the file after this process opened it. Windows may then deny access.
            match disk::is_in_place(&file, path) {
                Ok(true) => return Ok(Some(Lock { file, path: path.to_owned(), unlocked })),
                Err(error) if error.kind() != io::ErrorKind::PermissionDenied => return Err(error),
                _ => {}
            }
        }
    }

    /// If the file system does not support locks, returns the error of the operating system. Without a lock,
    /// flap does not detect a second run that writes to the same results.
    pub fn unlocked(&self) -> Option<&io::Error> {
        self.unlocked.as_ref()
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        // The file is removed while it is locked, so a process that opens it later creates a new file.
        if disk::is_in_place(&self.file, &self.path).unwrap_or(false) {
            let _ = fs::remove_file(&self.path);
        }
    }
}

#[cfg(test)]
mod tests {
    use temp_dir::TempDir;

    use super::*;

    #[test]
    fn a_lock_is_held_by_one_and_leaves_no_file() {
        let folder = TempDir::new().unwrap();
        let path = folder.path().join("rows.csv.lock");
        // A process that was killed leaves an empty file.
        fs::write(&path, "").unwrap();
        for _ in 0..2 {
            let held = Lock::take(&path).unwrap().expect("nobody holds it");
            assert!(held.unlocked().is_none());
            assert!(Lock::take(&path).unwrap().is_none());
            drop(held);
            assert!(!path.exists());
        }
    }

    #[test]
    fn many_processes_hold_it_one_after_the_other() {
        let folder = TempDir::new().unwrap();
        let (path, held) = (folder.path().join("lock"), folder.path().join("held"));
        let hold_often = || {
            let mut count = 0;
            while count < 100 {
                let Some(lock) = Lock::take(&path).unwrap() else { continue };
                File::create_new(&held).expect("no other thread has the lock");
                fs::remove_file(&held).unwrap();
                drop(lock);
                count += 1;
            }
        };
        std::thread::scope(|scope| {
            for _ in 0..4 {
                scope.spawn(hold_often);
            }
        });
        assert!(!path.exists());
    }

    #[test]
    fn files_of_others_are_neither_locked_nor_removed() {
        let folder = TempDir::new().unwrap();
        let path = folder.path().join("rows.csv.lock");
        fs::write(&path, "precious").unwrap();
        assert_eq!(Lock::take(&path).unwrap_err().kind(), io::ErrorKind::AlreadyExists);
        assert_eq!(fs::read_to_string(&path).unwrap(), "precious");
    }
}
