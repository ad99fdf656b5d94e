//! Reading grid files from disk.

use std::io;
use std::path::{Path, PathBuf};

use flap_core::simulate::Simulator;

use super::parse::parse;
use crate::grid::diagnostic::Mistakes;
use crate::input::{self, InputError, MOST_BYTES};
use crate::plan::Plan;

/// The reason why there is no plan.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// The file has no text to be used.
    #[error("{}", placed(path, error))]
    Input {
        /// The path as given.
        path: PathBuf,
        /// The reason.
        #[source]
        error: InputError,
    },
    /// The file holds results.
    #[error("{}: this looks like results, not like a grid file", .0.display())]
    Results(PathBuf),
    /// The text is not a proper grid: the mistakes, in the order of the file.
    #[error("{}", one_per_line(.0))]
    Grid(Mistakes),
}

impl ReadError {
    /// Advice, if there is any.
    pub fn help(&self) -> Option<String> {
        match self {
            ReadError::Results(path) => Some(format!("did you mean `flap plot {}`?", path.display())),
            ReadError::Input { error: InputError::TooLarge(_), .. } => {
                Some("put long lists of points into a CSV file: [sample] with `method = \"file\"`".to_owned())
            }
            _ => None,
        }
    }
}

/// The reason with the path, and with line and column behind it as terminals link to them.
fn placed(path: &Path, error: &InputError) -> String {
    let path = path.display();
    match error {
        InputError::NotUtf8 { byte, line, column } => {
            format!("{path}:{line}:{column}: not UTF-8 text at byte {byte}: save the file as UTF-8")
        }
        _ => format!("{path}: {error}"),
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
    let file = input::open(path).map_err(|error| ReadError::Input { path: path.to_owned(), error })?;
    read_from(file, path, models)
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
    let refused = |error| ReadError::Input { path: name.to_owned(), error };
    let bytes = input::beginning(source, MOST_BYTES).map_err(refused)?;
    if looks_like_results(&bytes) {
        return Err(ReadError::Results(name.to_owned()));
    }
    let text = input::of_bytes(bytes, MOST_BYTES).map_err(refused)?;
    parse(&name.display().to_string(), &text, models).map_err(ReadError::Grid)
}

/// True if a file that begins with these bytes is compressed, Parquet, or has the header of results.
fn looks_like_results(bytes: &[u8]) -> bool {
    const ZSTD: [u8; 4] = [0x28, 0xb5, 0x2f, 0xfd];
    let header = bytes.split(|byte| *byte == b'\n').next().unwrap_or_default();
    let mut columns = header.split(|byte| *byte == b',');
    let is_table = columns.next() == Some(b"point") && columns.any(|column| column == b"status");
    is_table || bytes.starts_with(&ZSTD) || bytes.starts_with(b"PAR1")
}
