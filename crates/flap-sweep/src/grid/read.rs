//! Reading grid files from disk.

use std::fs::File;
use std::io::{self, Read as _};
use std::path::{Path, PathBuf};

use flap_core::simulate::Simulator;

use super::parse::parse;
use crate::grid::diagnostic::{Mistakes, position};
use crate::plan::Plan;

/// The most bytes a grid file may have: 16 MiB. Lists of more values than that holds are a file of points, which has no limit.
pub const MOST_BYTES: u64 = 16 << 20;

/// The reason why there is no plan.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// There is no such file.
    #[error("{}: there is no such file", .0.display())]
    Missing(PathBuf),
    /// The path is a folder.
    #[error("{}: this is a folder, not a grid file", .0.display())]
    Folder(PathBuf),
    /// The file cannot be read.
    #[error("{}: cannot be read: {cause}", path.display())]
    Unreadable {
        /// The path as given.
        path: PathBuf,
        /// The error of the operating system.
        #[source]
        cause: io::Error,
    },
    /// The file is not text.
    #[error("{}:{line}:{column}: not UTF-8 text at byte {byte}: save the file as UTF-8", path.display())]
    NotUtf8 {
        /// The path as given.
        path: PathBuf,
        /// Offset of the first byte that is not UTF-8, from 0.
        byte: usize,
        /// Its line, from 1.
        line: usize,
        /// Its column in characters, from 1.
        column: usize,
    },
    /// The file holds results.
    #[error("{}: this looks like results, not like a grid file", .0.display())]
    Results(PathBuf),
    /// The file is too large.
    #[error(
        "{}: the file has more than {} MiB, the most that a grid file may have",
        .0.display(),
        MOST_BYTES >> 20
    )]
    TooLarge(PathBuf),
    /// The text is not a proper grid: the mistakes, in the order of the file.
    #[error("{}", one_per_line(.0))]
    Grid(Mistakes),
}

impl ReadError {
    /// Advice, if there is any.
    pub fn help(&self) -> Option<String> {
        match self {
            ReadError::Results(path) => Some(format!("did you mean `flap plot {}`?", path.display())),
            ReadError::TooLarge { .. } => {
                Some("put long lists of points into a CSV file: [sample] with `method = \"file\"`".to_owned())
            }
            _ => None,
        }
    }
}

fn one_per_line(mistakes: &Mistakes) -> String {
    let mut lines: Vec<String> = mistakes.iter().map(ToString::to_string).collect();
    if mistakes.more() > 0 {
        lines.push(format!("and {} more", mistakes.more()));
    }
    lines.join("\n")
}

/// Reads the grid file at `path` and makes its plan, with the presets of all models.
///
/// # Errors
/// If the file cannot be read, or there are mistakes in it.
pub fn read(path: &Path, models: &[&'static dyn Simulator]) -> Result<Plan, ReadError> {
    File::open(path).map_err(|cause| unreadable(path, cause)).and_then(|file| read_from(file, path, models))
}

/// Reads a grid from a stream, such as stdin, and makes its plan, with the presets of all models. `name` stands for the
/// stream in messages and in the sidecar of rows. Files that the grid names are relative to the folder of `name`.
///
/// # Errors
/// If the stream cannot be read, or there are mistakes in the grid.
pub fn read_from(
    source: impl io::Read,
    name: &Path,
    models: &[&'static dyn Simulator],
) -> Result<Plan, ReadError> {
    let bytes = bytes(source).map_err(|cause| unreadable(name, cause))?;
    if looks_like_results(&bytes) {
        return Err(ReadError::Results(name.to_owned()));
    }
    if bytes.len() as u64 > MOST_BYTES {
        return Err(ReadError::TooLarge(name.to_owned()));
    }
    let text = String::from_utf8(bytes).map_err(|error| {
        let byte = error.utf8_error().valid_up_to();
        let before = String::from_utf8_lossy(&error.as_bytes()[..byte]);
        let (line, column) = position(&before, byte);
        ReadError::NotUtf8 { path: name.to_owned(), byte, line, column }
    })?;
    parse(&name.display().to_string(), &text, models).map_err(ReadError::Grid)
}

/// The error of the operating system in words of the user.
fn unreadable(path: &Path, cause: io::Error) -> ReadError {
    let path = path.to_owned();
    match cause.kind() {
        io::ErrorKind::NotFound => ReadError::Missing(path),
        io::ErrorKind::IsADirectory => ReadError::Folder(path),
        // Not every system has an error of its own for reading a folder.
        _ if path.is_dir() => ReadError::Folder(path),
        _ => ReadError::Unreadable { path, cause },
    }
}

/// The beginning of a stream: all of it, unless it is too large.
fn bytes(source: impl io::Read) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    source.take(MOST_BYTES + 1).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// True if a file that begins with these bytes is compressed, Parquet, or has the header of results.
fn looks_like_results(bytes: &[u8]) -> bool {
    const ZSTD: [u8; 4] = [0x28, 0xb5, 0x2f, 0xfd];
    let header = bytes.split(|byte| *byte == b'\n').next().unwrap_or_default();
    let mut columns = header.split(|byte| *byte == b',');
    let is_table = columns.next() == Some(b"point") && columns.any(|column| column == b"status");
    is_table || bytes.starts_with(&ZSTD) || bytes.starts_with(b"PAR1")
}
