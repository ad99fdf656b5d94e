//! One drive period from a state, whether it repeats or not.

use core::ops::ControlFlow;

use super::motion::check;
use super::row::measures;
use super::scalar::cycle;
use super::search::{begin, varied};
use super::simulator::{Period, SolverSettings, Unfinished};
use crate::measure::cycle::Signals;
use crate::model::Model;
use crate::num::Scalar;
use crate::ode::Interrupt;
use crate::ode::solve::solve_until;
use crate::ode::variation::{Variation, response};

/// Follows a point from the state `from` for one drive period.
pub(super) fn from<M, R, const N: usize, const K: usize, const S: usize>(
    model: &M,
    solver: &SolverSettings,
    values: &[f64],
    from: &[f64],
    interrupted: Interrupt<'_>,
) -> Result<Period, Unfinished>
where
    M: Model<N, S>,
    R: Scalar,
{
    let model = &model.variant(values);
    let start = begin(model, values, Some(from))?;
    let mut all = [0.0; K];
    let outcome = solve_until::<Variation<'_, M, N>, R, K>(
        &Variation(model),
        &solver.tolerances(),
        &varied(&start, &start.scale),
        interrupted,
        |_, _| {},
        |end| {
            all = *end;
            ControlFlow::Break(())
        },
    );
    check(outcome.ending, interrupted)?;
    let varied = outcome.rhs_evals * (N as u64 + 1);
    let (totals, outcome) = cycle::<M, R, N, S>(model, solver, &start, Signals::ALL, interrupted);
    check(outcome.ending, interrupted)?;
    let measures = totals.map(|totals| measures(model, &start.constants, &totals, start.span));
    Ok(Period {
        end: all[..N].to_vec(),
        responses: (0..N)
            .map(|j| response::<N, K>(&all, j).map(|change| change / start.scale[j]).to_vec())
            .collect(),
        scale: start.scale.to_vec(),
        measures: measures.unwrap_or_default(),
        rhs_evals: varied + outcome.rhs_evals,
    })
}
