//! The search for the periodic orbit that a point approaches: marching, with Newton's iteration when the march is near.

use core::ops::ControlFlow;

use super::accuracy::COARSER;
use super::newton::{FixedPoint, Newton, Step, identity, product, spectral_radius};
use super::simulator::SolverSettings;
use crate::measure::strobe::Strobe;
use crate::model::Model;
use crate::ode::variation::initial;
use crate::ode::{Ending, Outcome, Start};
use crate::parameter::Invalid;

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

/// The finest tolerances at which a point is integrated again: relative to those that were asked for, and as `rtol`.
const FINEST: f64 = 1e-5;
const FINEST_RTOL: f64 = 1e-12;

/// The factor on the tolerances of a point whose period map jumps too much to find its fixed point.
const FINER: f64 = 1.0 / 32.0;

/// The residual, in units of `settle_tol`, below which such jumps are what an iteration is stuck in.
const JUMPS: f64 = 100.0;

/// The most times that a point is integrated again for its row's accuracy.
const REFINEMENTS: u32 = 3;

/// The smallest residual that Newton's iteration aims at.
const SMALLEST_GOAL: f64 = 1e-10;

/// Where a point's search has come to.
#[derive(Clone, Copy, Debug)]
pub(super) struct Search<const N: usize> {
    strobe: Strobe<N>,
    newton: Newton<N>,
    scale: [f64; N],
    /// The sizes of the states, of which the integrator's absolute tolerances are multiples.
    size: [f64; N],
    /// The largest magnitude that each state has reached.
    largest: [f64; N],
    /// The integrator's relative tolerance, and the factor on it and on the absolute ones.
    rtol: f64,
    tighten: f64,
    /// The smallest such factor.
    finest: f64,
    /// Times that the point has been integrated again for its row's accuracy.
    refinements: u32,
    tolerance: f64,
    max_cycles: u32,
    /// Periods marched before Newton's iteration is tried next; `None` if it never is.
    next_try: Option<u32>,
    /// Drive periods of Newton's iteration, each integrated N + 1 times.
    periods_varied: u32,
    /// Drive periods along the orbit, to measure it.
    periods_measured: u32,
    /// Length in drive periods of the orbit on which the march has settled.
    period: Option<u32>,
    found: Option<FixedPoint<N>>,
    round: Option<Round<N>>,
    ending: Ending,
    rhs_evals: u64,
}

/// The way along a subharmonic orbit.
#[derive(Clone, Copy, Debug)]
struct Round<const N: usize> {
    /// Drive periods to go.
    left: u32,
    /// What becomes of a change until here, see [`Newton::monodromy`]; not numbers if a period failed.
    monodromy: [[f64; N]; N],
}

/// How a search goes on.
pub(super) enum Next<const N: usize> {
    /// Marching from this state.
    March([f64; N]),
    /// With a period from this state and its responses to changes of it.
    Vary([f64; N]),
    /// Not at all.
    Done,
}

impl<const N: usize> Search<N> {
    /// A search that begins at `start`; `nearby` if that is perhaps near the orbit.
    pub(super) fn new<C>(start: &Start<C, N>, solver: &SolverSettings, nearby: bool) -> Search<N> {
        let tolerance = solver.settle_tol;
        Search {
            strobe: Strobe::new(&start.y, &start.scale, tolerance),
            newton: Newton::new(&start.y, &start.scale, tolerance),
            scale: start.scale,
            size: start.scale,
            largest: [0.0; N],
            rtol: solver.rtol,
            tighten: start.tighten,
            finest: start.tighten * FINEST.max(FINEST_RTOL / solver.rtol).min(1.0),
            refinements: 0,
            tolerance,
            max_cycles: solver.max_cycles,
            next_try: solver.newton.then_some(if nearby { FIRST_TRY_NEARBY } else { FIRST_TRY }),
            periods_varied: 0,
            periods_measured: 0,
            period: None,
            found: None,
            round: None,
            ending: Ending::Stopped,
            rhs_evals: 0,
        }
    }

    /// Takes the state at the end of a marched period, with the largest magnitude of each state so far, and goes on
    /// marching or breaks.
    pub(super) fn period_end(&mut self, y: &[f64; N], largest: &[f64; N]) -> ControlFlow<()> {
        self.period = self.strobe.period_end(y);
        for i in 0..N {
            self.largest[i] = self.largest[i].max(largest[i]);
        }
        if self.period.is_some() || self.is_promising() || self.is_exhausted() || self.is_oversized() {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }

    /// Whether the motion turns out to be far smaller than what its tolerances were chosen for.
    fn is_oversized(&self) -> bool {
        let size = self.motion_size();
        self.strobe.cycles() == SIZED && (0..N).any(|i| size[i] < 0.5 * self.size[i])
    }

    /// The sizes of the states in this motion: the typical ones, but for states that stay small.
    fn motion_size(&self) -> [f64; N] {
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

    fn is_promising(&self) -> bool {
        self.next_try.is_some_and(|next| self.strobe.cycles() >= next) && self.strobe.change(1) <= NEAR
    }

    fn is_exhausted(&self) -> bool {
        self.strobe.cycles() >= self.max_cycles
    }

    /// How to go on after marching.
    pub(super) fn marched(&mut self, outcome: Outcome) -> Next<N> {
        self.rhs_evals += outcome.rhs_evals;
        self.ending = outcome.ending;
        if self.ending != Ending::Stopped {
            return Next::Done;
        }
        self.size = self.motion_size();
        match self.period {
            Some(1) => {}
            None if self.is_promising() => {}
            None if self.is_exhausted() => return Next::Done,
            None => return Next::March(*self.strobe.state()),
            Some(period) => {
                self.round = Some(Round { left: period, monodromy: identity() });
            }
        }
        self.newton = Newton::new(self.strobe.state(), &self.scale, self.tolerance);
        Next::Vary(*self.strobe.state())
    }

    /// How to go on after a period with its responses; none if it could not be integrated.
    pub(super) fn varied<const K: usize>(&mut self, all: Option<&[f64; K]>, outcome: Outcome) -> Next<N> {
        // Each evaluation is one of the states and one of each response.
        self.rhs_evals += outcome.rhs_evals * (N as u64 + 1);
        self.periods_varied += 1;
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
            Step::Stuck(residual) if residual <= JUMPS * self.tolerance && self.tighten > self.finest => {
                self.tighten = (self.tighten * FINER).max(self.finest);
                let (newton, y) = self.newton.resumed();
                self.newton = newton;
                Next::Vary(y)
            }
            Step::Stuck(_) | Step::Failed => self.give_up_newton(all),
        }
    }

    /// Tightens the tolerances of an orbit whose row may err by `doubt` where `accuracy` is asked for. Returns the state from
    /// which it is to be found again; `None` if the row is good enough, or cannot be made better.
    pub(super) fn refine(&mut self, doubt: f64, accuracy: f64) -> Option<[f64; N]> {
        let enough = doubt <= accuracy || self.refinements == REFINEMENTS || self.tighten <= self.finest;
        let orbit = self.found.filter(|_| !enough)?;
        // The error goes about as the tolerances do.
        let factor = if doubt.is_finite() { (0.25 * accuracy / doubt).clamp(1e-3, 0.125) } else { FINER };
        self.tighten = (self.tighten * factor).max(self.finest);
        self.refinements += 1;
        self.found = None;
        let goal = (self.tolerance * self.tighten).max(SMALLEST_GOAL).min(self.tolerance);
        self.newton = Newton::new(&orbit.y, &self.scale, self.tolerance).aiming_at(goal);
        Some(orbit.y)
    }

    /// The relative tolerance with which the point is integrated.
    pub(super) fn rtol(&self) -> f64 {
        self.rtol * self.tighten
    }

    /// Adds the cost of a period along the orbit, which was integrated without responses.
    pub(super) fn charge(&mut self, outcome: Outcome) {
        self.rhs_evals += outcome.rhs_evals;
        self.periods_measured += 1;
    }

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
            let (y, residual) = (*self.strobe.state(), self.strobe.change(1));
            self.found = Some(FixedPoint { y, residual, monodromy, floquet_max });
            return Next::Done;
        }
        if self.is_exhausted() {
            return Next::Done;
        }
        self.next_try = Some(2 * self.strobe.cycles());
        Next::March(*self.strobe.state())
    }

    /// The orbit of one drive period, if there is one.
    pub(super) fn orbit(&self) -> Option<&FixedPoint<N>> {
        self.found.as_ref()
    }

    /// Length in drive periods of the orbit on which the march has settled.
    pub(super) fn period(&self) -> Option<u32> {
        self.period
    }

    /// The state at the end of the last period, on the orbit if there is one.
    pub(super) fn state(&self) -> Option<&[f64; N]> {
        let marched = (self.strobe.cycles() > 0).then(|| self.strobe.state());
        self.found.as_ref().map(|point| &point.y).or(marched)
    }

    /// The point's run from `y`, with the tolerances that its motion needs.
    pub(super) fn start<C: Copy>(&self, start: &Start<C, N>, y: &[f64; N]) -> Start<C, N> {
        Start { y: *y, scale: self.size, tighten: self.tighten, ..*start }
    }

    /// The beginning of a period from `y` with its responses to changes of `y`.
    pub(super) fn responding<C: Copy, const K: usize>(
        &self,
        start: &Start<C, N>,
        y: &[f64; N],
    ) -> Start<C, K> {
        varied(&self.start(start, y), &self.scale)
    }

    /// The beginning of a period that is integrated with coarser tolerances, for comparison.
    pub(super) fn coarse<C: Copy>(&self, start: &Start<C, N>, y: &[f64; N]) -> Start<C, N> {
        Start { tighten: self.tighten * COARSER, ..self.start(start, y) }
    }

    /// The beginning of the orbit that coarser integration has, given the end of a period on its way from this
    /// search's orbit.
    pub(super) fn coarse_orbit(&self, end: &[f64; N]) -> Option<[f64; N]> {
        self.found.as_ref()?.of_map(&self.scale, end)
    }

    /// Largest modulus of the orbit's Floquet multipliers; NaN if there is no orbit.
    pub(super) fn floquet_max(&self) -> f64 {
        let round = self.round.map_or(f64::NAN, |round| spectral_radius(&round.monodromy));
        self.found.map_or(round, |point| point.floquet_max)
    }

    /// Why the search has ended.
    pub(super) fn ending(&self) -> Ending {
        self.ending
    }

    /// Drive periods integrated.
    pub(super) fn cycles(&self) -> u32 {
        let varied = self.periods_varied * (u32::try_from(N).unwrap_or(0) + 1);
        self.strobe.cycles() + varied + self.periods_measured
    }

    /// Change of the state over the orbit, or over the last period if there is none.
    pub(super) fn residual(&self) -> f64 {
        self.found.map_or_else(|| self.strobe.change(self.period.unwrap_or(1)), |point| point.residual)
    }

    /// Right-hand sides evaluated.
    pub(super) fn rhs_evals(&self) -> u64 {
        self.rhs_evals
    }
}

impl<const N: usize> Round<N> {
    /// Goes on after a period of the orbit with its responses; none if it could not be integrated.
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

/// The run of a point, from rest or another state.
pub(super) fn begin<M: Model<N, S>, const N: usize, const S: usize>(
    model: &M,
    values: &[f64],
    from: Option<&[f64]>,
) -> Result<Start<M::Constants<f64>, N>, Invalid> {
    let mut start = model.start(values)?;
    if let Some(from) = from {
        let finite = from.iter().all(|y| y.is_finite());
        start.y = from.try_into().ok().filter(|_| finite).ok_or_else(|| {
            Invalid::new(format!("the motion cannot begin at {from:?}: a state is {N} finite numbers"))
        })?;
    }
    Ok(start)
}

/// Where a period begins with its responses to changes of its beginning, each by `change`.
pub(super) fn varied<C: Copy, const N: usize, const K: usize>(
    start: &Start<C, N>,
    change: &[f64; N],
) -> Start<C, K> {
    // Step sizes depend on the states alone; the responses' scales are never used.
    let mut scale = [1.0; K];
    scale[..N].copy_from_slice(&start.scale);
    Start {
        constants: start.constants,
        y: initial(&start.y, change),
        span: start.span,
        scale,
        tighten: start.tighten,
    }
}
