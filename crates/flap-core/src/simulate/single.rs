//! One point on scalars, the readable path and the oracle of the lanes: its row, its motion over time, one of its periods.

use super::begin::begin;
use super::lanes::run_alone;
use super::orbit_row::measures;
use super::periods::{Kind, Request};
use super::request::{Period, Trajectory, TrajectoryRequest, Unfinished};
use super::row::{Row, Status};
use super::sampler::sampled;
use super::search::{Settled, settle};
use super::settings::SolverSettings;
use crate::measure::multipliers::spectral_radius;
use crate::model::Model;
use crate::num::{Arithmetic, Backend, Scalar, Unfused};
use crate::ode::ensemble::Restart;
use crate::ode::{Interrupt, Start, never};

/// The run of a single point on scalars.
#[derive(Clone, Copy)]
pub struct PointRun<'a> {
    /// The backend in whose arithmetic class the point is followed.
    pub backend: Backend,
    /// Solver settings.
    pub solver: &'a SolverSettings,
    /// One value per parameter of the model.
    pub values: &'a [f64],
    /// Ends the run early.
    pub interrupted: Interrupt<'a>,
}

impl<'a> PointRun<'a> {
    /// A run that nothing interrupts.
    pub fn new(backend: Backend, solver: &'a SolverSettings, values: &'a [f64]) -> PointRun<'a> {
        PointRun { backend, solver, values, interrupted: &never }
    }

    /// The same run, which ends early once `interrupted` says so.
    #[must_use]
    pub fn until(self, interrupted: Interrupt<'a>) -> PointRun<'a> {
        PointRun { interrupted, ..self }
    }
}

/// A question about one point, answered in either arithmetic of scalars.
///
/// The model has N states. It is the point's variant.
pub(crate) trait Question<M: Model<N>, const N: usize> {
    type Answer;

    fn answer<R: Scalar>(self, model: &M, run: &PointRun<'_>) -> Self::Answer;
}

/// The answer to a question about the point of `run`.
pub(crate) fn ask<M, Q, const N: usize>(model: &M, run: &PointRun<'_>, question: Q) -> Q::Answer
where
    M: Model<N>,
    Q: Question<M, N>,
{
    let model = &model.variant(run.values);
    match run.backend.arithmetic() {
        Arithmetic::Fused => question.answer::<f64>(model, run),
        Arithmetic::Unfused => question.answer::<Unfused>(model, run),
    }
}

/// The row of a point from this state, or from rest. Interrupted, the row means nothing.
pub(super) struct RowFrom<'a>(pub(super) Option<&'a [f64]>);

impl<M: Model<N>, const N: usize> Question<M, N> for RowFrom<'_> {
    type Answer = Row;

    fn answer<R: Scalar>(self, model: &M, run: &PointRun<'_>) -> Row {
        let PointRun { solver, values, interrupted, .. } = *run;
        let start = match begin(model, values, self.0) {
            Ok(start) => start,
            Err(error) => return Row::invalid(error),
        };
        let settled = run_alone::<_, R, _, _, N>(model, solver, &start, interrupted, |exchange| {
            settle(model, solver, start, self.0.is_some(), exchange)
        });
        settled.map_or_else(|| Row::empty(Status::Unsettled), |settled| settled.row)
    }
}

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

/// The drive period that begins at this state, whether it repeats or not.
pub(super) struct PeriodFrom<'a>(pub(super) &'a [f64]);

impl<M: Model<N>, const N: usize> Question<M, N> for PeriodFrom<'_> {
    type Answer = Result<Period, Unfinished>;

    fn answer<R: Scalar>(self, model: &M, run: &PointRun<'_>) -> Result<Period, Unfinished> {
        let PointRun { solver, values, interrupted, .. } = *run;
        let start = begin(model, values, Some(self.0))?;
        let Start { y, span, scale, tolerance_factor, .. } = start;
        let begin = Some(Restart { y, span, scale, tolerance_factor, change: scale });
        let ends = run_alone::<_, R, _, _, N>(model, solver, &start, interrupted, |exchange| async move {
            let varied = exchange.period(Request { kind: Kind::Responses, begin }).await;
            let measured = exchange.period(Request { kind: Kind::Signals, begin }).await;
            [varied, measured]
        });
        let [varied, measured] = ends.ok_or(Unfinished::Interrupted)?;
        Unfinished::check(varied.outcome.ending, interrupted)?;
        Unfinished::check(measured.outcome.ending, interrupted)?;
        let measures =
            measured.sums.map(|sums| measures::<M, N>(model, solver, &start.constants, &sums, start.span));
        // In units of the state's components, where the monodromy matrix has those of their typical sizes.
        let response = |j: usize| (0..N).map(|i| varied.monodromy[i][j] * scale[i] / scale[j]).collect();
        Ok(Period {
            end: varied.y.to_vec(),
            responses: (0..N).map(response).collect(),
            scale: scale.to_vec(),
            floquet_max: spectral_radius(&varied.monodromy),
            measures: measures.unwrap_or_default(),
            rhs_evals: varied.outcome.rhs_evals * (N as u64 + 1) + measured.outcome.rhs_evals,
        })
    }
}
