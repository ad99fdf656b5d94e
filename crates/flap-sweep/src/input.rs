//! Reads input files, with a limit on the size of each file.

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::Path;

use crate::notation::text::position;
use crate::system::is_pipe_of_shell;

/// Largest allowed number of bytes in a file that a person or an instrument writes: grids, devices, wing
/// outlines, waveforms, motions, and tracked points.
pub const MOST_BYTES: u64 = 16 << 20;

/// Largest allowed number of bytes in a file that a program writes, such as a list of points or a sidecar.
pub const MOST_LISTED: u64 = 256 << 20;

/// Reason why an input file cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum InputError {
    /// The input file does not exist.
    #[error("there is no such file")]
    Missing,
    /// The path is a folder.
    #[error("this is a folder, not a file")]
    Folder,
    /// The path is a device file such as `/dev/zero`, a named pipe or a socket, and its data may never end.
    #[error("this is a device or a pipe, not a file")]
    Endless,
    /// The file is too large.
    #[error("the file is too large: at most {} MiB are allowed", .0 >> 20)]
    TooLarge(u64),
    /// The operating system cannot read the file.
    #[error("cannot be read: {0}")]
    Unreadable(#[source] io::Error),
    /// The file is not UTF-8 text.
    #[error("not UTF-8 text at byte {byte} (line {line}, column {column}): save the file as UTF-8")]
    NotUtf8 {
        /// Offset of the first byte that is not UTF-8, counted from 0.
        byte: usize,
        /// Line of the invalid byte, counted from 1.
        line: usize,
        /// Column of the invalid byte in characters, counted from 1.
        column: usize,
    },
}

/// Returns the error of the operating system if there is one. If the operating system reported no error,
/// returns an error with the message of the [`InputError`] and a suitable [`io::ErrorKind`].
impl From<InputError> for io::Error {
    fn from(error: InputError) -> io::Error {
        let kind = match error {
            InputError::Unreadable(cause) => return cause,
            InputError::Missing => io::ErrorKind::NotFound,
            InputError::Folder => io::ErrorKind::IsADirectory,
            InputError::Endless | InputError::TooLarge(_) | InputError::NotUtf8 { .. } => {
                io::ErrorKind::InvalidData
            }
        };
        io::Error::new(kind, error.to_string())
    }
}

/// Returns the text of the file at `path`, which may have at most `most` bytes.
///
/// # Errors
/// [`InputError`] if the path is not a file, or the file is too large, unreadable or not text.
pub fn text(path: &Path, most: u64) -> Result<String, InputError> {
    of_bytes(beginning(open(path)?, most)?, most)
}

/// Returns the content of the file at `path`, which may have at most `most` bytes.
///
/// # Errors
/// [`InputError`] if the path is not a file, or the file is too large or unreadable.
pub fn bytes(path: &Path, most: u64) -> Result<Vec<u8>, InputError> {
    within(beginning(open(path)?, most)?, most)
}

/// Opens the file at `path`.
///
/// The path may be a pipe that the shell opened, such as `/dev/stdin` or `<(command)`. The data in a pipe of
/// the shell are complete when the command that writes into the pipe has ended.
///
/// # Errors
/// [`InputError`] if the path is not a file, or cannot be opened.
pub fn open(path: &Path) -> Result<File, InputError> {
    let metadata = fs::metadata(path).map_err(|cause| match cause.kind() {
        io::ErrorKind::NotFound => InputError::Missing,
        _ => InputError::Unreadable(cause),
    })?;
    if metadata.is_dir() {
        return Err(InputError::Folder);
    }
    if !metadata.is_file() && !is_pipe_of_shell(path, &metadata) {
        return Err(InputError::Endless);
    }
    File::open(path).map_err(InputError::Unreadable)
}

/// Returns all bytes of `source`, or the first `most + 1` bytes of a longer source.
///
/// # Errors
/// [`InputError::Unreadable`] if the source cannot be read.
pub fn beginning(source: impl Read, most: u64) -> Result<Vec<u8>, InputError> {
    let mut bytes = Vec::new();
    source.take(most + 1).read_to_end(&mut bytes).map_err(InputError::Unreadable)?;
    Ok(bytes)
}

/// Converts the result of [`beginning`] to text.
///
/// # Errors
/// [`InputError`] if there are more than `most` bytes, or the bytes are not text.
pub fn of_bytes(bytes: Vec<u8>, most: u64) -> Result<String, InputError> {
    String::from_utf8(within(bytes, most)?).map_err(|error| {
        let byte = error.utf8_error().valid_up_to();
        let before = String::from_utf8_lossy(&error.as_bytes()[..byte]);
        let (line, column) = position(&before, byte);
        InputError::NotUtf8 { byte, line, column }
    })
}

fn within(bytes: Vec<u8>, most: u64) -> Result<Vec<u8>, InputError> {
    if bytes.len() as u64 > most { Err(InputError::TooLarge(most)) } else { Ok(bytes) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_has_a_limit_and_a_place_for_what_is_none() {
        let refused = |bytes: &[u8], most| of_bytes(beginning(bytes, most).unwrap(), most).unwrap_err();
        assert_eq!(of_bytes(beginning(&b"abc"[..], 3).unwrap(), 3).unwrap(), "abc");
        assert!(matches!(refused(b"abcd", 3), InputError::TooLarge(3)));
        let endless = beginning(io::repeat(b'0'), 10).unwrap();
        assert_eq!(endless.len(), 11, "an endless source is read up to the limit");
        assert!(matches!(refused(b"a\nb\xff", 9), InputError::NotUtf8 { byte: 3, line: 2, column: 2 }));
    }

    #[test]
    #[cfg(unix)]
    fn what_may_never_end_is_not_opened() {
        let refused = |path: &str| text(Path::new(path), 10).unwrap_err();
        assert!(matches!(refused("/dev/zero"), InputError::Endless));
        assert!(matches!(refused("/dev"), InputError::Folder));
        assert!(matches!(refused("/dev/nothing"), InputError::Missing));
    }
}
