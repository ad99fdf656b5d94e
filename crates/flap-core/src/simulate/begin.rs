//! Initial values of runs: at rest or at a given state.

use super::request::{RequestError, Unfinished};
use crate::model::Model;
use crate::ode::Start;

/// Returns the start of a point, at rest or at the state `begin`.
pub(super) fn begin<M: Model<N>, const N: usize>(
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
