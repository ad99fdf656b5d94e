//! Points of earlier results that are to be run again.

use flap_core::simulate::Status;

use crate::files::results::{Checked, Reader, RowCheck, RowsError};
use crate::plan::Plan;
use crate::plan::selection::MOST_LISTED;

/// The rows that are to be computed again.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Wanted {
    /// Rows with one of these statuses.
    pub statuses: Vec<Status>,
    /// Rows whose `error_estimate` exceeds this.
    pub accuracy: Option<f64>,
}

/// Points that cannot be listed.
#[derive(Debug, thiserror::Error)]
pub enum RerunError {
    /// The rows cannot be read, or are not those of the plan.
    #[error(transparent)]
    Rows(#[from] RowsError),
    /// Nothing tells which rows are inaccurate.
    #[error("the rows have no column `error_estimate`: their grid leaves it out of `columns` in [output]")]
    NoEstimate,
    /// There are more than [`MOST_LISTED`] of them.
    #[error("more than {MOST_LISTED} points would be run again: change the grid file instead")]
    TooMany,
}

impl Wanted {
    /// The kinds of rows in words: statuses, and `inaccurate`.
    pub fn words(&self) -> Vec<String> {
        let inaccurate = self.accuracy.map(|_| "inaccurate");
        self.statuses.iter().map(|status| status.name()).chain(inaccurate).map(str::to_owned).collect()
    }

    /// True if a row with these cells is wanted.
    fn includes(&self, status: Option<&str>, estimate: Option<&str>) -> bool {
        let estimate = estimate.and_then(|cell| cell.parse::<f64>().ok());
        self.statuses.iter().any(|wanted| status == Some(wanted.name()))
            || self.accuracy.is_some_and(|accuracy| estimate.is_some_and(|estimate| estimate > accuracy))
    }
}

/// The indices of the rows that are `wanted`, rising. The results are those of `plan`; `rows` is the number of rows that were
/// written, if it is known.
///
/// # Errors
/// - [`RerunError::Rows`] if the rows cannot be read, or are not those of the plan
/// - [`RerunError::NoEstimate`] if inaccurate rows are wanted, and the rows have no estimate of their error
/// - [`RerunError::TooMany`] if there are more than [`MOST_LISTED`] of them
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
