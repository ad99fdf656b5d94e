//! The runner of plans: a row for each point.

use std::io;
use std::ops::Range;
use std::sync::atomic::AtomicBool;

use flap_core::simulate::{Interrupt, Jobs, Point, PointRun, Row, Status};

use super::error::RunError;
use super::finished::Finished;
use super::gradient;
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
/// Raising `stop` ends the sweep within a second: points in hand have [`RunOptions::grace`] and are dropped then. The rows
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

/// Runs the selected points of `plan` one after another on the calling thread, on scalars. The rows are those of [`run`]: for
/// a few points they come sooner, since no thread starts and no lanes stay empty.
///
/// # Errors
/// [`RunError`] as of [`run`]. Once `interrupted` says so, the rows written are those of the first points.
pub fn alone(
    plan: &Plan,
    options: &RunOptions,
    sink: &mut dyn Sink,
    interrupted: Interrupt<'_>,
) -> Result<Summary, RunError> {
    let mut ledger = PointLedger::begin(plan, Summary::default(), sink)?;
    for position in ledger.ledger.remaining() {
        let finished = match taken(plan, position) {
            Ok(point) => {
                let run = PointRun::new(options.instructions, plan.solver(), &point.values);
                let row = plan.rows().run_point(&run.until(interrupted), point.begin.as_deref());
                if interrupted() {
                    break;
                }
                let completed = completed(plan, options, position, row, interrupted);
                let Some(finished) = completed.map_err(RunError::Model)? else { break };
                finished
            }
            Err(finished) => finished,
        };
        ledger.take([finished])?;
    }
    ledger.ledger.end(Ok(()))
}

/// The point at `position` among the selected ones, or its outcome if it is not run.
fn taken(plan: &Plan, position: u64) -> Result<Point, Finished> {
    let point = plan.selected_point(position);
    match plan.judge(&point.values) {
        // The model hands the index back and has no other use for it: rows are put in order by position.
        Verdict::Runs => Ok(Point { index: position, ..point }),
        Verdict::Excluded(unsatisfied) => Err(Finished::Excluded(unsatisfied)),
        Verdict::Invalid(invalid) => Err(Finished::Row(Row::invalid(invalid))),
    }
}

/// The outcome of a point with the row of the model, `None` if it was interrupted, or the model's mistake.
fn completed(
    plan: &Plan,
    options: &RunOptions,
    position: u64,
    mut row: Row,
    interrupted: Interrupt<'_>,
) -> Result<Option<Finished>, String> {
    let expected = if row.status == Status::Periodic { plan.rows().columns().len() } else { 0 };
    if row.measures.len() != expected {
        let found = row.measures.len();
        return Err(format!("it returned {found} measures, not {expected}, for point {position}"));
    }
    let has_more = !plan.measures().is_empty() || plan.gradient().is_some();
    if has_more && position < plan.selected() {
        let point = plan.selected_point(position);
        plan.add_own_measures(&point.values, &mut row.measures);
        if !gradient::add(plan, options, &point, &mut row, interrupted) {
            return Ok(None);
        }
    }
    Ok(Some(Finished::Row(row)))
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
    let few = (positions.end - positions.start).div_ceil(options.threads.get() as u64) <= FEW;
    let worker = |hand: &mut Hand<'_, Finished>| {
        let mut points = Points { plan, options, hand };
        if few && plan.resonance().is_none() {
            points.run_singly();
        } else {
            plan.rows().run(options.instructions, plan.solver(), &mut points);
        }
    };
    ordered::run(positions, options, stop, &worker, take, progress)
}

/// Points per thread that run sooner one after another on scalars than side by side in lanes, most of which they leave empty.
const FEW: u64 = 2;

/// The points of a plan, as the model sees the queue.
struct Points<'a, 'q> {
    plan: &'a Plan,
    options: &'a RunOptions,
    hand: &'a mut Hand<'q, Finished>,
}

impl Points<'_, '_> {
    /// Runs points one after another on scalars.
    fn run_singly(&mut self) {
        while let Some(point) = self.next(true) {
            let cancelled = || self.hand.is_cancelled();
            let run = PointRun::new(self.options.instructions, self.plan.solver(), &point.values);
            let row = self.plan.rows().run_point(&run.until(&cancelled), point.begin.as_deref());
            if self.hand.is_cancelled() {
                break;
            }
            self.done(point.index, row);
        }
    }
}

impl Jobs for Points<'_, '_> {
    fn next(&mut self, idle: bool) -> Option<Point> {
        loop {
            let position = self.hand.next(idle)?;
            match taken(self.plan, position) {
                Ok(point) => return Some(point),
                Err(finished) => self.hand.done(position, finished),
            }
        }
    }

    fn done(&mut self, position: u64, row: Row) {
        let cancelled = || self.hand.is_cancelled();
        match completed(self.plan, self.options, position, row, &cancelled) {
            Ok(Some(finished)) => self.hand.done(position, finished),
            Ok(None) => {}
            Err(fault) => self.hand.fail(fault),
        }
    }

    fn interrupted(&self) -> bool {
        self.hand.is_cancelled()
    }
}

/// The ledger of a plan: turns the outcomes of points into rows.
pub(super) struct PointLedger<'a> {
    plan: &'a Plan,
    layout: Layout<'a>,
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
