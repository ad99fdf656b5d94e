//! The runner of plans: a row for each point.

use std::io;
use std::ops::Range;
use std::sync::atomic::AtomicBool;

use flap_core::simulate::{Jobs, Point, Row, Status};

use super::error::RunError;
use super::finished::Finished;
use super::hand::Hand;
use super::ledger::Ledger;
use super::options::RunOptions;
use super::ordered;
use super::progress::Progress;
use super::sink::Sink;
use super::summary::Summary;
use crate::plan::{Plan, Verdict};
use crate::table::layout::Layout;

/// Runs the selected points of `plan` and writes the rows to `sink` in point order.
///
/// Raising `stop` ends the sweep within a second: points in hand have half of it and are dropped then. The rows
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
    let mut ledger = PointLedger::begin(plan, before, sink)?;
    let positions = ledger.ledger.remaining();
    let mut take = |batch: &mut Vec<Finished>| ledger.take(batch.drain(..));
    let worked = work(plan, options, positions, stop, &mut take, progress);
    ledger.ledger.end(worked)
}

/// Runs the points at these positions among the selected ones, on all threads, and hands their outcomes to `take`, in
/// order.
pub(super) fn work(
    plan: &Plan,
    options: &RunOptions,
    positions: Range<u64>,
    stop: &AtomicBool,
    take: &mut dyn FnMut(&mut Vec<Finished>) -> Result<(), RunError>,
    progress: &mut dyn FnMut(Progress),
) -> Result<(), RunError> {
    let worker = |hand: &mut Hand<'_, Finished>| {
        plan.rows().run(options.instructions, plan.solver(), &mut Points { plan, hand });
    };
    ordered::run(positions, options, stop, &worker, take, progress)
}

/// The points of a plan, as the model sees the queue.
struct Points<'a, 'q> {
    plan: &'a Plan,
    hand: &'a mut Hand<'q, Finished>,
}

impl Jobs for Points<'_, '_> {
    fn next(&mut self, idle: bool) -> Option<Point> {
        loop {
            let position = self.hand.next(idle)?;
            let point = self.plan.selected_point(position);
            match self.plan.judge(&point.values) {
                // The model hands the index back and has no other use for it: rows are put in order by position.
                Verdict::Runs => return Some(Point { index: position, ..point }),
                Verdict::Excluded(unsatisfied) => self.hand.done(position, Finished::Excluded(unsatisfied)),
                Verdict::Invalid(invalid) => self.hand.done(position, Finished::Row(Row::invalid(invalid))),
            }
        }
    }

    fn done(&mut self, position: u64, mut row: Row) {
        let expected = if row.status == Status::Periodic { self.plan.rows().columns().len() } else { 0 };
        if row.measures.len() != expected {
            let found = row.measures.len();
            self.hand.fail(format!("it returned {found} measures, not {expected}, for point {position}"));
            return;
        }
        if !self.plan.measures().is_empty() && position < self.plan.selected() {
            self.plan.add_own_measures(&self.plan.selected_point(position).values, &mut row.measures);
        }
        self.hand.done(position, Finished::Row(row));
    }

    fn interrupted(&self) -> bool {
        self.hand.is_cancelled()
    }
}

/// The ledger of a plan: turns the outcomes of points into rows.
pub(super) struct PointLedger<'a> {
    plan: &'a Plan,
    layout: Layout,
    pub(super) ledger: Ledger<'a>,
}

impl<'a> PointLedger<'a> {
    /// Begins to write to `sink`, where the rows that `before` counts are written already.
    pub(super) fn begin(
        plan: &'a Plan,
        before: Summary,
        sink: &'a mut dyn Sink,
    ) -> Result<PointLedger<'a>, RunError> {
        let ledger = Ledger::begin(plan, plan.selected(), before, sink)?;
        Ok(PointLedger { plan, layout: Layout::of(plan), ledger })
    }

    /// Takes the outcomes of the next points.
    pub(super) fn take(&mut self, batch: impl IntoIterator<Item = Finished>) -> Result<(), RunError> {
        self.write(batch).map_err(RunError::Sink)
    }

    fn write(&mut self, batch: impl IntoIterator<Item = Finished>) -> io::Result<()> {
        for finished in batch {
            match finished {
                Finished::Row(row) => {
                    let point = self.plan.selected_point(self.ledger.done());
                    let cells = self.layout.cells(&point, &row);
                    self.ledger.unit(point.index, [(cells, &row)])?;
                }
                Finished::Excluded(unsatisfied) => self.ledger.exclude(&unsatisfied)?,
            }
        }
        self.ledger.flush()
    }
}
