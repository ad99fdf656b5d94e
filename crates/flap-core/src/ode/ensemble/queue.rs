//! Source of the runs of an ensemble, and the sums that an observer computes during the runs.

use crate::num::{Lanes, PerLane};
use crate::ode::step::Attempt;
use crate::ode::{Ode, Outcome, Start};

/// Largest number of lanes of any backend: the lanes of two AVX-512 registers.
pub const MOST_LANES: usize = 16;

/// Initial state of a run that replaces the run in the same lane, with the same constants.
pub type Restart<const N: usize> = Start<(), N>;

/// A run at the end of a span, or at its failure.
#[derive(Clone, Copy, Debug)]
pub struct SpanEnd<'a, T, const N: usize> {
    /// State.
    pub y: &'a [f64; N],
    /// Totals of the observer since the start of the run.
    pub totals: &'a T,
    /// Responses of the state to a change of each component of the initial state by [`Start::change`]; empty in
    /// [`run`](super::run).
    pub responses: &'a [[f64; N]],
    /// Ending of the run, and its cost since the start. At the end of a span, the ending is
    /// [`Stopped`](crate::ode::Ending::Stopped).
    pub outcome: Outcome,
}

/// Next task of a run that stays in its lane.
#[derive(Clone, Copy, Debug)]
pub enum Next<const N: usize> {
    /// Integrates the next span, from the state at the end of the last span. After a failure, this task is not allowed.
    Span,
    /// Integrates a span from another state or with other tolerances. Totals and costs begin at zero again.
    Restart(Restart<N>),
}

/// Source of runs and receiver of their results. Lanes are numbered from zero, below [`MOST_LANES`].
pub trait Queue<O: Ode<N>, V: Observer<O, N>, const N: usize> {
    /// Returns the initial state of the next run, which is loaded into the free lane `lane`. The result is `None` if no
    /// run is available at present.
    ///
    /// If `idle` is true, no lane has a run. In this case the function may wait for a run, and the result `None` ends
    /// the ensemble.
    fn next(&mut self, lane: usize, idle: bool) -> Option<Start<O::Constants<f64>, N>>;

    /// Receives the run of a lane at the end of a span, or after a failure. Returns the next task of the run, or `None`
    /// to remove the run from the lane.
    fn ended(&mut self, lane: usize, end: SpanEnd<'_, V::Totals<f64>, N>) -> Option<Next<N>>;

    /// Returns true if the ensemble must end at once. Runs in lanes are then discarded, see
    /// [`Interrupt`](crate::ode::Interrupt).
    fn interrupted(&self) -> bool {
        false
    }
}

/// Observer that computes sums during the run in each lane.
pub trait Observer<O: Ode<N>, const N: usize> {
    /// Sums.
    type Totals<R: Lanes>: PerLane<R, One = Self::Totals<f64>>;

    /// Returns the values of the sums before the first step.
    fn nothing(&self) -> Self::Totals<f64>;

    /// Adds a step to the sums, in the lanes in which the step was `accepted`. `c` contains the constants of the runs.
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
