//! Initial values of runs: at rest or at a given state, with or without responses to changes.

use super::error::{RequestError, Unfinished};
use crate::model::Model;
use crate::ode::Start;
use crate::ode::variation::initial;

/// The run of a point, from rest or from the state `begin`.
pub(super) fn begin<M: Model<N, S>, const N: usize, const S: usize>(
    model: &M,
    values: &[f64],
    begin: Option<&[f64]>,
) -> Result<Start<M::Constants<f64>, N>, Unfinished> {
    let mut start = model.start(values)?;
    if let Some(begin) = begin {
        let finite = begin.iter().all(|y| y.is_finite());
        let state = begin.try_into().ok().filter(|_| finite);
        start.y = state.ok_or_else(|| RequestError::Begin { begin: begin.to_vec(), states: N })?;
    }
    Ok(start)
}

/// The run `start` with its responses to changes of the initial state, each of the size `change`.
pub(super) fn varied<C: Copy, const N: usize, const K: usize>(
    start: &Start<C, N>,
    change: &[f64; N],
) -> Start<C, K> {
    // Step sizes depend on the states alone; the responses' scales are never used.
    let mut scale = [1.0; K];
    scale[..N].copy_from_slice(&start.scale);
    Start {
        constants: start.constants,
        y: initial(&start.y, change),
        span: start.span,
        scale,
        tighten: start.tighten,
    }
}
