//! The last steps of a search: chord steps at the tolerance of the row, and the confirmation of the orbit.

use super::chord::Chord;
use super::full::{FINER, JUMPS};
use super::newton::{FixedPoint, Newton, Step};
use super::next::Next;
use super::state::{Search, Stage};

/// The largest distance between the orbits of two tolerances of a search, in units of the states' typical
/// sizes.
pub(super) const APART: f64 = 0.1;

/// The factor by which a chord step at full tolerance is presumed to make a residual fall.
const PRESUMED: f64 = 100.0;

/// The most times that a point is integrated again for its row's accuracy.
const REFINEMENTS: u32 = 3;

/// The smallest residual that Newton's iteration aims at.
const SMALLEST_GOAL: f64 = 1e-10;

impl<const N: usize> Search<N> {
    /// Tightens the tolerances of an orbit whose row may err by `doubt` where `accuracy` is asked for. Returns the state
    /// from which it is to be found again; `None` if the row is good enough, or cannot be made better.
    pub(in crate::simulate) fn refine(&mut self, doubt: f64, accuracy: f64) -> Option<[f64; N]> {
        let enough = doubt <= accuracy || self.refinements == REFINEMENTS || self.precision.is_finest();
        let orbit = self.found.filter(|_| !enough)?;
        // The error goes about as the tolerances do.
        let factor = if doubt.is_finite() { (0.25 * accuracy / doubt).clamp(1e-3, 0.125) } else { FINER };
        self.precision.tighten(factor);
        self.refinements += 1;
        self.stage = Stage::Refining;
        self.fallback = None;
        self.found = None;
        let goal = (self.tolerance * self.precision.factor()).max(SMALLEST_GOAL).min(self.tolerance);
        self.newton = Newton::new(&orbit.y, &self.scale, self.tolerance).aiming_at(goal).allowing(APART);
        Some(orbit.y)
    }

    /// The step after a period with its responses at a tighter tolerance, from the orbit of the last one.
    pub(super) fn refined<const K: usize>(&mut self, all: Option<&[f64; K]>) -> Next<N> {
        let Some(point) = all.and_then(|all| self.newton.linearised(all)) else { return Next::Done };
        let chord = Chord::new(point);
        self.stage = Stage::Closing(chord);
        let presumed = self.newton.is_enough(point.residual / PRESUMED);
        if presumed { self.take(point, Some(chord)) } else { Next::March(point.y) }
    }

    /// The step after a chord step at the tolerance of the row.
    pub(super) fn close(&mut self, mut chord: Chord<N>) -> Next<N> {
        let presumed = if chord.is_disproved() { 1.0 } else { PRESUMED };
        let step = chord.step(&self.newton, presumed * self.newton.goal());
        self.stage = Stage::Closing(chord);
        match step {
            Step::Again(y) => Next::March(y),
            Step::Found(point) => self.take(point, Some(chord).filter(|chord| !chord.is_disproved())),
            Step::Stuck(residual) if residual <= self.tolerance => {
                self.take(FixedPoint { residual, ..chord.point() }, None)
            }
            Step::Stuck(residual) if residual <= JUMPS * self.tolerance && !self.precision.is_finest() => {
                self.precision.tighten(FINER);
                self.stage = Stage::Closing(Chord::new(chord.point()));
                Next::March(chord.y())
            }
            Step::Stuck(_) | Step::Failed => self.fall_back(),
        }
    }

    /// Takes the orbit to which the last chord step has led; `presumed` if its residual is still to be confirmed.
    pub(super) fn take(&mut self, point: FixedPoint<N>, presumed: Option<Chord<N>>) -> Next<N> {
        if self.newton.leads_to(&point) { self.measure(point, presumed) } else { self.fall_back() }
    }

    /// Takes the end of the orbit's period; `None` if the period could not be integrated. Returns the next step if the
    /// orbit turns out not to be one.
    pub(in crate::simulate) fn confirm(&mut self, end: Option<&[f64; N]>) -> Option<Next<N>> {
        let Stage::Known { presumed: Some(mut chord) } = self.stage else { return None };
        let Some(end) = end else { return Some(self.fall_back()) };
        chord.period_end(end);
        let residual = chord.residual(&self.newton);
        if self.newton.is_enough(residual) {
            self.found = self.found.map(|point| FixedPoint { residual, ..point });
            return None;
        }
        self.found = None;
        self.period = None;
        chord.disprove();
        Some(self.close(chord))
    }
}
