//! Equidistant samples of a motion, as rows of a [`Trajectory`].

use core::ops::ControlFlow;

use super::request::{Trajectory, Unfinished};
use super::settings::SolverSettings;
use crate::model::{Instant, Model, Signal, SignalSet};
use crate::num::Scalar;
use crate::ode::solve::solve_until;
use crate::ode::step::Attempt;
use crate::ode::{Interrupt, Start};

/// Integrates a motion from `start` over `spans` time spans, and takes equidistant samples in each time span.
pub(super) fn sampled<M, R, const N: usize>(
    model: &M,
    solver: &SolverSettings,
    start: &Start<M::Constants<f64>, N>,
    spans: u32,
    samples_per_span: u32,
    interrupted: Interrupt<'_>,
) -> Result<Trajectory, Unfinished>
where
    M: Model<N>,
    R: Scalar,
{
    let mut sampler = Sampler::new(samples_per_span);
    let mut ended = 0;
    let outcome = solve_until::<M, R, N>(
        model,
        &solver.tolerances(),
        start,
        interrupted,
        &mut |c, attempt| {
            if attempt.t.lane(0) == 0.0 {
                sampler.begin_cycle(start.span);
            }
            sampler.step(model, c, attempt);
        },
        &mut |_| {
            ended += 1;
            if ended == spans { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        },
    );
    Unfinished::check(outcome.ending, interrupted)?;
    Ok(sampler.finish::<M, N>())
}

/// Sampler of a motion, with equidistant samples in each cycle.
pub(super) struct Sampler {
    samples_per_cycle: u32,
    /// Time at the beginning of the current cycle, and the cycle's length (s).
    began: f64,
    span: f64,
    /// Index of the next sample of the current cycle.
    next: u32,
    rows: Vec<Vec<f64>>,
    /// Sample at the end of the last cycle. If a further cycle begins, the first sample of that cycle
    /// replaces this sample.
    last: Option<Vec<f64>>,
}

impl Sampler {
    /// Returns a new sampler, which takes no samples if `samples_per_cycle` is 0.
    pub(super) fn new(samples_per_cycle: u32) -> Sampler {
        Sampler { samples_per_cycle, began: 0.0, span: 0.0, next: 0, rows: Vec::new(), last: None }
    }

    /// Begins a cycle of `span` seconds.
    pub(super) fn begin_cycle(&mut self, span: f64) {
        self.began += self.span;
        self.span = span;
        self.next = 0;
    }

    /// Takes the samples whose times lie within an accepted integration step.
    pub(super) fn step<M, R, const N: usize>(
        &mut self,
        model: &M,
        c: &M::Constants<R>,
        attempt: &Attempt<'_, R, N>,
    ) where
        M: Model<N>,
        R: Scalar,
    {
        let (t, h) = (attempt.t.lane(0), attempt.h.lane(0));
        let number = |x: f64| R::new(x);
        while self.next < self.samples_per_cycle {
            let time = self.span * (f64::from(self.next) / f64::from(self.samples_per_cycle));
            if time > t + h {
                break;
            }
            let theta = ((time - t) / h).clamp(0.0, 1.0);
            let y = attempt.step.interpolate(attempt.h, number(theta));
            self.rows.push(sample(model, c, number(time), attempt.side, &y, self.began + time));
            self.next += 1;
        }
        // The step that ends the cycle has exactly this size.
        if h == self.span - t {
            let (y, end) = (&attempt.step.y[6], self.began + self.span);
            self.last = Some(sample(model, c, number(self.span), attempt.side, y, end));
        }
    }

    /// Returns the samples, including the end of the last cycle.
    pub(super) fn finish<M: Model<N>, const N: usize>(mut self) -> Trajectory {
        self.rows.extend(self.last);
        Trajectory { columns: columns::<M, N>(), rows: self.rows }
    }
}

/// Returns the names of the columns of a trajectory: time, states, signals.
pub(super) fn columns<M: Model<N>, const N: usize>() -> Vec<String> {
    let mut columns = vec!["time_s".to_owned()];
    columns.extend(M::STATES.iter().map(|&name| name.to_owned()));
    columns.extend(M::Signals::TABLE.iter().filter(|signal| signal.is_shown()).map(Signal::column));
    columns
}

/// Returns the descriptions of the columns of a trajectory, in the order of the columns.
pub(super) fn meanings<M: Model<N>, const N: usize>() -> Vec<String> {
    let mut meanings = vec!["time since the beginning of the motion".to_owned()];
    meanings.extend(M::STATES.iter().map(|name| format!("state {name} of the equations of motion")));
    let shown = M::Signals::TABLE.iter().filter(|signal| signal.is_shown());
    meanings.extend(shown.map(|signal| signal.doc.to_owned()));
    meanings
}

/// Returns one row of a trajectory. `t` is the time since the beginning of the cycle, and `time` is the time
/// since the beginning of the motion (s).
fn sample<M, R, const N: usize>(
    model: &M,
    c: &M::Constants<R>,
    t: R,
    side: R,
    y: &[R; N],
    time: f64,
) -> Vec<f64>
where
    M: Model<N>,
    R: Scalar,
{
    let input = model.input(c, t);
    let dy = model.rhs(c, &input, side, y);
    let signals = model.signals(c, Instant { input: &input, side, y, dy: &dy });
    let mut row = vec![time];
    row.extend(y.iter().map(|y| y.lane(0)));
    row.extend(shown::<M::Signals>(&M::Signals::map(&signals, |_, value| value.lane(0))));
    row
}

/// Returns the values of the signals that have columns, in the units of the columns.
pub(super) fn shown<S: SignalSet>(signals: &S::Of<f64>) -> impl Iterator<Item = f64> {
    let shown = S::each(signals).filter(|(signal, _)| signal.is_shown());
    shown.map(|(signal, value)| value * signal.unit.factor)
}
