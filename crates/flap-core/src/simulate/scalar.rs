//! One point at a time on scalars: the readable path, and the oracle of the lanes.

use core::ops::ControlFlow;

use super::search::begin;
use super::settle::settle;
use super::simulator::{
    ChirpRequest, ChirpResponse, ImpulseRequest, Period, Row, SolverSettings, Trajectory, TrajectoryRequest,
    Unfinished,
};
use super::{chirp, impulse, motion, period};
use crate::measure::cycle::{Signals, Totals};
use crate::model::{Model, Motions};
use crate::num::{Arithmetic, InstructionSet, PerLane, Scalar, Unfused};
use crate::ode::ensemble::Observer;
use crate::ode::solve::solve_until;
use crate::ode::{Ending, Interrupt, Outcome, Start};

/// Runs one point. Interrupted, its row means nothing.
fn point<M, R, const N: usize, const K: usize, const S: usize>(
    model: &M,
    solver: &SolverSettings,
    values: &[f64],
    from: Option<&[f64]>,
    interrupted: Interrupt<'_>,
) -> Row
where
    M: Model<N, S>,
    R: Scalar,
{
    let model = &model.variant(values);
    match begin(model, values, from) {
        Ok(start) => settle::<M, R, N, K, S>(model, solver, &start, from.is_some(), interrupted).row,
        Err(error) => Row::invalid(error),
    }
}

/// The totals of a drive period from where a run begins, of what `signals` asks for, unless it fails.
pub(super) fn cycle<M, R, const N: usize, const S: usize>(
    model: &M,
    solver: &SolverSettings,
    start: &Start<M::Constants<f64>, N>,
    signals: Signals<S>,
    interrupted: Interrupt<'_>,
) -> (Option<[Totals<f64>; S]>, Outcome)
where
    M: Model<N, S>,
    R: Scalar,
{
    let observer = signals;
    let mut totals = Observer::<M, N>::nothing(&observer).map(|one| Totals::<R>::fill((), &one));
    let outcome = solve_until::<M, R, N>(
        model,
        &solver.tolerances(),
        start,
        interrupted,
        |c, accepted| {
            R::enter(
                #[inline(always)]
                || observer.add(model, c, accepted, true, &mut totals),
            );
        },
        |_| ControlFlow::Break(()),
    );
    let totals = totals.map(|total| total.get(0));
    ((outcome.ending == Ending::Stopped).then_some(totals), outcome)
}

/// One point on scalars of the arithmetic class of a machine's instructions.
pub(super) struct Scalars<'a, M> {
    pub(super) model: &'a M,
    pub(super) solver: &'a SolverSettings,
    pub(super) values: &'a [f64],
}

impl<M> Scalars<'_, M> {
    /// The point's row, from rest or another state; it means nothing if it was interrupted.
    pub(super) fn row<const N: usize, const K: usize, const S: usize>(
        &self,
        set: InstructionSet,
        begin: Option<&[f64]>,
        interrupted: Interrupt<'_>,
    ) -> Row
    where
        M: Model<N, S>,
    {
        match set.arithmetic() {
            Arithmetic::Fused => {
                point::<M, f64, N, K, S>(self.model, self.solver, self.values, begin, interrupted)
            }
            Arithmetic::Unfused => {
                point::<M, Unfused, N, K, S>(self.model, self.solver, self.values, begin, interrupted)
            }
        }
    }

    /// The point's sampled motion.
    pub(super) fn trajectory<const N: usize, const K: usize, const S: usize>(
        &self,
        set: InstructionSet,
        request: &TrajectoryRequest,
        interrupted: Interrupt<'_>,
    ) -> Result<Trajectory, Unfinished>
    where
        M: Model<N, S>,
    {
        let Scalars { model, solver, values } = *self;
        match set.arithmetic() {
            Arithmetic::Fused => {
                motion::trajectory::<M, f64, N, K, S>(model, solver, values, request, interrupted)
            }
            Arithmetic::Unfused => {
                motion::trajectory::<M, Unfused, N, K, S>(model, solver, values, request, interrupted)
            }
        }
    }

    /// One drive period of the point from a state.
    pub(super) fn period<const N: usize, const K: usize, const S: usize>(
        &self,
        set: InstructionSet,
        begin: &[f64],
        interrupted: Interrupt<'_>,
    ) -> Result<Period, Unfinished>
    where
        M: Model<N, S>,
    {
        let Scalars { model, solver, values } = *self;
        match set.arithmetic() {
            Arithmetic::Fused => period::from::<M, f64, N, K, S>(model, solver, values, begin, interrupted),
            Arithmetic::Unfused => {
                period::from::<M, Unfused, N, K, S>(model, solver, values, begin, interrupted)
            }
        }
    }

    /// The point's response to a chirp.
    pub(super) fn chirp<const N: usize, const S: usize>(
        &self,
        set: InstructionSet,
        request: &ChirpRequest,
        interrupted: Interrupt<'_>,
    ) -> Result<ChirpResponse, Unfinished>
    where
        M: Motions<N, S>,
    {
        let Scalars { model, solver, values } = *self;
        match set.arithmetic() {
            Arithmetic::Fused => chirp::respond::<M, f64, N, S>(model, solver, values, request, interrupted),
            Arithmetic::Unfused => {
                chirp::respond::<M, Unfused, N, S>(model, solver, values, request, interrupted)
            }
        }
    }

    /// The point's free motion after an impulse.
    pub(super) fn free_response<const N: usize, const S: usize>(
        &self,
        set: InstructionSet,
        request: &ImpulseRequest,
        interrupted: Interrupt<'_>,
    ) -> Result<Trajectory, Unfinished>
    where
        M: Motions<N, S>,
    {
        let Scalars { model, solver, values } = *self;
        match set.arithmetic() {
            Arithmetic::Fused => {
                impulse::respond::<M, f64, N, S>(model, solver, values, request, interrupted)
            }
            Arithmetic::Unfused => {
                impulse::respond::<M, Unfused, N, S>(model, solver, values, request, interrupted)
            }
        }
    }
}
