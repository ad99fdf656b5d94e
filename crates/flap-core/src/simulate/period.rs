//! One drive period from a state, whether it repeats or not.

use super::begin::{begin, varied};
use super::cycle::{cycle, end_of_period};
use super::error::Unfinished;
use super::orbit_row::measures;
use super::request::Period;
use super::single::{PointRun, Question};
use crate::measure::cycle::Signals;
use crate::measure::multipliers::{monodromy, spectral_radius};
use crate::model::Model;
use crate::num::Scalar;
use crate::ode::variation::{Variation, response};

/// The period that begins at this state.
pub(super) struct PeriodFrom<'a>(pub(super) &'a [f64]);

impl<M: Model<N, S>, const N: usize, const K: usize, const S: usize> Question<M, N, K, S> for PeriodFrom<'_> {
    type Answer = Result<Period, Unfinished>;

    fn answer<R: Scalar>(self, model: &M, run: &PointRun<'_>) -> Result<Period, Unfinished> {
        let PointRun { solver, values, interrupted, .. } = *run;
        let start = begin(model, values, Some(self.0))?;
        let from = varied(&start, &start.scale);
        let (all, outcome) = end_of_period::<_, R, K>(&Variation(model), solver, &from, interrupted);
        Unfinished::check(outcome.ending, interrupted)?;
        let all = all.ok_or(Unfinished::Interrupted)?;
        let varied = outcome.rhs_evals * (N as u64 + 1);
        let (totals, outcome) = cycle::<M, R, N, S>(
            model,
            solver,
            &start,
            &Signals::all(model).with_loads(solver.loads),
            interrupted,
        );
        Unfinished::check(outcome.ending, interrupted)?;
        let measures =
            totals.map(|(_, totals)| measures(model, solver, &start.constants, &totals, start.span));
        Ok(Period {
            end: all[..N].to_vec(),
            responses: (0..N)
                .map(|j| response::<N, K>(&all, j).map(|change| change / start.scale[j]).to_vec())
                .collect(),
            scale: start.scale.to_vec(),
            floquet_max: spectral_radius(&monodromy(&all, &start.scale)),
            measures: measures.unwrap_or_default(),
            rhs_evals: varied + outcome.rhs_evals,
        })
    }
}
