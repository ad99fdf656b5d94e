//! The outcome of a point in a sweep.

use flap_core::simulate::{Row, Status};
use serde::{Deserialize, Serialize};

/// The outcome of a point.
#[derive(Debug, Serialize, Deserialize)]
pub(super) enum Finished {
    /// The point has a row.
    Row(#[serde(with = "RowFields")] Row),
    /// The point does not satisfy the conditions with these numbers, and has no row.
    Excluded(Vec<usize>),
}

/// The fields of a [`Row`], for serialization.
#[derive(Serialize, Deserialize)]
#[serde(remote = "Row")]
struct RowFields {
    #[serde(with = "status")]
    status: Status,
    measures: Vec<f64>,
    cycles: u32,
    residual: f64,
    period: u32,
    floquet_max: f64,
    error_estimate: f64,
    state: Vec<f64>,
    rhs_evals: u64,
    reason: Option<String>,
}

/// A status as its place among all.
mod status {
    use flap_core::simulate::Status;
    use serde::de::Error;
    use serde::{Deserialize, Deserializer, Serializer};

    #[expect(clippy::trivially_copy_pass_by_ref, reason = "serde calls it so")]
    pub(super) fn serialize<S: Serializer>(status: &Status, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_u8(*status as u8)
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Status, D::Error> {
        let place = usize::from(u8::deserialize(deserializer)?);
        Status::ALL.get(place).copied().ok_or_else(|| D::Error::custom("there is no such status"))
    }
}
