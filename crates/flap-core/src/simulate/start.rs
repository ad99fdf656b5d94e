//! Initial values of runs: at rest or at a given state.

use super::request::{RequestError, Unfinished};
use super::settings::SolverSettings;
use crate::body::BodyParameters;
use crate::model::Model;
use crate::ode::Start;

/// Returns the start of a point, at rest or at `state`.
///
/// If rows contain no loads, the motion of the body must not be in the loads alone.
pub(super) fn start_at<M: Model<N>, const N: usize>(
    model: &M,
    solver: &SolverSettings,
    values: &[f64],
    state: Option<&[f64]>,
) -> Result<Start<M::Constants<f64>, N>, Unfinished> {
    if !solver.loads {
        BodyParameters::check_single(M::DESCRIPTION.parameters, values)?;
    }
    let mut start = model.start(values)?;
    if let Some(state) = state {
        let is_finite = state.iter().all(|y| y.is_finite());
        let y = state.try_into().ok().filter(|_| is_finite);
        start.y = y.ok_or_else(|| RequestError::Begin { begin: state.to_vec(), states: N })?;
    }
    Ok(start)
}
