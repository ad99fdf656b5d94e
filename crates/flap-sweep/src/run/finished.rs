//! What becomes of a point in a sweep.

use flap_core::simulate::Row;

/// What became of a point.
#[derive(Debug)]
pub(super) enum Finished {
    /// It has a row.
    Row(Row),
    /// It does not satisfy the conditions with these numbers, and has no row.
    Excluded(Vec<usize>),
}
