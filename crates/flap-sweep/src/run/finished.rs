//! What becomes of a point in a sweep.

use flap_core::simulate::Row;
use serde::{Deserialize, Serialize};

use super::parcel::RowFields;

/// What became of a point.
#[derive(Debug, Serialize, Deserialize)]
pub(super) enum Finished {
    /// It has a row.
    Row(#[serde(with = "RowFields")] Row),
    /// It does not satisfy the conditions with these numbers, and has no row.
    Excluded(Vec<usize>),
}
