//! Functions for Linux, macOS and other Unix systems.

use std::fs::Metadata;
use std::os::unix::fs::FileTypeExt as _;
use std::path::Path;

/// Returns true for a pipe or a device without storage. A disk is a device with storage, so the result for a disk is
/// false.
pub(crate) fn is_stream(metadata: &Metadata) -> bool {
    metadata.file_type().is_fifo() || metadata.file_type().is_char_device()
}

/// Returns true if `path` is a pipe that the shell opened for the command, such as `<(command)` or
/// `/dev/stdin`.
pub(crate) fn is_pipe_of_shell(path: &Path, metadata: &Metadata) -> bool {
    metadata.file_type().is_fifo() && (path.starts_with("/dev") || path.starts_with("/proc"))
}
