//! The march of a point: it integrates one drive period after another.
//!
//! The march ends when the motion has settled or may be close to an orbit, or after the largest allowed
//! number of periods.

use super::settings::SolverSettings;
use crate::measure::strobe::Strobe;

/// Number of drive periods that are integrated from rest before Newton's iteration is tried for the first
/// time.
const FIRST_TRY: u32 = 6;

/// Number of drive periods before Newton's iteration is tried for the first time, if the initial state may be
/// close to an orbit.
const FIRST_TRY_NEARBY: u32 = 1;

/// Newton's iteration is tried only if the state changes by at most this amount over a period, in units of
/// the states' typical sizes.
const NEAR: f64 = 0.3;

/// Number of marched drive periods after which flap checks if the motion is small.
const SIZED: u32 = 2;

/// A state counts as small if its largest magnitude is below this fraction of its typical size.
///
/// The absolute tolerance of a small state is a multiple of the actual size of the state.
const SMALL: f64 = 0.1;

/// Smallest size of a state in the computation of its absolute tolerance, relative to the largest state of
/// the motion.
const NEGLIGIBLE: f64 = 1e-6;

/// The march of a point.
#[derive(Clone, Copy, Debug)]
pub(super) struct March<const N: usize> {
    strobe: Strobe<N>,
    /// Typical sizes of the states.
    scale: [f64; N],
    /// Largest magnitude of each state so far.
    largest: [f64; N],
    /// Length in drive periods of the orbit on which the march has settled.
    period: Option<u32>,
    max_cycles: u32,
    /// Number of marched drive periods at which Newton's iteration is tried next. The value is `None` if
    /// Newton's iteration is not used.
    next_try: Option<u32>,
}

impl<const N: usize> March<N> {
    /// Returns a march that begins at the state `y` and has at most `max_cycles` drive periods. If `nearby`
    /// is true, `y` may be close to the orbit.
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

    /// Adds to the march the state at the end of a period, and the largest magnitude that each state has
    /// reached.
    pub(super) fn period_end(&mut self, y: &[f64; N], largest: &[f64; N]) {
        for i in 0..N {
            self.largest[i] = self.largest[i].max(largest[i]);
        }
        self.period = self.strobe.period_end(y);
    }

    /// Returns the length in drive periods of the orbit on which the march has settled.
    pub(super) fn period(&self) -> Option<u32> {
        self.period
    }

    /// Returns true if a state is far smaller than its size in `assumed`. The tolerance of the state was
    /// computed from the size in `assumed`. The result is true only after [`SIZED`] periods.
    pub(super) fn is_oversized(&self, assumed: &[f64; N]) -> bool {
        let size = self.motion_size();
        self.strobe.cycles() == SIZED && (0..N).any(|i| size[i] < 0.5 * assumed[i])
    }

    /// Returns the size of each state from which its absolute tolerance is computed. The result is the
    /// typical size of the state, or less if the state stays small.
    pub(super) fn motion_size(&self) -> [f64; N] {
        let relative: [f64; N] = core::array::from_fn(|i| self.largest[i] / self.scale[i]);
        let overall = relative.iter().fold(0.0_f64, |size, &one| size.max(one));
        // A motion at rest has no size.
        if overall == 0.0 {
            return self.scale;
        }
        core::array::from_fn(|i| {
            let size = relative[i].max(overall * NEGLIGIBLE);
            self.scale[i] * (size / SMALL).min(1.0)
        })
    }

    /// Returns true if the march may be close to an orbit, so that Newton's iteration is worth trying.
    pub(super) fn is_promising(&self) -> bool {
        self.next_try.is_some_and(|next| self.strobe.cycles() >= next) && self.strobe.change(1) <= NEAR
    }

    /// Returns true if the march has integrated the largest allowed number of periods.
    pub(super) fn is_exhausted(&self) -> bool {
        self.strobe.cycles() >= self.max_cycles
    }

    /// Postpones the next attempt of Newton's iteration until the march has twice as many periods as now.
    pub(super) fn put_off_newton(&mut self) {
        self.next_try = Some(2 * self.strobe.cycles());
    }

    /// Returns the state at the end of the last period.
    pub(super) fn state(&self) -> &[f64; N] {
        self.strobe.state()
    }

    /// Returns the state at the beginning of the last period.
    pub(super) fn before(&self) -> &[f64; N] {
        self.strobe.before()
    }

    /// Returns the number of marched drive periods.
    pub(super) fn cycles(&self) -> u32 {
        self.strobe.cycles()
    }

    /// Returns the change of the state over the last `periods` drive periods. The result is NaN if the march
    /// has fewer than `periods` drive periods.
    pub(super) fn change(&self, periods: u32) -> f64 {
        self.strobe.change(periods)
    }
}

/// Returns the factor by which the absolute tolerances are multiplied for an orbit through the state `y`. The
/// factor is less than 1 if all components of `y` are small.
pub(super) fn share_of_tolerance<const N: usize>(y: &[f64; N], scale: &[f64; N]) -> f64 {
    let overall = (0..N).fold(0.0_f64, |size, i| size.max(y[i].abs() / scale[i]));
    if overall == 0.0 { 1.0 } else { (overall / SMALL).min(1.0) }
}
