//! The parallel runner: units that run on all cores, and whose outcomes are pulled in order.
//!
//! A unit is a point of a plan with its one row, or a design with the rows of its response. Each worker is one lane
//! ensemble for the whole run, so its lanes stay full until the end of the run. Units finish in any
//! order. A bounded window puts them back in order, so that memory does not grow with their number and the output does
//! not depend on the number of threads.
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
//! - [`rows`]: the rows of a plan as a [`Run`], on threads (`workers`) with a `queue`; [`alone`]: on the calling thread
//! - [`Chunk`]: rows that another process computes
//! - [`RowWriter`]: writes rows to a [`Sink`] and counts them in a [`Summary`]
//! - [`identity`]: the settings and the build that decide the bytes of rows

use std::io;
use std::num::NonZeroUsize;
use std::thread;
use std::time::Duration;

use flap_core::num::Backend;

mod chunk;
pub mod identity;
mod points;
mod queue;
mod summary;
mod workers;
mod writer;

pub use chunk::{Chunk, chunk};
pub use points::{Outcome, alone, rows};
pub use summary::{Counts, InvalidPoint, Summary, Unsatisfied, Warnings};
pub use workers::Run;
pub(crate) use workers::Worker;
pub use writer::{RowWriter, Sink};

/// The options of a run. None of them changes a byte of the output, but for the arithmetic class of the instruction
/// set.
#[derive(Clone, Copy, Debug)]
pub struct RunOptions {
    /// Instructions of the lanes.
    pub instructions: Backend,
    /// Worker threads.
    pub threads: NonZeroUsize,
    /// Most rows between the last row pulled and the last point begun.
    ///
    /// A point that takes long holds up the rows behind it: the wider the window, the longer the others
    /// can go on meanwhile. A row of 40 measures takes about half a kilobyte.
    pub window: usize,
    /// Time for the points in hand after the run is stopped: those that take longer are dropped.
    pub grace: Duration,
}

/// Time for points in hand: long enough for ordinary ones, and less than a second with what is around it.
const GRACE: Duration = Duration::from_millis(400);

impl Default for RunOptions {
    /// The best instructions of the machine, a thread per core, a window that takes a few megabytes, and 0.4 s of grace.
    fn default() -> Self {
        let threads = thread::available_parallelism().unwrap_or(NonZeroUsize::MIN);
        RunOptions { instructions: Backend::best(), threads, window: 16_384, grace: GRACE }
    }
}

/// The progress of a run, in points of a sweep or in designs of a response.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// Points that have run or are excluded, whether their rows are pulled yet or not.
    pub finished: u64,
    /// Points that are run in all.
    pub points: u64,
}

/// An error that ends a run. The rows written until then are in order and complete.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// Rows could not be written.
    #[error("cannot write rows: {0}")]
    Sink(#[from] io::Error),
    /// The threads could not be started.
    #[error("cannot start the worker threads: {0}")]
    Threads(#[source] io::Error),
    /// The model broke its contract; this is a mistake in the program.
    #[error("the model does not keep its contract: {0}")]
    Model(String),
    /// Rows that another process has computed do not belong here.
    #[error("rows of a worker do not fit: {0}")]
    Chunk(String),
    /// The caller that fetches rows from other processes has given up.
    #[error("rows cannot be fetched: {0}")]
    Fetch(String),
    /// A worker panicked; this is a mistake in the program.
    #[error("a worker panicked: {0}")]
    Panic(String),
}
