//! The march of a point: one drive period after another, until the motion has settled, has perhaps come near an orbit, or
//! takes too long.

use super::settings::SolverSettings;
use crate::measure::strobe::Strobe;

/// Periods that are marched before Newton's iteration is first tried: from rest, and from a state that is perhaps near
/// an orbit.
const FIRST_TRY: u32 = 6;
const FIRST_TRY_NEARBY: u32 = 1;

/// The largest change of the state over a period with which Newton's iteration is tried: in units of the states' typical
/// sizes.
const NEAR: f64 = 0.3;

/// Periods of the march after which the motion's size is first looked at.
const SIZED: u32 = 2;

/// A state counts as small if it does not reach this fraction of its typical size: its absolute tolerance is then a
/// multiple of what it does reach.
const SMALL: f64 = 0.1;

/// The smallest size of a state that tolerances follow, relative to that of the largest state of the motion.
const NEGLIGIBLE: f64 = 1e-6;

/// The march of a point.
#[derive(Clone, Copy, Debug)]
pub(super) struct March<const N: usize> {
    strobe: Strobe<N>,
    /// Typical sizes of the states.
    scale: [f64; N],
    /// The largest magnitude that each state has reached.
    largest: [f64; N],
    /// Length in drive periods of the orbit on which the march has settled.
    period: Option<u32>,
    max_cycles: u32,
    /// Periods marched before Newton's iteration is tried next; `None` if it never is.
    next_try: Option<u32>,
}

impl<const N: usize> March<N> {
    /// A march of at most `max_cycles` periods that begins at `y`; `nearby` if that is perhaps near the orbit.
    pub(super) fn new(
        y: &[f64; N],
        scale: &[f64; N],
        solver: &SolverSettings,
        nearby: bool,
        max_cycles: u32,
    ) -> March<N> {
        March {
            strobe: Strobe::new(y, scale, solver.settle_tol),
            scale: *scale,
            largest: [0.0; N],
            period: None,
            max_cycles,
            next_try: solver.newton.then_some(if nearby { FIRST_TRY_NEARBY } else { FIRST_TRY }),
        }
    }

    /// Takes the state at the end of a period, with the largest magnitude of each state in it.
    pub(super) fn period_end(&mut self, y: &[f64; N], largest: &[f64; N]) {
        for i in 0..N {
            self.largest[i] = self.largest[i].max(largest[i]);
        }
        self.period = self.strobe.period_end(y);
    }

    /// Length in drive periods of the orbit on which the march has settled.
    pub(super) fn period(&self) -> Option<u32> {
        self.period
    }

    /// True if the motion turns out to be far smaller than the sizes `assumed`, for which its tolerances were chosen.
    pub(super) fn is_oversized(&self, assumed: &[f64; N]) -> bool {
        let size = self.motion_size();
        self.strobe.cycles() == SIZED && (0..N).any(|i| size[i] < 0.5 * assumed[i])
    }

    /// The sizes of the states in this motion: the typical ones, but for states that stay small.
    pub(super) fn motion_size(&self) -> [f64; N] {
        let relative: [f64; N] = core::array::from_fn(|i| self.largest[i] / self.scale[i]);
        let overall = relative.iter().fold(0.0_f64, |size, &one| size.max(one));
        // A motion that is none has no size.
        if overall == 0.0 {
            return self.scale;
        }
        core::array::from_fn(|i| {
            let size = relative[i].max(overall * NEGLIGIBLE);
            self.scale[i] * (size / SMALL).min(1.0)
        })
    }

    /// True if the march may have come near an orbit: Newton's iteration is worth a try.
    pub(super) fn is_promising(&self) -> bool {
        self.next_try.is_some_and(|next| self.strobe.cycles() >= next) && self.strobe.change(1) <= NEAR
    }

    /// True if the march has taken as many periods as it may.
    pub(super) fn is_exhausted(&self) -> bool {
        self.strobe.cycles() >= self.max_cycles
    }

    /// Puts off the next try of Newton's iteration until the march is twice as long.
    pub(super) fn put_off_newton(&mut self) {
        self.next_try = Some(2 * self.strobe.cycles());
    }

    /// The state at the end of the last period.
    pub(super) fn state(&self) -> &[f64; N] {
        self.strobe.state()
    }

    /// The state a period before that.
    pub(super) fn before(&self) -> &[f64; N] {
        self.strobe.before()
    }

    /// Drive periods marched.
    pub(super) fn cycles(&self) -> u32 {
        self.strobe.cycles()
    }

    /// Change of the state over the last `periods` drive periods; NaN before that many have passed.
    pub(super) fn change(&self, periods: u32) -> f64 {
        self.strobe.change(periods)
    }
}
