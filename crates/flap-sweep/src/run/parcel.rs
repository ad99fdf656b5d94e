//! Rows on their way from one process to another.
//!
//! A cluster's engine hands stretches of a plan to its workers; each computes its rows with [`part`], and whoever has
//! asked puts them in order with [`feed`]. What is written is what [`resume`](super::resume) writes on one machine.

use std::ops::Range;
use std::sync::atomic::AtomicBool;

use flap_core::simulate::{Row, Status};
use serde::{Deserialize, Serialize};

use super::finished::Finished;
use super::ledger::Ledger;
use super::{Progress, RunError, RunOptions, Summary, work};
use crate::plan::Plan;
use crate::run::identity::{self, Identity};
use crate::run::sink::Sink;

/// What became of the points of a stretch.
#[derive(Debug, Serialize, Deserialize)]
pub struct Parcel {
    identity: Identity,
    /// Position of the first point among those selected.
    begin: u64,
    finished: Vec<Finished>,
}

/// The fields of a [`Row`], for serialization.
#[derive(Serialize, Deserialize)]
#[serde(remote = "Row")]
pub(super) struct RowFields {
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

    #[expect(clippy::trivially_copy_pass_by_ref, reason = "what serde calls")]
    pub(super) fn serialize<S: Serializer>(status: &Status, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_u8(*status as u8)
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Status, D::Error> {
        let place = usize::from(u8::deserialize(deserializer)?);
        Status::ALL.get(place).copied().ok_or_else(|| D::Error::custom("there is no such status"))
    }
}

impl Parcel {
    /// The parcel as bytes, for a process of the same build of flap: its name comes first, since another build may write
    /// what follows in another way.
    ///
    /// # Errors
    /// If there is not enough memory for them.
    pub fn to_bytes(&self) -> Result<Vec<u8>, RunError> {
        let bytes = identity::build().as_bytes().to_vec();
        postcard::to_extend(self, bytes).map_err(|error| RunError::Parcel(error.to_string()))
    }

    /// Reads what [`Parcel::to_bytes`] gave.
    ///
    /// # Errors
    /// If these are other bytes, or those of another build of flap.
    pub fn from_bytes(bytes: &[u8]) -> Result<Parcel, RunError> {
        let ours = identity::build();
        match bytes.split_at_checked(ours.len()) {
            Some((build, parcel)) if build == ours.as_bytes() => {
                postcard::from_bytes(parcel).map_err(|error| RunError::Parcel(error.to_string()))
            }
            _ => Err(RunError::Parcel(format!(
                "they are by another build of flap than this one ({ours}): install the same one on every worker"
            ))),
        }
    }

    /// How many points it is of.
    pub fn len(&self) -> u64 {
        self.finished.len() as u64
    }

    /// Whether it is of no points.
    pub fn is_empty(&self) -> bool {
        self.finished.is_empty()
    }
}

/// Runs the points at these `positions` among the selected ones. Fewer of them, the first ones, if `stop` is raised.
///
/// # Errors
/// [`RunError`] if a worker fails.
pub fn part(
    plan: &Plan,
    options: &RunOptions,
    positions: Range<u64>,
    stop: &AtomicBool,
    progress: &mut dyn FnMut(Progress),
) -> Result<Parcel, RunError> {
    let begin = positions.start;
    let mut finished = Vec::new();
    let mut take = |batch: &mut Vec<Finished>| {
        finished.append(batch);
        Ok(())
    };
    work(plan, options, positions, stop, &mut take, progress)?;
    Ok(Parcel { identity: Identity::of(plan, options), begin, finished })
}

/// Writes the rows of parcels, which `next` gives in the order of the points, after those that `before` counts. `next` is
/// told how many points are done, and gives `None` if no more is to come.
///
/// # Errors
/// [`RunError`] if rows cannot be written, a parcel is not of this plan or not the next one, and what `next` says.
pub fn feed(
    plan: &Plan,
    options: &RunOptions,
    before: Summary,
    sink: &mut dyn Sink,
    next: &mut dyn FnMut(u64) -> Result<Option<Parcel>, RunError>,
) -> Result<Summary, RunError> {
    let identity = Identity::of(plan, options);
    let mut ledger = Ledger::begin(plan, before, sink).map_err(RunError::Sink)?;
    let mut fed = Ok(());
    while ledger.done() < ledger.points() {
        match next(ledger.done()) {
            Ok(Some(parcel)) => {
                fed = check(&parcel, &identity, &ledger, plan);
                if fed.is_err() {
                    break;
                }
                ledger.take(parcel.finished).map_err(RunError::Sink)?;
            }
            Ok(None) => break,
            Err(error) => {
                fed = Err(error);
                break;
            }
        }
    }
    let summary = ledger.finish().map_err(RunError::Sink)?;
    fed.map(|()| summary)
}

/// Checks that a parcel is of this plan, and goes on where the ledger is.
fn check(parcel: &Parcel, identity: &Identity, ledger: &Ledger<'_>, plan: &Plan) -> Result<(), RunError> {
    let differences = identity.differences(&parcel.identity);
    if !differences.is_empty() {
        return Err(RunError::Parcel(differences.join("; ")));
    }
    let (begin, done) = (parcel.begin, ledger.done());
    let end = begin.saturating_add(parcel.len());
    if begin != done || parcel.is_empty() || end > ledger.points() {
        return Err(RunError::Parcel(format!("points {begin} to {end} came where {done} was next")));
    }
    let is_condition = |condition: &usize| *condition < plan.conditions().len();
    let excluded = parcel.finished.iter().filter_map(|finished| match finished {
        Finished::Excluded(unsatisfied) => Some(unsatisfied),
        Finished::Row(_) => None,
    });
    if !excluded.flatten().all(is_condition) {
        return Err(RunError::Parcel("there are no such conditions".to_owned()));
    }
    Ok(())
}
