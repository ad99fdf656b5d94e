//! One drive period from a state, whether it repeats or not.

use super::begin::begin;
use super::error::Unfinished;
use super::lanes::run_alone;
use super::orbit_row::measures;
use super::periods::{Kind, Request};
use super::request::Period;
use super::single::{PointRun, Question};
use crate::measure::multipliers::spectral_radius;
use crate::model::Model;
use crate::num::Scalar;
use crate::ode::Start;
use crate::ode::ensemble::Restart;

/// The period that begins at this state.
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
