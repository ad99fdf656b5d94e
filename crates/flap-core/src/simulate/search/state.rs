//! The state of a search: its stage, the march, the iteration, the orbit, and the cost.

use super::chord::Chord;
use super::cost::Cost;
use super::march::March;
use super::newton::{FixedPoint, Newton};
use super::next::Next;
use super::precision::Precision;
use super::round::Round;
use crate::ode::{Ending, Outcome, Start};
use crate::simulate::begin::varied;
use crate::simulate::settings::SolverSettings;

/// The search for a point's orbit.
#[derive(Clone, Copy, Debug)]
pub(in crate::simulate) struct Search<const N: usize> {
    /// Typical sizes of the states.
    pub(super) scale: [f64; N],
    /// The residual with which an orbit counts as found.
    pub(super) tolerance: f64,
    pub(super) precision: Precision<N>,
    pub(super) stage: Stage<N>,
    /// The march at full tolerance and its beginning, to which a search with progressive tolerances falls back.
    pub(super) fallback: Option<(March<N>, [f64; N])>,
    /// Times that the point has been integrated again for its row's accuracy.
    pub(super) refinements: u32,
    pub(super) march: March<N>,
    pub(super) newton: Newton<N>,
    /// Length in drive periods of the orbit on which the march has settled.
    pub(super) period: Option<u32>,
    /// The orbit of one drive period.
    pub(super) found: Option<FixedPoint<N>>,
    /// The beginning of the orbit that coarser tolerances have.
    pub(super) coarse: Option<[f64; N]>,
    /// The way along an orbit of more drive periods.
    pub(super) round: Option<Round<N>>,
    pub(super) ending: Ending,
    pub(super) cost: Cost,
}

/// The stage of a search.
#[derive(Clone, Copy, Debug)]
pub(super) enum Stage<const N: usize> {
    /// March and Newton's iteration at a loose tolerance.
    Loose,
    /// Chord steps at the loose tolerance.
    Nearing(Chord<N>),
    /// Chord steps at the middle tolerance.
    Approaching(Chord<N>),
    /// Newton's iteration at the middle tolerance, for the linear map of the last steps.
    Mapping,
    /// Chord steps at the tolerance of the row.
    Closing(Chord<N>),
    /// March and Newton's iteration at full tolerance.
    Full,
    /// A step of Newton's iteration at a tighter tolerance, from an orbit whose row is not accurate enough.
    Refining,
    /// The orbit is known. A period at coarser tolerances leads to the orbit that these have. An orbit that chord steps
    /// presume is still to be confirmed.
    Known { presumed: Option<Chord<N>> },
}

impl<const N: usize> Search<N> {
    /// A search at full tolerance that begins at `start`; `nearby` if that is perhaps near the orbit.
    pub(super) fn at_full_tolerance<C>(
        start: &Start<C, N>,
        solver: &SolverSettings,
        nearby: bool,
    ) -> Search<N> {
        Search {
            scale: start.scale,
            tolerance: solver.settle_tol,
            precision: Precision::new(start, solver),
            stage: Stage::Full,
            fallback: None,
            refinements: 0,
            march: March::new(start, solver, nearby),
            newton: Newton::new(&start.y, &start.scale, solver.settle_tol),
            period: None,
            found: None,
            coarse: None,
            round: None,
            ending: Ending::Stopped,
            cost: Cost::default(),
        }
    }

    /// Takes an orbit of one drive period; `presumed` if its own period has not been integrated yet.
    pub(super) fn measure(&mut self, point: FixedPoint<N>, presumed: Option<Chord<N>>) -> Next<N> {
        self.stage = Stage::Known { presumed };
        self.period = Some(1);
        self.found = Some(point);
        self.coarse = None;
        Next::March(point.y)
    }

    /// Adds the cost of a period of the states alone.
    pub(in crate::simulate) fn charge(&mut self, outcome: Outcome) {
        self.cost.add_period(outcome, 1);
    }

    /// The beginning of periods of the states alone, from `y`.
    pub(in crate::simulate) fn marching<C: Copy>(&self, start: &Start<C, N>, y: &[f64; N]) -> Start<C, N> {
        match self.stage {
            Stage::Known { .. } => self.precision.coarse(start, y),
            _ => self.precision.start(start, y),
        }
    }

    /// The beginning of a period from `y` with its responses to changes of `y`.
    pub(in crate::simulate) fn responding<C: Copy, const K: usize>(
        &self,
        start: &Start<C, N>,
        y: &[f64; N],
    ) -> Start<C, K> {
        varied(&self.precision.start(start, y), &self.scale)
    }

    /// The beginning of the orbit's period, if there is one.
    pub(in crate::simulate) fn orbit<C: Copy>(&self, start: &Start<C, N>) -> Option<Start<C, N>> {
        self.found.map(|point| self.from(start, &point.y))
    }

    /// The beginning of a run from `y` with the tolerances of the search.
    pub(in crate::simulate) fn from<C: Copy>(&self, start: &Start<C, N>, y: &[f64; N]) -> Start<C, N> {
        self.precision.start(start, y)
    }

    /// The beginning of the orbit's period that coarser integration has, if it is known.
    pub(in crate::simulate) fn coarse_orbit<C: Copy>(&self, start: &Start<C, N>) -> Option<Start<C, N>> {
        self.coarse.map(|y| self.precision.coarse(start, &y))
    }

    /// The relative tolerance of the orbit.
    pub(in crate::simulate) fn rtol(&self) -> f64 {
        self.precision.rtol()
    }

    /// Length in drive periods of the orbit on which the march has settled.
    pub(in crate::simulate) fn period(&self) -> Option<u32> {
        self.period
    }

    /// The state at the end of the last period, on the orbit if there is one.
    pub(in crate::simulate) fn state(&self) -> Option<&[f64; N]> {
        let marched = (self.march.cycles() > 0).then(|| self.march.state());
        self.found.as_ref().map(|point| &point.y).or(marched)
    }

    /// Largest modulus of the orbit's Floquet multipliers; NaN if there is no orbit.
    pub(in crate::simulate) fn floquet_max(&self) -> f64 {
        let round = self.round.map_or(f64::NAN, |round| round.floquet_max());
        self.found.map_or(round, |point| point.floquet_max)
    }

    /// The ending of the march.
    pub(in crate::simulate) fn ending(&self) -> Ending {
        self.ending
    }

    /// Drive periods integrated.
    pub(in crate::simulate) fn cycles(&self) -> u32 {
        self.cost.periods() + self.march.cycles()
    }

    /// Change of the state over the orbit, or over the last period if there is none.
    pub(in crate::simulate) fn residual(&self) -> f64 {
        self.found.map_or_else(|| self.march.change(self.period.unwrap_or(1)), |point| point.residual)
    }

    /// Right-hand sides evaluated.
    pub(in crate::simulate) fn rhs_evals(&self) -> u64 {
        self.cost.rhs_evals()
    }
}
