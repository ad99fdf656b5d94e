//! Functions for Windows.

use std::fs::Metadata;
use std::path::Path;

/// Returns true for a pipe or a device.
pub(crate) fn is_stream(metadata: &Metadata) -> bool {
    !metadata.is_file() && !metadata.is_dir()
}

/// Returns false, because shells of Windows do not pass pipes as paths.
pub(crate) fn is_pipe_of_shell(_: &Path, _: &Metadata) -> bool {
    false
}
