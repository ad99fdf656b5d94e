//! Checks that the rows of a file are the rows of a plan, are in the right order, and contain valid cells.

use std::io;

use csv::StringRecord;
use flap_core::simulate::Status;

use super::Reader;
use crate::plan::Plan;
use crate::plan::selection::Selection;
use crate::table::layout::{Cell, Column, Layout};

/// Checks the rows of a file one after the other.
pub struct RowCheck {
    columns: Vec<Column>,
    status: usize,
    selection: Selection,
    points: u64,
    /// Number of rows that flap wrote into the file; `None` if unknown.
    rows: Option<u64>,
    /// Smallest allowed position of the next row's point in the list of selected points.
    next: u64,
    seen: u64,
    /// True if every selected point must have a row.
    is_dense: bool,
    /// True if a point may have several rows. For example, a design with a response curve has one row per
    /// motion.
    is_repeated: bool,
}

/// Error if a row is not the expected next row of the plan. The error contains a message, in which rows are
/// counted from 1.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct RowError(String);

impl RowCheck {
    /// Returns a [`RowCheck`] for the rows of `plan`. `rows` is the number of rows that flap wrote, if known.
    pub fn new(plan: &Plan, rows: Option<u64>) -> RowCheck {
        RowCheck::of(plan, plan.selection().clone(), rows)
    }

    /// Returns a [`RowCheck`] for the points of `selection` instead of the points that `plan` selects.
    pub fn of(plan: &Plan, selection: Selection, rows: Option<u64>) -> RowCheck {
        let columns = Layout::of(plan).columns();
        let status = columns.iter().position(|column| column.name == "status").unwrap_or(0);
        RowCheck {
            columns,
            status,
            points: if matches!(selection, Selection::Shard(_)) { plan.len() } else { plan.most_points() },
            selection,
            rows,
            next: 0,
            seen: 0,
            is_dense: plan.conditions().is_empty(),
            is_repeated: plan.followed().is_some(),
        }
    }

    /// Allows missing rows from now on, because a tolerant reader leaves out unreadable rows.
    pub fn allow_gaps(&mut self) {
        self.is_dense = false;
        self.rows = None;
    }

    /// Checks the next row and returns the index of its point.
    ///
    /// # Errors
    /// Returns a [`RowError`] if the row is not the expected next row of the plan.
    pub fn row(&mut self, cells: &StringRecord) -> Result<u64, RowError> {
        let row = self.seen + 1;
        let columns = self.columns.len();
        if cells.len() != columns {
            let cells = cells.len();
            return Err(RowError(format!("row {row} has {cells} cells instead of {columns}")));
        }
        for (column, cell) in self.columns.iter().zip(cells) {
            if !cell.is_empty() && Cell::parse(column.kind, cell).is_none() {
                let message = format!("row {row}: `{cell}` does not fit column {}", column.name);
                return Err(RowError(message));
            }
        }
        let status = cells.get(self.status).unwrap_or_default();
        if !Status::ALL.iter().any(|known| known.name() == status) {
            return Err(RowError(format!("row {row}: `{status}` is not a status")));
        }
        let cell = cells.get(0).unwrap_or_default();
        let place = cell.parse().ok().and_then(|point| Some((point, self.position(point)?)));
        let Some((point, position)) = place else {
            return Err(RowError(format!("row {row} belongs to point `{cell}`, which was not run")));
        };
        let goes_on = self.is_repeated && position + 1 == self.next;
        if position < self.next && !goes_on {
            let message = format!("row {row} belongs to point {point}: it is repeated or out of order");
            return Err(RowError(message));
        }
        if self.is_dense && position > self.next {
            let missing = self.selection.index(self.next);
            let message =
                format!("row {row} belongs to point {point}: the row of point {missing} is missing");
            return Err(RowError(message));
        }
        self.next = position + 1;
        self.seen += 1;
        Ok(point)
    }

    /// Checks that no row is missing. Call this function after the last row.
    ///
    /// # Errors
    /// Returns a [`RowError`] if the number of checked rows differs from the number of rows that flap wrote.
    pub fn end(&self) -> Result<(), RowError> {
        match self.rows {
            Some(written) if written != self.seen => {
                Err(RowError(format!("it contains {} rows, but {written} were written", self.seen)))
            }
            _ => Ok(()),
        }
    }

    /// Returns the position of a point in the list of selected points, or `None` if the point is not
    /// selected.
    fn position(&self, point: u64) -> Option<u64> {
        if point >= self.points {
            return None;
        }
        match &self.selection {
            Selection::All => Some(point),
            Selection::Shard(shard) => shard.contains(point).then(|| point / shard.of()),
            Selection::Listed(list) => list.binary_search(&point).ok().map(|position| position as u64),
        }
    }
}

/// A reader that checks each row with a [`RowCheck`]. A tolerant reader leaves out rows that fail the check.
pub(crate) struct Checked<'a> {
    reader: &'a mut Reader,
    check: RowCheck,
    row: StringRecord,
}

/// Reason why the rows of a file cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum RowsError {
    /// The file cannot be read.
    #[error(transparent)]
    Read(#[from] io::Error),
    /// The file's columns differ from the plan's columns.
    #[error("its columns differ from the columns of the grid in its sidecar")]
    Columns,
    /// A row is not the expected next row of the plan.
    #[error(transparent)]
    Row(#[from] RowError),
}

impl<'a> Checked<'a> {
    /// Returns a reader that checks the rows of `reader`. Before this call, no row may have been read
    /// from `reader`.
    ///
    /// # Errors
    /// Returns [`RowsError::Columns`] if the file's columns differ from the plan's columns.
    pub(crate) fn new(reader: &'a mut Reader, mut check: RowCheck) -> Result<Checked<'a>, RowsError> {
        if !reader.names().iter().eq(check.columns.iter().map(|column| &column.name)) {
            return Err(RowsError::Columns);
        }
        if reader.is_tolerant() {
            check.allow_gaps();
        }
        Ok(Checked { reader, check, row: StringRecord::new() })
    }

    /// Reads the next row and returns the index of its point. Returns `None` after the last row.
    ///
    /// # Errors
    /// - [`RowsError::Read`] if the file cannot be read.
    /// - [`RowsError::Row`] if the row is not the expected next row of the plan, or if rows are missing at
    ///   the end of the file.
    pub(crate) fn next(&mut self) -> Result<Option<u64>, RowsError> {
        while self.reader.next(&mut self.row)? {
            match self.check.row(&self.row) {
                Ok(point) => return Ok(Some(point)),
                Err(_) if self.reader.leave_out() => {}
                Err(error) => return Err(error.into()),
            }
        }
        self.check.end()?;
        Ok(None)
    }

    /// Returns the cells of the row that was read last.
    pub(crate) fn row(&self) -> &StringRecord {
        &self.row
    }
}
