//! The motion of one point over time, sampled.

use super::begin::begin;
use super::error::Unfinished;
use super::request::{Trajectory, TrajectoryRequest};
use super::sampler::sampled;
use super::settle::{Settled, settle};
use super::single::{PointRun, Question};
use super::status::Status;
use crate::model::Model;
use crate::num::Scalar;

/// The motion of a point that begins in this state, or at rest.
pub(super) struct TrajectoryFrom<'a> {
    pub(super) begin: Option<&'a [f64]>,
    pub(super) request: &'a TrajectoryRequest,
}

impl<M: Model<N, S>, const N: usize, const K: usize, const S: usize> Question<M, N, K, S>
    for TrajectoryFrom<'_>
{
    type Answer = Result<Trajectory, Unfinished>;

    fn answer<R: Scalar>(self, model: &M, run: &PointRun<'_>) -> Result<Trajectory, Unfinished> {
        let PointRun { solver, values, interrupted, .. } = *run;
        let TrajectoryRequest { cycles, samples_per_cycle, settled } = *self.request;
        let mut start = begin(model, values, self.begin)?;
        if settled {
            let nearby = self.begin.is_some();
            let Settled { search, row } = settle::<M, R, N, K, S>(model, solver, &start, nearby, interrupted);
            if interrupted() {
                return Err(Unfinished::Interrupted);
            }
            // The row's state, not the search's: a search for a more exact orbit may have failed after it.
            let orbit = <[f64; N]>::try_from(row.state.as_slice()).ok();
            let Some(orbit) = orbit.filter(|_| row.status == Status::Periodic) else {
                return Err(Unfinished::NotPeriodic { status: row.status, cycles: row.cycles });
            };
            start = search.from(&start, &orbit);
        }
        sampled::<M, R, N, S>(model, solver, &start, cycles, samples_per_cycle, interrupted)
    }
}
