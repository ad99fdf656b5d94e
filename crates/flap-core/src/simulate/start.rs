//! Initial values of runs: at rest or at a given state.

use super::request::cannot_begin;
use super::settings::SolverSettings;
use crate::body::BodyParameters;
use crate::model::Model;
use crate::ode::Start;
use crate::parameter::Invalid;

/// Returns the start of a point, at rest or at `state`.
///
/// If the rows contain no loads and the body moves, the value "frozen" of the parameter `body_response` is an
/// error.
pub(super) fn start_at<M: Model<N>, const N: usize>(
    model: &M,
    solver: &SolverSettings,
    values: &[f64],
    state: Option<&[f64]>,
) -> Result<Start<M::Constants<f64>, N>, Invalid> {
    if !solver.loads {
        BodyParameters::check_single(M::DESCRIPTION.parameters, values)?;
    }
    let mut start = model.start(values)?;
    if let Some(state) = state {
        let is_finite = state.iter().all(|y| y.is_finite());
        let y = state.try_into().ok().filter(|_| is_finite);
        start.y = y.ok_or_else(|| cannot_begin(state, N))?;
    }
    Ok(start)
}
