//! Runs units of work on several worker threads, and returns the outcomes in the order of the units.

use std::any::Any;
use std::ops::Range;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::thread::{self, JoinHandle};
use std::vec;

use super::queue::Queue;
use super::{Progress, RunError, RunOptions};
use crate::notation::text::count;

/// The function that each worker thread calls: it computes units of work until the queue is empty.
type Work<T> = dyn Fn(&mut Worker<'_, T>) + Send + Sync;

/// An iterator over the outcomes of units of work, for example the rows of points, in the order of the units.
///
/// The worker threads start when the caller requests the first outcome, and end when the run is dropped. The
/// threads compute at most [`RunOptions::window`] units of work ahead of the last returned outcome. If the
/// run fails, the last item of the iterator is the error. The outcomes before the error are the outcomes of
/// the first units of work, without gaps.
pub struct Run<T> {
    queue: Arc<Queue<T>>,
    work: Arc<Work<T>>,
    workers: usize,
    threads: Vec<JoinHandle<()>>,
    /// Finished outcomes that the iterator has not returned yet.
    batch: vec::IntoIter<T>,
    progress: Progress,
}

impl<T: Send + 'static> Run<T> {
    /// Returns a run that computes the units of work with the numbers `positions`. Each worker thread calls
    /// the function `work` once.
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

    /// Waits at most a tenth of a second and returns the next outcomes, which may be an empty list. Returns
    /// `None` after the last outcome.
    ///
    /// If your program shows the progress or must react to interruptions, call `next_batch` repeatedly. If
    /// your program needs neither the progress nor interruptions, use the run as an iterator.
    ///
    /// # Errors
    /// [`RunError`] if a worker thread panics or cannot be started, or if the model returns wrong rows.
    /// Before the error, the function returns the outcomes of all units of work before the first missing
    /// outcome.
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

    /// Returns the progress of the run at the last call of `next_batch`.
    pub fn progress(&self) -> Progress {
        self.progress
    }

    /// Stops the run: worker threads begin no new units of work.
    ///
    /// Units of work that are not finished after the time [`RunOptions::grace`] are discarded. With the
    /// default grace time, the run ends within a second.
    pub fn stop(&mut self) {
        self.queue.stop();
    }

    /// Starts the worker threads, unless the threads are already running.
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

/// Connects one worker thread with the queue. With a `Worker`, the thread requests units of work and returns
/// their outcomes.
pub(crate) struct Worker<'a, T> {
    queue: &'a Queue<T>,
    /// Number of units of work that this worker has requested and not finished.
    missing: u64,
    /// Description of a mistake in the program of the model, if a mistake was found.
    fault: Option<String>,
}

impl<T> Worker<'_, T> {
    /// Returns the number of the next unit of work, or `None` if no unit is available at present.
    ///
    /// `idle` is true if the worker has no unfinished units of work. If `idle` is true, the call may wait. If
    /// the call then returns `None`, the worker must end.
    pub(crate) fn next(&mut self, idle: bool) -> Option<u64> {
        if self.fault.is_some() {
            return None;
        }
        // A worker with running units must never wait, because others may be waiting for their rows.
        let position = self.queue.next(idle && self.missing == 0)?;
        self.missing += 1;
        Some(position)
    }

    /// Passes the outcome of the unit of work with the number `position` to the queue.
    pub(crate) fn done(&mut self, position: u64, outcome: T) {
        self.missing = self.missing.saturating_sub(1);
        self.queue.done(position, outcome);
    }

    /// Ends the work of this thread because the model returned a wrong row. `fault` describes the mistake.
    pub(crate) fn fail(&mut self, fault: String) {
        self.fault = Some(fault);
    }

    /// Returns true if the worker must abandon its unfinished units of work. Abandoned units have no rows.
    pub(crate) fn is_cancelled(&self) -> bool {
        self.queue.is_cancelled()
    }
}

/// Calls `work` on a worker thread, and then reports the end of the worker to the queue. If `work` panics or
/// an outcome is missing, the run ends with an error.
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

/// Returns the message of a panic, or `no message` if the panic has no message.
fn panic_message(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().copied().or_else(|| panic.downcast_ref().map(String::as_str));
    text.unwrap_or("no message").to_owned()
}
