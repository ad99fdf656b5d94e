//! The summary of a results file.

use serde::Serialize;

use super::best::Best;
use super::spread::Spread;
use super::words::Words;

/// The summary of a results file.
#[derive(Serialize)]
pub(super) struct Description {
    pub(super) rows: usize,
    pub(super) statuses: Vec<Count>,
    pub(super) columns: Vec<Spread>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) words: Vec<Words>,
    pub(super) best: Vec<Best>,
}

/// A status, and the number of rows with this status.
#[derive(Serialize)]
pub(super) struct Count {
    pub(super) status: String,
    pub(super) rows: usize,
}
