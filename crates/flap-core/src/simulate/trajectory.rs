//! The motion of one point over time, sampled.

use super::begin::begin;
use super::error::Unfinished;
use super::lanes::run_alone;
use super::request::{Trajectory, TrajectoryRequest};
use super::row::Status;
use super::sampler::sampled;
use super::search::{Settled, settle};
use super::single::{PointRun, Question};
use crate::model::Model;
use crate::num::Scalar;

/// The motion of a point that begins in this state, or at rest.
pub(super) struct TrajectoryFrom<'a> {
    pub(super) begin: Option<&'a [f64]>,
    pub(super) request: &'a TrajectoryRequest,
}

impl<M: Model<N>, const N: usize> Question<M, N> for TrajectoryFrom<'_> {
    type Answer = Result<Trajectory, Unfinished>;

    fn answer<R: Scalar>(self, model: &M, run: &PointRun<'_>) -> Result<Trajectory, Unfinished> {
        let PointRun { solver, values, interrupted, .. } = *run;
        let TrajectoryRequest { cycles, samples_per_cycle, settled } = *self.request;
        let mut start = begin(model, values, self.begin)?;
        if settled {
            let nearby = self.begin.is_some();
            let settled = run_alone::<_, R, _, _, N>(model, solver, &start, interrupted, |exchange| {
                settle(model, solver, start, nearby, exchange)
            });
            let Settled { row, orbit } = settled.ok_or(Unfinished::Interrupted)?;
            let Some(orbit) = orbit.filter(|_| row.status == Status::Periodic) else {
                return Err(Unfinished::NotPeriodic { status: row.status, cycles: row.cycles });
            };
            start = orbit.start(start.constants);
        }
        sampled::<M, R, N>(model, solver, &start, cycles, samples_per_cycle, interrupted)
    }
}
