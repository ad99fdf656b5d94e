//! The motion of one point over time, sampled.

use core::ops::ControlFlow;

use super::settle::{Settled, settle};
use super::simulator::{SolverSettings, Status, Trajectory, TrajectoryRequest, Unfinished};
use crate::model::Model;
use crate::num::Scalar;
use crate::ode::dense::interpolate;
use crate::ode::solve::solve_until;
use crate::ode::step::Attempt;
use crate::ode::{Ending, Interrupt};
use crate::parameter::Invalid;

/// Samples the motion of a point.
pub(super) fn trajectory<M, R, const N: usize, const K: usize, const S: usize>(
    model: &M,
    solver: &SolverSettings,
    values: &[f64],
    request: &TrajectoryRequest,
    interrupted: Interrupt<'_>,
) -> Result<Trajectory, Unfinished>
where
    M: Model<N, S>,
    R: Scalar,
{
    let model = &model.variant(values);
    let mut start = model.start(values)?;
    if request.settled {
        let Settled { search, row } = settle::<M, R, N, K, S>(model, solver, &start, false, interrupted);
        if interrupted() {
            return Err(Unfinished::Interrupted);
        }
        // The row's state, not the search's: a search for a more exact orbit may have failed after it.
        let orbit = <[f64; N]>::try_from(row.state.as_slice()).ok();
        let Some(orbit) = orbit.filter(|_| row.status == Status::Periodic) else {
            return Err(Invalid::new(format!(
                "the motion does not settle on an orbit of one drive period (status {}, {} cycles); \
                 sample it from rest instead",
                row.status.name(),
                row.cycles
            ))
            .into());
        };
        start = search.start(&start, &orbit);
    }

    let mut sampler = Sampler::new(request.samples_per_cycle);
    let mut ended = 0;
    let outcome = solve_until::<M, R, N>(
        model,
        &solver.tolerances(),
        &start,
        interrupted,
        |c, attempt| {
            if attempt.t.lane(0) == 0.0 {
                sampler.begin_cycle(start.span);
            }
            sampler.step(model, c, attempt);
        },
        |_| {
            ended += 1;
            if ended == request.cycles { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        },
    );
    check(outcome.ending, interrupted)?;
    Ok(sampler.finish::<M, N, S>())
}

/// Why a motion did not get as far as requested.
pub(super) fn check(ending: Ending, interrupted: Interrupt<'_>) -> Result<(), Unfinished> {
    if interrupted() {
        return Err(Unfinished::Interrupted);
    }
    match ending {
        Ending::Stopped => Ok(()),
        Ending::Diverged => Err(Invalid::new("the motion diverges").into()),
        Ending::StepLimit => {
            Err(Invalid::new("the motion needs more than max_steps steps in a drive period").into())
        }
    }
}

/// Samples a motion cycle by cycle, each at equal distances.
pub(super) struct Sampler {
    samples_per_cycle: u32,
    /// Time at which the current cycle began, and its length (s).
    began: f64,
    span: f64,
    /// The next sample of the current cycle.
    next: u32,
    rows: Vec<Vec<f64>>,
    /// The end of the last cycle; replaced by the first sample of the next.
    last: Option<Vec<f64>>,
}

impl Sampler {
    pub(super) fn new(samples_per_cycle: u32) -> Sampler {
        Sampler { samples_per_cycle, began: 0.0, span: 0.0, next: 0, rows: Vec::new(), last: None }
    }

    /// Begins a cycle of `span` seconds.
    pub(super) fn begin_cycle(&mut self, span: f64) {
        self.began += self.span;
        self.span = span;
        self.next = 0;
    }

    /// Takes the samples that lie in an accepted step.
    pub(super) fn step<M, R, const N: usize, const S: usize>(
        &mut self,
        model: &M,
        c: &M::Constants<R>,
        attempt: &Attempt<'_, R, N>,
    ) where
        M: Model<N, S>,
        R: Scalar,
    {
        let (t, h) = (attempt.t.lane(0), attempt.h.lane(0));
        let number = |x: f64| R::splat((), x);
        while self.next < self.samples_per_cycle {
            let time = self.span * (f64::from(self.next) / f64::from(self.samples_per_cycle));
            if time > t + h {
                break;
            }
            let theta = ((time - t) / h).clamp(0.0, 1.0);
            let y = interpolate(attempt.step, attempt.h, number(theta));
            self.rows.push(sample(model, c, number(time), attempt.side, &y, self.began + time));
            self.next += 1;
        }
        // The step that lands has exactly this size.
        if h == self.span - t {
            let (y, end) = (&attempt.step.y[6], self.began + self.span);
            self.last = Some(sample(model, c, number(self.span), attempt.side, y, end));
        }
    }

    /// The samples, the end of the last cycle included.
    pub(super) fn finish<M: Model<N, S>, const N: usize, const S: usize>(mut self) -> Trajectory {
        self.rows.extend(self.last);
        Trajectory { columns: columns::<M, N, S>(), rows: self.rows }
    }
}

/// Names of the columns of a trajectory: time, states, signals.
pub(super) fn columns<M: Model<N, S>, const N: usize, const S: usize>() -> Vec<String> {
    let mut columns = vec!["time_s".to_owned()];
    columns.extend(M::STATES.iter().map(|&name| name.to_owned()));
    columns.extend(M::SIGNALS.iter().filter(|signal| signal.is_shown()).map(|signal| {
        if signal.unit.suffix.is_empty() {
            signal.name.to_owned()
        } else {
            format!("{}_{}", signal.name, signal.unit.suffix)
        }
    }));
    columns
}

/// One row of a trajectory, at `t` within a cycle and `time` since the beginning (s).
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
    R: Scalar,
{
    let input = model.input(c, t);
    let signals = model.signals(c, &input, side, y, &model.rhs(c, &input, side, y));
    let mut row = vec![time];
    row.extend(y.iter().map(|y| y.lane(0)));
    row.extend(shown::<M, N, S>(&signals.map(|value| value.lane(0))));
    row
}

/// The signals that have columns, in their units.
pub(super) fn shown<M: Model<N, S>, const N: usize, const S: usize>(
    signals: &[f64; S],
) -> impl Iterator<Item = f64> + '_ {
    let pairs = signals.iter().zip(&M::SIGNALS).filter(|(_, signal)| signal.is_shown());
    pairs.map(|(value, signal)| value * signal.unit.factor)
}
