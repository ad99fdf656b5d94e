//! The runner of units: workers on all threads, and their outcomes in order.

use std::ops::Range;
use std::sync::atomic::AtomicBool;

use super::error::RunError;
use super::hand::{self, Hand};
use super::options::RunOptions;
use super::progress::Progress;
use super::queue::Queue;

/// Runs the units at `positions` on all threads, and hands their outcomes to `take`, in order. `worker` runs units until
/// its hand gives no more.
///
/// # Errors
/// The error of `take`, or [`RunError`] if a worker panics, breaks its contract or cannot be started. Outcomes taken
/// until then are those of the first units.
pub(crate) fn run<T: Send>(
    positions: Range<u64>,
    options: &RunOptions,
    stop: &AtomicBool,
    worker: &(dyn Fn(&mut Hand<'_, T>) + Sync),
    take: &mut dyn FnMut(&mut Vec<T>) -> Result<(), RunError>,
    progress: &mut dyn FnMut(Progress),
) -> Result<(), RunError> {
    // More workers than units would have nothing to do.
    let units = usize::try_from(positions.end - positions.start).unwrap_or(usize::MAX);
    let workers = options.threads.get().min(units.max(1));
    // A pool of our own: the global one belongs to the caller, and does not survive a fork.
    let pool = rayon::ThreadPoolBuilder::new().num_threads(workers).build().map_err(RunError::Threads)?;
    let end = positions.end;
    let queue = Queue::new(positions, options, workers, stop);
    pool.in_place_scope(|scope| {
        for _ in 0..workers {
            scope.spawn(|_| hand::work(&queue, worker));
        }
        collect(end, &queue, take, progress)
    })?;
    queue.into_failure().map_or(Ok(()), Err)
}

/// Hands the outcomes of units to `take` until the workers have ended.
fn collect<T>(
    units: u64,
    queue: &Queue<'_, T>,
    take: &mut dyn FnMut(&mut Vec<T>) -> Result<(), RunError>,
    progress: &mut dyn FnMut(Progress),
) -> Result<(), RunError> {
    let _ends_the_workers = Abort(queue);
    let mut batch = Vec::new();
    while let Some(finished) = queue.turn(&mut batch) {
        if !batch.is_empty() {
            take(&mut batch)?;
            batch.clear();
        }
        progress(Progress { finished, points: units });
    }
    Ok(())
}

/// Aborts the run when the collector ends, be it by an error or a panic: otherwise workers would wait for room
/// for ever.
struct Abort<'a, T>(&'a Queue<'a, T>);

impl<T> Drop for Abort<'_, T> {
    fn drop(&mut self) {
        self.0.abort();
    }
}
