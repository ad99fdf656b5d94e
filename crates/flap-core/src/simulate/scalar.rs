//! One point at a time on scalars: the readable path, and the oracle of the lanes.

use core::ops::ControlFlow;

use super::row::{Settled, invalid};
use super::simulator::{Row, SolverSettings, Trajectory, TrajectoryRequest};
use crate::measure::cycle::{Signals, Totals};
use crate::measure::strobe::Strobe;
use crate::model::{Invalid, Model};
use crate::num::{Arithmetic, InstructionSet, Lanes, PerLane, Unfused};
use crate::ode::dense::interpolate;
use crate::ode::ensemble::Observer;
use crate::ode::solve::solve;
use crate::ode::{Ending, Start};

/// Marches a point until it settles.
#[inline(always)]
fn settle<M, R, const N: usize, const S: usize>(
    model: &M,
    solver: &SolverSettings,
    start: &Start<M::Constants<f64>, N>,
) -> Settled<N>
where
    M: Model<N, S>,
    R: Lanes<Token = (), Mask = bool>,
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
#[inline(always)]
fn point<M, R, const N: usize, const S: usize>(model: &M, solver: &SolverSettings, values: &[f64]) -> Row
where
    M: Model<N, S>,
    R: Lanes<Token = (), Mask = bool>,
{
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
    let mut totals = Observer::<M, N>::nothing(&observer).map(|one| Totals::<R>::splat((), &one));
    let outcome = solve::<M, R, N>(
        model,
        &solver.tolerances(),
        &start,
        |c, accepted| observer.add(model, c, accepted, true, &mut totals),
        |_| ControlFlow::Break(()),
    );
    let totals = totals.map(|total| total.lane(0));
    let measured = (outcome.ending == Ending::Stopped).then_some(&totals);
    settled.measured(model, &start.constants, start.span, measured, outcome)
}

/// Samples the motion of a point.
#[inline(always)]
fn trajectory<M, R, const N: usize, const S: usize>(
    model: &M,
    solver: &SolverSettings,
    values: &[f64],
    request: &TrajectoryRequest,
) -> Result<Trajectory, Invalid>
where
    M: Model<N, S>,
    R: Lanes<Token = (), Mask = bool>,
{
    let mut start = model.start(values)?;
    if request.settled {
        let settled = settle::<M, R, N, S>(model, solver, &start);
        if let Some(row) = settled.unmeasured() {
            return Err(Invalid::new(format!(
                "the motion does not settle on an orbit of one drive period (status {}, {} cycles); \
                 sample it from rest instead",
                row.status.name(),
                row.cycles
            )));
        }
        start.y = *settled.strobe.state();
    }

    let samples = u64::from(request.samples_per_cycle);
    let spacing = start.span / samples as f64;
    let mut rows = Vec::new();
    let (mut begun, mut next) = (0, 0);
    let mut ended = 0;
    let outcome = solve::<M, R, N>(
        model,
        &solver.tolerances(),
        &start,
        |c, accepted| {
            let (t, h) = (accepted.t.lane(0), accepted.h.lane(0));
            if t == 0.0 {
                begun += 1;
                next = 0;
            }
            let before = f64::from(begun - 1) * start.span;
            // The last sample of a cycle is the first of the next; the very last is added at the end.
            while next < samples && next as f64 * spacing <= t + h {
                let time = next as f64 * spacing;
                let theta = R::splat((), ((time - t) / h).clamp(0.0, 1.0));
                let y = interpolate(accepted.step, accepted.h, theta);
                rows.push(sample(model, c, R::splat((), time), accepted.side, &y, before + time));
                next += 1;
            }
            if begun == request.cycles && t + h >= start.span {
                let y = accepted.step.y[6];
                rows.push(sample(model, c, R::splat((), start.span), accepted.side, &y, before + start.span));
            }
        },
        |_| {
            ended += 1;
            if ended == request.cycles { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        },
    );
    match outcome.ending {
        Ending::Stopped => Ok(Trajectory { columns: trajectory_columns::<M, N, S>(), rows }),
        Ending::Diverged => Err(Invalid::new("the motion diverges")),
        Ending::StepLimit => {
            Err(Invalid::new("the motion needs more than max_steps steps in a drive period"))
        }
    }
}

/// Names of the columns of a trajectory: time, drive phase, states, signals.
fn trajectory_columns<M: Model<N, S>, const N: usize, const S: usize>() -> Vec<String> {
    let mut columns = vec!["time_s".to_owned()];
    columns.extend(M::STATES.iter().map(|&name| name.to_owned()));
    // Signals that merely repeat a state in another unit are wanted too: they are what rows measure.
    columns.extend(M::SIGNALS.iter().map(|signal| {
        if signal.suffix.is_empty() {
            signal.name.to_owned()
        } else {
            format!("{}_{}", signal.name, signal.suffix)
        }
    }));
    columns
}

/// One row of a trajectory, at `t` within a drive period and `time` since the beginning (s).
fn sample<M, R, const N: usize, const S: usize>(
    model: &M,
    c: &M::Constants<R>,
    t: R,
    side: R,
    y: &[R; N],
    time: f64,
) -> Vec<f64>
where
    M: Model<N, S>,
    R: Lanes<Token = (), Mask = bool>,
{
    let input = model.input(c, t);
    let signals = model.signals(c, &input, side, y, &model.rhs(c, &input, side, y));
    let mut row = vec![time];
    row.extend(y.iter().map(|y| y.lane(0)));
    row.extend(signals.iter().zip(&M::SIGNALS).map(|(value, signal)| value.lane(0) * signal.factor));
    row
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
            Arithmetic::Fused => set.fused_scalars(
                #[inline(always)]
                || point::<M, f64, N, S>(self.model, self.solver, self.values),
            ),
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
        match set.arithmetic() {
            Arithmetic::Fused => trajectory::<M, f64, N, S>(self.model, self.solver, self.values, request),
            Arithmetic::Unfused => {
                trajectory::<M, Unfused, N, S>(self.model, self.solver, self.values, request)
            }
        }
    }
}
