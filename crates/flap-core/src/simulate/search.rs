//! The search for the settled motion of a point, from its first drive period to its row.
//!
//! [`Search::settle`] is the whole way:
//!
//! 1. **Find.** The point is marched from rest, one drive period after another, until Newton's iteration leads to a periodic
//!    orbit near by. A loose tolerance suffices for this.
//! 2. **Middle.** The orbit of a middle tolerance is found and measured. This orbit is much nearer to the row's orbit than the
//!    first one, and the difference of its measures from the row gives the row's error estimate.
//! 3. **Close.** Chord steps at the tolerance of the row lead near its orbit. A period with responses to changes of the state
//!    gives the monodromy matrix, and with it the orbit. The period of that orbit is measured, and confirms it.
//! 4. **Judge.** A row that is not accurate enough is computed again with tighter tolerances, from its orbit.
//!
//! If the point is [symmetric](Symmetry), its orbit presumably is so too: Newton's iteration, the chord steps and the measured
//! periods then integrate half a period and mirror its end. The march always integrates whole periods. If no symmetric orbit is
//! found, the search gives up the symmetry and goes on with whole periods.
//!
//! If the search at the loose tolerance fails, it begins again, at rest and at the tolerance of the row.
//! A search integrates nothing itself: it asks for drive periods and waits for them (see [`periods`](super::periods)), and a
//! driver integrates those of many points in lanes (see [`lanes`](super::lanes)).

use std::rc::Rc;

use super::march::March;
use super::orbit_row::{self, MeasuredOrbit};
use super::period_map::{self, Chord, Marched, Orbit, PROGRESS, distance, fixed_point};
use super::periods::{Exchange, Kind, PeriodEnd, Request};
use super::row::{Row, Status};
use super::settings::SolverSettings;
use crate::measure::cycle::{SumsOf, over_both_halves};
use crate::measure::multipliers::{Matrix, identity, product, spectral_radius};
use crate::model::{Model, Symmetry};
use crate::ode::ensemble::Restart;
use crate::ode::{Ending, Outcome, Start, input, slope};

/// The relative tolerance with which a search begins, and the largest tolerance of rows for which it does.
const LOOSE_RTOL: f64 = 3e-4;
const LOOSE_FOR: f64 = 4e-6;

/// The most drive periods marched at the loose tolerance.
const LOOSE_CYCLES: u32 = 16;

/// The residual of an orbit at the loose tolerance. The period map of this tolerance jumps by less.
const LOOSE_RESIDUAL: f64 = 1e-2;

/// The residual of a march at the loose tolerance that is as near to its orbit as Newton's iteration would lead.
const ARRIVED: f64 = 1e-3;

/// The drive periods up to which a march with less than [`LOOSE_RESIDUAL`] goes on until it has [`ARRIVED`].
const ARRIVAL_CYCLES: u32 = 9;

/// The factor between the tolerances of a row and the middle ones. The errors of the two orbits differ by about as much.
const MIDDLE: f64 = 64.0;

/// The residual at the middle tolerance, relative to that tolerance, after which one more chord step is the last.
const MIDDLE_RESIDUAL: f64 = 10.0;

/// The relative tolerance of the period with responses that gives the multipliers, relative to the root of the row's tolerance.
/// It is never finer than the row's tolerance.
const RESPONSES: f64 = 1.25e-3;

/// The residual from which one more step leads to a state with the monodromy matrix of the orbit, relative to the root of the
/// row's tolerance.
const MATRIX_RESIDUAL: f64 = 0.1;

/// The length of a step with the monodromy matrix of the row's orbit that is presumed to be the last, relative to the root of
/// the residual to be reached: a step leaves a residual of about its square.
const LAST_STEP: f64 = 0.1;

/// Iterations after which Newton's iteration is given up: where it converges at all, it takes two to four.
const MAX_ITERATIONS: u32 = 8;

/// The residual, in units of `settle_tol`, below which an iteration is stuck in jumps of the period map, and the factor on the
/// tolerances that makes them smaller.
const JUMPS: f64 = 100.0;
const FINER: f64 = 1.0 / 32.0;

/// The finest tolerances at which a point is integrated: relative to those that were asked for, and as `rtol`.
const FINEST: f64 = 1e-5;
const FINEST_RTOL: f64 = 1e-12;

/// The most times that a point is integrated again for its row's accuracy.
const REFINEMENTS: u32 = 3;

/// The smallest residual that such a refinement aims at.
const SMALLEST_GOAL: f64 = 1e-10;

/// The largest difference between the rates of mirrored states in symmetric equations, as a share of the largest rate.
const ASYMMETRY: f64 = 1e-9;

/// The largest distance between the orbits of two tolerances, in units of the states' typical sizes.
const ORBITS_DIFFER: f64 = 0.1;

/// A point that has been followed until it settled, or until it was given up.
pub(super) struct Settled<const N: usize> {
    pub(super) row: Row,
    /// The beginning of the row's orbit, with its tolerances.
    pub(super) orbit: Option<Restart<N>>,
}

/// The search for a point's orbit.
struct Search<'a, M: Model<N>, const N: usize> {
    model: &'a M,
    solver: &'a SolverSettings,
    start: Start<M::Constants<f64>, N>,
    exchange: Rc<Exchange<SumsOf<M, N>, N>>,
    /// The symmetry of the orbit, as long as it is presumed to have one.
    symmetry: Option<Symmetry<M::Signals, N>>,
    /// The sizes of the states, of which absolute tolerances are multiples.
    size: [f64; N],
    /// The factor on the tolerances that were asked for.
    tolerance_factor: f64,
    /// The residual with which an orbit counts as found.
    goal: f64,
    march: March<N>,
    /// Largest modulus of the multipliers of a subharmonic orbit.
    subharmonic: f64,
    ending: Ending,
    /// Half drive periods integrated, right-hand sides evaluated, and those that the present run has evaluated.
    half_cycles: u64,
    rhs_evals: u64,
    rhs_evals_of_run: u64,
}

/// An orbit near by.
#[derive(Clone, Copy)]
struct Near<const N: usize> {
    orbit: Orbit<N>,
    /// A part of the march that should lead there.
    march: Marched<N>,
    /// The monodromy matrix of the row's orbit, if it is known: computed at the row's tolerance, near enough.
    monodromy: Option<Matrix<N>>,
    /// The residual before the last step, at the tolerance of the last iteration; of a march that has arrived, its last change.
    residual: f64,
    /// The length of that step, if it was made with `monodromy`.
    step: f64,
    /// The march has settled there, and Newton's iteration cannot improve on it: the orbit is measured as it is.
    is_final: bool,
}

impl<const N: usize> Near<N> {
    /// An orbit whose own monodromy matrix is not known.
    fn without_matrix(orbit: Orbit<N>, march: Marched<N>, residual: f64) -> Near<N> {
        Near { orbit, march, monodromy: None, residual, step: f64::INFINITY, is_final: false }
    }
}

/// The tolerance of a march or of Newton's iteration.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Tolerance {
    /// [`LOOSE_RTOL`].
    Loose,
    /// That of the row.
    Row,
}

/// An orbit that has been measured.
struct Measured<T, const N: usize> {
    orbit: Orbit<N>,
    /// Its monodromy matrix.
    monodromy: Option<Matrix<N>>,
    residual: f64,
    /// The end of its measured period.
    end: PeriodEnd<T, N>,
}

/// The reason why the row's orbit is not found.
enum NoOrbit<const N: usize> {
    /// The period map jumps too much at these tolerances, near this orbit.
    Jumps(Orbit<N>),
    /// No stable orbit was found that the march approaches, or a period could not be integrated.
    Failed,
}

/// Follows a point from `start` to its row. `nearby` says that this is a given state, such as one on the orbit of a neighbouring
/// point, and not rest.
pub(super) fn settle<'a, M: Model<N>, const N: usize>(
    model: &'a M,
    solver: &'a SolverSettings,
    start: Start<M::Constants<f64>, N>,
    nearby: bool,
    exchange: Rc<Exchange<SumsOf<M, N>, N>>,
) -> impl Future<Output = Settled<N>> + 'a {
    let mut search = Box::new(Search {
        model,
        solver,
        start,
        exchange,
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
    });
    async move { search.settle(nearby).await }
}

impl<M: Model<N>, const N: usize> Search<'_, M, N> {
    /// The point's row and orbit; for `nearby` see [`settle`].
    async fn settle(&mut self, nearby: bool) -> Settled<N> {
        let SolverSettings { newton, progressive, max_cycles, .. } = *self.solver;
        let is_worth_it = self.rtol() <= LOOSE_FOR && max_cycles > LOOSE_CYCLES;
        if newton && progressive && !nearby && is_worth_it {
            self.begin(false, LOOSE_CYCLES);
            if let Some(settled) = self.follow(Tolerance::Loose).await {
                return settled;
            }
        }
        self.begin(nearby, max_cycles);
        match self.follow(Tolerance::Row).await {
            Some(settled) => settled,
            None => Settled { row: self.unsettled(), orbit: None },
        }
    }

    /// The row of an orbit near by; `None` if no orbit of the row's tolerance lies near it.
    async fn settle_near(&mut self, mut near: Near<N>) -> Option<Settled<N>> {
        let mut last: Option<Settled<N>> = None;
        for refinement in 0..=REFINEMENTS {
            let (measured, middle) = loop {
                let middle = self.measure_middle(&mut near).await;
                match self.close(&near).await {
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
            let settled = Settled { row, orbit: Some(self.from(&orbit.y, 1.0)) };
            if !is_periodic || error <= self.solver.accuracy || self.is_finest() {
                return Some(self.with_costs(settled));
            }
            last = Some(settled);
            if refinement < REFINEMENTS {
                self.refine(error);
                let march = Marched { begin: orbit.y, end: orbit.y, error: ORBITS_DIFFER, maps: 1 };
                near = Near::without_matrix(orbit, march, f64::INFINITY);
            }
        }
        last.map(|last| self.with_costs(last))
    }

    /// Marches until an orbit near by is the orbit of the point. `None` if the march fails, is exhausted, or settles on a subharmonic
    /// orbit; at the loose tolerance also if an orbit near by turns out to be none.
    async fn follow(&mut self, at: Tolerance) -> Option<Settled<N>> {
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
            // As long as the orbit is presumed to be symmetric, half periods are searched first.
            let is_lost = loop {
                let found = self.find(at, settled).await;
                if let Some(near) = found {
                    if let Some(row) = self.settle_near(near).await {
                        return Some(row);
                    }
                    // The march has settled all the same: on an orbit that is measured as it is.
                    if settled && at == Tolerance::Row && self.symmetry.is_none() && !near.is_final {
                        self.reset_tolerances();
                        return self.settle_near(self.marched(near.orbit.monodromy)).await;
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

    /// The orbit near the state of the march, which has perhaps `settled`; `None` if Newton's iteration leads to none.
    async fn find(&mut self, at: Tolerance, settled: bool) -> Option<Near<N>> {
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
                Some(self.marched(monodromy))
            }
            Err(_) => None,
        }
    }

    /// Gives up the symmetry if the equations do not have it at the state of the march, whatever the model says.
    fn check_symmetry(&mut self) {
        let Some(Symmetry { centre, .. }) = self.symmetry else { return };
        let Start { constants: c, span, scale, .. } = &self.start;
        let rate = |t: f64, side: f64, y: &[f64; N]| slope(self.model, c, &input(self.model, c, t), side, y);
        let y = *self.march.state();
        let now = rate(0.0, 1.0, &y);
        let later = rate(0.5 * span, -1.0, &core::array::from_fn(|i| 2.0 * centre[i] - y[i]));
        let deviation = distance(&now, &later.map(|rate| -rate), scale);
        if deviation > ASYMMETRY * distance(&now, &[0.0; N], scale) {
            self.symmetry = None;
        }
    }

    /// Goes back to the tolerances that were asked for, after a try that has failed.
    fn reset_tolerances(&mut self) {
        self.tolerance_factor = self.start.tolerance_factor;
        self.goal = self.solver.settle_tol;
        self.ending = Ending::Stopped;
    }

    /// The orbit on which the march has settled: its state jitters by more than Newton's iteration may leave.
    fn marched(&self, monodromy: Matrix<N>) -> Near<N> {
        let march = self.last_marched(self.goal);
        let orbit = Orbit { y: march.end, monodromy };
        let residual = self.march.change(1);
        Near { monodromy: Some(monodromy), is_final: true, ..Near::without_matrix(orbit, march, residual) }
    }

    /// The last period of the march, with this error.
    fn last_marched(&self, error: f64) -> Marched<N> {
        let (begin, end) = (*self.march.before(), *self.march.state());
        Marched { begin, end, error, maps: self.maps_per_period() }
    }

    /// Marches until the motion has settled or may be near an orbit, or for as many periods as are allowed. `None` if
    /// a period cannot be integrated.
    async fn march(&mut self, at: Tolerance) -> Option<()> {
        let factor = self.factor(at);
        let mut begin = Some(self.from(&self.march.state().clone(), factor));
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
                begin = Some(self.from(&end.y, factor));
            }
        }
        self.size = self.march.motion_size();
        Some(())
    }

    /// Newton's iteration from the state of the march. An error is the monodromy matrix there, if there is one.
    async fn iterate(&mut self, at: Tolerance) -> Result<Near<N>, Option<Matrix<N>>> {
        let (goal, error) = match at {
            Tolerance::Loose => (LOOSE_RESIDUAL.max(self.goal), LOOSE_RESIDUAL),
            Tolerance::Row => (self.matrix_residual(), self.goal),
        };
        let scale = self.start.scale;
        let mut y = *self.march.state();
        let mut march: Option<Marched<N>> = None;
        let mut last = f64::INFINITY;
        let mut monodromy = None;
        for _ in 0..=MAX_ITERATIONS {
            let Some(end) = self.map(Kind::Responses, &y, self.factor(at)).await else {
                self.ending = Ending::Stopped;
                return Err(monodromy);
            };
            // That of the march's state.
            monodromy.get_or_insert(end.monodromy);
            // The first of these continues the march.
            let march = *march.get_or_insert(Marched { begin: y, end: end.y, error, maps: 1 });
            let residual = period_map::residual(&y, &end.y, &scale);
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
                // Near a fold, the multipliers of an orbit show only close to it.
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

    /// Finds the orbit of the middle tolerance and measures its means; `None` if it is not found. If the orbit near by was not
    /// found at the row's tolerance, the state that the chord steps lead to takes its place.
    async fn measure_middle(&mut self, near: &mut Near<N>) -> Option<Box<SumsOf<M, N>>> {
        let is_known = near.monodromy.is_some();
        // With the monodromy matrix of the row's orbit, one step suffices.
        let enough =
            if is_known { f64::INFINITY } else { self.goal.max(MIDDLE_RESIDUAL * MIDDLE * self.rtol()) };
        let mut chord = Chord::new(near.orbit, &self.start.scale);
        // A period that fails at this tolerance is no failure of the row.
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

    /// Chord steps with so many times the tolerances of the row, until the residual is small enough. False if it does not become
    /// so.
    async fn converge(&mut self, chord: &mut Chord<N>, factor: f64, enough: f64) -> bool {
        loop {
            let y = chord.orbit.y;
            let Some(end) = self.map(Kind::States, &y, factor).await else { return false };
            if !chord.step(&end.y) || chord.residual <= enough {
                return chord.residual <= enough;
            }
        }
    }

    /// Goes from an orbit near by onto the orbit of the row's tolerance, in chord steps, and measures its period.
    async fn close(&mut self, near: &Near<N>) -> Result<Measured<SumsOf<M, N>, N>, NoOrbit<N>> {
        let scale = self.start.scale;
        let Near { monodromy: mut matrix, mut residual, mut step, mut is_final, .. } = *near;
        let mut chord = Chord::new(near.orbit, &scale);
        // The residual at which the monodromy matrix of the row's orbit is computed, and the last at which it was.
        let mut near_enough = self.matrix_residual();
        let mut residual_of_matrix = f64::INFINITY;
        // After a short step the period is measured without another one before it, until a measured period shows that the step
        // was not the last.
        let mut presumes = true;
        let last_step = LAST_STEP * self.goal.sqrt();
        loop {
            while !is_final && (matrix.is_none() || residual > self.goal && !(presumes && step <= last_step))
            {
                let y = chord.orbit.y;
                let end = self.map(Kind::States, &y, 1.0).await.ok_or(NoOrbit::Failed)?;
                let mut moved = chord.step(&end.y);
                residual = chord.residual;
                // The matrix is computed where the steps are stuck, too.
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
            let confirmed = period_map::residual(&orbit.y, &end.y, &scale);
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

    /// The monodromy matrix of an orbit through `y`. `None` if the period cannot be integrated.
    async fn monodromy(&mut self, y: &[f64; N]) -> Option<Matrix<N>> {
        // The multipliers of a period are powers of those of the map, and err by as many times more.
        let rtol = RESPONSES / f64::from(self.maps_per_period()) * self.rtol().sqrt();
        Some(self.map(Kind::Responses, y, (rtol / self.rtol()).max(1.0)).await?.monodromy)
    }

    /// Largest modulus of the multipliers of a subharmonic orbit of so many drive periods, on which the march is.
    async fn multiplier_over(&mut self, periods: u32) -> f64 {
        let mut monodromy = identity();
        let mut y = *self.march.state();
        for _ in 0..periods {
            let Some(end) = self.period(Kind::Responses, Some(self.from(&y, 1.0))).await else {
                self.ending = Ending::Stopped;
                return f64::NAN;
            };
            monodromy = product(&end.monodromy, &monodromy);
            y = end.y;
        }
        spectral_radius(&monodromy)
    }

    /// Integrates the map of which an orbit is a fixed point, with so many times the tolerances of the row: over a period, or
    /// over half a period that is mirrored at its end.
    async fn map(&mut self, kind: Kind, y: &[f64; N], factor: f64) -> Option<PeriodEnd<SumsOf<M, N>, N>> {
        let begin = self.from(y, factor);
        let Some(Symmetry { centre, .. }) = self.symmetry else {
            return self.period(kind, Some(begin)).await;
        };
        let mut end = self.period(kind, Some(Restart { span: 0.5 * begin.span, ..begin })).await?;
        end.y = core::array::from_fn(|i| 2.0 * centre[i] - end.y[i]);
        end.monodromy = end.monodromy.map(|row| row.map(|response| -response));
        Some(end)
    }

    /// Integrates a period of an orbit with sums over the signals, or half of it if the rest follows.
    async fn measure(&mut self, kind: Kind, y: &[f64; N], factor: f64) -> Option<PeriodEnd<SumsOf<M, N>, N>> {
        let Some(Symmetry { second_half: Some(second_half), .. }) = self.symmetry else {
            return self.period(kind, Some(self.from(y, factor))).await;
        };
        let mut end = self.map(kind, y, factor).await?;
        if let Some(sums) = end.sums.as_deref_mut() {
            *sums = over_both_halves::<M::Signals>(sums, second_half);
        }
        end.outcome.switches *= 2;
        Some(end)
    }

    /// True if what is measured of an orbit is what a map integrates, and not more.
    fn measures_maps(&self) -> bool {
        self.symmetry.as_ref().is_none_or(|symmetry| symmetry.second_half.is_some())
    }

    /// The number of times that the map of which an orbit is a fixed point is applied in a period.
    fn maps_per_period(&self) -> i32 {
        if self.symmetry.is_some() { 2 } else { 1 }
    }

    /// Integrates a period, or half of one. `None`, with the ending, if that fails.
    async fn period(&mut self, kind: Kind, begin: Option<Restart<N>>) -> Option<PeriodEnd<SumsOf<M, N>, N>> {
        let halves = if begin.is_some_and(|begin| begin.span < self.start.span) { 1 } else { 2 };
        if begin.is_some() {
            self.rhs_evals_of_run = 0;
        }
        let end = self.exchange.period(Request { kind, begin }).await;
        let Outcome { ending, rhs_evals, .. } = end.outcome;
        // With responses, each evaluation is one of the states and one of each response.
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

    /// Begins at the initial state, with the tolerances that were asked for.
    fn begin(&mut self, nearby: bool, max_cycles: u32) {
        let Start { y, scale, .. } = self.start;
        self.march = March::new(&y, &scale, self.solver, nearby, max_cycles);
        self.size = scale;
        self.reset_tolerances();
    }

    /// The beginning of a period at `y`, with the tolerances of the row times `factor`.
    fn from(&self, y: &[f64; N], factor: f64) -> Restart<N> {
        let tolerance_factor = self.tolerance_factor * factor;
        let Start { span, scale, .. } = self.start;
        Restart { y: *y, span, scale: self.size, tolerance_factor, change: scale }
    }

    /// The factor on the tolerances of the row.
    fn factor(&self, at: Tolerance) -> f64 {
        match at {
            Tolerance::Loose => LOOSE_RTOL / self.rtol(),
            Tolerance::Row => 1.0,
        }
    }

    /// The relative tolerance of the row.
    fn rtol(&self) -> f64 {
        self.solver.rtol * self.tolerance_factor
    }

    /// The residual near which the monodromy matrix is the matrix of the row's orbit.
    fn matrix_residual(&self) -> f64 {
        self.solver.settle_tol.max(MATRIX_RESIDUAL * self.rtol().sqrt())
    }

    /// The smallest factor on the tolerances.
    fn finest(&self) -> f64 {
        self.start.tolerance_factor * FINEST.max(FINEST_RTOL / self.solver.rtol).min(1.0)
    }

    fn is_finest(&self) -> bool {
        self.tolerance_factor <= self.finest()
    }

    fn tighten(&mut self, factor: f64) {
        self.tolerance_factor = (self.tolerance_factor * factor).max(self.finest());
    }

    /// Tightens the tolerances of a row that errs by `error`.
    fn refine(&mut self, error: f64) {
        let SolverSettings { accuracy, settle_tol, .. } = *self.solver;
        // The error is about proportional to the tolerances.
        self.tighten(if error.is_finite() { (0.25 * accuracy / error).clamp(1e-3, 0.125) } else { FINER });
        self.goal = (settle_tol * self.tolerance_factor).max(SMALLEST_GOAL).min(settle_tol);
    }

    /// The row of an orbit, and its largest relative error.
    fn row(&self, measured: &Measured<SumsOf<M, N>, N>, middle: Option<&SumsOf<M, N>>) -> (Row, f64) {
        let Measured { orbit: Orbit { y, .. }, monodromy, residual, end } = measured;
        let Some(sums) = end.sums.as_deref() else { return (self.unsettled(), 0.0) };
        let Search { model, solver, start, .. } = self;
        let orbit = MeasuredOrbit { y, sums, middle, switches: end.outcome.switches, rtol: self.rtol() };
        let (row, error) = orbit_row::row_of(*model, solver, start, &orbit);
        let at_rest = row.status != Status::Periodic || orbit_row::is_at_rest(*model, start, &orbit);
        let multiplier = monodromy.as_ref().filter(|_| !at_rest).map(spectral_radius);
        let floquet_max = multiplier.map_or(f64::NAN, |largest| largest.powi(self.maps_per_period()));
        (Row { residual: *residual, floquet_max, state: y.to_vec(), ..row }, error)
    }

    /// Drive periods integrated.
    fn cycles(&self) -> u32 {
        u32::try_from(self.half_cycles.div_ceil(2)).unwrap_or(u32::MAX)
    }

    /// The row of a point without an orbit of one drive period.
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

    /// The same row, with all that its point has cost.
    fn with_costs(&self, mut settled: Settled<N>) -> Settled<N> {
        settled.row.cycles = self.cycles();
        settled.row.rhs_evals = self.rhs_evals;
        settled
    }
}
