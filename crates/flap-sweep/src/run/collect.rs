//! The collector: takes the outcomes of units out of the queue, in order.

use super::error::RunError;
use super::progress::Progress;
use super::queue::Queue;

/// Hands the outcomes of units to `take` until the workers have ended.
pub(super) fn collect<T>(
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
