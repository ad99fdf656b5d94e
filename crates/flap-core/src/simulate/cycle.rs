//! One drive period on scalars: its end, or totals of the signals along it.

use core::ops::ControlFlow;

use super::settings::SolverSettings;
use crate::measure::cycle::{Signals, Sums};
use crate::model::Model;
use crate::num::{PerLane, Scalar};
use crate::ode::ensemble::Observer;
use crate::ode::solve::solve_until;
use crate::ode::{Interrupt, Ode, Outcome, Start};

/// The state and the totals at the end of a period, unless it failed.
pub(super) type Measured<const N: usize, const S: usize> = (Option<([f64; N], Sums<f64, S>)>, Outcome);

/// The state at the end of a drive period from `start`, and totals of what `signals` asks for, unless it fails.
pub(super) fn cycle<M, R, const N: usize, const S: usize>(
    model: &M,
    solver: &SolverSettings,
    start: &Start<M::Constants<f64>, N>,
    signals: &Signals<'_, M, S>,
    interrupted: Interrupt<'_>,
) -> Measured<N, S>
where
    M: Model<N, S>,
    R: Scalar,
{
    let mut end = None;
    let mut totals = Sums::<R, S>::fill((), &Observer::<M, N>::nothing(signals));
    let outcome = solve_until::<M, R, N>(
        model,
        &solver.tolerances(),
        start,
        interrupted,
        |c, accepted| {
            R::enter(
                #[inline(always)]
                || signals.add(c, accepted, true, &mut totals),
            );
        },
        |y| {
            end = Some(*y);
            ControlFlow::Break(())
        },
    );
    (end.map(|end| (end, totals.get(0))), outcome)
}

/// The state at the end of a drive period from `start`, unless the period fails or is interrupted.
pub(super) fn end_of_period<O: Ode<N>, R: Scalar, const N: usize>(
    ode: &O,
    solver: &SolverSettings,
    start: &Start<O::Constants<f64>, N>,
    interrupted: Interrupt<'_>,
) -> (Option<[f64; N]>, Outcome) {
    let mut end = None;
    let outcome = solve_until::<O, R, N>(
        ode,
        &solver.tolerances(),
        start,
        interrupted,
        |_, _| {},
        |y| {
            end = Some(*y);
            ControlFlow::Break(())
        },
    );
    (end, outcome)
}
