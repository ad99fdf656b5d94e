//! One point at a time on scalars: the readable path, and the oracle of the lanes.

use core::ops::ControlFlow;

use super::row;
use super::search::{Next, Search, begin, varied};
use super::simulator::{
    ChirpRequest, ChirpResponse, ImpulseRequest, Period, Row, SolverSettings, Trajectory, TrajectoryRequest,
    Unfinished,
};
use super::{chirp, impulse, motion, period};
use crate::measure::cycle::{Signals, Totals};
use crate::model::Model;
use crate::num::{Arithmetic, InstructionSet, PerLane, Scalar, Unfused};
use crate::ode::ensemble::Observer;
use crate::ode::solve::solve_until;
use crate::ode::variation::Variation;
use crate::ode::{Ending, Interrupt, Outcome, Start};

/// Searches for the orbit of a point; `nearby` if it begins perhaps near that. Interrupted, it comes to nothing.
pub(super) fn search<M, R, const N: usize, const K: usize, const S: usize>(
    model: &M,
    solver: &SolverSettings,
    start: &Start<M::Constants<f64>, N>,
    nearby: bool,
    interrupted: Interrupt<'_>,
) -> Search<N>
where
    M: Model<N, S>,
    R: Scalar,
{
    let tolerances = &solver.tolerances();
    let mut search = Search::new(start, solver, nearby);
    let mut next = Next::March(start.y);
    loop {
        next = match next {
            Next::March(y) => {
                let from = Start { y, ..*start };
                let period_end = |y: &[f64; N]| search.period_end(y);
                let outcome =
                    solve_until::<M, R, N>(model, tolerances, &from, interrupted, |_, _| {}, period_end);
                search.marched(outcome)
            }
            Next::Vary(y) => {
                let from = varied(start, &y);
                let mut end = None;
                let outcome = solve_until::<Variation<'_, M, N>, R, K>(
                    &Variation(model),
                    tolerances,
                    &from,
                    interrupted,
                    |_, _| {},
                    |all| {
                        end = Some(*all);
                        ControlFlow::Break(())
                    },
                );
                search.varied(end.as_ref(), outcome)
            }
            Next::Done => return search,
        }
    }
}

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
    let mut start = match begin(model, values, from) {
        Ok(start) => start,
        Err(error) => return Row::invalid(error),
    };
    let search = search::<M, R, N, K, S>(model, solver, &start, from.is_some(), interrupted);
    if let Some(row) = row::unmeasured(&search) {
        return row;
    }

    start.y = search.orbit().map_or(start.y, |orbit| orbit.y);
    let (totals, outcome) = cycle::<M, R, N, S>(model, solver, &start, interrupted);
    row::measured(&search, model, &start.constants, start.span, totals.as_ref(), outcome)
}

/// The totals of a drive period from where a run begins, unless it fails.
pub(super) fn cycle<M, R, const N: usize, const S: usize>(
    model: &M,
    solver: &SolverSettings,
    start: &Start<M::Constants<f64>, N>,
    interrupted: Interrupt<'_>,
) -> (Option<[Totals<f64>; S]>, Outcome)
where
    M: Model<N, S>,
    R: Scalar,
{
    let observer = Signals::<S>;
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
        M: Model<N, S>,
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
        M: Model<N, S>,
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
