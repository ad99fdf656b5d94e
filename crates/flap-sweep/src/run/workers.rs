//! Runner of units of work: workers on all threads, whose outcomes are collected in order.

use std::any::Any;
use std::ops::Range;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::thread::{self, JoinHandle};
use std::vec;

use super::queue::Queue;
use super::{Progress, RunError, RunOptions};
use crate::notation::text::count;

/// Work of one thread, which runs units of work until the queue is empty.
type Work<T> = dyn Fn(&mut Worker<'_, T>) + Send + Sync;

/// Outcomes of units of work, such as the rows of points, in order: an iterator over `Result<T, RunError>`.
///
/// Threads start when the first outcome is requested. The threads run at most [`RunOptions::window`] units of work
/// ahead, and end when the run is dropped. The iterator ends after an error. The outcomes before the error belong to
/// the first units of work.
pub struct Run<T> {
    queue: Arc<Queue<T>>,
    work: Arc<Work<T>>,
    workers: usize,
    threads: Vec<JoinHandle<()>>,
    /// Outcomes that the iterator returns next.
    batch: vec::IntoIter<T>,
    progress: Progress,
}

impl<T: Send + 'static> Run<T> {
    /// Returns a run of the units of work at `positions`. Each worker thread calls `work` once.
    pub(crate) fn new(
        positions: Range<u64>,
        options: &RunOptions,
        work: impl Fn(&mut Worker<'_, T>) + Send + Sync + 'static,
    ) -> Run<T> {
        // More workers than units would be idle.
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

    /// Returns the next outcomes, possibly none, after at most a tenth of a second; `None` at the end.
    ///
    /// A caller that shows progress or may be interrupted uses batches; other callers iterate.
    ///
    /// # Errors
    /// [`RunError`] if a worker panics, violates its contract or cannot be started, after the outcomes of earlier
    /// units.
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

    /// Returns the progress at the latest batch.
    pub fn progress(&self) -> Progress {
        self.progress
    }

    /// Stops assigning units.
    ///
    /// Running units of work are discarded after [`RunOptions::grace`], so the run ends within a second.
    pub fn stop(&mut self) {
        self.queue.stop();
    }

    /// Starts the threads, unless the threads run already.
    fn start(&mut self) {
        // The run has its own threads: a pool of the caller would not survive a fork.
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
            // The panic has already been reported as the failure of the run.
            let _ = thread.join();
        }
    }
}

/// Access of a worker to the queue. The access requests units of work, passes on their outcomes, and counts missing
/// outcomes.
pub(crate) struct Worker<'a, T> {
    queue: &'a Queue<T>,
    /// Number of assigned units of work without an outcome.
    missing: u64,
    /// Description of the mistake in the program of the model.
    fault: Option<String>,
}

impl<T> Worker<'_, T> {
    /// Returns the position of the next unit of work to run, or `None` if no unit is available at present.
    ///
    /// If `idle` is true, the worker runs nothing: the call may wait, and `None` ends the work.
    pub(crate) fn next(&mut self, idle: bool) -> Option<u64> {
        if self.fault.is_some() {
            return None;
        }
        // A worker with running units must never wait, because others may be waiting for their rows.
        let position = self.queue.next(idle && self.missing == 0)?;
        self.missing += 1;
        Some(position)
    }

    /// Passes on the outcome of the unit of work at `position`.
    pub(crate) fn done(&mut self, position: u64, outcome: T) {
        self.missing = self.missing.saturating_sub(1);
        self.queue.done(position, outcome);
    }

    /// Ends the work because the model violated its contract. `fault` is the description of the violation.
    pub(crate) fn fail(&mut self, fault: String) {
        self.fault = Some(fault);
    }

    /// Returns true if running units of work must be discarded without rows.
    pub(crate) fn is_cancelled(&self) -> bool {
        self.queue.is_cancelled()
    }
}

/// Runs `work` as one worker, and leaves the queue in any case. A panic or a missing outcome fails the run.
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

/// Returns the text of a panic, if the panic has a text.
fn panic_message(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().copied().or_else(|| panic.downcast_ref().map(String::as_str));
    text.unwrap_or("no message").to_owned()
}
