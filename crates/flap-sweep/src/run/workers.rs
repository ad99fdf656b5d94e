//! The runner of units: workers on all threads, whose outcomes are pulled in order.

use std::any::Any;
use std::ops::Range;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::thread::{self, JoinHandle};
use std::vec;

use super::queue::Queue;
use super::{Progress, RunError, RunOptions};
use crate::notation::text::count;

/// The work of one thread: runs units until the queue gives no more.
type Work<T> = dyn Fn(&mut Worker<'_, T>) + Send + Sync;

/// The outcomes of units, such as the rows of points, in order: an iterator over `Result<T, RunError>`.
///
/// Threads start with the first outcome that is pulled. They run at most [`RunOptions::window`] units ahead, and end when the
/// run is dropped. After an error, the iterator ends: the outcomes before it are those of the first units.
pub struct Run<T> {
    queue: Arc<Queue<T>>,
    work: Arc<Work<T>>,
    workers: usize,
    threads: Vec<JoinHandle<()>>,
    /// Outcomes that the iterator gives next.
    batch: vec::IntoIter<T>,
    progress: Progress,
}

impl<T: Send + 'static> Run<T> {
    /// A run of the units at `positions`. Each thread calls `work` once.
    pub(crate) fn new(
        positions: Range<u64>,
        options: &RunOptions,
        work: impl Fn(&mut Worker<'_, T>) + Send + Sync + 'static,
    ) -> Run<T> {
        // More workers than units would have nothing to do.
        let units = usize::try_from(positions.end - positions.start).unwrap_or(usize::MAX);
        let workers = options.threads.get().min(units.max(1));
        let progress = Progress { finished: positions.start, points: positions.end };
        let queue = Arc::new(Queue::new(positions, options, workers));
        Run {
            queue,
            work: Arc::new(work),
            workers,
            threads: Vec::new(),
            batch: Vec::new().into_iter(),
            progress,
        }
    }

    /// The next outcomes, after a tenth of a second at the latest, when there may be none; `None` at the end. A caller that
    /// shows progress or may be interrupted pulls batches, others iterate.
    ///
    /// # Errors
    /// [`RunError`] if a worker panics, breaks its contract or cannot be started, after the outcomes of the units before.
    pub fn next_batch(&mut self) -> Result<Option<Vec<T>>, RunError> {
        self.start();
        match self.queue.next_batch() {
            Some((batch, finished)) => {
                self.progress.finished = finished;
                Ok(Some(batch))
            }
            None => self.queue.take_failure().map_or(Ok(None), Err),
        }
    }

    /// The progress at the latest batch.
    pub fn progress(&self) -> Progress {
        self.progress
    }

    /// Begins no more units. Those in hand have [`RunOptions::grace`] and are dropped then, so that the run ends within a second.
    pub fn stop(&mut self) {
        self.queue.stop();
    }

    /// Starts the threads, unless they have been started.
    fn start(&mut self) {
        // Threads of its own: those of the caller, such as a pool, do not survive a fork.
        for _ in 0..std::mem::take(&mut self.workers) {
            let (queue, work) = (Arc::clone(&self.queue), Arc::clone(&self.work));
            match thread::Builder::new().spawn(move || run_worker(&queue, &*work)) {
                Ok(thread) => self.threads.push(thread),
                Err(error) => self.queue.leave(Err(RunError::Threads(error))),
            }
        }
    }
}

impl<T: Send + 'static> Iterator for Run<T> {
    type Item = Result<T, RunError>;

    fn next(&mut self) -> Option<Result<T, RunError>> {
        loop {
            if let Some(outcome) = self.batch.next() {
                return Some(Ok(outcome));
            }
            match self.next_batch() {
                Ok(Some(batch)) => self.batch = batch.into_iter(),
                Ok(None) => return None,
                Err(error) => return Some(Err(error)),
            }
        }
    }
}

impl<T> Drop for Run<T> {
    fn drop(&mut self) {
        self.queue.abort();
        for thread in self.threads.drain(..) {
            // Its panic has been reported as the failure of the run.
            let _ = thread.join();
        }
    }
}

/// A worker's side of the queue: takes units, hands in their outcomes, and counts those that are missing.
pub(crate) struct Worker<'a, T> {
    queue: &'a Queue<T>,
    /// Number of units taken whose outcomes have not been handed in.
    missing: u64,
    /// A mistake of the model.
    fault: Option<String>,
}

impl<T> Worker<'_, T> {
    /// The position of the next unit to run, or `None` if there is none for now. With `idle` the worker runs nothing: the
    /// call may wait, and `None` ends the work.
    pub(crate) fn next(&mut self, idle: bool) -> Option<u64> {
        if self.fault.is_some() {
            return None;
        }
        // A worker with units in hand must never wait: others may be waiting for their rows.
        let position = self.queue.next(idle && self.missing == 0)?;
        self.missing += 1;
        Some(position)
    }

    /// Hands in the outcome of the unit at `position`.
    pub(crate) fn done(&mut self, position: u64, outcome: T) {
        self.missing = self.missing.saturating_sub(1);
        self.queue.done(position, outcome);
    }

    /// Ends the work because the model broke its contract in this way.
    pub(crate) fn fail(&mut self, fault: String) {
        self.fault = Some(fault);
    }

    /// True if units in hand are to be dropped without their rows.
    pub(crate) fn is_cancelled(&self) -> bool {
        self.queue.is_cancelled()
    }
}

/// Does `work` as one worker, and leaves the queue in any case: a panic and units that are lost fail the run.
fn run_worker<T>(queue: &Queue<T>, work: &Work<T>) {
    let mut worker = Worker { queue, missing: 0, fault: None };
    let ended = catch_unwind(AssertUnwindSafe(|| work(&mut worker)));
    let outcome = match (ended, worker.fault, worker.missing) {
        (Err(panic), _, _) => Err(RunError::Panic(panic_message(&*panic))),
        (Ok(()), Some(fault), _) => Err(RunError::Model(fault)),
        (Ok(()), None, 0) => Ok(()),
        (Ok(()), None, _) if queue.is_cancelled() => Ok(()),
        (Ok(()), None, lost) => {
            Err(RunError::Model(format!("it returned without the rows of {}", count(lost, "point"))))
        }
    };
    queue.leave(outcome);
}

/// The text of a panic, which is a string in all but exotic cases.
fn panic_message(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().copied().or_else(|| panic.downcast_ref().map(String::as_str));
    text.unwrap_or("no message").to_owned()
}
