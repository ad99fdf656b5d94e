//! Initial values of runs: at rest or at a given state.

use super::request::{RequestError, Unfinished};
use crate::model::Model;
use crate::ode::Start;

/// Returns the start of a point, at rest or at `state`.
pub(super) fn start_at<M: Model<N>, const N: usize>(
    model: &M,
    values: &[f64],
    state: Option<&[f64]>,
) -> Result<Start<M::Constants<f64>, N>, Unfinished> {
    let mut start = model.start(values)?;
    if let Some(state) = state {
        let is_finite = state.iter().all(|y| y.is_finite());
        let y = state.try_into().ok().filter(|_| is_finite);
        start.y = y.ok_or_else(|| RequestError::Begin { begin: state.to_vec(), states: N })?;
    }
    Ok(start)
}
