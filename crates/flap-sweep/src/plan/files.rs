//! The files of a plan: the grid file, the file of points, the file of rows.

use std::path::PathBuf;

use serde::{Deserialize, Serialize};

/// The file that rows go to, and its columns.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Output {
    /// Path as written in the grid file, relative to the working directory; `None` if it names none.
    pub path: Option<PathBuf>,
    /// Indices into the model's columns, followed by the plan's own measures and the columns on the course of a run, in the
    /// order wanted; `None` for all.
    pub columns: Option<Vec<usize>>,
}

/// A file that lists the points of a sample.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PointsFile {
    /// Its path, from the working directory.
    pub path: PathBuf,
    /// The hash of its text: XXH3 of 64 bits.
    pub xxh3: u64,
}

impl PointsFile {
    /// The hash in hexadecimal digits.
    pub fn hash(&self) -> String {
        format!("{:016x}", self.xxh3)
    }
}

/// A grid file or a device as read.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Source {
    /// Name for messages, usually the path.
    pub name: String,
    /// The text.
    pub text: String,
}
