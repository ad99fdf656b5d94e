//! The search for the periodic orbit that a point approaches: marching, with Newton's iteration when the march is near.

use core::ops::ControlFlow;

use super::begin::varied;
use super::march::March;
use super::newton::{FixedPoint, Newton, Step, identity, product, spectral_radius};
use super::precision::Precision;
use super::settings::SolverSettings;
use crate::ode::{Ending, Outcome, Start};

/// The factor on the tolerances of a point whose period map jumps too much to find its fixed point.
const FINER: f64 = 1.0 / 32.0;

/// The residual, in units of `settle_tol`, below which such jumps are what an iteration is stuck in.
const JUMPS: f64 = 100.0;

/// The most times that a point is integrated again for its row's accuracy.
const REFINEMENTS: u32 = 3;

/// The smallest residual that Newton's iteration aims at.
const SMALLEST_GOAL: f64 = 1e-10;

/// The search for a point's orbit.
#[derive(Clone, Copy, Debug)]
pub(super) struct Search<const N: usize> {
    /// Typical sizes of the states.
    scale: [f64; N],
    /// The residual with which an orbit counts as found.
    tolerance: f64,
    precision: Precision<N>,
    /// Times that the point has been integrated again for its row's accuracy.
    refinements: u32,
    march: March<N>,
    newton: Newton<N>,
    /// Length in drive periods of the orbit on which the march has settled.
    period: Option<u32>,
    /// The orbit of one drive period.
    found: Option<FixedPoint<N>>,
    /// The way along an orbit of more drive periods.
    round: Option<Round<N>>,
    ending: Ending,
    cost: Cost,
}

/// The cost of a search, but for the periods of the march.
#[derive(Clone, Copy, Debug, Default)]
struct Cost {
    /// Drive periods of Newton's iteration, each integrated N + 1 times.
    periods_varied: u32,
    /// Drive periods along the orbit, to measure it.
    periods_measured: u32,
    rhs_evals: u64,
}

/// The way along a subharmonic orbit.
#[derive(Clone, Copy, Debug)]
struct Round<const N: usize> {
    /// Drive periods to go.
    left: u32,
    /// The monodromy matrix of the way so far, see [`Newton::monodromy`]; not numbers if a period failed.
    monodromy: [[f64; N]; N],
}

/// The next step of a search.
pub(super) enum Next<const N: usize> {
    /// Marching from this state.
    March([f64; N]),
    /// A period from this state, with its responses to changes of it.
    Vary([f64; N]),
    /// None: the search has ended.
    Done,
}

impl<const N: usize> Search<N> {
    /// A search that begins at `start`; `nearby` if that is perhaps near the orbit.
    pub(super) fn new<C>(start: &Start<C, N>, solver: &SolverSettings, nearby: bool) -> Search<N> {
        let tolerance = solver.settle_tol;
        Search {
            scale: start.scale,
            tolerance,
            precision: Precision::new(start, solver),
            refinements: 0,
            march: March::new(start, solver, nearby),
            newton: Newton::new(&start.y, &start.scale, tolerance),
            period: None,
            found: None,
            round: None,
            ending: Ending::Stopped,
            cost: Cost::default(),
        }
    }

    /// Takes the state at the end of a marched period, with the largest magnitude of each state so far, and goes on
    /// marching or breaks.
    pub(super) fn period_end(&mut self, y: &[f64; N], largest: &[f64; N]) -> ControlFlow<()> {
        self.period = self.march.period_end(y, largest);
        if self.period.is_some() || self.march.is_to_pause(self.precision.size()) {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }

    /// The step after marching.
    pub(super) fn marched(&mut self, outcome: Outcome) -> Next<N> {
        self.cost.rhs_evals += outcome.rhs_evals;
        self.ending = outcome.ending;
        if self.ending != Ending::Stopped {
            return Next::Done;
        }
        self.precision.resize(self.march.motion_size());
        match self.period {
            Some(1) => {}
            None if self.march.is_promising() => {}
            None if self.march.is_exhausted() => return Next::Done,
            None => return Next::March(*self.march.state()),
            Some(period) => {
                self.round = Some(Round { left: period, monodromy: identity() });
            }
        }
        self.newton = Newton::new(self.march.state(), &self.scale, self.tolerance);
        Next::Vary(*self.march.state())
    }

    /// The step after a period with its responses; `None` if the period could not be integrated.
    pub(super) fn varied<const K: usize>(&mut self, all: Option<&[f64; K]>, outcome: Outcome) -> Next<N> {
        // Each evaluation is one of the states and one of each response.
        self.cost.rhs_evals += outcome.rhs_evals * (N as u64 + 1);
        self.cost.periods_varied += 1;
        if let Some(round) = &mut self.round {
            return round.pass(&self.newton, all);
        }
        let step = all.map_or(Step::Failed, |all| self.newton.judge(all));
        match step {
            Step::Again(y) => Next::Vary(y),
            Step::Found(point) => {
                self.period = Some(1);
                self.found = Some(point);
                Next::Done
            }
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
    fn give_up_newton<const K: usize>(&mut self, all: Option<&[f64; K]>) -> Next<N> {
        if self.refinements > 0 {
            return Next::Done;
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
            self.found = Some(FixedPoint { y, residual, monodromy, floquet_max });
            return Next::Done;
        }
        if self.march.is_exhausted() {
            return Next::Done;
        }
        self.march.put_off_newton();
        Next::March(*self.march.state())
    }

    /// Tightens the tolerances of an orbit whose row may err by `doubt` where `accuracy` is asked for. Returns the state
    /// from which it is to be found again; `None` if the row is good enough, or cannot be made better.
    pub(super) fn refine(&mut self, doubt: f64, accuracy: f64) -> Option<[f64; N]> {
        let enough = doubt <= accuracy || self.refinements == REFINEMENTS || self.precision.is_finest();
        let orbit = self.found.filter(|_| !enough)?;
        // The error goes about as the tolerances do.
        let factor = if doubt.is_finite() { (0.25 * accuracy / doubt).clamp(1e-3, 0.125) } else { FINER };
        self.precision.tighten(factor);
        self.refinements += 1;
        self.found = None;
        let goal = (self.tolerance * self.precision.factor()).max(SMALLEST_GOAL).min(self.tolerance);
        self.newton = Newton::new(&orbit.y, &self.scale, self.tolerance).aiming_at(goal);
        Some(orbit.y)
    }

    /// Adds the cost of a period along the orbit, which was integrated without responses.
    pub(super) fn charge(&mut self, outcome: Outcome) {
        self.cost.rhs_evals += outcome.rhs_evals;
        self.cost.periods_measured += 1;
    }

    /// The tolerances with which the point is integrated.
    pub(super) fn precision(&self) -> &Precision<N> {
        &self.precision
    }

    /// The beginning of a period from `y` with its responses to changes of `y`.
    pub(super) fn responding<C: Copy, const K: usize>(
        &self,
        start: &Start<C, N>,
        y: &[f64; N],
    ) -> Start<C, K> {
        varied(&self.precision.start(start, y), &self.scale)
    }

    /// The orbit of one drive period, if there is one.
    pub(super) fn orbit(&self) -> Option<&FixedPoint<N>> {
        self.found.as_ref()
    }

    /// The beginning of the orbit that coarser integration has, given the end of a period on its way from this
    /// search's orbit.
    pub(super) fn coarse_orbit(&self, end: &[f64; N]) -> Option<[f64; N]> {
        self.found.as_ref()?.of_map(&self.scale, end)
    }

    /// Length in drive periods of the orbit on which the march has settled.
    pub(super) fn period(&self) -> Option<u32> {
        self.period
    }

    /// The state at the end of the last period, on the orbit if there is one.
    pub(super) fn state(&self) -> Option<&[f64; N]> {
        let marched = (self.march.cycles() > 0).then(|| self.march.state());
        self.found.as_ref().map(|point| &point.y).or(marched)
    }

    /// Largest modulus of the orbit's Floquet multipliers; NaN if there is no orbit.
    pub(super) fn floquet_max(&self) -> f64 {
        let round = self.round.map_or(f64::NAN, |round| spectral_radius(&round.monodromy));
        self.found.map_or(round, |point| point.floquet_max)
    }

    /// The ending of the march.
    pub(super) fn ending(&self) -> Ending {
        self.ending
    }

    /// Drive periods integrated.
    pub(super) fn cycles(&self) -> u32 {
        let varied = self.cost.periods_varied * (u32::try_from(N).unwrap_or(0) + 1);
        self.march.cycles() + varied + self.cost.periods_measured
    }

    /// Change of the state over the orbit, or over the last period if there is none.
    pub(super) fn residual(&self) -> f64 {
        self.found.map_or_else(|| self.march.change(self.period.unwrap_or(1)), |point| point.residual)
    }

    /// Right-hand sides evaluated.
    pub(super) fn rhs_evals(&self) -> u64 {
        self.cost.rhs_evals
    }
}

impl<const N: usize> Round<N> {
    /// The step after a period of the orbit with its responses; `None` if the period could not be integrated.
    fn pass<const K: usize>(&mut self, newton: &Newton<N>, all: Option<&[f64; K]>) -> Next<N> {
        let Some(all) = all else {
            self.monodromy = [[f64::NAN; N]; N];
            return Next::Done;
        };
        self.monodromy = product(&newton.monodromy(all), &self.monodromy);
        self.left -= 1;
        if self.left == 0 { Next::Done } else { Next::Vary(core::array::from_fn(|i| all[i])) }
    }
}
