//! Functions that store files safely on disk, replace whole files, compare files, and remove files.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

use atomic_write_file::AtomicWriteFile;
use same_file::Handle;

use crate::system;

/// Waits until the written bytes would survive a crash of the machine. The function does nothing for devices
/// and pipes, because devices and pipes store nothing and may not support `fsync`.
///
/// # Errors
/// Returns the error of the operating system.
pub(crate) fn sync(file: &File) -> io::Result<()> {
    if file.metadata()?.is_file() { file.sync_all() } else { Ok(()) }
}

/// A new version of a file. The new version replaces the earlier version only when the new version is
/// complete and safe on disk.
///
/// Until the new version is complete, its file has no name or a temporary name. If the file name belongs to a
/// symbolic link, the new version replaces the link, not the target of the link.
pub(crate) struct Whole(AtomicWriteFile);

impl Whole {
    /// Creates an empty file. When [`Whole::commit`] is called, the file gets the name `path`.
    ///
    /// # Errors
    /// Returns the error of the operating system.
    pub(crate) fn begin(path: &Path) -> io::Result<Whole> {
        AtomicWriteFile::open(path).map(Whole)
    }

    /// Returns the file, which is open for writing.
    pub(crate) fn file(&self) -> &File {
        self.0.as_file()
    }

    /// Gives the file its final name, and waits until the file and its name are safe on disk.
    ///
    /// # Errors
    /// Returns the error of the operating system. If the error occurs before the file has its final name, the
    /// earlier version of the file is unchanged.
    pub(crate) fn commit(self) -> io::Result<()> {
        self.0.commit().map_err(|error| {
            // On Linux, a file without a name gets its name through /proc.
            if cfg!(target_os = "linux") && !Path::new("/proc/self/fd").exists() {
                io::Error::other(
                    "/proc is not mounted: mount it, for example with `mount -t proc proc /proc`",
                )
            } else {
                error
            }
        })
    }
}

/// Returns true if the name `path` is free: no file has this name, or the file with this name is empty. If a
/// link has the name `path`, the result is false.
pub(crate) fn is_free(path: &Path) -> bool {
    match fs::symlink_metadata(path) {
        Ok(metadata) => metadata.is_file() && metadata.len() == 0,
        Err(error) => error.kind() == io::ErrorKind::NotFound,
    }
}

/// Creates a new file for reading and writing. If an empty file has the same name, the new file replaces the
/// empty file.
///
/// # Errors
/// - [`io::ErrorKind::AlreadyExists`] if a file with contents, a folder or a link has this name: see
///   [`is_free`].
/// - The error of the operating system if the file cannot be created.
pub(crate) fn create_new(path: &Path) -> io::Result<File> {
    if is_taken(path) && is_free(path) {
        fs::remove_file(path)?;
    }
    File::options().read(true).write(true).create_new(true).open(path)
}

/// Opens a file for reading and writing. If the file does not exist, the function creates it with
/// [`create_new`].
pub(crate) fn open_or_create(path: &Path) -> io::Result<File> {
    match File::options().read(true).write(true).open(path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => create_new(path),
        opened => opened,
    }
}

/// Renames a file, and waits until the new name is safe on disk.
pub(crate) fn rename(from: &Path, to: &Path) -> io::Result<()> {
    fs::rename(from, to)?;
    sync_folder(to)
}

/// Returns true if a file, a folder or a link has the name `path`. For a link, the result is true even if the
/// target of the link does not exist.
pub(crate) fn is_taken(path: &Path) -> bool {
    fs::symlink_metadata(path).is_ok()
}

/// Largest number of symbolic links that [`target`] follows one after the other. Linux also follows at most
/// 40 links.
const MOST_LINKS: usize = 40;

/// Returns the target of a symbolic link. The target of the link need not exist. A path that is not a link is
/// returned unchanged.
pub fn target(path: &Path) -> PathBuf {
    let mut target = path.to_owned();
    for _ in 0..MOST_LINKS {
        let Ok(link) = fs::read_link(&target) else { break };
        target = target.with_file_name("").join(link);
    }
    target
}

/// Empties a file. The function does not change devices and pipes.
///
/// # Errors
/// Returns the error of the operating system.
pub fn empty(file: &File) -> io::Result<()> {
    if file.metadata()?.is_file() { file.set_len(0) } else { Ok(()) }
}

/// Returns true if `path` is a pipe or a device without storage, such as `/dev/null`. Links are followed.
pub(crate) fn is_stream(path: &Path) -> bool {
    fs::metadata(path).is_ok_and(|metadata| system::is_stream(&metadata))
}

/// Returns true if no file exists at `path`, or if the file at `path` is empty.
pub fn is_empty(path: &Path) -> bool {
    fs::metadata(path).map_or(true, |metadata| metadata.is_file() && metadata.len() == 0)
}

/// Removes the file at `path`, if the file exists.
pub(crate) fn remove_if_there(path: &Path) -> io::Result<()> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}

/// Waits until the names of new files in the folder of `path` are safe on disk.
pub(crate) fn sync_folder(path: &Path) -> io::Result<()> {
    use io::ErrorKind::{InvalidInput, PermissionDenied, Unsupported};
    match File::open(folder_of(path)).and_then(|folder| folder.sync_all()) {
        // Not supported by this system, or by a folder without permission to list it.
        Err(error) if matches!(error.kind(), InvalidInput | PermissionDenied | Unsupported) => Ok(()),
        synced => synced,
    }
}

/// Returns the folder of `path`. If `path` is a file name without a folder, the result is the working
/// directory.
fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Checks that no program has removed or replaced the file at `path` since the file was opened as `file`.
///
/// # Errors
/// Returns [`io::ErrorKind::Other`] if there is no file at `path`, or if the file at `path` is a different
/// file. If the check itself fails, the function returns the error of the operating system.
pub(crate) fn check_in_place(file: &File, path: &Path) -> io::Result<()> {
    if is_in_place(file, path)? {
        Ok(())
    } else {
        Err(io::Error::other(format!("{} was removed or replaced while it was open", path.display())))
    }
}

/// Returns true if no program has removed or replaced the file at `path` since the file was opened as
/// `file`.
///
/// # Errors
/// Returns the error of the operating system. On Windows, the error may be
/// [`io::ErrorKind::PermissionDenied`] if the file was removed but is still open.
pub(crate) fn is_in_place(file: &File, path: &Path) -> io::Result<bool> {
    match Handle::from_path(path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(false),
        there => Ok(there? == Handle::from_file(file.try_clone()?)?),
    }
}

/// Returns true if `a` and `b` are paths of the same file. The result is false for devices and pipes, because
/// devices and pipes store nothing that a command could overwrite.
pub fn is_same_file(a: &Path, b: &Path) -> bool {
    let is_file = |path| fs::metadata(path).is_ok_and(|metadata| metadata.is_file());
    is_file(a) && is_file(b) && same_file::is_same_file(a, b).unwrap_or(false)
}

/// Returns true if `a` and `b` are paths of the same file, even if the file does not exist yet.
pub fn is_same_target(a: &Path, b: &Path) -> bool {
    let place = |path: &Path| Some((fs::canonicalize(folder_of(path)).ok()?, path.file_name()?.to_owned()));
    a == b || is_same_file(a, b) || place(a).is_some_and(|a| Some(a) == place(b))
}

#[cfg(test)]
mod tests {
    use temp_dir::TempDir;

    use super::*;

    #[test]
    fn targets_need_not_be_there() {
        let folder = TempDir::new().unwrap();
        let path = |name: &str| folder.path().join(name);
        assert!(is_same_target(&path("new.csv"), &path("./new.csv")));
        assert!(!is_same_target(&path("new.csv"), &path("newer.csv")));
    }

    #[test]
    fn a_new_file_takes_the_place_of_an_empty_one_alone() {
        let folder = TempDir::new().unwrap();
        let path = |name: &str| folder.path().join(name);
        let refusal = |name: &str| create_new(&path(name)).unwrap_err().kind();
        fs::write(path("empty"), "").unwrap();
        create_new(&path("empty")).unwrap();
        fs::write(path("precious"), "text").unwrap();
        assert_eq!(refusal("precious"), io::ErrorKind::AlreadyExists);
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink("empty", path("link")).unwrap();
            std::os::unix::fs::symlink("nowhere", path("dangling")).unwrap();
            assert_eq!(refusal("link"), io::ErrorKind::AlreadyExists);
            assert_eq!(refusal("dangling"), io::ErrorKind::AlreadyExists);
            assert!(!path("nowhere").exists());
        }
    }

    #[test]
    #[cfg(unix)]
    fn links_are_followed_to_their_end() {
        use std::os::unix::fs::symlink;
        let folder = TempDir::new().unwrap();
        let path = |name: &str| folder.path().join(name);
        fs::create_dir(path("sub")).unwrap();
        symlink("sub/second", path("first")).unwrap();
        symlink("../nowhere.csv", path("sub/second")).unwrap();
        symlink(path("first"), path("absolute")).unwrap();
        for name in ["first", "absolute"] {
            assert_eq!(target(&path(name)), path("sub/../nowhere.csv"), "{name}");
        }
        assert_eq!(target(&path("none.csv")), path("none.csv"));
        symlink("circle", path("circle")).unwrap();
        assert_eq!(target(&path("circle")), path("circle"));
    }
}
