//! Windows.

use std::fs::{File, Metadata};
use std::io;
use std::path::Path;

use winapi_util::file::{Information, information};
use winapi_util::{Handle, HandleRef};

/// Returns the identity of an open file: volume and file index. Hard links to a file have the identity of the file.
///
/// # Errors
/// The error of the operating system.
pub(crate) fn id_of(file: &File) -> io::Result<(u64, u64)> {
    information(HandleRef::from_file(file)).map(|found| id(&found))
}

/// Returns the identity of the file at `path`, as [`id_of`] does. Links are followed.
///
/// # Errors
/// The error of the operating system. If a file is removed while it is open, the error may be
/// [`io::ErrorKind::PermissionDenied`] until the file is closed.
pub(crate) fn id_at(path: &Path) -> io::Result<(u64, u64)> {
    information(Handle::from_path_any(path)?).map(|found| id(&found))
}

fn id(found: &Information) -> (u64, u64) {
    (found.volume_serial_number(), found.file_index())
}

/// Returns true for a pipe or a device.
pub(crate) fn is_stream(metadata: &Metadata) -> bool {
    !metadata.is_file() && !metadata.is_dir()
}

/// Returns false, because shells of Windows do not pass pipes as paths.
pub(crate) fn is_pipe_of_shell(_: &Path, _: &Metadata) -> bool {
    false
}
