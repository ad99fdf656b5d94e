//! The parallel runner, which runs units of work on all cores and returns their outcomes in order.
//!
//! A unit of work is a point of a plan with its row, or a design with the rows of its response. Each worker integrates
//! one set of lanes for the whole run, so its lanes stay full until the end of the run. Units of work finish in any
//! order.
//!
//! A window of limited size brings the outcomes into order. Memory therefore does not grow with the number of units of
//! work, and the output does not depend on the number of threads.
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
//! - [`rows`]: the rows of a plan as a [`Run`], on threads (`workers`) with a `queue`.
//! - [`alone`]: the rows of a plan on the calling thread.
//! - [`Chunk`]: rows computed by another process.
//! - [`RowWriter`]: writes rows to a [`Sink`] and counts them in a [`Summary`].
//! - [`identity`]: settings and build that determine the bytes of rows.

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

/// Options of a run. Only the arithmetic class of the instruction set changes the output; all other options have no
/// effect on the output.
#[derive(Clone, Copy, Debug)]
pub struct RunOptions {
    /// Instruction set of the lanes.
    pub instructions: Backend,
    /// Number of worker threads.
    pub threads: NonZeroUsize,
    /// Largest number of rows between the last returned row and the last started point.
    ///
    /// A slow point delays the rows after it. With a wider window, the other points can continue longer while a slow
    /// point runs. A row of 40 measures takes about half a kilobyte.
    pub window: usize,
    /// Time for running points after the run is stopped. Points that take longer than this time are discarded.
    pub grace: Duration,
}

/// Default time for running points after a stop. The time is long enough for ordinary points, and less than a second
/// including overhead.
const GRACE: Duration = Duration::from_millis(400);

impl RunOptions {
    /// Returns the default options with this number of threads, or with a thread per core for `None`.
    pub fn with_threads(threads: Option<NonZeroUsize>) -> RunOptions {
        let default = RunOptions::default();
        RunOptions { threads: threads.unwrap_or(default.threads), ..default }
    }
}

impl Default for RunOptions {
    /// Returns the best instruction set of the machine, one thread per core, a window of a few megabytes, and a grace
    /// time of 0.4 s.
    fn default() -> Self {
        let threads = thread::available_parallelism().unwrap_or(NonZeroUsize::MIN);
        RunOptions { instructions: Backend::best(), threads, window: 16_384, grace: GRACE }
    }
}

/// Progress of a run, in points of a sweep or designs of a response.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// Number of points that have run or are excluded, even if their rows have not been returned yet.
    pub finished: u64,
    /// Number of points to run in total.
    pub points: u64,
}

/// Error that ends a run. The rows that were written before the error are complete and in order.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// Rows could not be written.
    #[error("cannot write rows: {0}")]
    Sink(#[from] io::Error),
    /// The threads could not be started.
    #[error("cannot start the worker threads: {0}")]
    Threads(#[source] io::Error),
    /// The model violated its contract, which is a bug in the program.
    #[error("bug in the model: {0}")]
    Model(String),
    /// Rows from another process do not belong to the run.
    #[error("rows of a worker do not belong to this run: {0}")]
    Chunk(String),
    /// Fetching rows from other processes failed.
    #[error("rows cannot be fetched: {0}")]
    Fetch(String),
    /// A worker panicked, which is a bug in the program.
    #[error("a worker panicked: {0}")]
    Panic(String),
}
