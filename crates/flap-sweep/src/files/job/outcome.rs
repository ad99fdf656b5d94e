//! Reports of a job: before its points are run, and at its end.

use std::io;
use std::path::PathBuf;

use crate::run::Summary;

/// The outcome of a job.
#[derive(Debug)]
pub enum Outcome {
    /// Points were run.
    Ran(Box<Done>),
    /// All rows wanted were there already.
    Complete {
        /// True if all of them are periodic.
        all_periodic: bool,
    },
}

/// The work of this process.
#[derive(Debug)]
pub struct Done {
    /// Summary of all rows, those of earlier sessions too.
    pub summary: Summary,
    /// Number of rows of earlier sessions.
    pub rows_before: u64,
    /// Running time of this process (s).
    pub seconds: f64,
    /// The file that holds the rows; `None` for a stream.
    pub place: Option<PathBuf>,
}

/// A notice for the user before points are run.
#[derive(Debug)]
pub enum Notice {
    /// The job continues earlier work.
    Continued {
        /// Number of rows that had been written but are no longer in the file: they are computed again.
        lost: u64,
        /// Number of points that are done.
        done: u64,
    },
    /// The results could not be locked, for this reason: another run that writes to them would not be noticed.
    Unlocked(io::Error),
}
