//! Points of earlier results that are to be run again.

use std::io;

use csv::StringRecord;
use flap_core::simulate::Status;

use crate::results::Reader;
use crate::selection::MOST_LISTED;

/// The indices of the rows that have one of `statuses`, rising.
///
/// # Errors
/// What reading says, or that these are not results of a grid with this many points.
pub fn points(reader: &mut Reader, statuses: &[Status], points: u64) -> io::Result<Vec<u64>> {
    let wrong = |message: String| io::Error::new(io::ErrorKind::InvalidData, message);
    let column = |name: &str| {
        let found = reader.names().iter().position(|column| column == name);
        found.ok_or_else(|| wrong(format!("there is no column {name}")))
    };
    let (point, status) = (column("point")?, column("status")?);
    let mut row = StringRecord::new();
    let mut list: Vec<u64> = Vec::new();
    while reader.next(&mut row)? {
        if !statuses.iter().any(|wanted| row.get(status) == Some(wanted.name())) {
            continue;
        }
        let index = row.get(point).and_then(|cell| cell.parse().ok());
        if list.len() as u64 == MOST_LISTED {
            return Err(wrong(format!(
                "more than {MOST_LISTED} points would be run again: change the grid file instead"
            )));
        }
        match index.filter(|&index| index < points && list.last().is_none_or(|&last| last < index)) {
            Some(index) => list.push(index),
            None => {
                return Err(wrong(format!("point {} is out of order", row.get(point).unwrap_or_default())));
            }
        }
    }
    Ok(list)
}
