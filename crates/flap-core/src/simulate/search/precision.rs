//! The tolerances with which a point is integrated: those of its motion's size, tightened where they do not suffice.

use crate::ode::Start;
use crate::simulate::settings::SolverSettings;

/// The finest tolerances at which a point is integrated again: relative to those that were asked for, and as `rtol`.
const FINEST: f64 = 1e-5;
const FINEST_RTOL: f64 = 1e-12;

/// The factor between the tolerances of a row and those, coarser, with which it is compared.
const COARSER: f64 = 64.0;

/// The tolerances of a point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Precision<const N: usize> {
    /// The sizes of the states, of which the integrator's absolute tolerances are multiples.
    size: [f64; N],
    /// The relative tolerance that was asked for.
    rtol: f64,
    /// The factor on the relative tolerance and on the absolute ones: that of the point, and the one now.
    asked: f64,
    tighten: f64,
    /// The smallest such factor.
    finest: f64,
}

impl<const N: usize> Precision<N> {
    /// The tolerances with which the point that begins at `start` is integrated first.
    pub(super) fn new<C>(start: &Start<C, N>, solver: &SolverSettings) -> Precision<N> {
        Precision {
            size: start.scale,
            rtol: solver.rtol,
            asked: start.tighten,
            tighten: start.tighten,
            finest: start.tighten * FINEST.max(FINEST_RTOL / solver.rtol).min(1.0),
        }
    }

    /// The sizes of the states to which tolerances are relative.
    pub(super) fn size(&self) -> &[f64; N] {
        &self.size
    }

    /// Makes the absolute tolerances multiples of other sizes of the states.
    pub(super) fn resize(&mut self, size: [f64; N]) {
        self.size = size;
    }

    /// True if tolerances cannot be tightened any more.
    pub(super) fn is_finest(&self) -> bool {
        self.tighten <= self.finest
    }

    /// Multiplies the tolerances by `factor`, down to the finest.
    pub(super) fn tighten(&mut self, factor: f64) {
        self.tighten = (self.tighten * factor).max(self.finest);
    }

    /// Loosens the tolerances to the relative tolerance `rtol`, or to that asked for if it is looser.
    pub(super) fn loosen_to(&mut self, rtol: f64) {
        self.tighten = self.asked * (rtol / self.rtol).max(1.0);
    }

    /// The relative tolerance that was asked for.
    pub(super) fn asked_rtol(&self) -> f64 {
        self.rtol * self.asked
    }

    /// Returns to the tolerances that were asked for, relative to these sizes of the states.
    pub(super) fn begin_again(&mut self, size: &[f64; N]) {
        self.size = *size;
        self.restore();
    }

    /// Returns to the tolerances that were asked for.
    pub(super) fn restore(&mut self) {
        self.tighten = self.asked;
    }

    /// The factor on the tolerances that were asked for.
    pub(super) fn factor(&self) -> f64 {
        self.tighten
    }

    /// The relative tolerance.
    pub(super) fn rtol(&self) -> f64 {
        self.rtol * self.tighten
    }

    /// The point's run from `y`, with these tolerances.
    pub(super) fn start<C: Copy>(&self, start: &Start<C, N>, y: &[f64; N]) -> Start<C, N> {
        Start { y: *y, scale: self.size, tighten: self.tighten, ..*start }
    }

    /// The point's run from `y`, with coarser tolerances, for comparison.
    pub(super) fn coarse<C: Copy>(&self, start: &Start<C, N>, y: &[f64; N]) -> Start<C, N> {
        Start { tighten: self.tighten * COARSER, ..self.start(start, y) }
    }
}
