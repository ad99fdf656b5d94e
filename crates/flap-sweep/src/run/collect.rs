//! The collector: takes what became of points out of the queue, in order.

use super::finished::Finished;
use super::queue::{Queue, Turn};
use super::{Progress, RunError};

/// Hands what became of points to `take` until the workers have ended.
pub(super) fn collect(
    points: u64,
    queue: &Queue,
    take: &mut dyn FnMut(&mut Vec<Finished>) -> Result<(), RunError>,
    progress: &mut dyn FnMut(Progress),
) -> Result<(), RunError> {
    let _ends_the_workers = Abort(queue);
    let mut batch = Vec::new();
    while let Turn::Rows(finished) = queue.turn(&mut batch) {
        if !batch.is_empty() {
            take(&mut batch)?;
            batch.clear();
        }
        progress(Progress { finished, points });
    }
    Ok(())
}

/// Aborts the run when the collector ends, be it by an error or a panic: otherwise workers would wait for room
/// for ever.
struct Abort<'a>(&'a Queue<'a>);

impl Drop for Abort<'_> {
    fn drop(&mut self) {
        self.0.abort();
    }
}
