//! Points of earlier results that are to be run again.

use std::io;

use csv::StringRecord;
use flap_core::simulate::Status;

use crate::files::integrity::RowCheck;
use crate::files::results::Reader;
use crate::plan::Plan;
use crate::plan::selection::MOST_LISTED;
use crate::table::layout::Layout;

/// Which rows are to be computed again.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Wanted {
    /// Those with one of these statuses.
    pub statuses: Vec<Status>,
    /// Those whose `error_estimate` exceeds this.
    pub accuracy: Option<f64>,
}

impl Wanted {
    /// The kinds of rows in words: statuses, and `inaccurate`.
    pub fn words(&self) -> Vec<String> {
        let inaccurate = self.accuracy.map(|_| "inaccurate");
        self.statuses.iter().map(|status| status.name()).chain(inaccurate).map(str::to_owned).collect()
    }

    /// Whether a row with this status and error estimate is wanted, each as its cell's text.
    fn includes(&self, status: Option<&str>, estimate: Option<&str>) -> bool {
        let estimate = estimate.and_then(|cell| cell.parse::<f64>().ok());
        self.statuses.iter().any(|wanted| status == Some(wanted.name()))
            || self.accuracy.is_some_and(|accuracy| estimate.is_some_and(|estimate| estimate > accuracy))
    }
}

/// The indices of the rows that are `wanted`, rising. The results are those of `plan`, of which there are `rows` if that is
/// known.
///
/// # Errors
/// What reading says, or that these are not results of the plan.
pub fn points(reader: &mut Reader, wanted: &Wanted, plan: &Plan, rows: Option<u64>) -> io::Result<Vec<u64>> {
    let wrong = |message: String| io::Error::new(io::ErrorKind::InvalidData, message);
    let names = Layout::of(plan).names();
    if reader.names() != names {
        return Err(wrong("its columns are not those of the grid that its sidecar holds".to_owned()));
    }
    let column = |wanted: &str| names.iter().position(|name| name == wanted).unwrap_or_default();
    let (status, estimate) = (column("status"), column("error_estimate"));
    let mut check = RowCheck::new(plan, rows);
    if reader.is_tolerant() {
        check.allow_gaps();
    }
    let mut row = StringRecord::new();
    let mut list: Vec<u64> = Vec::new();
    while reader.next(&mut row)? {
        let point = match check.row(&row) {
            Ok(point) => point,
            Err(_) if reader.leave_out() => continue,
            Err(reason) => return Err(wrong(reason)),
        };
        if !wanted.includes(row.get(status), row.get(estimate)) {
            continue;
        }
        if list.len() as u64 == MOST_LISTED {
            return Err(wrong(format!(
                "more than {MOST_LISTED} points would be run again: change the grid file instead"
            )));
        }
        list.push(point);
    }
    check.end().map_err(wrong)?;
    Ok(list)
}
