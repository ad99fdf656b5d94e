//! Largest magnitude that each component of the state reaches in a motion.

use crate::num::Lanes;
use crate::ode::Ode;
use crate::ode::ensemble::Observer;
use crate::ode::step::Attempt;

/// Observer that records the largest magnitude of each component of the state at the ends of the steps.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Size;

impl<O: Ode<N>, const N: usize> Observer<O, N> for Size {
    type Totals<R: Lanes> = [R; N];

    #[inline(always)]
    fn nothing(&self) -> [f64; N] {
        [0.0; N]
    }

    #[inline(always)]
    fn add<R: Lanes>(
        &self,
        _c: &O::Constants<R>,
        attempt: &Attempt<'_, R, N>,
        accepted: R::Mask,
        largest: &mut [R; N],
    ) {
        let [.., end] = &attempt.step.y;
        for i in 0..N {
            largest[i] = R::select(accepted, end[i].abs().max(largest[i]), largest[i]);
        }
    }
}
