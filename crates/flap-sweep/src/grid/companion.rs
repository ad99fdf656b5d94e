//! Files that a grid file names.

use std::fs;
use std::path::Path;

/// The text of the file, or the reason why it cannot be read.
pub(super) fn text(path: &Path) -> Result<String, String> {
    let metadata = fs::metadata(path).map_err(|error| error.to_string())?;
    // A device or a pipe may never end.
    if !metadata.is_file() {
        return Err("this is not a file".to_owned());
    }
    let bytes = fs::read(path).map_err(|error| error.to_string())?;
    String::from_utf8(bytes).map_err(|_| "the file is not UTF-8 text".to_owned())
}
