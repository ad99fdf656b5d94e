//! Reasons why a job failed.

use std::io;
use std::path::{Path, PathBuf};

use crate::files::inputs::Overlap;
use crate::files::integrity::OpenError;
use crate::files::output::CreateError;
use crate::files::results::FormatError;
use crate::files::session::ResumeError;
use crate::run::RunError;

/// Reason why a job failed.
#[derive(Debug, thiserror::Error)]
pub enum JobError {
    /// The results would overwrite a file that they are made from.
    #[error(transparent)]
    Overlap(#[from] Overlap),
    /// The name stands for no format.
    #[error(transparent)]
    Format(#[from] FormatError),
    /// The results cannot be made.
    #[error(transparent)]
    Create(#[from] CreateError),
    /// A file has the name of the results, and does not hold their rows.
    #[error("{} exists already{}", path.display(), other_rows(changes))]
    Exists {
        /// The file.
        path: PathBuf,
        /// The differences between its rows and those of the job, in words; empty if they are not known.
        changes: Vec<String>,
        /// The first line of the grid file that differs, in words.
        changed: Option<String>,
    },
    /// A file has the name of the results, and is the unfinished result of an interrupted sweep.
    #[error("{} is the unfinished result of an interrupted sweep{}", path.display(), other_rows(changes))]
    Unfinished {
        /// The file.
        path: PathBuf,
        /// The differences between its rows and those of the job, in words.
        changes: Vec<String>,
        /// The first line of the grid file that has changed, in words.
        changed: Option<String>,
        /// True if the sweep that began the rows can be continued from its sidecar.
        continues: bool,
    },
    /// The run cannot be resumed.
    #[error("{error}")]
    Resume {
        /// The reason.
        error: ResumeError,
        /// The first line of the grid file that has changed, in words.
        changed: Option<String>,
        /// True if the sweep that began the rows can be continued from its sidecar.
        continues: bool,
    },
    /// The results are complete, but they or their sidecar are damaged or cannot be read.
    #[error(transparent)]
    Open(OpenError),
    /// A file beside the results cannot be written, or they cannot be completed.
    #[error("cannot write {}: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// The error of the operating system.
        source: io::Error,
        /// True if the run can be resumed.
        resumable: bool,
    },
    /// The run failed.
    #[error("{error}")]
    Run {
        /// The reason.
        error: RunError,
        /// True if the run can be resumed: if its rows went into a file.
        resumable: bool,
    },
}

/// The differences of existing rows, as the end of a message.
fn other_rows(changes: &[String]) -> String {
    if changes.is_empty() { String::new() } else { format!(", with other rows: {}", changes.join("; ")) }
}

impl JobError {
    pub(super) fn write(path: &Path, source: io::Error, resumable: bool) -> JobError {
        JobError::Write { path: path.to_owned(), source, resumable }
    }
}
