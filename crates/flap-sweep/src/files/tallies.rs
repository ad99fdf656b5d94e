//! Counts of a summary in the form that sidecars and journals record.

use std::collections::BTreeMap;

use flap_core::simulate::Status;
use serde::{Deserialize, Serialize};

use crate::run::Counts;

/// A point whose parameters are impossible together.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct InvalidPoint {
    /// The point's index in the grid.
    pub point: u64,
    /// The reason, in words.
    pub reason: String,
}

impl From<&(u64, String)> for InvalidPoint {
    fn from((point, reason): &(u64, String)) -> InvalidPoint {
        InvalidPoint { point: *point, reason: reason.clone() }
    }
}

impl From<&InvalidPoint> for (u64, String) {
    fn from(invalid: &InvalidPoint) -> (u64, String) {
        (invalid.point, invalid.reason.clone())
    }
}

/// The counts by the names of their statuses.
pub(crate) fn by_name(counts: &Counts) -> BTreeMap<String, u64> {
    counts.iter().map(|(status, count)| (status.name().to_owned(), count)).collect()
}

/// The counts that [`by_name`] gives, summed over several runs. Names that are no status are ignored.
pub(crate) fn total<'a>(counts: impl IntoIterator<Item = &'a BTreeMap<String, u64>>) -> Counts {
    let known = |name: &str| Status::ALL.into_iter().find(|status| status.name() == name);
    counts.into_iter().flatten().filter_map(|(name, count)| Some((known(name)?, *count))).collect()
}
