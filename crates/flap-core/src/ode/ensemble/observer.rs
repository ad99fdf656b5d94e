//! Sums along the runs of an ensemble.

use crate::num::{Lanes, PerLane};
use crate::ode::Ode;
use crate::ode::step::Attempt;

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
