//! The ledger of a run: rows into the sink, in order, and what they come to.

use std::io;

use super::Summary;
use super::finished::Finished;
use super::summary::Doubtful;
use crate::plan::Plan;
use crate::run::sink::Sink;

/// Writes what becomes of points, in their order, and counts it.
pub(super) struct Ledger<'a> {
    plan: &'a Plan,
    sink: &'a mut dyn Sink,
    summary: Summary,
    doubtful: Doubtful,
}

impl<'a> Ledger<'a> {
    /// Begins to write to `sink`, where the rows that `before` counts are written already.
    pub(super) fn begin(plan: &'a Plan, before: Summary, sink: &'a mut dyn Sink) -> io::Result<Ledger<'a>> {
        // The header is there from the beginning, however long the first row takes.
        sink.begin()?;
        sink.flush()?;
        Ok(Ledger { plan, sink, summary: Summary::after(before, plan), doubtful: Doubtful::of(plan) })
    }

    /// Points that are done with: the first ones of those selected.
    pub(super) fn done(&self) -> u64 {
        self.summary.done()
    }

    /// Points that are run in all.
    pub(super) fn points(&self) -> u64 {
        self.summary.points
    }

    /// Takes what became of the next points.
    pub(super) fn take(&mut self, batch: impl IntoIterator<Item = Finished>) -> io::Result<()> {
        for finished in batch {
            match finished {
                Finished::Row(row) => {
                    let point = self.plan.selected_point(self.summary.done());
                    self.sink.write(&point, &row)?;
                    self.doubtful.count(&row, &mut self.summary.doubts);
                    self.summary.add(point.index, row);
                }
                Finished::Excluded(unsatisfied) => self.summary.exclude(&unsatisfied),
            }
            self.sink.done(&self.summary)?;
        }
        self.sink.flush()
    }

    /// Completes the sink.
    pub(super) fn finish(mut self) -> io::Result<Summary> {
        self.sink.finish()?;
        self.summary.interrupted = self.summary.done() < self.summary.points;
        Ok(self.summary)
    }
}
