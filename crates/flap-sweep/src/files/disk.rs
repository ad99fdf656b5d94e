//! Files that are made durable, replaced as a whole, compared and removed.

use std::fs::{self, File, Metadata};
use std::io::{self, Stdout, Write};
use std::path::Path;

use crate::files::beside::temporary_of;

/// A target of writing that can be made durable.
pub trait Durable: Write {
    /// Waits until the bytes written are safe from a crash of the machine. Does nothing for a target that a crash
    /// cannot harm, which is the default.
    ///
    /// # Errors
    /// The error of the operating system.
    fn sync(&self) -> io::Result<()> {
        Ok(())
    }
}

impl Durable for File {
    fn sync(&self) -> io::Result<()> {
        // Devices and pipes may refuse to be synchronised, and have nothing to lose.
        if self.metadata()?.is_file() { self.sync_all() } else { Ok(()) }
    }
}

impl Durable for Stdout {}

impl Durable for Vec<u8> {}

/// Makes the file at `path`, in place of an earlier one, once `write` has written all of it and it is durable.
///
/// # Errors
/// The error of `write` or of the operating system. An earlier file is then unchanged.
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

/// Empties a file. Devices and pipes are left alone.
///
/// # Errors
/// The error of the operating system.
pub fn empty(file: &File) -> io::Result<()> {
    if file.metadata()?.is_file() { file.set_len(0) } else { Ok(()) }
}

/// True if there is no file at `path`, or an empty one.
pub fn is_empty(path: &Path) -> bool {
    fs::metadata(path).map_or(true, |metadata| metadata.is_file() && metadata.len() == 0)
}

/// Removes the file at `path`, if there is one.
pub(crate) fn remove_if_there(path: &Path) -> io::Result<()> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}

/// Makes new names in the folder of `path` durable. File systems that cannot synchronise folders do not need it.
pub(crate) fn sync_folder(path: &Path) {
    let _ = File::open(folder_of(path)).and_then(|folder| folder.sync_all());
}

/// The folder that `path` lies in: the working directory for a bare name.
fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Checks that `file` is still the file at `path`, where it was opened.
///
/// # Errors
/// [`io::ErrorKind::Other`] if there is no file at `path`, or another one; else the error of the operating system.
pub(crate) fn check_in_place(file: &File, path: &Path) -> io::Result<()> {
    let gone = || io::Error::other(format!("{} was removed or replaced meanwhile", path.display()));
    let there = fs::metadata(path).map_err(|error| match error.kind() {
        io::ErrorKind::NotFound => gone(),
        _ => error,
    })?;
    // Elsewhere than on Unix, a file that is open can neither be removed nor replaced.
    if !cfg!(unix) || is_same((path, &file.metadata()?), (path, &there)) { Ok(()) } else { Err(gone()) }
}

/// True if both names are of one file. Devices and pipes hold nothing that could be lost, so they are never the same.
pub fn is_same_file(a: &Path, b: &Path) -> bool {
    match (fs::metadata(a), fs::metadata(b)) {
        (Ok(of_a), Ok(of_b)) => of_a.is_file() && of_b.is_file() && is_same((a, &of_a), (b, &of_b)),
        _ => false,
    }
}

/// True if two files that are to be written are one. They need not exist.
pub fn is_same_target(a: &Path, b: &Path) -> bool {
    let place = |path: &Path| Some((fs::canonicalize(folder_of(path)).ok()?, path.file_name()?.to_owned()));
    a == b || is_same_file(a, b) || place(a).is_some_and(|a| Some(a) == place(b))
}

/// True if two files are one: by device and inode where there are such numbers, elsewhere by the full path.
#[cfg(unix)]
fn is_same((_, a): (&Path, &Metadata), (_, b): (&Path, &Metadata)) -> bool {
    use std::os::unix::fs::MetadataExt;
    (a.dev(), a.ino()) == (b.dev(), b.ino())
}

#[cfg(not(unix))]
fn is_same((a, _): (&Path, &Metadata), (b, _): (&Path, &Metadata)) -> bool {
    matches!((fs::canonicalize(a), fs::canonicalize(b)), (Ok(a), Ok(b)) if a == b)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn targets_need_not_be_there() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        assert!(is_same_target(&path("new.csv"), &path("./new.csv")));
        assert!(!is_same_target(&path("new.csv"), &path("newer.csv")));
    }
}
