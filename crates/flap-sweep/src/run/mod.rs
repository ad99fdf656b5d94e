//! The parallel runner computes units of work on all cores and returns the outcomes in the order of the
//! units.
//!
//! A unit of work is the computation of one row for one point, or of all rows of the response of one design.
//! Each worker thread fills a free lane with its next unit of work, so all lanes stay full until the end of
//! the run. Units of work finish in any order.
//!
//! A buffer of limited size, the window, stores finished outcomes until all earlier outcomes are finished.
//! The memory therefore does not grow with the number of units of work. The output does not depend on the
//! number of threads.
//!
//! ```no_run
//! # use flap_sweep::{files::csv_sink::CsvSink, plan::Plan, run::{self, RowWriter, RunError, RunOptions, Summary}, table::layout::Layout};
//! # fn csv(plan: &Plan) -> Result<Summary, RunError> {
//! let mut sink = CsvSink::new(Layout::of(plan).names(), std::io::stdout());
//! let mut output = RowWriter::begin(plan, Summary::default(), &mut sink)?;
//! for row in run::rows(plan, &RunOptions::default(), 0) {
//!     output.write(&row?)?;
//! }
//! output.finish(Ok(()))
//! # }
//! ```
//!
//! - [`rows`] computes the rows of a plan on several threads and returns a [`Run`]. The threads (module
//!   `workers`) take the points from a queue (module `queue`).
//! - [`alone`] computes the rows of a plan on the thread of the caller.
//! - [`Chunk`] contains rows that another process has computed.
//! - [`RowWriter`] writes rows to a [`Sink`], and counts the written rows in a [`Summary`].
//! - [`identity`] describes the inputs and settings that determine the bytes of rows.

use std::io;
use std::num::NonZeroUsize;
use std::thread;
use std::time::Duration;

use flap_core::num::Backend;

mod added_columns;
mod chunk;
pub mod identity;
mod points;
mod queue;
mod summary;
mod workers;
mod writer;

pub use added_columns::add_columns;
pub use chunk::{Chunk, chunk};
pub use points::{Outcome, alone, rows};
pub use summary::{Counts, InvalidPoint, Summary, Unsatisfied, Warnings};
pub use workers::Run;
pub(crate) use workers::Worker;
pub use writer::{RowWriter, Sink, Written};

/// Options of a run. Of all options, only the arithmetic of the instruction set has an effect on the output.
#[derive(Clone, Copy, Debug)]
pub struct RunOptions {
    /// SIMD instruction set with which the lanes are computed.
    pub instructions: Backend,
    /// Number of worker threads.
    pub threads: NonZeroUsize,
    /// Largest number of points that may be computed ahead of the last returned row.
    ///
    /// A slow point delays the rows of all later points. If more points may be computed ahead, the
    /// computation of later points can continue longer while a slow point is computed. A row of 40 measures
    /// needs about half a kilobyte of memory.
    pub window: usize,
    /// After a request to stop, flap finishes the points whose computation has begun, if they need no more
    /// than this time. flap abandons the points whose computation takes longer.
    pub grace: Duration,
}

/// Default of [`RunOptions::grace`]. Ordinary points finish within this time, and a stop takes less than a
/// second in total.
const GRACE: Duration = Duration::from_millis(400);

impl RunOptions {
    /// Returns the default options with the given number of threads. If `threads` is `None`, each core has
    /// one thread.
    pub fn with_threads(threads: Option<NonZeroUsize>) -> RunOptions {
        let default = RunOptions::default();
        RunOptions { threads: threads.unwrap_or(default.threads), ..default }
    }
}

impl Default for RunOptions {
    /// Returns the best instruction set of the machine, one thread per core, and a buffer of a few megabytes
    /// for finished rows. After a request to stop, the points whose computation has begun have 0.4 s to
    /// finish.
    fn default() -> Self {
        let threads = thread::available_parallelism().unwrap_or(NonZeroUsize::MIN);
        RunOptions { instructions: Backend::best(), threads, window: 16_384, grace: GRACE }
    }
}

/// Progress of a run, as numbers of points. In a run of responses, the progress counts designs instead of
/// points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// Number of points that are computed or excluded. The number of finished points includes points whose
    /// rows have not been returned yet.
    pub finished: u64,
    /// Number of all selected points.
    pub points: u64,
}

/// An error that ends a run. The rows that were written before the error are complete and in the order of the
/// points.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// Rows could not be written.
    #[error("cannot write rows: {0}")]
    Sink(#[from] io::Error),
    /// The threads could not be started.
    #[error("cannot start the worker threads: {0}")]
    Threads(#[source] io::Error),
    /// The model returned a wrong number of measures, or rows for wrong points. A bug in the code of the
    /// model causes this error.
    #[error("bug in the model: {0}")]
    Model(String),
    /// Rows from another process are not the expected rows of this run.
    #[error("rows of a worker do not belong to this run: {0}")]
    Chunk(String),
    /// Rows from other processes cannot be fetched.
    #[error("rows cannot be fetched: {0}")]
    Fetch(String),
    /// A worker thread panicked. A panic is a bug in the program.
    #[error("a worker panicked: {0}")]
    Panic(String),
}
