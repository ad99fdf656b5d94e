//! The source of an ensemble's runs, and sums along them.

use crate::num::{Lanes, PerLane};
use crate::ode::step::Attempt;
use crate::ode::{Ode, Outcome, Start};

/// A run to be started: the caller's note of it, and its beginning.
pub type NewRun<Run, C, const N: usize> = (Run, Start<C, N>);

/// A new beginning of a run that keeps its lane, with the same constants.
#[derive(Clone, Copy, Debug)]
pub struct Restart<const N: usize> {
    /// The initial state.
    pub y: [f64; N],
    /// As [`Start::span`].
    pub span: f64,
    /// As [`Start::scale`].
    pub scale: [f64; N],
    /// As [`Start::tolerance_factor`].
    pub tolerance_factor: f64,
    /// As [`Start::change`].
    pub change: [f64; N],
}

impl<const N: usize> Restart<N> {
    /// The beginning of a run with these constants.
    pub(crate) fn start<C>(self, constants: C) -> Start<C, N> {
        let Restart { y, span, scale, tolerance_factor, change } = self;
        Start { constants, y, span, scale, tolerance_factor, change }
    }
}

/// A run at the end of a span, or where it has failed.
#[derive(Clone, Copy, Debug)]
pub struct SpanEnd<'a, T, const N: usize> {
    /// The state.
    pub y: &'a [f64; N],
    /// The observer's totals since the run's beginning.
    pub totals: &'a T,
    /// The response of the state to the change of each initial state by [`Start::change`]; empty in [`run`](super::run).
    pub responses: &'a [[f64; N]],
    /// The ending and the cost since the run's beginning. The ending is [`Stopped`](crate::ode::Ending::Stopped) at the end of
    /// a span.
    pub outcome: Outcome,
}

/// The next work of a run that keeps its lane.
#[derive(Clone, Copy, Debug)]
pub enum Next<const N: usize> {
    /// The next span, from the state at the end of the last one. A run that has failed cannot have one.
    Span,
    /// A span from another state, or with other tolerances. Totals and costs begin again.
    Restart(Restart<N>),
}

/// A source of runs, which also receives their results.
pub trait Queue<O: Ode<N>, V: Observer<O, N>, const N: usize> {
    /// The caller's note of a run while it is in a lane.
    type Run;

    /// The next run, or `None` if there is none for now.
    ///
    /// With `idle`, no lane is running: the call may wait, and `None` ends the ensemble.
    fn next(&mut self, idle: bool) -> Option<NewRun<Self::Run, O::Constants<f64>, N>>;

    /// Takes a run at the end of a span, or where it has failed. Returns it with its next work if it is to keep its lane.
    fn ended(&mut self, run: Self::Run, end: SpanEnd<'_, V::Totals<f64>, N>) -> Option<(Self::Run, Next<N>)>;

    /// True to end at once. Runs in lanes are dropped; see [`Interrupt`](crate::ode::Interrupt).
    fn interrupted(&self) -> bool {
        false
    }
}

/// Sums along a run, lane by lane.
pub trait Observer<O: Ode<N>, const N: usize> {
    /// The sums.
    type Totals<R: Lanes>: PerLane<R, One = Self::Totals<f64>>;

    /// The sums before the first step.
    fn nothing(&self) -> Self::Totals<f64>;

    /// Adds a step of a run with the constants `c`, in the lanes in which it was `accepted`.
    fn add<R: Lanes>(
        &self,
        c: &O::Constants<R>,
        attempt: &Attempt<'_, R, N>,
        accepted: R::Mask,
        totals: &mut Self::Totals<R>,
    );
}

/// Observes nothing.
#[derive(Clone, Copy, Debug)]
pub struct Unobserved;

impl<O: Ode<N>, const N: usize> Observer<O, N> for Unobserved {
    type Totals<R: Lanes> = ();

    #[inline(always)]
    fn nothing(&self) {}

    #[inline(always)]
    fn add<R: Lanes>(&self, _: &O::Constants<R>, _: &Attempt<'_, R, N>, _: R::Mask, (): &mut ()) {}
}
