//! The lines of a journal.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::files::results::FileSum;
use crate::files::tallies::{self, InvalidPoint};
use crate::run::identity::Identity;
use crate::run::{Doubts, Summary};

/// Version of the format.
const FORMAT: u32 = 1;

/// The first line.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Header {
    format: u32,
    /// Start of the first session, as RFC 3339 in UTC.
    pub started: String,
    /// The identity of the run's rows.
    pub identity: Identity,
    /// True if earlier results are kept until these are complete.
    #[serde(default)]
    pub replaces: bool,
}

impl Header {
    /// The first line of a run that starts now.
    pub fn new(started: String, identity: Identity) -> Header {
        Header { format: FORMAT, started, identity, replaces: false }
    }

    /// True if this version of flap reads the journal.
    pub(super) fn is_known(&self) -> bool {
        self.format == FORMAT
    }
}

/// A place at which a run can be resumed: every line but the first.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Checkpoint {
    /// Number of rows written.
    pub rows: u64,
    /// Number of points all of whose rows are written; `None` in journals of early versions, which wrote one row per point.
    ran: Option<u64>,
    /// Number of rows written of the point after those that are done with.
    #[serde(default)]
    begun: u64,
    /// Number of points that conditions exclude.
    excluded: u64,
    /// Bytes of the file that holds the rows.
    pub bytes: u64,
    /// XXH3 of these bytes, in hexadecimal digits.
    pub xxh3: String,
    /// Running time of all sessions (s).
    pub seconds: f64,
    cycles: u64,
    rhs_evals: u64,
    statuses: BTreeMap<String, u64>,
    unsatisfied: BTreeMap<String, u64>,
    #[serde(default)]
    doubts: Doubts,
    invalid: Vec<InvalidPoint>,
}

impl Checkpoint {
    /// The checkpoint behind the rows that `summary` counts, in a `file` of these bytes, after `seconds` of running.
    pub fn new(summary: &Summary, file: FileSum, seconds: f64) -> Checkpoint {
        let mut statuses = tallies::by_name(&summary.counts);
        statuses.retain(|_, count| *count > 0);
        // A checkpoint is one line, and so are reasons.
        let invalid = summary
            .invalid
            .iter()
            .map(|(point, reason)| InvalidPoint { point: *point, reason: reason.replace(['\n', '\r'], " ") });
        Checkpoint {
            rows: summary.rows,
            ran: Some(summary.ran),
            begun: summary.begun,
            excluded: summary.excluded,
            bytes: file.bytes,
            xxh3: file.xxh3,
            seconds,
            cycles: summary.cycles,
            rhs_evals: summary.rhs_evals,
            statuses,
            unsatisfied: summary.unsatisfied.iter().cloned().collect(),
            doubts: summary.doubts,
            invalid: invalid.collect(),
        }
    }

    /// The summary of the rows up to here. Its number of points is 0: the plan tells that.
    pub fn summary(&self) -> Summary {
        Summary {
            points: 0,
            ran: self.ran.unwrap_or(self.rows),
            begun: self.begun,
            rows: self.rows,
            excluded: self.excluded,
            unsatisfied: self.unsatisfied.clone().into_iter().collect(),
            interrupted: false,
            counts: tallies::total([&self.statuses]),
            rhs_evals: self.rhs_evals,
            cycles: self.cycles,
            doubts: self.doubts,
            invalid: self.invalid.iter().map(From::from).collect(),
        }
    }
}
