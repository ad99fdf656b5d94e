//! Reading grid files from disk.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use flap_core::simulate;

use crate::diagnostic::{Diagnostic, position};
use crate::plan::Plan;

/// Why there is no plan.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// There is no such file.
    #[error("{}: there is no such file", path.display())]
    Missing {
        /// The path as given.
        path: PathBuf,
    },
    /// The path is a folder.
    #[error("{}: this is a folder, not a grid file", path.display())]
    Folder {
        /// The path as given.
        path: PathBuf,
    },
    /// The file cannot be read.
    #[error("{}: cannot be read: {cause}", path.display())]
    Unreadable {
        /// The path as given.
        path: PathBuf,
        /// What the system says.
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
    /// The text is not a proper grid: all mistakes, in the order of the file.
    #[error("{}", one_per_line(.0))]
    Grid(Vec<Diagnostic>),
}

fn one_per_line(diagnostics: &[Diagnostic]) -> String {
    diagnostics.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
}

/// Reads the grid file at `path` and makes its plan, with the presets of all models.
///
/// # Errors
/// If the file cannot be read, or there are mistakes in it.
pub fn read(path: &Path) -> Result<Plan, ReadError> {
    let bytes = fs::read(path).map_err(|cause| {
        let path = path.to_owned();
        match cause.kind() {
            io::ErrorKind::NotFound => ReadError::Missing { path },
            io::ErrorKind::IsADirectory => ReadError::Folder { path },
            // Not every system has an error of its own for reading a folder.
            _ if path.is_dir() => ReadError::Folder { path },
            _ => ReadError::Unreadable { path, cause },
        }
    })?;
    let text = String::from_utf8(bytes).map_err(|error| {
        let byte = error.utf8_error().valid_up_to();
        let before = String::from_utf8_lossy(&error.as_bytes()[..byte]);
        let (line, column) = position(&before, byte);
        ReadError::NotUtf8 { path: path.to_owned(), byte, line, column }
    })?;
    super::parse(&path.display().to_string(), &text, simulate::all()).map_err(ReadError::Grid)
}
