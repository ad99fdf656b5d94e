//! Whether rows are those of a plan: each in its place, with cells of its columns' kinds.

use csv::StringRecord;
use flap_core::simulate::Status;

use crate::plan::Plan;
use crate::plan::selection::Selection;
use crate::table::layout::{Column, Kind, Layout};

/// Checks rows as they come.
pub struct RowCheck {
    columns: Vec<Column>,
    status: usize,
    selection: Selection,
    points: u64,
    /// Rows there should be; `None` if that is not known.
    rows: Option<u64>,
    /// Position among the selected points that the next row may be of.
    next: u64,
    seen: u64,
    /// Whether no point may be left out.
    is_dense: bool,
}

impl RowCheck {
    /// For the rows of `plan`, of which there should be `rows`, if that is known.
    pub fn new(plan: &Plan, rows: Option<u64>) -> RowCheck {
        RowCheck::of(plan, plan.selection.clone(), rows)
    }

    /// For other points of `plan` than those it selects.
    pub fn of(plan: &Plan, selection: Selection, rows: Option<u64>) -> RowCheck {
        let columns = Layout::of(plan).columns();
        let status = columns.iter().position(|column| column.name == "status").unwrap_or(0);
        RowCheck {
            columns,
            status,
            selection,
            points: plan.len(),
            rows,
            next: 0,
            seen: 0,
            is_dense: plan.conditions.is_empty(),
        }
    }

    /// From now on lets points be missing: of a reader that leaves out what it cannot read.
    pub fn allow_gaps(&mut self) {
        self.is_dense = false;
        self.rows = None;
    }

    /// The point of the next row.
    ///
    /// # Errors
    /// Why it is not the next row of the plan, in words.
    pub fn row(&mut self, row: &StringRecord) -> Result<u64, String> {
        let number = self.seen + 1;
        if row.len() != self.columns.len() {
            return Err(format!("row {number} has {} cells, not {}", row.len(), self.columns.len()));
        }
        for (column, cell) in self.columns.iter().zip(row) {
            if !cell.is_empty() && !is_of_kind(cell, column.kind) {
                return Err(format!("row {number}: `{cell}` does not belong into column {}", column.name));
            }
        }
        let status = row.get(self.status).unwrap_or_default();
        if !Status::ALL.iter().any(|known| known.name() == status) {
            return Err(format!("row {number}: there is no status `{status}`"));
        }
        let cell = row.get(0).unwrap_or_default();
        let place = cell.parse().ok().and_then(|point| Some((point, self.position(point)?)));
        let Some((point, position)) = place else {
            return Err(format!(
                "row {number} is of point `{cell}`, which is none of the points that were run"
            ));
        };
        if position < self.next {
            return Err(format!("row {number} is of point {point}: it comes twice or out of order"));
        }
        if self.is_dense && position > self.next {
            let missing = self.selection.index(self.next);
            return Err(format!("row {number} is of point {point}: the row of point {missing} is missing"));
        }
        self.next = position + 1;
        self.seen += 1;
        Ok(point)
    }

    /// Checks that no row is missing at the end.
    ///
    /// # Errors
    /// How many there are, in words.
    pub fn end(&self) -> Result<(), String> {
        match self.rows {
            Some(rows) if rows != self.seen => {
                Err(format!("it holds {} rows, {rows} were written", self.seen))
            }
            _ => Ok(()),
        }
    }

    /// The position of a point among those selected.
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

fn is_of_kind(cell: &str, kind: Kind) -> bool {
    match kind {
        Kind::Whole => cell.parse::<u64>().is_ok(),
        Kind::Number => cell.parse::<f64>().is_ok(),
        Kind::Flag => cell.parse::<bool>().is_ok(),
        Kind::Text => true,
    }
}
