//! The row, the motion over time, or a single period of one point, computed with scalars. This code is
//! simple, and its results are the reference for the results of the SIMD lanes.

use super::lanes::run_alone;
use super::orbit_row::measures;
use super::periods::{Kind, Request};
use super::request::{Period, Trajectory, TrajectoryRequest, Unfinished};
use super::row::{Row, Status};
use super::sampler::sampled;
use super::search::{SearchResult, settle};
use super::settings::SolverSettings;
use super::start::start_at;
use crate::measure::multipliers::spectral_radius;
use crate::model::Model;
use crate::num::{Backend, Scalar};
use crate::ode::{Interrupt, Start, never};
use crate::parameter::Invalid;

/// The parameter values and settings for a computation of a single point with scalars.
#[derive(Clone, Copy)]
pub struct PointRun<'a> {
    /// Backend whose arithmetic class the computation uses.
    pub backend: Backend,
    /// Solver settings.
    pub solver: &'a SolverSettings,
    /// One value per parameter of the model.
    pub values: &'a [f64],
    /// Callback that returns true to end the computation early.
    pub interrupted: Interrupt<'a>,
}

impl<'a> PointRun<'a> {
    /// Returns the values and settings for a computation that is never interrupted.
    pub fn new(backend: Backend, solver: &'a SolverSettings, values: &'a [f64]) -> PointRun<'a> {
        PointRun { backend, solver, values, interrupted: &never }
    }

    /// Returns a copy of these settings for a computation that ends early if `interrupted` returns true.
    #[must_use]
    pub fn until(self, interrupted: Interrupt<'a>) -> PointRun<'a> {
        PointRun { interrupted, ..self }
    }
}

/// Evaluates an expression in which `$R` is the scalar type of the arithmetic class of the backend.
macro_rules! on_scalars {
    ($run:expr, $R:ident => $value:expr) => {
        match $run.backend.arithmetic() {
            $crate::num::Arithmetic::Fused => {
                type $R = f64;
                $value
            }
            $crate::num::Arithmetic::Unfused => {
                type $R = $crate::num::Unfused;
                $value
            }
        }
    };
}
pub(super) use on_scalars;

/// Returns the row of a point whose motion begins in the state `from` or at rest. If the computation is
/// interrupted, the row is meaningless.
pub(super) fn row<M: Model<N>, R: Scalar, const N: usize>(
    model: &M,
    run: &PointRun<'_>,
    from: Option<&[f64]>,
) -> Row {
    let PointRun { solver, values, interrupted, .. } = *run;
    let model = &model.variant(values);
    let start = match start_at(model, solver, values, from) {
        Ok(start) => start,
        Err(error) => return Row::invalid(error),
    };
    let settled = run_alone::<_, R, _, _, N>(model, solver, &start, interrupted, |exchange| {
        settle(model, solver, from.is_some(), exchange)
    });
    settled.map_or_else(|| Row::empty(Status::Unsettled), |settled| settled.row)
}

/// Returns the motion of a point. The motion begins in the state `from` or at rest.
pub(super) fn trajectory<M: Model<N>, R: Scalar, const N: usize>(
    model: &M,
    run: &PointRun<'_>,
    from: Option<&[f64]>,
    request: &TrajectoryRequest,
) -> Result<Trajectory, Unfinished> {
    let PointRun { solver, values, interrupted, .. } = *run;
    let TrajectoryRequest { cycles, samples_per_cycle, settled } = *request;
    let model = &model.variant(values);
    let mut start = start_at(model, solver, values, from)?;
    if settled {
        let settled = run_alone::<_, R, _, _, N>(model, solver, &start, interrupted, |exchange| {
            settle(model, solver, from.is_some(), exchange)
        });
        let SearchResult { row, orbit } = settled.ok_or(Unfinished::Interrupted)?;
        let Some(orbit) = orbit.filter(|_| row.status == Status::Periodic) else {
            return Err(Invalid::new(format!(
                "the motion does not settle on an orbit of one drive period (status {}, {} cycles); sample it from rest \
                 instead",
                row.status.name(),
                row.cycles
            ))
            .into());
        };
        start = orbit.with(start.constants);
    }
    sampled::<M, R, N>(model, solver, &start, cycles, samples_per_cycle, interrupted)
}

/// Returns the results of the drive period that begins in the state `from`. The state at the end of the
/// period may differ from `from`.
pub(super) fn period<M: Model<N>, R: Scalar, const N: usize>(
    model: &M,
    run: &PointRun<'_>,
    from: &[f64],
) -> Result<Period, Unfinished> {
    let PointRun { solver, values, interrupted, .. } = *run;
    let model = &model.variant(values);
    let start = start_at(model, solver, values, Some(from))?;
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
