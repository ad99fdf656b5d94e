//! Points of earlier results that are to be run again.

use std::io;

use csv::StringRecord;
use flap_core::simulate::Status;

use crate::integrity::RowCheck;
use crate::layout::Layout;
use crate::plan::Plan;
use crate::results::Reader;
use crate::selection::MOST_LISTED;

/// The indices of the rows that have one of `statuses`, rising. The results are those of `plan`, of which there are `rows` if
/// that is known.
///
/// # Errors
/// What reading says, or that these are not results of the plan.
pub fn points(
    reader: &mut Reader,
    statuses: &[Status],
    plan: &Plan,
    rows: Option<u64>,
) -> io::Result<Vec<u64>> {
    let wrong = |message: String| io::Error::new(io::ErrorKind::InvalidData, message);
    let names = Layout::of(plan).names();
    if reader.names() != names {
        return Err(wrong("its columns are not those of the grid that its sidecar holds".to_owned()));
    }
    let status = names.iter().position(|name| name == "status").unwrap_or_default();
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
        if !statuses.iter().any(|wanted| row.get(status) == Some(wanted.name())) {
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
