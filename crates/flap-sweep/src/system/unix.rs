//! Operations of Linux, macOS and other Unix systems.

use std::fs::{self, File, Metadata};
use std::io;
use std::os::unix::fs::{FileTypeExt as _, MetadataExt as _};
use std::path::Path;

/// Returns the identity of an open file: device and inode. Hard links to a file have the identity of the file.
///
/// # Errors
/// The error of the operating system.
pub(crate) fn id_of(file: &File) -> io::Result<(u64, u64)> {
    file.metadata().map(|metadata| id(&metadata))
}

/// Returns the identity of the file at `path`, as [`id_of`] does. Links are followed.
///
/// # Errors
/// The error of the operating system.
pub(crate) fn id_at(path: &Path) -> io::Result<(u64, u64)> {
    fs::metadata(path).map(|metadata| id(&metadata))
}

fn id(metadata: &Metadata) -> (u64, u64) {
    (metadata.dev(), metadata.ino())
}

/// Returns true for a pipe or a device without storage. A disk is a device with storage, so the result for a disk is
/// false.
pub(crate) fn is_stream(metadata: &Metadata) -> bool {
    metadata.file_type().is_fifo() || metadata.file_type().is_char_device()
}

/// Returns true if `path` is a pipe that the shell opened for the command: `<(command)` or `/dev/stdin`.
pub(crate) fn is_pipe_of_shell(path: &Path, metadata: &Metadata) -> bool {
    metadata.file_type().is_fifo() && (path.starts_with("/dev") || path.starts_with("/proc"))
}
