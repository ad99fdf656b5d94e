//! Runs a plan on all cores and writes its rows in point order.
//!
//! Each worker is one lane ensemble that lives for the whole sweep, so lanes are never left empty at the end of
//! a chunk. Points finish in any order; a bounded window puts the rows back into point order, so that memory
//! does not grow with the number of points and the output does not depend on the number of threads.

mod collect;
mod finished;
pub mod identity;
mod ledger;
mod parcel;
mod queue;
pub mod sink;
pub(crate) mod solver;
mod summary;
mod window;
mod worker;

use std::io;
use std::num::NonZeroUsize;
use std::ops::Range;
use std::sync::atomic::AtomicBool;
use std::thread;

use flap_core::num::InstructionSet;
pub use parcel::{Parcel, feed, part};
pub use summary::{Counts, Doubts, Summary};

use crate::plan::Plan;
use crate::run::sink::Sink;
use finished::Finished;
use ledger::Ledger;
use queue::Queue;

/// How a plan is run. Nothing here changes a byte of the output, but for the arithmetic class of the
/// instruction set.
#[derive(Clone, Copy, Debug)]
pub struct RunOptions {
    /// Instructions of the lanes.
    pub instructions: InstructionSet,
    /// Worker threads.
    pub threads: NonZeroUsize,
    /// Most points between the last row written and the last point begun.
    ///
    /// A point that takes long holds up the rows behind it: the wider the window, the longer the others
    /// can go on meanwhile. A row of 40 measures takes about half a kilobyte.
    pub window: usize,
}

impl Default for RunOptions {
    /// The best instructions of the machine, a thread per core, and a window that takes a few megabytes.
    fn default() -> Self {
        let threads = thread::available_parallelism().unwrap_or(NonZeroUsize::MIN);
        RunOptions { instructions: InstructionSet::best(), threads, window: 16_384 }
    }
}

/// How far a sweep is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// Points that have run or are excluded, whether their rows are written yet or not.
    pub finished: u64,
    /// Points that are run in all.
    pub points: u64,
}

/// Why a sweep failed. The rows written until then are in order and complete.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// Rows could not be written.
    #[error("cannot write rows: {0}")]
    Sink(#[source] io::Error),
    /// The threads could not be started.
    #[error("cannot start the worker threads: {0}")]
    Threads(#[source] rayon::ThreadPoolBuildError),
    /// The model broke its contract; this is a mistake in the program.
    #[error("the model does not keep its contract: {0}")]
    Model(String),
    /// Rows that another process has computed do not belong here.
    #[error("rows from elsewhere do not fit: {0}")]
    Parcel(String),
    /// Whoever fetches rows from elsewhere has given up.
    #[error("rows cannot be fetched: {0}")]
    Fetch(String),
    /// A worker panicked; this is a mistake in the program.
    #[error("a worker panicked: {0}")]
    Panic(String),
}

/// Runs the selected points of `plan` and writes the rows to `sink` in point order.
///
/// When `stop` is raised, the sweep ends within a second: points in hand have half of it and are dropped then. The rows
/// written are those of the first points selected. `progress` is called from this thread, several times a second.
///
/// # Errors
/// [`RunError`] if rows cannot be written or a worker fails. Rows are never left out: those written are
/// those of the first points selected, in this case too.
pub fn run(
    plan: &Plan,
    options: &RunOptions,
    sink: &mut dyn Sink,
    stop: &AtomicBool,
    progress: &mut dyn FnMut(Progress),
) -> Result<Summary, RunError> {
    resume(plan, options, Summary::default(), sink, stop, progress)
}

/// Goes on as [`run`] does after the points that `before` counts, whose rows are written. The summary is of all of them.
///
/// # Errors
/// As [`run`].
pub fn resume(
    plan: &Plan,
    options: &RunOptions,
    before: Summary,
    sink: &mut dyn Sink,
    stop: &AtomicBool,
    progress: &mut dyn FnMut(Progress),
) -> Result<Summary, RunError> {
    let mut ledger = Ledger::begin(plan, before, sink).map_err(RunError::Sink)?;
    let positions = ledger.done()..ledger.points();
    let mut take = |batch: &mut Vec<Finished>| ledger.take(batch.drain(..)).map_err(RunError::Sink);
    let worked = work(plan, options, positions, stop, &mut take, progress);
    // What cannot be written cannot be completed.
    if matches!(worked, Err(RunError::Sink(_))) {
        return worked.map(|()| Summary::default());
    }
    let summary = ledger.finish().map_err(RunError::Sink)?;
    worked.map(|()| summary)
}

/// Runs the points at these positions among the selected ones, on all threads, and hands what became of them to `take`,
/// in order.
fn work(
    plan: &Plan,
    options: &RunOptions,
    positions: Range<u64>,
    stop: &AtomicBool,
    take: &mut dyn FnMut(&mut Vec<Finished>) -> Result<(), RunError>,
    progress: &mut dyn FnMut(Progress),
) -> Result<(), RunError> {
    // More workers than points would have nothing to do.
    let points = usize::try_from(positions.end - positions.start).unwrap_or(usize::MAX);
    let workers = options.threads.get().min(points.max(1));
    // A pool of our own: the global one belongs to the caller, and does not survive a fork.
    let pool = rayon::ThreadPoolBuilder::new().num_threads(workers).build().map_err(RunError::Threads)?;
    let end = positions.end;
    let queue = Queue::new(positions, options.window, workers, stop);
    pool.in_place_scope(|scope| {
        for _ in 0..workers {
            scope.spawn(|_| worker::work(plan, options.instructions, &queue));
        }
        collect::collect(end, &queue, take, progress)
    })?;
    queue.into_failure().map_or(Ok(()), Err)
}
