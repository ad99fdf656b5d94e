//! One point at a time on scalars: the readable path, and the oracle of the lanes.

use core::ops::ControlFlow;

use super::row::{Settled, invalid};
use super::simulator::{
    ChirpRequest, ChirpResponse, ImpulseRequest, Row, SolverSettings, Trajectory, TrajectoryRequest,
};
use super::{chirp, impulse, motion};
use crate::measure::cycle::{Signals, Totals};
use crate::measure::strobe::Strobe;
use crate::model::Model;
use crate::num::{Arithmetic, InstructionSet, PerLane, Scalar, Unfused};
use crate::ode::ensemble::Observer;
use crate::ode::solve::solve;
use crate::ode::{Ending, Start};
use crate::parameter::Invalid;

/// Marches a point until it settles.
pub(super) fn settle<M, R, const N: usize, const S: usize>(
    model: &M,
    solver: &SolverSettings,
    start: &Start<M::Constants<f64>, N>,
) -> Settled<N>
where
    M: Model<N, S>,
    R: Scalar,
{
    let mut strobe = Strobe::new(&start.y, &start.scale, solver.settle_tol);
    let mut period = None;
    let outcome = solve::<M, R, N>(
        model,
        &solver.tolerances(),
        start,
        |_, _| {},
        |y| {
            period = strobe.period_end(y);
            if period.is_some() || strobe.cycles() >= solver.max_cycles {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        },
    );
    Settled { strobe, period, outcome }
}

/// Runs one point.
fn point<M, R, const N: usize, const S: usize>(model: &M, solver: &SolverSettings, values: &[f64]) -> Row
where
    M: Model<N, S>,
    R: Scalar,
{
    let model = &model.variant(values);
    let mut start = match model.start(values) {
        Ok(start) => start,
        Err(error) => return invalid(error),
    };
    let settled = settle::<M, R, N, S>(model, solver, &start);
    if let Some(row) = settled.unmeasured() {
        return row;
    }

    start.y = *settled.strobe.state();
    let observer = Signals::<S>;
    let mut totals = Observer::<M, N>::nothing(&observer).map(|one| Totals::<R>::fill((), &one));
    let outcome = solve::<M, R, N>(
        model,
        &solver.tolerances(),
        &start,
        |c, accepted| {
            R::enter(
                #[inline(always)]
                || observer.add(model, c, accepted, true, &mut totals),
            );
        },
        |_| ControlFlow::Break(()),
    );
    let totals = totals.map(|total| total.get(0));
    let measured = (outcome.ending == Ending::Stopped).then_some(&totals);
    settled.measured(model, &start.constants, start.span, measured, outcome)
}

/// One point on scalars of the arithmetic class of a machine's instructions.
pub(super) struct Scalars<'a, M> {
    pub(super) model: &'a M,
    pub(super) solver: &'a SolverSettings,
    pub(super) values: &'a [f64],
}

impl<M> Scalars<'_, M> {
    /// The point's row.
    pub(super) fn row<const N: usize, const S: usize>(&self, set: InstructionSet) -> Row
    where
        M: Model<N, S>,
    {
        match set.arithmetic() {
            Arithmetic::Fused => point::<M, f64, N, S>(self.model, self.solver, self.values),
            Arithmetic::Unfused => point::<M, Unfused, N, S>(self.model, self.solver, self.values),
        }
    }

    /// The point's sampled motion.
    pub(super) fn trajectory<const N: usize, const S: usize>(
        &self,
        set: InstructionSet,
        request: &TrajectoryRequest,
    ) -> Result<Trajectory, Invalid>
    where
        M: Model<N, S>,
    {
        let Scalars { model, solver, values } = *self;
        match set.arithmetic() {
            Arithmetic::Fused => motion::trajectory::<M, f64, N, S>(model, solver, values, request),
            Arithmetic::Unfused => motion::trajectory::<M, Unfused, N, S>(model, solver, values, request),
        }
    }

    /// The point's response to a chirp.
    pub(super) fn chirp<const N: usize, const S: usize>(
        &self,
        set: InstructionSet,
        request: &ChirpRequest,
    ) -> Result<ChirpResponse, Invalid>
    where
        M: Model<N, S>,
    {
        let Scalars { model, solver, values } = *self;
        match set.arithmetic() {
            Arithmetic::Fused => chirp::respond::<M, f64, N, S>(model, solver, values, request),
            Arithmetic::Unfused => chirp::respond::<M, Unfused, N, S>(model, solver, values, request),
        }
    }

    /// The point's free motion after an impulse.
    pub(super) fn free_response<const N: usize, const S: usize>(
        &self,
        set: InstructionSet,
        request: &ImpulseRequest,
    ) -> Result<Trajectory, Invalid>
    where
        M: Model<N, S>,
    {
        let Scalars { model, solver, values } = *self;
        match set.arithmetic() {
            Arithmetic::Fused => impulse::respond::<M, f64, N, S>(model, solver, values, request),
            Arithmetic::Unfused => impulse::respond::<M, Unfused, N, S>(model, solver, values, request),
        }
    }
}
