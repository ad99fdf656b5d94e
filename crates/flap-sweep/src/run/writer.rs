//! Writes the rows of a run to a sink in order, and computes the summary of the rows.

use std::borrow::Cow;
use std::io;

use csv::StringRecord;
use flap_core::simulate::Row;

use super::summary::{Limits, Summary};
use super::{Outcome, Progress, RunError, RunOptions, points};
use crate::plan::Plan;
use crate::refine::{self, Refinement};
use crate::table::layout::{Cell, Layout};

/// A table that receives rows in order.
///
/// The order of calls is `begin`, then any number of `write`, `after_point` and `flush`, then `finish`. After an error,
/// the caller calls no more functions of the sink.
pub trait Sink {
    /// Writes the header, if the sink has a header.
    ///
    /// # Errors
    /// The error of the write operation.
    fn begin(&mut self) -> io::Result<()> {
        Ok(())
    }

    /// Returns the rows that earlier runs have written, as text, in the order of the rows. A refinement requires the
    /// rows of earlier runs.
    ///
    /// # Errors
    /// The error of opening the file with the rows.
    fn written(&self) -> io::Result<Written> {
        Ok(Box::new(std::iter::empty()))
    }

    /// Writes the next row: one cell per column.
    ///
    /// # Errors
    /// The error of the write operation.
    fn write(&mut self, cells: &[Cell]) -> io::Result<()>;

    /// Receives the summary of all rows so far, after every row and every excluded point. The run can be resumed after
    /// the counted rows.
    ///
    /// # Errors
    /// The error of storing the rows.
    fn after_point(&mut self, so_far: &Summary) -> io::Result<()> {
        let _ = so_far;
        Ok(())
    }

    /// Passes the rows so far to the operating system, so that a killed process loses few rows. Does nothing for a
    /// sink in memory.
    ///
    /// # Errors
    /// The error of writing the rows.
    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }

    /// Completes the output and makes it durable. Only flushes by default.
    ///
    /// # Errors
    /// The error of writing the rows.
    fn finish(&mut self) -> io::Result<()> {
        self.flush()
    }
}

/// Rows as text, in the order of the rows.
pub type Written = Box<dyn Iterator<Item = io::Result<StringRecord>>>;

/// Writer of the rows of a plan to a sink. The writer also counts the rows.
pub struct RowWriter<'a> {
    /// Plan with the points of all rounds so far.
    plan: Cow<'a, Plan>,
    refinement: Option<Refinement>,
    layout: Layout<'a>,
    limits: Limits,
    summary: Summary,
    sink: &'a mut dyn Sink,
}

impl<'a> RowWriter<'a> {
    /// Begins to write the rows of `plan` to `sink`. The rows that `before` counts are already written.
    ///
    /// # Errors
    /// [`RunError::Sink`] if the header cannot be written.
    pub fn begin(plan: &'a Plan, before: Summary, sink: &'a mut dyn Sink) -> Result<RowWriter<'a>, RunError> {
        // The header is written at once, even if the first row takes long.
        sink.begin()?;
        sink.flush()?;
        let replayed = match before.done() {
            0 => Refinement::of(plan).map(|refinement| (plan.clone(), refinement)),
            done if plan.refine().is_some() => refine::replay(plan, done, sink.written()?)?,
            _ => None,
        };
        let (layout, limits) = (Layout::of(plan), Limits::of(plan));
        let (plan, refinement) = match replayed {
            Some((plan, refinement)) => (Cow::Owned(plan), Some(refinement)),
            None => (Cow::Borrowed(plan), None),
        };
        let summary = Summary::after(before, &plan);
        Ok(RowWriter { plan, refinement, layout, limits, summary, sink })
    }

    /// Returns the plan with the points of all rounds of its refinement so far.
    pub fn plan(&self) -> &Plan {
        &self.plan
    }

    /// Runs the points whose rows are not yet written, and the points that the refinement of the plan adds. Writes the
    /// rows of all these points.
    ///
    /// `stops` is called before each batch of rows, with the progress at the latest batch. If `stops` returns true, the
    /// run stops, see [`Run::stop`](super::Run::stop).
    ///
    /// # Errors
    /// The error of the run, or [`RunError::Sink`] if the rows cannot be written.
    pub fn run_points(
        &mut self,
        options: &RunOptions,
        mut stops: impl FnMut(Progress) -> bool,
    ) -> Result<(), RunError> {
        loop {
            let mut run = points::rows(&self.plan, options, self.done());
            let is_stopped = loop {
                let is_stopped = stops(run.progress());
                if is_stopped {
                    run.stop();
                }
                let Some(batch) = run.next_batch()? else { break is_stopped };
                for outcome in &batch {
                    self.write(outcome)?;
                }
                self.flush()?;
            };
            if is_stopped || !self.next_round() {
                return Ok(());
            }
        }
    }

    /// Adds the points of the next round of the refinement to the plan, after the rows of all its points are written.
    ///
    /// Returns false if there are no further points: the plan has no refinement, the refinement has ended, or rows are
    /// missing.
    pub fn next_round(&mut self) -> bool {
        let Some(refinement) = &mut self.refinement else { return false };
        if self.summary.is_interrupted() || self.summary.refined.is_some() {
            return false;
        }
        let before = self.plan.len();
        self.plan = Cow::Owned(self.plan.clone().into_owned().with_added_unchecked(refinement.next_round()));
        self.summary.points = self.plan.selected();
        let has_more = self.plan.len() > before;
        self.summary.refined = (!has_more).then(|| refinement.refined());
        has_more
    }

    /// Returns the columns of the rows.
    pub fn layout(&self) -> &Layout<'a> {
        &self.layout
    }

    /// Returns the number of finished points, which is the position of the next point.
    pub fn done(&self) -> u64 {
        self.summary.done()
    }

    /// Writes the row of the next point, or counts an excluded point.
    ///
    /// # Errors
    /// [`RunError::Sink`] if the row cannot be written.
    pub fn write(&mut self, outcome: &Outcome) -> Result<(), RunError> {
        match outcome {
            Outcome::Ran(row) => {
                let point = self.plan.selected_point(self.done());
                let cells = self.layout.cells(&point, row);
                if let Some(refinement) = &mut self.refinement {
                    refinement.add(|column| number(&cells[column]));
                }
                self.write_rows(point.index, [(cells, row)])
            }
            Outcome::Excluded(unsatisfied) => {
                if let Some(refinement) = &mut self.refinement {
                    refinement.add(|_| f64::NAN);
                }
                self.exclude(unsatisfied)
            }
        }
    }

    /// Writes the rows of the next unit of work, except rows that an earlier run has written. `index` is the index of
    /// the point or design in the plan.
    pub(crate) fn write_rows<'r>(
        &mut self,
        index: u64,
        rows: impl IntoIterator<Item = (Vec<Cell<'r>>, &'r Row)>,
    ) -> Result<(), RunError> {
        let written = usize::try_from(self.summary.begun).unwrap_or(usize::MAX);
        let mut rows = rows.into_iter().skip(written).peekable();
        while let Some((cells, row)) = rows.next() {
            self.sink.write(&cells)?;
            self.summary.add(index, row, &self.limits);
            if rows.peek().is_some() {
                self.summary.begun += 1;
                self.sink.after_point(&self.summary)?;
            }
        }
        self.summary.begun = 0;
        self.summary.ran += 1;
        Ok(self.sink.after_point(&self.summary)?)
    }

    /// Counts the next unit of work as excluded by the conditions with the given indices. An excluded unit of work has
    /// no row.
    pub(crate) fn exclude(&mut self, unsatisfied: &[usize]) -> Result<(), RunError> {
        self.summary.exclude(unsatisfied);
        Ok(self.sink.after_point(&self.summary)?)
    }

    /// Passes the rows so far to the operating system.
    ///
    /// # Errors
    /// [`RunError::Sink`] if the rows cannot be written.
    pub fn flush(&mut self) -> Result<(), RunError> {
        Ok(self.sink.flush()?)
    }

    /// Completes the sink after a run with the result `ended`, unless the sink cannot be written.
    ///
    /// # Errors
    /// The error of the run, or [`RunError::Sink`].
    pub fn finish(mut self, ended: Result<(), RunError>) -> Result<Summary, RunError> {
        // A run that is interrupted between two rounds has points left.
        self.next_round();
        if !matches!(ended, Err(RunError::Sink(_))) {
            self.sink.finish()?;
        }
        ended.map(|()| self.summary)
    }
}

/// Returns the number in a cell; NaN if the cell has no number.
fn number(cell: &Cell<'_>) -> f64 {
    if let Cell::Number(number) = cell { *number } else { f64::NAN }
}
