//! A chunk: the rows of a range of points, computed by another process.
//!
//! A cluster passes ranges of a plan to its workers. Each worker computes the rows of a range with [`chunk`]. The
//! requesting process writes the rows in order, with the same bytes as a run on one machine.

use std::ops::Range;

use serde::{Deserialize, Serialize};

use super::identity::{self, Identity};
use super::points::{Outcome, rows_of};
use super::{Run, RunError, RunOptions};
use crate::plan::Plan;

/// Outcomes of the points of a range.
#[derive(Debug, Serialize, Deserialize)]
pub struct Chunk {
    identity: Identity,
    /// Position of the first point among the selected points.
    begin: u64,
    outcomes: Vec<Outcome>,
}

/// Runs the points at the given `positions` among the selected points.
///
/// `stop` is called several times a second. After `stop` returns true, the chunk contains only the first points.
///
/// # Errors
/// [`RunError`] if a worker fails.
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
    /// Returns the chunk as a part of a larger plan. The points of the chunk begin at position `begin` of the larger plan.
    pub fn beginning_at(self, begin: u64) -> Chunk {
        Chunk { begin, ..self }
    }

    /// Returns the chunk as bytes, for a process with the same build of flap.
    ///
    /// The name of the build comes first, because another build may use another format for the rest.
    ///
    /// # Errors
    /// [`RunError::Chunk`] if there is not enough memory.
    pub fn to_bytes(&self) -> Result<Vec<u8>, RunError> {
        let bytes = identity::build().as_bytes().to_vec();
        postcard::to_extend(self, bytes).map_err(|error| RunError::Chunk(error.to_string()))
    }

    /// Parses the bytes of [`Chunk::to_bytes`].
    ///
    /// # Errors
    /// [`RunError::Chunk`] if the bytes are malformed or belong to another build of flap.
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

    /// Returns the outcomes of the points of the chunk. The points of the chunk must be points of `plan` beginning at
    /// position `next`.
    ///
    /// # Errors
    /// [`RunError::Chunk`] if the chunk contains other points.
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
