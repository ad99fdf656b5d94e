//! Rows on their way from one process to another.
//!
//! A cluster's engine hands stretches of a plan to its workers. Each computes its rows with [`part`], and the process that
//! asked for them puts them in order with [`feed`]. The bytes are those that [`resume`](super::resume) writes on one
//! machine.

use std::ops::Range;
use std::sync::atomic::AtomicBool;

use serde::{Deserialize, Serialize};

use super::error::RunError;
use super::finished::Finished;
use super::identity::{self, Identity};
use super::ledger::Ledger;
use super::options::RunOptions;
use super::points::{PointLedger, work};
use super::progress::Progress;
use super::sink::Sink;
use super::summary::Summary;
use crate::plan::Plan;

/// The outcomes of the points of a stretch.
#[derive(Debug, Serialize, Deserialize)]
pub struct Parcel {
    identity: Identity,
    /// Position of the first point among those selected.
    begin: u64,
    finished: Vec<Finished>,
}

impl Parcel {
    /// The parcel as bytes, for a process of the same build of flap. The name of the build comes first, since another build
    /// may write the rest in another way.
    ///
    /// # Errors
    /// [`RunError::Parcel`] if there is not enough memory for them.
    pub fn to_bytes(&self) -> Result<Vec<u8>, RunError> {
        let bytes = identity::build().as_bytes().to_vec();
        postcard::to_extend(self, bytes).map_err(|error| RunError::Parcel(error.to_string()))
    }

    /// Reads the bytes of [`Parcel::to_bytes`].
    ///
    /// # Errors
    /// [`RunError::Parcel`] if these are other bytes, or those of another build of flap.
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

    /// The number of its points.
    pub fn len(&self) -> u64 {
        self.finished.len() as u64
    }

    /// True if it has no points.
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
/// [`RunError::Sink`] if rows cannot be written, [`RunError::Parcel`] if a parcel is not of this plan or not the next one,
/// and any error of `next`.
pub fn feed(
    plan: &Plan,
    options: &RunOptions,
    before: Summary,
    sink: &mut dyn Sink,
    next: &mut dyn FnMut(u64) -> Result<Option<Parcel>, RunError>,
) -> Result<Summary, RunError> {
    let identity = Identity::of(plan, options);
    let mut ledger = PointLedger::begin(plan, before, sink)?;
    let fed = take_all(plan, &identity, &mut ledger, next);
    ledger.ledger.end(fed)
}

/// Takes parcels until all points are done or no more are to come.
fn take_all(
    plan: &Plan,
    identity: &Identity,
    points: &mut PointLedger<'_>,
    next: &mut dyn FnMut(u64) -> Result<Option<Parcel>, RunError>,
) -> Result<(), RunError> {
    while !points.ledger.remaining().is_empty() {
        let Some(parcel) = next(points.ledger.done())? else { break };
        check(&parcel, identity, &points.ledger, plan)?;
        points.take(parcel.finished)?;
    }
    Ok(())
}

/// Checks that a parcel is of this plan, and begins where the ledger is.
fn check(parcel: &Parcel, identity: &Identity, ledger: &Ledger<'_>, plan: &Plan) -> Result<(), RunError> {
    let differences = identity.differences(&parcel.identity);
    if !differences.is_empty() {
        return Err(RunError::Parcel(differences.join("; ")));
    }
    let (begin, done) = (parcel.begin, ledger.done());
    let end = begin.saturating_add(parcel.len());
    if begin != done || parcel.is_empty() || end > ledger.units() {
        return Err(RunError::Parcel(format!(
            "points {begin} to {end} came, but point {done} was expected next"
        )));
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
