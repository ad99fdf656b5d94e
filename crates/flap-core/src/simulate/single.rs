//! One point on scalars: its row, its motion over time, and single periods. This simple code is the reference for the
//! lanes.

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
use crate::ode::{Interrupt, Start, never};

/// Run of a single point on scalars.
#[derive(Clone, Copy)]
pub struct PointRun<'a> {
    /// Backend that determines the arithmetic class.
    pub backend: Backend,
    /// Solver settings.
    pub solver: &'a SolverSettings,
    /// One value per parameter of the model.
    pub values: &'a [f64],
    /// Callback that ends the run early.
    pub interrupted: Interrupt<'a>,
}

impl<'a> PointRun<'a> {
    /// Returns a run that is never interrupted.
    pub fn new(backend: Backend, solver: &'a SolverSettings, values: &'a [f64]) -> PointRun<'a> {
        PointRun { backend, solver, values, interrupted: &never }
    }

    /// Returns the same run, which ends early once `interrupted` returns true.
    #[must_use]
    pub fn until(self, interrupted: Interrupt<'a>) -> PointRun<'a> {
        PointRun { interrupted, ..self }
    }
}

/// A computation for one point, generic over the arithmetic of scalars.
///
/// The model has N states and is the point's variant.
pub(crate) trait Question<M: Model<N>, const N: usize> {
    type Answer;

    fn answer<R: Scalar>(self, model: &M, run: &PointRun<'_>) -> Self::Answer;
}

/// Returns the answer to a question about the point of `run`.
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

/// Question: the row of a point from this state, or from rest. If the run is interrupted, the row is meaningless.
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

/// Question: the motion of a point from this state, or from rest.
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
            start = orbit.with(start.constants);
        }
        sampled::<M, R, N>(model, solver, &start, cycles, samples_per_cycle, interrupted)
    }
}

/// Question: the drive period that begins at this state. The motion need not repeat.
pub(super) struct PeriodFrom<'a>(pub(super) &'a [f64]);

impl<M: Model<N>, const N: usize> Question<M, N> for PeriodFrom<'_> {
    type Answer = Result<Period, Unfinished>;

    fn answer<R: Scalar>(self, model: &M, run: &PointRun<'_>) -> Result<Period, Unfinished> {
        let PointRun { solver, values, interrupted, .. } = *run;
        let start = begin(model, values, Some(self.0))?;
        let Start { y, span, scale, tolerance_factor, .. } = start;
        let begin = Some(Start { constants: (), y, span, scale, tolerance_factor, change: scale });
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
        // The monodromy matrix is in units of the states' typical sizes; the responses are in units of the states.
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
