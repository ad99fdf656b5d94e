//! Traits for the source of the runs of an ensemble, and for an observer that computes sums during the runs.

use crate::num::{Lanes, PerLane};
use crate::ode::step::Attempt;
use crate::ode::{Ode, Outcome, Start};

/// Largest number of lanes of any backend: the lanes of two AVX-512 registers.
pub const MOST_LANES: usize = 16;

/// Start of a run that replaces the previous run in a lane and has the same constants as the previous run.
pub type Restart<const N: usize> = Start<(), N>;

/// A run at the end of a time span, or a run that has failed.
#[derive(Clone, Copy, Debug)]
pub struct SpanEnd<'a, T, const N: usize> {
    /// State.
    pub y: &'a [f64; N],
    /// Sums that the observer has computed over the steps since the start of the run.
    pub totals: &'a T,
    /// Responses of the state to a change of each component of the initial state by [`Start::change`]. The
    /// slice is empty in the function [`run`](super::run), which computes no responses.
    pub responses: &'a [[f64; N]],
    /// Reason for the end of the run, and the numbers of steps and evaluations since the start of the run. At
    /// the end of a time span, the ending is [`Stopped`](crate::ode::Ending::Stopped).
    pub outcome: Outcome,
}

/// Next task of a run that stays in its lane.
#[derive(Clone, Copy, Debug)]
pub enum Next<const N: usize> {
    /// The run continues with the next time span, from the state at the end of the last time span. Do not
    /// return `Span` for a failed run.
    Span,
    /// The run is replaced by a run with a different initial state or different tolerances. The sums, and the
    /// numbers of steps and evaluations, begin at zero again.
    Restart(Restart<N>),
}

/// Object that provides the runs of an ensemble and receives the results of the runs. The numbers of the
/// lanes begin at 0 and are less than [`MOST_LANES`].
pub trait Queue<O: Ode<N>, V: Observer<O, N>, const N: usize> {
    /// Returns the start of the next run, which flap loads into the free lane `lane`. The result is `None` if
    /// no run is available at present.
    ///
    /// If `idle` is true, no lane has a run. If no lane has a run, the function may wait until a run is
    /// available. A result of `None` then ends the ensemble.
    fn next(&mut self, lane: usize, idle: bool) -> Option<Start<&O::Constants<f64>, N>>;

    /// Receives the run in a lane at the end of a time span, or after a failure of the run. Returns the next
    /// task of the run, or `None` to remove the run from the lane.
    fn ended(&mut self, lane: usize, end: SpanEnd<'_, V::Totals<f64>, N>) -> Option<Next<N>>;

    /// Returns true if the ensemble must end at once. flap then discards the runs in all lanes, see
    /// [`Interrupt`](crate::ode::Interrupt).
    fn interrupted(&self) -> bool {
        false
    }
}

/// Observer that computes sums over the steps of each run, such as time integrals.
pub trait Observer<O: Ode<N>, const N: usize> {
    /// Type of the sums that the observer computes in each lane.
    type Totals<R: Lanes>: PerLane<R, One = Self::Totals<f64>>;

    /// Returns the initial values of the sums, before the first step of a run.
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

/// Observer that computes no sums over the steps of a run.
#[derive(Clone, Copy, Debug)]
pub struct Unobserved;

impl<O: Ode<N>, const N: usize> Observer<O, N> for Unobserved {
    type Totals<R: Lanes> = ();

    #[inline(always)]
    fn nothing(&self) {}

    #[inline(always)]
    fn add<R: Lanes>(&self, _: &O::Constants<R>, _: &Attempt<'_, R, N>, _: R::Mask, (): &mut ()) {}
}
