//! The search at full tolerance: Newton's iteration where the march is near an orbit.

use super::newton::{FixedPoint, Step};
use super::next::Next;
use super::state::{Search, Stage};
use crate::measure::multipliers::spectral_radius;
use crate::ode::Ending;

/// The factor on the tolerances of a point whose period map jumps too much to find its fixed point.
pub(super) const FINER: f64 = 1.0 / 32.0;

/// The residual, in units of `settle_tol`, below which such jumps are what an iteration is stuck in.
pub(super) const JUMPS: f64 = 100.0;

impl<const N: usize> Search<N> {
    /// The step after an iteration at full tolerance.
    pub(super) fn iterate<const K: usize>(&mut self, all: Option<&[f64; K]>) -> Next<N> {
        match all.map_or(Step::Failed, |all| self.newton.judge(all)) {
            Step::Again(y) => Next::Vary(y),
            Step::Found(point) => self.measure(point, None),
            Step::Stuck(residual) if residual <= JUMPS * self.tolerance && !self.precision.is_finest() => {
                self.precision.tighten(FINER);
                let (newton, y) = self.newton.resumed();
                self.newton = newton;
                Next::Vary(y)
            }
            Step::Stuck(_) | Step::Failed => self.give_up_newton(all),
        }
    }

    /// The step after an iteration that has not found an orbit.
    pub(super) fn give_up_newton<const K: usize>(&mut self, all: Option<&[f64; K]>) -> Next<N> {
        if self.fallback.is_some() && (self.period == Some(1) || self.march.is_exhausted()) {
            return self.fall_back();
        }
        if self.period == Some(1) {
            // The march has settled: its state jitters more than Newton's iteration may leave.
            let Some(all) = all else {
                self.period = None;
                return Next::Done;
            };
            let monodromy = self.newton.monodromy(all);
            let floquet_max = spectral_radius(&monodromy);
            let (y, residual) = (*self.march.state(), self.march.change(1));
            return self.measure(FixedPoint { y, residual, monodromy, floquet_max }, None);
        }
        if self.march.is_exhausted() {
            return Next::Done;
        }
        self.march.put_off_newton();
        Next::March(*self.march.state())
    }

    /// Begins again at full tolerance. A search without progressive tolerances has ended.
    pub(super) fn fall_back(&mut self) -> Next<N> {
        let Some((march, y)) = self.fallback.take() else { return Next::Done };
        self.cost.add_march(self.march.cycles());
        self.march = march;
        self.precision.begin_again(&self.scale);
        self.stage = Stage::Full;
        self.period = None;
        self.found = None;
        self.ending = Ending::Stopped;
        Next::March(y)
    }
}
