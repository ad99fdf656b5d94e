//! The search with progressive tolerances: the same orbit as at full tolerance, for about half the work.
//!
//! The search marches at a loose tolerance until it is near an orbit, and goes onto that by a step of Newton's iteration and
//! chord steps. The orbit of the middle tolerance is near. There, Newton's iteration gives the monodromy matrix, of which
//! come the multipliers of the row, and with which chord steps go on at full tolerance: each takes one period of the states
//! alone. The orbit's own period, measured, confirms the last step.
//!
//! Where a stage fails, or the orbit is close to the limit of stability, the search falls back: it begins again, at rest and
//! at full tolerance.

use super::chord::Chord;
use super::closing::APART;
use super::newton::Step;
use super::next::Next;
use super::state::{Search, Stage};
use crate::simulate::settings::SolverSettings;

/// The loose tolerance: the relative tolerance with which the search begins.
const LOOSE: f64 = 3e-4;

/// The largest relative tolerance for which there are progressive tolerances.
const LARGEST: f64 = 1e-5;

/// The middle tolerance, as a multiple of the square root of the relative tolerance asked for. Around the presets, multipliers
/// then err by less than 5e-3 at `rtol` 1e-6, and by less than 1e-3 at 1e-8: see `tests/core/floquet.rs`.
const MIDDLE: f64 = 4e-3;

/// The most drive periods marched at the loose tolerance.
const LONGEST: u32 = 16;

/// The largest residual of the orbit at the loose tolerance. The period map of this tolerance jumps by less.
const NEAR: f64 = 1e-2;

/// The residual of a march that is as near as an iteration at the loose tolerance comes.
const NEARER: f64 = 1e-3;

/// The residual at the middle tolerance below which one more chord step is the last.
const NEAREST: f64 = 3e-4;

/// The drive periods up to which a march that has come [`NEAR`] goes on until it is [`NEARER`]: it is about to arrive.
const COASTING: u32 = 9;

/// Largest Floquet multipliers so near the limit of stability that they are computed at full tolerance.
const DOUBTFUL: core::ops::RangeInclusive<f64> = 0.95..=1.05;

impl<const N: usize> Search<N> {
    /// The same search from `y` with progressive tolerances, if the tolerance asked for is tight enough.
    pub(super) fn loosened(mut self, y: &[f64; N], solver: &SolverSettings) -> Search<N> {
        if self.precision.rtol() <= LARGEST && solver.max_cycles > LONGEST {
            self.fallback = Some((self.march, *y));
            self.stage = Stage::Loose;
            self.precision.loosen_to(LOOSE);
            self.march = self.march.at_most(LONGEST);
        }
        self
    }

    /// True if the march is about to arrive at its orbit.
    pub(super) fn coasts(&self) -> bool {
        let change = self.march.change(1);
        matches!(self.stage, Stage::Loose)
            && change <= NEAR
            && change > NEARER
            && self.march.cycles() < COASTING
    }

    /// The step after the march at the loose tolerance.
    pub(super) fn iterate_loosely(&mut self) -> Next<N> {
        self.newton = self.newton.aiming_at(NEAR.max(self.tolerance)).allowing(NEAR);
        if self.march.change(1) > NEARER {
            return Next::Vary(*self.march.state());
        }
        self.newton = self.newton.after(self.march.before(), self.march.state());
        self.approach_from(Chord::marching(*self.march.state()))
    }

    /// The step after a period with its responses at the loose tolerance.
    pub(super) fn vary_loosely<const K: usize>(&mut self, all: Option<&[f64; K]>) -> Next<N> {
        match (all.map_or(Step::Failed, |all| self.newton.judge(all)), all) {
            (Step::Again(y), Some(all)) => {
                self.stage = Stage::Nearing(Chord::new(self.newton.point(y, all)));
                Next::March(y)
            }
            (Step::Found(point), _) => self.approach_from(Chord::new(point)),
            _ => self.give_up_newton(all),
        }
    }

    /// The step after a chord step at the loose tolerance.
    pub(super) fn near(&mut self, mut chord: Chord<N>) -> Next<N> {
        let step = chord.step(&self.newton, NEAR);
        self.stage = Stage::Nearing(chord);
        match step {
            Step::Again(y) => Next::March(y),
            Step::Found(point) if self.newton.leads_to(&point) => self.approach_from(Chord::new(point)),
            _ => {
                self.stage = Stage::Loose;
                self.newton = self.newton.moved_to(chord.y());
                Next::Vary(chord.y())
            }
        }
    }

    /// Goes on at the middle tolerance.
    fn approach_from(&mut self, chord: Chord<N>) -> Next<N> {
        self.precision.loosen_to(MIDDLE * self.precision.asked_rtol().sqrt());
        self.stage = Stage::Approaching(chord);
        Next::March(chord.y())
    }

    /// The square root of the relative tolerance asked for: the largest residual, at the middle tolerance, of the orbit
    /// whose monodromy matrix is taken.
    fn mapped_residual(&self) -> f64 {
        self.precision.asked_rtol().sqrt()
    }

    /// The step after a chord step at the middle tolerance.
    pub(super) fn approach(&mut self, mut chord: Chord<N>) -> Next<N> {
        let step = chord.step(&self.newton, NEAREST);
        self.stage = Stage::Approaching(chord);
        if let Step::Again(y) = step {
            return Next::March(y);
        }
        self.stage = Stage::Mapping;
        self.newton = self.newton.resumed_at(chord.y()).aiming_at(self.mapped_residual()).allowing(APART);
        Next::Vary(chord.y())
    }

    /// The step after a period with its responses at the middle tolerance.
    pub(super) fn map<const K: usize>(&mut self, all: Option<&[f64; K]>) -> Next<N> {
        match all.map_or(Step::Failed, |all| self.newton.judge(all)) {
            Step::Again(y) => Next::Vary(y),
            Step::Found(point) if DOUBTFUL.contains(&point.floquet_max) => self.fall_back(),
            Step::Found(point) => {
                self.precision.restore();
                self.newton = self.newton.aiming_at(self.tolerance);
                let chord = Chord::new(point);
                self.stage = Stage::Closing(chord);
                // The orbit of the middle tolerance is that near to the one of full tolerance.
                if self.tolerance >= NEAREST { self.take(point, Some(chord)) } else { Next::March(point.y) }
            }
            Step::Stuck(_) | Step::Failed => self.fall_back(),
        }
    }
}
