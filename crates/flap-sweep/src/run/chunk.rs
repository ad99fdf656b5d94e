//! Rows that another process computes.
//!
//! A cluster hands stretches of a plan to its workers. Each computes its rows with [`chunk`], and the process that
//! asked for them writes them in order. The bytes are those of a run on one machine.

use std::ops::Range;

use serde::{Deserialize, Serialize};

use super::identity::{self, Identity};
use super::points::{Outcome, rows_of};
use super::{Run, RunError, RunOptions};
use crate::plan::Plan;

/// The outcomes of the points of a stretch.
#[derive(Debug, Serialize, Deserialize)]
pub struct Chunk {
    identity: Identity,
    /// Position of the first point among those selected.
    begin: u64,
    outcomes: Vec<Outcome>,
}

/// Runs the points at these `positions` among the selected ones. `stop` is called several times a second: if it gives true,
/// the chunk has fewer points, the first ones.
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
    /// The chunk as bytes, for a process of the same build of flap. The name of the build comes first, since another build
    /// may write the rest in another way.
    ///
    /// # Errors
    /// [`RunError::Chunk`] if there is not enough memory for them.
    pub fn to_bytes(&self) -> Result<Vec<u8>, RunError> {
        let bytes = identity::build().as_bytes().to_vec();
        postcard::to_extend(self, bytes).map_err(|error| RunError::Chunk(error.to_string()))
    }

    /// Reads the bytes of [`Chunk::to_bytes`].
    ///
    /// # Errors
    /// [`RunError::Chunk`] if these are other bytes, or those of another build of flap.
    pub fn from_bytes(bytes: &[u8]) -> Result<Chunk, RunError> {
        let ours = identity::build();
        match bytes.split_at_checked(ours.len()) {
            Some((build, chunk)) if build == ours.as_bytes() => {
                postcard::from_bytes(chunk).map_err(|error| RunError::Chunk(error.to_string()))
            }
            _ => Err(RunError::Chunk(format!(
                "they are by another build of flap than this one ({ours}): install the same one on every worker"
            ))),
        }
    }

    /// The outcomes of its points, which must be points of `plan` from the one at position `next` on.
    ///
    /// # Errors
    /// [`RunError::Chunk`] if they are not.
    pub fn outcomes(self, plan: &Plan, options: &RunOptions, next: u64) -> Result<Vec<Outcome>, RunError> {
        let differences = Identity::of(plan, options).differences(&self.identity);
        if !differences.is_empty() {
            return Err(RunError::Chunk(differences.join("; ")));
        }
        let begin = self.begin;
        let end = begin.saturating_add(self.outcomes.len() as u64);
        if begin != next || self.outcomes.is_empty() || end > plan.selected() {
            return Err(RunError::Chunk(format!(
                "points {begin} to {end} came, but point {next} was expected next"
            )));
        }
        let is_condition = |condition: &usize| *condition < plan.conditions().len();
        let excluded = self.outcomes.iter().filter_map(|outcome| match outcome {
            Outcome::Excluded(unsatisfied) => Some(unsatisfied),
            Outcome::Ran(_) => None,
        });
        if !excluded.flatten().all(is_condition) {
            return Err(RunError::Chunk("there are no such conditions".to_owned()));
        }
        Ok(self.outcomes)
    }
}
