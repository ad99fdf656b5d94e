//! A chunk contains the rows of consecutive points that another process has computed.
//!
//! On a cluster, each worker process computes the rows of one range of points with [`chunk`]. The process
//! that started the workers writes all rows in the order of the points. The bytes of the output are the same
//! as after a run on one machine.

use std::ops::Range;

use serde::{Deserialize, Serialize};

use super::identity::{self, Identity};
use super::points::{Outcome, rows_of};
use super::{Run, RunError, RunOptions};
use crate::plan::Plan;

/// The outcomes of consecutive points: rows, and conditions that excluded points.
#[derive(Debug, Serialize, Deserialize)]
pub struct Chunk {
    identity: Identity,
    /// Position of the chunk's first point in the list of the plan's selected points.
    begin: u64,
    outcomes: Vec<Outcome>,
}

/// Computes the points at the given `positions` in the list of the plan's selected points.
///
/// `stop` is called several times a second. If `stop` returns true, the computation ends early, and the last
/// points of the range are missing in the chunk.
///
/// # Errors
/// [`RunError`] if a worker thread panics or cannot be started, or if the model returns wrong rows.
pub fn chunk(
    plan: &Plan,
    options: &RunOptions,
    positions: Range<u64>,
    mut stop: impl FnMut(&Run<Outcome>) -> bool,
) -> Result<Chunk, RunError> {
    let begin = positions.start;
    let mut run = rows_of(plan, options, positions);
    let mut outcomes = Vec::new();
    while let Some(batch) = run.next_batch()? {
        outcomes.extend(batch);
        if stop(&run) {
            run.stop();
        }
    }
    Ok(Chunk { identity: Identity::of(plan, options), begin, outcomes })
}

impl Chunk {
    /// Returns the chunk with `begin` as the position of its first point. If the chunk was computed from a
    /// part of a plan, `begin` is the position of its first point in the whole plan.
    pub fn beginning_at(self, begin: u64) -> Chunk {
        Chunk { begin, ..self }
    }

    /// Returns the chunk as bytes, which a process with the same build of flap can read.
    ///
    /// The bytes begin with the hash of the build, because the format of the remaining bytes may differ
    /// between builds.
    ///
    /// # Errors
    /// [`RunError::Chunk`] if there is not enough memory.
    pub fn to_bytes(&self) -> Result<Vec<u8>, RunError> {
        let bytes = identity::build().as_bytes().to_vec();
        postcard::to_extend(self, bytes).map_err(|error| RunError::Chunk(error.to_string()))
    }

    /// Reads a chunk from bytes that [`Chunk::to_bytes`] has written.
    ///
    /// # Errors
    /// [`RunError::Chunk`] if the bytes are malformed, or if another build of flap has written the bytes.
    pub fn from_bytes(bytes: &[u8]) -> Result<Chunk, RunError> {
        let ours = identity::build();
        match bytes.split_at_checked(ours.len()) {
            Some((build, chunk)) if build == ours.as_bytes() => {
                postcard::from_bytes(chunk).map_err(|error| RunError::Chunk(error.to_string()))
            }
            _ => Err(RunError::Chunk(format!(
                "they come from another build of flap than this one ({ours}): install the same build on every worker"
            ))),
        }
    }

    /// Returns the outcomes of the points in the chunk. The chunk must be computed from `plan`, and the first
    /// point of the chunk must have the position `next`.
    ///
    /// # Errors
    /// [`RunError::Chunk`] if the chunk is empty, or its points do not begin at `next`. The error also occurs
    /// if the chunk was computed with another plan, another build of flap, or another floating-point arithmetic
    /// than `options` selects.
    pub fn outcomes(self, plan: &Plan, options: &RunOptions, next: u64) -> Result<Vec<Outcome>, RunError> {
        let differences = Identity::of(plan, options).differences(&self.identity);
        if !differences.is_empty() {
            return Err(RunError::Chunk(differences.join("; ")));
        }
        let begin = self.begin;
        let end = begin.saturating_add(self.outcomes.len() as u64);
        if begin != next || self.outcomes.is_empty() || end > plan.selected() {
            return Err(RunError::Chunk(format!(
                "points {begin} to {end} arrived, but point {next} was expected next"
            )));
        }
        let is_condition = |condition: &usize| *condition < plan.conditions().len();
        let excluded = self.outcomes.iter().filter_map(|outcome| match outcome {
            Outcome::Excluded(unsatisfied) => Some(unsatisfied),
            Outcome::Ran(_) => None,
        });
        if !excluded.flatten().all(is_condition) {
            return Err(RunError::Chunk("they refer to conditions that the plan does not have".to_owned()));
        }
        Ok(self.outcomes)
    }
}
