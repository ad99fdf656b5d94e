//! The collector: takes rows out of the queue and writes them.

use std::io;

use super::finished::Finished;
use super::queue::{Queue, Turn};
use super::{Progress, Summary};
use crate::plan::Plan;
use crate::sink::Sink;

/// Writes rows until the workers have ended; `before` counts the rows that are written already.
pub(super) fn collect(
    plan: &Plan,
    before: Summary,
    queue: &Queue,
    sink: &mut dyn Sink,
    progress: &mut dyn FnMut(Progress),
) -> io::Result<Summary> {
    let _ends_the_workers = Abort(queue);
    let mut summary = Summary::after(before, plan);
    let mut batch = Vec::new();
    while let Turn::Rows(finished) = queue.turn(&mut batch) {
        if !batch.is_empty() {
            for finished in batch.drain(..) {
                match finished {
                    Finished::Row(row) => {
                        let point = plan.selected_point(summary.done());
                        sink.write(&point, &row)?;
                        summary.add(point.index, row);
                    }
                    Finished::Excluded(unsatisfied) => summary.exclude(&unsatisfied),
                }
                sink.done(&summary)?;
            }
            sink.flush()?;
        }
        progress(Progress { finished, points: summary.points });
    }
    summary.interrupted = summary.done() < summary.points;
    Ok(summary)
}

/// Aborts the run when the collector ends, be it by an error or a panic: otherwise workers would wait for room
/// for ever.
struct Abort<'a>(&'a Queue<'a>);

impl Drop for Abort<'_> {
    fn drop(&mut self) {
        self.0.abort();
    }
}
