//! Selects the points of earlier results that are computed again.

use flap_core::simulate::Status;

use crate::files::results::{Checked, Reader, RowCheck, RowsError};
use crate::plan::Plan;
use crate::plan::selection::MOST_LISTED;

/// Criteria that select the rows to compute again.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Wanted {
    /// Selects rows with one of these statuses.
    pub statuses: Vec<Status>,
    /// Selects rows with an `error_estimate` above this value.
    pub accuracy: Option<f64>,
}

/// Reason why no points can be selected for a rerun.
#[derive(Debug, thiserror::Error)]
pub enum RerunError {
    /// The rows cannot be read, or are not the rows of the plan.
    #[error(transparent)]
    Rows(#[from] RowsError),
    /// The rows have no column `error_estimate`.
    #[error("the rows have no column `error_estimate`: their grid leaves it out of `columns` in [output]")]
    NoEstimate,
    /// More than [`MOST_LISTED`] points are selected.
    #[error("more than {MOST_LISTED} points would be run again: change the grid file instead")]
    TooMany,
}

impl Wanted {
    /// Returns words for the selected kinds of rows: the names of statuses, and `inaccurate` for rows with a
    /// large `error_estimate`.
    pub fn words(&self) -> Vec<String> {
        let inaccurate = self.accuracy.map(|_| "inaccurate");
        self.statuses.iter().map(|status| status.name()).chain(inaccurate).map(str::to_owned).collect()
    }

    /// Returns true if the criteria select a row with the status `status` and the error estimate
    /// `estimate`.
    fn includes(&self, status: Option<&str>, estimate: Option<&str>) -> bool {
        let estimate = estimate.and_then(|cell| cell.parse::<f64>().ok());
        self.statuses.iter().any(|wanted| status == Some(wanted.name()))
            || self.accuracy.is_some_and(|accuracy| estimate.is_some_and(|estimate| estimate > accuracy))
    }
}

/// Returns the indices of the points whose rows meet the criteria `wanted`, in ascending order.
///
/// The rows must be the rows of `plan`. `rows` is the number of rows that flap wrote, if known.
///
/// # Errors
/// - [`RerunError::Rows`] if the rows cannot be read, or are not the rows of the plan.
/// - [`RerunError::NoEstimate`] if `wanted` selects inaccurate rows, but the rows have no column
///   `error_estimate`.
/// - [`RerunError::TooMany`] if more than [`MOST_LISTED`] points are selected.
pub fn points(
    reader: &mut Reader,
    wanted: &Wanted,
    plan: &Plan,
    rows: Option<u64>,
) -> Result<Vec<u64>, RerunError> {
    let column = |wanted: &str| reader.names().iter().position(|name| name == wanted);
    let (status, estimate) = (column("status"), column("error_estimate"));
    if wanted.accuracy.is_some() && estimate.is_none() {
        return Err(RerunError::NoEstimate);
    }
    let mut checked = Checked::new(reader, RowCheck::new(plan, rows))?;
    let mut list: Vec<u64> = Vec::new();
    while let Some(point) = checked.next()? {
        let cell = |column: Option<usize>| column.and_then(|column| checked.row().get(column));
        if !wanted.includes(cell(status), cell(estimate)) {
            continue;
        }
        if list.len() as u64 == MOST_LISTED {
            return Err(RerunError::TooMany);
        }
        list.push(point);
    }
    Ok(list)
}
