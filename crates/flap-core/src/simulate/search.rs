//! The search for the settled motion of a point, from the first integrated drive period to the row of the
//! point.
//!
//! [`Search::settle`] consists of these stages:
//!
//! 1. **Find.** flap integrates one drive period after another from rest, until Newton's iteration leads to a
//!    nearby periodic orbit. A loose tolerance is sufficient to find this nearby orbit.
//! 2. **Middle.** flap finds the orbit and computes its measures at a middle tolerance, between the loose
//!    tolerance and the tolerance of the row. The error estimate of the row is computed from the difference
//!    between the measures at the middle tolerance and the measures of the row.
//! 3. **Approach.** Steps of Broyden's method move the state close to the orbit of the row. In this code,
//!    these steps are called chord steps. The periods of these steps are integrated at the tolerance of the
//!    row. The monodromy matrix is computed from a period with responses to changes of the initial state. A
//!    Newton step with the monodromy matrix moves the state to the orbit of the row. The period of this orbit
//!    is then integrated and measured, which also confirms that the motion returns to its initial state.
//! 4. **Judge.** If a row is not accurate enough, the row is computed again with tighter tolerances, from the
//!    orbit that was found.
//!
//! If the equations are [symmetric](Symmetry), the orbit is probably also symmetric. For a symmetric orbit,
//! Newton's iteration, Broyden's method and the measured periods integrate half a period, and the final state
//! is mirrored. The march always integrates whole periods. If no symmetric orbit is found, the search
//! continues with whole periods.
//!
//! If the search at the loose tolerance fails, the search begins again from rest, at the tolerance of the
//! row.
//!
//! A search does not integrate: it requests the integration of drive periods and waits for the results (see
//! [`periods`](super::periods)). A driver integrates the periods of many points in lanes (see
//! [`lanes`](super::lanes)).

use std::rc::Rc;

use super::march::March;
use super::orbit_row::{self, MeasuredOrbit};
use super::period_map::{Chord, Marched, Orbit, PROGRESS, fixed_point};
use super::periods::{Exchange, Kind, PeriodEnd, Request};
use super::row::{Row, Status};
use super::settings::SolverSettings;
use crate::measure::cycle::{SumsOf, over_both_halves};
use crate::measure::multipliers::{Matrix, identity, product, spectral_radius};
use crate::measure::strobe::{self, distance};
use crate::model::{Model, Symmetry};
use crate::ode::ensemble::Restart;
use crate::ode::{Ending, Outcome, Start, input, slope};

/// Relative tolerance at the beginning of a search, if the relative tolerance of the row is at most
/// [`LOOSE_FOR`]. If the relative tolerance of the row is larger than [`LOOSE_FOR`], the search begins at the
/// tolerance of the row.
const LOOSE_RTOL: f64 = 3e-4;

/// Largest relative tolerance of a row whose search begins at [`LOOSE_RTOL`]. For larger tolerances of the
/// row, a search at the loose tolerance costs more than it saves.
const LOOSE_FOR: f64 = 4e-6;

/// A wing at rest counts as stable if its Floquet multipliers exceed 1 by at most this amount.
const NEUTRAL: f64 = 1e-3;

/// Largest number of drive periods marched at the loose tolerance.
const LOOSE_CYCLES: u32 = 16;

/// Largest residual of an orbit that is found at the loose tolerance. The residual is larger than the jumps
/// of the period map that the step-size control causes at the loose tolerance.
const LOOSE_RESIDUAL: f64 = 1e-2;

/// Residual below which the march at the loose tolerance is as close to its orbit as the result of Newton's
/// iteration would be.
const ARRIVED: f64 = 1e-3;

/// A march with a residual between [`ARRIVED`] and [`LOOSE_RESIDUAL`] continues without Newton's iteration up
/// to this number of drive periods.
const ARRIVAL_CYCLES: u32 = 9;

/// The middle tolerances are the tolerances of the row, multiplied by this factor. The errors of the orbits
/// at the middle tolerances and at the tolerances of the row differ by about this factor.
const MIDDLE: f64 = 64.0;

/// Residual at the middle tolerance, relative to this tolerance, below which Broyden's method ends after the
/// next step.
const MIDDLE_RESIDUAL: f64 = 10.0;

/// Relative tolerance of the period from which the Floquet multipliers are computed, divided by the square
/// root of the row's relative tolerance.
///
/// The tolerance for the Floquet multipliers is never smaller than the tolerance of the row.
const RESPONSES: f64 = 1.25e-3;

/// If the residual is below this limit, the next step ends close to the orbit. The orbit's monodromy matrix
/// can then be computed at the end of this step. The limit is relative to the square root of the row's
/// tolerance.
const MATRIX_RESIDUAL: f64 = 0.1;

/// If a Newton step with the orbit's monodromy matrix changes the state by less than this length, flap
/// assumes that no further step is needed.
///
/// The length is relative to the square root of the target residual.
///
/// After a Newton step, the residual is about the square of the length of this step.
const LAST_STEP: f64 = 0.1;

/// Largest number of Newton iterations. If Newton's iteration converges, two to four iterations are usual.
const MAX_ITERATIONS: u32 = 8;

/// If Newton's iteration stops with a residual below this limit, jumps of the period map are the reason. The
/// limit is in units of `settle_tol`.
const JUMPS: f64 = 100.0;

/// Factor by which the tolerances are multiplied for the next integration if the error is unknown or the
/// orbit was not found.
const FINER: f64 = 1.0 / 32.0;

/// Smallest tolerances at which a point is integrated, relative to the requested tolerances.
const FINEST: f64 = 1e-5;

/// Smallest relative tolerance at which a point is integrated.
const FINEST_RTOL: f64 = 1e-12;

/// Largest number of times that a row is computed again because the row is not accurate enough.
const REFINEMENTS: u32 = 3;

/// Smallest target residual if a row is computed again with tighter tolerances.
const SMALLEST_GOAL: f64 = 1e-10;

/// The equations count as symmetric if the rates of mirrored states differ by at most this fraction of the
/// largest rate.
const ASYMMETRY: f64 = 1e-9;

/// Largest distance between the orbits of a point at two tolerances, in units of the states' typical sizes.
const ORBITS_DIFFER: f64 = 0.1;

/// Result of a search: the row of a point, whose motion may have settled or not.
pub(super) struct SearchResult<const N: usize> {
    pub(super) row: Row,
    /// Start of the row's orbit, with its tolerances.
    pub(super) orbit: Option<Restart<N>>,
}

/// The search for a point's orbit.
struct Search<'a, M: Model<N>, const N: usize> {
    model: &'a M,
    solver: &'a SolverSettings,
    exchange: Rc<Exchange<M, N>>,
    /// Symmetry of the orbit, or `None` if the search does not assume that the orbit is symmetric.
    symmetry: Option<Symmetry<M::Signals, N>>,
    /// Sizes of the states, of which the absolute tolerances are multiples.
    size: [f64; N],
    /// Factor by which the requested tolerances are multiplied.
    tolerance_factor: f64,
    /// Largest residual of an orbit that counts as found.
    goal: f64,
    march: March<N>,
    /// Largest modulus of the Floquet multipliers of a subharmonic orbit.
    subharmonic: f64,
    ending: Ending,
    /// Number of half drive periods and of evaluated right-hand sides, in total and in the current run.
    half_cycles: u64,
    rhs_evals: u64,
    rhs_evals_of_run: u64,
}

/// A state near an orbit, at which Broyden's method begins.
#[derive(Clone, Copy)]
struct Near<const N: usize> {
    orbit: Orbit<N>,
    /// A part of the march, from which the search checks that the march approaches the orbit.
    march: Marched<N>,
    /// Monodromy matrix of the row's orbit, if known. The matrix is computed at the row's tolerance, at a
    /// state close to the orbit.
    monodromy: Option<Matrix<N>>,
    /// Residual before the last step of Newton's or Broyden's method, at the tolerance of this step. If no
    /// step was made, the field contains the change of the state over the last marched period.
    residual: f64,
    /// Change of the state in the last step, if this step was made with the matrix `monodromy`.
    step: f64,
    /// True if the march has settled on this orbit and Newton's iteration cannot improve the orbit. The
    /// measures of this orbit are then computed without further steps.
    is_final: bool,
}

impl<const N: usize> Near<N> {
    /// Returns a nearby orbit, at which the monodromy matrix has not been computed.
    fn without_matrix(orbit: Orbit<N>, march: Marched<N>, residual: f64) -> Near<N> {
        Near { orbit, march, monodromy: None, residual, step: f64::INFINITY, is_final: false }
    }
}

/// Tolerance of a march or of Newton's iteration.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Tolerance {
    /// [`LOOSE_RTOL`].
    Loose,
    /// Tolerance of the row.
    Row,
}

/// A measured orbit.
struct Measured<T, const N: usize> {
    orbit: Orbit<N>,
    /// Monodromy matrix of the orbit.
    monodromy: Option<Matrix<N>>,
    residual: f64,
    /// Results of the measured period.
    end: PeriodEnd<T, N>,
}

/// Reason for a row without orbit.
enum NoOrbit<const N: usize> {
    /// Near the orbit, the jumps of the period map are too large at the current tolerances. The variant
    /// contains the last state of the iteration.
    Jumps(Orbit<N>),
    /// The search found no stable orbit that the march approaches, or a period could not be integrated.
    Failed,
}

/// Searches for the orbit of a point, from the initial state in `start`, and returns the row of the point.
///
/// `nearby` is true if the start is a given state, such as the orbit of a neighbouring point, and not rest.
pub(super) fn settle<'a, M: Model<N>, const N: usize>(
    model: &'a M,
    solver: &'a SolverSettings,
    nearby: bool,
    exchange: Rc<Exchange<M, N>>,
) -> impl Future<Output = SearchResult<N>> + 'a {
    let start = &exchange.start;
    let mut search = Box::new(Search {
        model,
        solver,
        symmetry: if solver.symmetry { model.symmetry(&start.constants) } else { None },
        size: start.scale,
        tolerance_factor: start.tolerance_factor,
        goal: solver.settle_tol,
        march: March::new(&start.y, &start.scale, solver, nearby, 0),
        subharmonic: f64::NAN,
        ending: Ending::Stopped,
        half_cycles: 0,
        rhs_evals: 0,
        rhs_evals_of_run: 0,
        exchange,
    });
    async move { search.settle(nearby).await }
}

impl<M: Model<N>, const N: usize> Search<'_, M, N> {
    /// Returns the point's row and orbit; for `nearby` see [`settle`].
    async fn settle(&mut self, nearby: bool) -> SearchResult<N> {
        let SolverSettings { newton, progressive, max_cycles, .. } = *self.solver;
        let is_worth_it = self.rtol() <= LOOSE_FOR && max_cycles > LOOSE_CYCLES;
        if newton && progressive && !nearby && is_worth_it {
            self.begin(false, LOOSE_CYCLES);
            if let Some(settled) = self.find(Tolerance::Loose).await {
                return settled;
            }
        }
        self.begin(nearby, max_cycles);
        match self.find(Tolerance::Row).await {
            Some(settled) => settled,
            None => SearchResult { row: self.unsettled(), orbit: None },
        }
    }

    /// Returns the row of the orbit near a state. Returns `None` if no orbit is found near the state at the
    /// tolerance of the row.
    async fn settle_near(&mut self, mut near: Near<N>) -> Option<SearchResult<N>> {
        let mut last: Option<SearchResult<N>> = None;
        for refinement in 0..=REFINEMENTS {
            let (measured, middle) = loop {
                let middle = self.measure_middle(&mut near).await;
                match self.approach(&near).await {
                    Ok(measured) => break (measured, middle),
                    Err(NoOrbit::Jumps(orbit)) => {
                        self.tighten(FINER);
                        near = Near::without_matrix(orbit, near.march, near.residual);
                    }
                    Err(NoOrbit::Failed) => return last.map(|last| self.with_costs(last)),
                }
            };
            let Measured { orbit, monodromy, residual, .. } = measured;
            near = Near { orbit, monodromy, residual, ..near };
            let middle = match middle {
                Some(middle) => Some(middle),
                None => self.measure_middle(&mut near).await,
            };
            let (row, error) = self.row(&measured, middle.as_deref());
            let is_periodic = row.status == Status::Periodic;
            if !is_periodic && last.is_some() {
                break;
            }
            let settled = SearchResult { row, orbit: Some(self.restart_at(&orbit.y, 1.0)) };
            if !is_periodic || error <= self.solver.accuracy || self.is_finest() {
                return Some(self.with_costs(settled));
            }
            last = Some(settled);
            if refinement < REFINEMENTS {
                self.tighten_for(error);
                let march = Marched { begin: orbit.y, end: orbit.y, error: ORBITS_DIFFER, maps: 1 };
                near = Near::without_matrix(orbit, march, f64::INFINITY);
            }
        }
        last.map(|last| self.with_costs(last))
    }

    /// Integrates drive periods until Newton's iteration finds the orbit that the motion approaches, and
    /// returns the row of this orbit.
    ///
    /// Returns `None` if an integration fails, if the largest number of periods is reached, or if the motion
    /// settles on a subharmonic orbit. At the loose tolerance, also returns `None` if Newton's iteration
    /// leads to no orbit at the tolerance of the row.
    async fn find(&mut self, at: Tolerance) -> Option<SearchResult<N>> {
        loop {
            self.march(at).await?;
            let settled = match self.march.period() {
                Some(1) => true,
                Some(periods) => {
                    if at == Tolerance::Row {
                        self.subharmonic = self.multiplier_over(periods).await;
                    }
                    return None;
                }
                None if self.march.is_promising() => false,
                None => return None,
            };
            self.check_symmetry();
            // While the orbit is assumed to be symmetric, half periods are tried first.
            let is_lost = loop {
                let found = self.orbit_near_march(at, settled).await;
                if let Some(near) = found {
                    if let Some(row) = self.settle_near(near).await {
                        return Some(row);
                    }
                    // The march has settled although no orbit was found. Its orbit is measured as it is.
                    if settled && at == Tolerance::Row && self.symmetry.is_none() && !near.is_final {
                        self.reset_tolerances();
                        return self.settle_near(self.orbit_of_settled_march(near.orbit.monodromy)).await;
                    }
                }
                self.reset_tolerances();
                if self.symmetry.take().is_none() {
                    break found.is_some();
                }
            };
            if settled || self.march.is_exhausted() || is_lost && at == Tolerance::Loose {
                return None;
            }
            self.march.put_off_newton();
        }
    }

    /// Returns the orbit near the state of the march, or `None` if Newton's iteration finds no orbit.
    /// `settled` is true if the march has settled.
    async fn orbit_near_march(&mut self, at: Tolerance, settled: bool) -> Option<Near<N>> {
        let change = self.march.change(1);
        if at == Tolerance::Loose && change <= ARRIVED.max(self.goal) {
            // The chord iteration continues the march.
            let marched = self.last_marched(LOOSE_RESIDUAL);
            let orbit = Orbit { y: marched.end, monodromy: [[0.0; N]; N] };
            return Some(Near::without_matrix(orbit, marched, change));
        }
        match self.iterate(at).await {
            Ok(near) => Some(near),
            Err(Some(monodromy)) if settled && at == Tolerance::Row && self.symmetry.is_none() => {
                Some(self.orbit_of_settled_march(monodromy))
            }
            Err(_) => None,
        }
    }

    /// Checks that the equations are symmetric at the current state of the march, as the model declares. If
    /// the equations are not symmetric, the search integrates whole periods from then on.
    fn check_symmetry(&mut self) {
        let Some(Symmetry { centre, .. }) = self.symmetry else { return };
        let Start { constants: c, span, scale, .. } = &self.exchange.start;
        let rate = |t: f64, side: f64, y: &[f64; N]| slope(self.model, c, &input(self.model, c, t), side, y);
        let y = *self.march.state();
        let now = rate(0.0, 1.0, &y);
        let later = rate(0.5 * span, -1.0, &core::array::from_fn(|i| 2.0 * centre[i] - y[i]));
        let deviation = distance(&now, &later.map(|rate| -rate), scale);
        if deviation > ASYMMETRY * distance(&now, &[0.0; N], scale) {
            self.symmetry = None;
        }
    }

    /// Resets the tolerances to the requested tolerances after a failed attempt.
    fn reset_tolerances(&mut self) {
        self.tolerance_factor = self.exchange.start.tolerance_factor;
        self.goal = self.solver.settle_tol;
        self.ending = Ending::Stopped;
    }

    /// Returns the orbit on which the march has settled. Newton's iteration did not reach its target
    /// residual, because the state varies from period to period by more than the target residual.
    fn orbit_of_settled_march(&self, monodromy: Matrix<N>) -> Near<N> {
        let march = self.last_marched(self.goal);
        let orbit = Orbit { y: march.end, monodromy };
        let residual = self.march.change(1);
        Near { monodromy: Some(monodromy), is_final: true, ..Near::without_matrix(orbit, march, residual) }
    }

    /// Returns the last period of the march, whose states have the given `error`.
    fn last_marched(&self, error: f64) -> Marched<N> {
        let (begin, end) = (*self.march.before(), *self.march.state());
        Marched { begin, end, error, maps: self.maps_per_period() }
    }

    /// Marches until the motion has settled or may be close to an orbit, or for the largest allowed number of
    /// periods.
    ///
    /// Returns `None` if a period cannot be integrated.
    async fn march(&mut self, at: Tolerance) -> Option<()> {
        let factor = self.factor(at);
        let mut begin = Some(self.restart_at(&self.march.state().clone(), factor));
        while !self.march.is_exhausted() {
            let end = self.period(Kind::States, begin.take()).await?;
            self.march.period_end(&end.y, &end.largest);
            let change = self.march.change(1);
            let arrives = at == Tolerance::Loose
                && change <= LOOSE_RESIDUAL
                && change > ARRIVED.max(self.goal)
                && self.march.cycles() < ARRIVAL_CYCLES;
            if self.march.period().is_some() || self.march.is_promising() && !arrives {
                break;
            }
            if self.march.is_oversized(&self.size) && !arrives {
                self.size = self.march.motion_size();
                begin = Some(self.restart_at(&end.y, factor));
            }
        }
        self.size = self.march.motion_size();
        Some(())
    }

    /// Runs Newton's iteration from the current state of the march. If the iteration fails, the `Err` value
    /// contains the monodromy matrix at this state, if this matrix is known.
    async fn iterate(&mut self, at: Tolerance) -> Result<Near<N>, Option<Matrix<N>>> {
        let (goal, error) = match at {
            Tolerance::Loose => (LOOSE_RESIDUAL.max(self.goal), LOOSE_RESIDUAL),
            Tolerance::Row => (self.matrix_residual(), self.goal),
        };
        let scale = self.exchange.start.scale;
        let mut y = *self.march.state();
        let mut march: Option<Marched<N>> = None;
        let mut last = f64::INFINITY;
        let mut monodromy = None;
        for _ in 0..=MAX_ITERATIONS {
            let Some(end) = self.apply_map(Kind::Responses, &y, self.factor(at)).await else {
                self.ending = Ending::Stopped;
                return Err(monodromy);
            };
            // The monodromy matrix at the state of the march.
            monodromy.get_or_insert(end.monodromy);
            // The first period continues the march.
            let march = *march.get_or_insert(Marched { begin: y, end: end.y, error, maps: 1 });
            let residual = strobe::residual(&y, &end.y, &scale);
            let orbit = Orbit { y, monodromy: end.monodromy };
            let next = fixed_point(&orbit, &end.y, &scale);
            if residual <= goal {
                let orbit = Orbit { y: next.unwrap_or(end.y), ..orbit };
                if orbit.attracts(&march, &scale) {
                    let near = Near::without_matrix(orbit, march, residual);
                    if at == Tolerance::Loose {
                        return Ok(near);
                    }
                    let step = distance(&y, &orbit.y, &scale);
                    return Ok(Near { monodromy: Some(orbit.monodromy), step, ..near });
                }
                // Near a fold, the multipliers of an orbit are accurate only close to it.
                if at == Tolerance::Loose || residual <= self.goal {
                    return Err(monodromy);
                }
            }
            let slow = residual > PROGRESS * last;
            last = residual;
            match next {
                Some(next) if !slow => y = next,
                _ if at == Tolerance::Row && residual <= JUMPS * self.goal && !self.is_finest() => {
                    self.tighten(FINER);
                    last = f64::INFINITY;
                    continue;
                }
                _ => return Err(monodromy),
            }
            if at == Tolerance::Loose {
                let mut chord = Chord::new(Orbit { y, ..orbit }, &scale);
                let found = self.converge(&mut chord, self.factor(at), LOOSE_RESIDUAL).await;
                let orbit = chord.orbit;
                if found && orbit.attracts(&march, &scale) {
                    return Ok(Near::without_matrix(orbit, march, chord.residual));
                }
                y = orbit.y;
            }
        }
        Err(monodromy)
    }

    /// Finds the orbit at the middle tolerance and returns its measured means, or `None` if the orbit is not
    /// found.
    ///
    /// If `near` was not found at the row's tolerance, the result of Broyden's method replaces the orbit in
    /// `near`.
    async fn measure_middle(&mut self, near: &mut Near<N>) -> Option<Box<SumsOf<M, N>>> {
        let is_known = near.monodromy.is_some();
        // With the monodromy matrix of the row's orbit, one step suffices.
        let enough =
            if is_known { f64::INFINITY } else { self.goal.max(MIDDLE_RESIDUAL * MIDDLE * self.rtol()) };
        let mut chord = Chord::new(near.orbit, &self.exchange.start.scale);
        // A period that fails at this tolerance does not make the row fail.
        let ending = self.ending;
        let found =
            !is_known && near.residual <= self.goal || self.converge(&mut chord, MIDDLE, enough).await;
        self.ending = ending;
        if !is_known && chord.residual <= LOOSE_RESIDUAL {
            near.orbit = chord.orbit;
            near.march.error = ORBITS_DIFFER;
        }
        if !found {
            return None;
        }
        let end = self.measure(Kind::Means, &chord.orbit.y, MIDDLE).await;
        self.ending = ending;
        end?.sums
    }

    /// Makes steps of Broyden's method at `factor` times the tolerances of the row, until the residual is at
    /// most `enough`.
    ///
    /// Returns false if the residual stays larger than `enough`.
    async fn converge(&mut self, chord: &mut Chord<N>, factor: f64, enough: f64) -> bool {
        loop {
            let y = chord.orbit.y;
            let Some(end) = self.apply_map(Kind::States, &y, factor).await else { return false };
            if !chord.step(&end.y) || chord.residual <= enough {
                return chord.residual <= enough;
            }
        }
    }

    /// Moves from a nearby orbit to the orbit of the row's tolerance by Broyden's method, and measures a
    /// period of this orbit.
    async fn approach(&mut self, near: &Near<N>) -> Result<Measured<SumsOf<M, N>, N>, NoOrbit<N>> {
        let scale = self.exchange.start.scale;
        let Near { monodromy: mut matrix, mut residual, mut step, mut is_final, .. } = *near;
        let mut chord = Chord::new(near.orbit, &scale);
        // Residual at which the monodromy matrix of the row's orbit is computed, and the last residual at which it
        // was computed.
        let mut near_enough = self.matrix_residual();
        let mut residual_of_matrix = f64::INFINITY;
        // After a short step the period is measured directly, without a period before it to check the residual. This
        // ends as soon as a measured period shows that the step was not the last.
        let mut presumes = true;
        let last_step = LAST_STEP * self.goal.sqrt();
        loop {
            while !is_final && (matrix.is_none() || residual > self.goal && !(presumes && step <= last_step))
            {
                let y = chord.orbit.y;
                let end = self.apply_map(Kind::States, &y, 1.0).await.ok_or(NoOrbit::Failed)?;
                let mut moved = chord.step(&end.y);
                residual = chord.residual;
                // The matrix is also computed if the steps make no progress.
                if matrix.is_none() && residual <= near_enough
                    || !moved && residual <= PROGRESS * residual_of_matrix
                {
                    let nearer = chord.orbit.y;
                    let monodromy = self.monodromy(&nearer).await.ok_or(NoOrbit::Failed)?;
                    match (Orbit { y: nearer, monodromy }).attracts(&near.march, &scale) {
                        true if residual <= near_enough => matrix = Some(monodromy),
                        false if residual <= self.goal => return Err(NoOrbit::Failed),
                        false if residual <= near_enough => near_enough = self.goal,
                        _ => {}
                    }
                    residual_of_matrix = residual;
                    // The same step again, with this matrix.
                    chord = Chord::new(Orbit { y, monodromy }, &scale);
                    moved = chord.step(&end.y);
                }
                step = distance(&y, &chord.orbit.y, &scale);
                if !moved {
                    // A smaller goal may be below the jumps of the period map.
                    let SolverSettings { settle_tol, .. } = *self.solver;
                    is_final = matrix.is_some() && residual <= settle_tol;
                    if !is_final {
                        let jumps = residual <= JUMPS * settle_tol && !self.is_finest();
                        return Err(if jumps { NoOrbit::Jumps(chord.orbit) } else { NoOrbit::Failed });
                    }
                }
            }
            let orbit = chord.orbit;
            let end = self.measure(Kind::Signals, &orbit.y, 1.0).await.ok_or(NoOrbit::Failed)?;
            let confirmed = strobe::residual(&orbit.y, &end.y, &scale);
            if is_final || !presumes || confirmed <= self.goal {
                let residual = confirmed.min(residual);
                return Ok(Measured { orbit, monodromy: matrix, residual, end });
            }
            if self.measures_maps() {
                chord.step(&end.y);
            }
            (residual, presumes) = (confirmed, false);
            self.exchange.reuse(end.sums);
        }
    }

    /// Returns the monodromy matrix of an orbit through `y`; `None` if the period cannot be integrated.
    async fn monodromy(&mut self, y: &[f64; N]) -> Option<Matrix<N>> {
        // Multipliers of a period are powers of the map's multipliers, with correspondingly larger relative errors.
        let rtol = RESPONSES / f64::from(self.maps_per_period()) * self.rtol().sqrt();
        Some(self.apply_map(Kind::Responses, y, (rtol / self.rtol()).max(1.0)).await?.monodromy)
    }

    /// Returns the largest modulus of the Floquet multipliers of a subharmonic orbit of `periods` drive
    /// periods, at the state of the march.
    async fn multiplier_over(&mut self, periods: u32) -> f64 {
        let mut monodromy = identity();
        let mut y = *self.march.state();
        for _ in 0..periods {
            let Some(end) = self.period(Kind::Responses, Some(self.restart_at(&y, 1.0))).await else {
                self.ending = Ending::Stopped;
                return f64::NAN;
            };
            monodromy = product(&end.monodromy, &monodromy);
            y = end.y;
        }
        spectral_radius(&monodromy)
    }

    /// Applies the map whose fixed point is the orbit, at `factor` times the tolerances of the row.
    ///
    /// The map integrates a whole period, or half a period and then mirrors the final state.
    async fn apply_map(
        &mut self,
        kind: Kind,
        y: &[f64; N],
        factor: f64,
    ) -> Option<PeriodEnd<SumsOf<M, N>, N>> {
        let begin = self.restart_at(y, factor);
        let Some(Symmetry { centre, .. }) = self.symmetry else {
            return self.period(kind, Some(begin)).await;
        };
        let mut end = self.period(kind, Some(Start { span: 0.5 * begin.span, ..begin })).await?;
        end.y = core::array::from_fn(|i| 2.0 * centre[i] - end.y[i]);
        end.monodromy = end.monodromy.map(|row| row.map(|response| -response));
        Some(end)
    }

    /// Integrates a period of an orbit with sums over the signals. If the sums over the second half follow
    /// from the first half, the function integrates only the first half.
    async fn measure(&mut self, kind: Kind, y: &[f64; N], factor: f64) -> Option<PeriodEnd<SumsOf<M, N>, N>> {
        let Some(Symmetry { second_half: Some(second_half), .. }) = self.symmetry else {
            return self.period(kind, Some(self.restart_at(y, factor))).await;
        };
        let mut end = self.apply_map(kind, y, factor).await?;
        if let Some(sums) = end.sums.as_deref_mut() {
            *sums = over_both_halves::<M::Signals>(sums, second_half);
        }
        end.outcome.switches *= 2;
        Some(end)
    }

    /// Returns true if a measured period is exactly one application of the map.
    fn measures_maps(&self) -> bool {
        self.symmetry.as_ref().is_none_or(|symmetry| symmetry.second_half.is_some())
    }

    /// Returns the number of applications of the map in a period.
    fn maps_per_period(&self) -> i32 {
        if self.symmetry.is_some() { 2 } else { 1 }
    }

    /// Integrates a period or half a period. If the integration fails, the function stores the reason in
    /// `ending` and returns `None`.
    async fn period(&mut self, kind: Kind, begin: Option<Restart<N>>) -> Option<PeriodEnd<SumsOf<M, N>, N>> {
        let halves = if begin.is_some_and(|begin| begin.span < self.exchange.start.span) { 1 } else { 2 };
        if begin.is_some() {
            self.rhs_evals_of_run = 0;
        }
        let end = self.exchange.period(Request { kind, begin }).await;
        let Outcome { ending, rhs_evals, .. } = end.outcome;
        // With responses, each evaluation comprises the state and each of its responses.
        let motions = if kind == Kind::Responses { 1 + N as u64 } else { 1 };
        self.rhs_evals += motions * (rhs_evals - self.rhs_evals_of_run);
        self.rhs_evals_of_run = rhs_evals;
        self.ending = ending;
        if ending != Ending::Stopped {
            return None;
        }
        self.half_cycles += halves * motions;
        Some(end)
    }

    /// Begins a march at the initial state of the point, with the requested tolerances.
    fn begin(&mut self, nearby: bool, max_cycles: u32) {
        let Start { y, scale, .. } = self.exchange.start;
        self.march = March::new(&y, &scale, self.solver, nearby, max_cycles);
        self.size = scale;
        self.reset_tolerances();
    }

    /// Returns the start of a period at `y`, with `factor` times the tolerances of the row.
    fn restart_at(&self, y: &[f64; N], factor: f64) -> Restart<N> {
        let tolerance_factor = self.tolerance_factor * factor;
        let Start { span, scale, .. } = self.exchange.start;
        Start { constants: (), y: *y, span, scale: self.size, tolerance_factor, change: scale }
    }

    /// Returns the given tolerance divided by the tolerance of the row.
    fn factor(&self, at: Tolerance) -> f64 {
        match at {
            Tolerance::Loose => LOOSE_RTOL / self.rtol(),
            Tolerance::Row => 1.0,
        }
    }

    /// Returns the relative tolerance of the row.
    fn rtol(&self) -> f64 {
        self.solver.rtol * self.tolerance_factor
    }

    /// Returns the residual below which the monodromy matrix at a state counts as the monodromy matrix of the
    /// row's orbit.
    fn matrix_residual(&self) -> f64 {
        self.solver.settle_tol.max(MATRIX_RESIDUAL * self.rtol().sqrt())
    }

    /// Returns the smallest factor by which the requested tolerances may be multiplied.
    fn finest(&self) -> f64 {
        self.exchange.start.tolerance_factor * FINEST.max(FINEST_RTOL / self.solver.rtol).min(1.0)
    }

    fn is_finest(&self) -> bool {
        self.tolerance_factor <= self.finest()
    }

    fn tighten(&mut self, factor: f64) {
        self.tolerance_factor = (self.tolerance_factor * factor).max(self.finest());
    }

    /// Tightens the tolerances of a row with this `error`.
    fn tighten_for(&mut self, error: f64) {
        let SolverSettings { accuracy, settle_tol, .. } = *self.solver;
        // The error is about proportional to the tolerances.
        self.tighten(if error.is_finite() { (0.25 * accuracy / error).clamp(1e-3, 0.125) } else { FINER });
        self.goal = (settle_tol * self.tolerance_factor).max(SMALLEST_GOAL).min(settle_tol);
    }

    /// Returns the row of an orbit, and its largest relative error.
    fn row(&self, measured: &Measured<SumsOf<M, N>, N>, middle: Option<&SumsOf<M, N>>) -> (Row, f64) {
        let Measured { orbit: Orbit { y, .. }, monodromy, residual, end } = measured;
        let Some(sums) = end.sums.as_deref() else { return (self.unsettled(), 0.0) };
        let (model, solver, start) = (self.model, self.solver, &self.exchange.start);
        let orbit = MeasuredOrbit { y, sums, middle, switches: end.outcome.switches, rtol: self.rtol() };
        let (row, error) = orbit_row::row_of(model, solver, start, &orbit);
        let is_periodic = row.status == Status::Periodic;
        let at_rest = is_periodic && orbit_row::is_at_rest(model, start, &orbit);
        let multiplier = monodromy.as_ref().map(spectral_radius);
        let multiplier = multiplier.map(|largest| largest.powi(self.maps_per_period()));
        // In still air, the drag of a wing at rest has no linear part, so rounding decides whether the multiplier is
        // below 1. In wind, the rest can be unstable.
        let is_known = |largest: &f64| is_periodic && (!at_rest || *largest > 1.0 + NEUTRAL);
        let floquet_max = multiplier.filter(is_known).unwrap_or(f64::NAN);
        (Row { residual: *residual, floquet_max, state: y.to_vec(), ..row }, error)
    }

    /// Returns the number of integrated drive periods.
    fn cycles(&self) -> u32 {
        u32::try_from(self.half_cycles.div_ceil(2)).unwrap_or(u32::MAX)
    }

    /// Returns the row of a point without an orbit of one drive period.
    fn unsettled(&self) -> Row {
        let status = match (self.ending, self.march.period()) {
            (Ending::Stopped, Some(2..)) => Status::Subharmonic,
            (Ending::Stopped, _) => Status::Unsettled,
            (Ending::Diverged, _) => Status::Diverged,
            (Ending::StepLimit, _) => Status::StepLimit,
        };
        let period = if status == Status::Subharmonic { self.march.period() } else { None };
        let marched = self.march.cycles() > 0;
        Row {
            cycles: self.cycles(),
            residual: self.march.change(period.unwrap_or(1)),
            period: period.unwrap_or(0),
            floquet_max: self.subharmonic,
            state: if marched { self.march.state().to_vec() } else { Vec::new() },
            rhs_evals: self.rhs_evals,
            ..Row::empty(status)
        }
    }

    /// Returns a copy of the result with the total costs of the search, `cycles` and `rhs_evals`.
    fn with_costs(&self, mut settled: SearchResult<N>) -> SearchResult<N> {
        settled.row.cycles = self.cycles();
        settled.row.rhs_evals = self.rhs_evals;
        settled
    }
}
