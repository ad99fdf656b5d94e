//! The ledger of a run: writes rows to the sink, in order, and sums them up.

use std::io;
use std::ops::Range;

use flap_core::simulate::Row;

use super::error::RunError;
use super::sink::Sink;
use super::summary::{Doubtful, Summary};
use crate::plan::Plan;
use crate::table::layout::Cell;

/// Writes the rows of units, in their order, and counts them.
pub(crate) struct Ledger<'a> {
    sink: &'a mut dyn Sink,
    summary: Summary,
    doubtful: Doubtful,
}

impl<'a> Ledger<'a> {
    /// Begins to write the rows of `units` points or designs of `plan` to `sink`, where the rows that `before` counts are
    /// written already.
    pub(crate) fn begin(
        plan: &Plan,
        units: u64,
        before: Summary,
        sink: &'a mut dyn Sink,
    ) -> Result<Ledger<'a>, RunError> {
        // The header is there from the beginning, however long the first row takes.
        sink.begin().and_then(|()| sink.flush()).map_err(RunError::Sink)?;
        let summary = Summary { points: units, ..Summary::after(before, plan) };
        Ok(Ledger { sink, summary, doubtful: Doubtful::of(plan) })
    }

    /// Units that are done with: the first ones.
    pub(crate) fn done(&self) -> u64 {
        self.summary.done()
    }

    /// Units that are run in all.
    pub(super) fn units(&self) -> u64 {
        self.summary.points
    }

    /// The positions of the units that are not done with.
    pub(crate) fn remaining(&self) -> Range<u64> {
        self.done()..self.units()
    }

    /// Writes the rows of the next unit, whose index in the plan is given, but for those that an earlier run has written.
    pub(crate) fn unit<'r>(
        &mut self,
        index: u64,
        rows: impl IntoIterator<Item = (Vec<Cell<'static>>, &'r Row)>,
    ) -> io::Result<()> {
        let written = usize::try_from(self.summary.begun).unwrap_or(usize::MAX);
        let mut rows = rows.into_iter().skip(written).peekable();
        while let Some((cells, row)) = rows.next() {
            self.sink.write(&cells)?;
            self.doubtful.count(row, &mut self.summary.doubts);
            self.summary.add(index, row);
            if rows.peek().is_some() {
                self.summary.begun += 1;
                self.sink.done(&self.summary)?;
            }
        }
        self.summary.begun = 0;
        self.summary.ran += 1;
        self.sink.done(&self.summary)
    }

    /// Notes that the next unit does not satisfy the conditions with these numbers, and has no row.
    pub(crate) fn exclude(&mut self, unsatisfied: &[usize]) -> io::Result<()> {
        self.summary.exclude(unsatisfied);
        self.sink.done(&self.summary)
    }

    /// Hands what has been written to the operating system.
    pub(crate) fn flush(&mut self) -> io::Result<()> {
        self.sink.flush()
    }

    /// Completes the sink once the units are `worked` through, unless it cannot be written to.
    pub(crate) fn end(mut self, worked: Result<(), RunError>) -> Result<Summary, RunError> {
        if !matches!(worked, Err(RunError::Sink(_))) {
            self.sink.finish().map_err(RunError::Sink)?;
        }
        self.summary.interrupted = self.done() < self.units();
        worked.map(|()| self.summary)
    }
}
