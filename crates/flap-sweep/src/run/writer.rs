//! Writes the rows of a run in the order of the points to a file or table, and computes the summary of the
//! rows.

use std::borrow::Cow;
use std::io;

use csv::StringRecord;
use flap_core::simulate::Row;

use super::summary::{Limits, Summary};
use super::{Outcome, Progress, RunError, RunOptions, points};
use crate::plan::Plan;
use crate::refine::{self, Refinement};
use crate::table::layout::{Cell, Layout};

/// A file or a table in memory to which rows are written in the order of the points.
///
/// The caller calls `begin` once, then `write`, `after_point` and `flush` any number of times, and finally
/// `finish` once. After an error, the caller calls no further functions of the sink.
pub trait Sink {
    /// Writes the names of the columns, if the format of the output has a header.
    ///
    /// # Errors
    /// The error of the operating system if the output cannot be written.
    fn begin(&mut self) -> io::Result<()> {
        Ok(())
    }

    /// Returns the rows that earlier runs have written to this output, with the cells as text. If a run with
    /// refinement is resumed, the refinement reads the rows of earlier runs.
    ///
    /// # Errors
    /// The error of the operating system if the file with the rows cannot be opened.
    fn written(&self) -> io::Result<Written> {
        Ok(Box::new(std::iter::empty()))
    }

    /// Writes the next row, with one cell for each column.
    ///
    /// # Errors
    /// The error of the operating system if the output cannot be written.
    fn write(&mut self, cells: &[Cell]) -> io::Result<()>;

    /// The caller calls this function after each row and after each excluded point. `so_far` is the summary
    /// of all rows so far. An interrupted run can be resumed from the summary in `so_far`.
    ///
    /// # Errors
    /// The error of the operating system if the rows cannot be stored on disk.
    fn after_point(&mut self, so_far: &Summary) -> io::Result<()> {
        let _ = so_far;
        Ok(())
    }

    /// Passes all buffered rows to the operating system, so that few rows are lost if the process is killed.
    /// By default, this function does nothing, because a table in memory has no buffer.
    ///
    /// # Errors
    /// The error of the operating system if the rows cannot be written.
    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }

    /// Completes the output, so that the rows are safe on disk. By default, this function only calls `flush`.
    ///
    /// # Errors
    /// The error of the operating system if the rows cannot be written.
    fn finish(&mut self) -> io::Result<()> {
        self.flush()
    }
}

/// An iterator over rows whose cells are text.
pub type Written = Box<dyn Iterator<Item = io::Result<StringRecord>>>;

/// Writes the rows of a plan to a [`Sink`], and counts the rows.
pub struct RowWriter<'a> {
    /// The plan, with all points that the refinement has added so far.
    plan: Cow<'a, Plan>,
    refinement: Option<Refinement>,
    layout: Layout<'a>,
    limits: Limits,
    summary: Summary,
    sink: &'a mut dyn Sink,
}

impl<'a> RowWriter<'a> {
    /// Writes the header to `sink`, and returns a writer for the rows of `plan`. `before` is the summary of
    /// the rows that are already written.
    ///
    /// # Errors
    /// [`RunError::Sink`] if the header cannot be written, or if the rows of earlier runs cannot be read.
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

    /// Returns the plan with all points that its refinement has added so far.
    pub fn plan(&self) -> &Plan {
        &self.plan
    }

    /// Computes and writes the rows that are not yet written, and the rows of all points that the refinement
    /// adds.
    ///
    /// Before each batch of rows, `run_points` calls `stops` with the current progress. If `stops` returns
    /// true, the run stops (see [`Run::stop`](super::Run::stop)).
    ///
    /// # Errors
    /// [`RunError::Sink`] if rows cannot be written, and the errors of
    /// [`Run::next_batch`](super::Run::next_batch).
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

    /// Adds points to the plan if the rows of all points are written and the refinement requires further
    /// points.
    ///
    /// Returns false if no points are added: the plan has no refinement, the refinement has ended, or rows
    /// are not yet written.
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

    /// Returns the layout, which contains the columns of the rows.
    pub fn layout(&self) -> &Layout<'a> {
        &self.layout
    }

    /// Returns the number of finished points. The number of finished points is also the position of the next
    /// point in the list of selected points.
    pub fn done(&self) -> u64 {
        self.summary.done()
    }

    /// Writes the row of the next point. If the next point is excluded, the function only counts the point.
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

    /// Writes the rows of the next point or design, except rows that an earlier run has already written.
    /// `index` is the index of the point or design in the plan.
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

    /// Counts the next point or design as excluded, because it does not satisfy the conditions with the
    /// indices `unsatisfied`. An excluded point or design has no row.
    pub(crate) fn exclude(&mut self, unsatisfied: &[usize]) -> Result<(), RunError> {
        self.summary.exclude(unsatisfied);
        Ok(self.sink.after_point(&self.summary)?)
    }

    /// Passes all buffered rows to the operating system.
    ///
    /// # Errors
    /// [`RunError::Sink`] if the rows cannot be written.
    pub fn flush(&mut self) -> Result<(), RunError> {
        Ok(self.sink.flush()?)
    }

    /// Completes the output and returns the summary. `ended` is the result of the run. If the rows could not
    /// be written, the output is not completed.
    ///
    /// # Errors
    /// The error in `ended`, or [`RunError::Sink`] if the output cannot be completed.
    pub fn finish(mut self, ended: Result<(), RunError>) -> Result<Summary, RunError> {
        // A run that is interrupted between two rounds has points left.
        self.next_round();
        if !matches!(ended, Err(RunError::Sink(_))) {
            self.sink.finish()?;
        }
        ended.map(|()| self.summary)
    }
}

/// Returns the number in a cell, or NaN if the cell contains text or is empty.
fn number(cell: &Cell<'_>) -> f64 {
    if let Cell::Number(number) = cell { *number } else { f64::NAN }
}
