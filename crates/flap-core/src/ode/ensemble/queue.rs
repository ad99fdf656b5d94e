//! Source of an ensemble's runs, and sums along them.

use crate::num::{Lanes, PerLane};
use crate::ode::step::Attempt;
use crate::ode::{Ode, Outcome, Start};

/// Largest number of lanes of any backend: two registers of AVX-512.
pub const MOST_LANES: usize = 16;

/// A run in the same lane, with the same constants.
pub type Restart<const N: usize> = Start<(), N>;

/// A run at the end of a span, or at its failure.
#[derive(Clone, Copy, Debug)]
pub struct SpanEnd<'a, T, const N: usize> {
    /// State.
    pub y: &'a [f64; N],
    /// Totals of the observer since the run's start.
    pub totals: &'a T,
    /// Responses of the state to a change of each initial state by [`Start::change`]; empty in [`run`](super::run).
    pub responses: &'a [[f64; N]],
    /// Ending and cost since the run's start. At the end of a span the ending is
    /// [`Stopped`](crate::ode::Ending::Stopped).
    pub outcome: Outcome,
}

/// Next task of a run that keeps its lane.
#[derive(Clone, Copy, Debug)]
pub enum Next<const N: usize> {
    /// The next span, from the state at the end of the last one. Not allowed after a failure.
    Span,
    /// A span from another state or with other tolerances. Totals and costs begin at zero again.
    Restart(Restart<N>),
}

/// Source of runs and receiver of their results. Lanes are numbered from zero, below [`MOST_LANES`].
pub trait Queue<O: Ode<N>, V: Observer<O, N>, const N: usize> {
    /// Returns the start of the next run, which goes into this free lane, or `None` if there is none at present.
    ///
    /// If `idle` is true, no lane is running: the call may wait, and `None` ends the ensemble.
    fn next(&mut self, lane: usize, idle: bool) -> Option<Start<O::Constants<f64>, N>>;

    /// Receives the run of a lane at the end of a span, or at its failure. Returns its next task; with `None` the run
    /// leaves the lane.
    fn ended(&mut self, lane: usize, end: SpanEnd<'_, V::Totals<f64>, N>) -> Option<Next<N>>;

    /// Returns true to end at once. Runs in lanes are dropped; see [`Interrupt`](crate::ode::Interrupt).
    fn interrupted(&self) -> bool {
        false
    }
}

/// Observer that computes sums along a run, lane by lane.
pub trait Observer<O: Ode<N>, const N: usize> {
    /// Sums.
    type Totals<R: Lanes>: PerLane<R, One = Self::Totals<f64>>;

    /// Returns the sums before the first step.
    fn nothing(&self) -> Self::Totals<f64>;

    /// Adds a step of a run with the constants `c`, in the lanes in which the step was `accepted`.
    fn add<R: Lanes>(
        &self,
        c: &O::Constants<R>,
        attempt: &Attempt<'_, R, N>,
        accepted: R::Mask,
        totals: &mut Self::Totals<R>,
    );
}

/// Observer that computes nothing.
#[derive(Clone, Copy, Debug)]
pub struct Unobserved;

impl<O: Ode<N>, const N: usize> Observer<O, N> for Unobserved {
    type Totals<R: Lanes> = ();

    #[inline(always)]
    fn nothing(&self) {}

    #[inline(always)]
    fn add<R: Lanes>(&self, _: &O::Constants<R>, _: &Attempt<'_, R, N>, _: R::Mask, (): &mut ()) {}
}
