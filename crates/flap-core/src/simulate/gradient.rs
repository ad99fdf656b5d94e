//! Derivatives of the measures of a settled motion with respect to parameters.
//!
//! If the parameter p changes, the state y₀ at the beginning of the orbit's period changes too. The state y₀
//! is a fixed point of the map Φ from the beginning of a period to its end, y₀ = Φ(p, y₀), so
//!
//! ```text
//! dy₀/dp = (1 − M)⁻¹ ∂Φ/∂p   with the monodromy matrix M = ∂Φ/∂y₀
//! dm/dp  = (m(p + δ, y₀ + δ dy₀/dp) − m(p − δ, y₀ − δ dy₀/dp)) / 2δ
//! ```
//!
//! flap integrates the period several times, each time with the same sequence of step sizes
//! ([`replay`](crate::ode::replay)). The map Φ and the measure m are therefore smooth functions, and the
//! change δ can be small.
//!
//! The two-sided difference dm/dp compares the orbit at p + δ with the orbit at p − δ. The difference dm/dp
//! is therefore accurate even if m has a kink as a function of y₀ alone. An example of a measure with a kink
//! is the largest magnitude of a signal in a symmetric motion. If m has a kink as a function of p, the
//! backward and the forward difference of m differ, and flap reports the kink. Before the backward and the
//! forward difference are compared, extrema that are equal within the integration error are made exactly
//! equal ([`quarters`](crate::measure::quarters)).

use nalgebra::{DMatrix, SMatrix, SVector};

use super::march::share_of_tolerance;
use super::orbit_row::{MANY_SWITCHES, measures};
use super::request::Unfinished;
use super::settings::SolverSettings;
use super::single::PointRun;
use super::start::start_at;
use crate::measure::cycle::{SignalObserver, Sums, finish};
use crate::measure::quarters::{InQuarters, Quarters, with_equal_extrema};
use crate::model::{Model, SignalSet};
use crate::num::{Kernel, Scalar, Simd};
use crate::ode::ensemble::Unobserved;
use crate::ode::replay::{RecordedStep, Repeated, record, replay};
use crate::ode::{Ending, Start};
use crate::parameter::{Kind, Parameter};

/// Change of a state for finite differences, in units of the state's typical size. The square of the change
/// is negligible, and the change is large compared with rounding errors.
const SMALL: f64 = 1e-8;

/// Factor by which the tolerances are multiplied in the integration that chooses the steps for derivatives.
/// Near a resonance, the derivatives of the states over a period are much larger than the states, and have
/// larger errors.
const TOLERANCE_FACTOR: f64 = 0.1;

/// Value of `rtol` below which the errors of derivatives decrease more slowly than the errors of the
/// measures. If `rtol` is below this value, the tolerances for derivatives are multiplied by a factor that is
/// less than [`TOLERANCE_FACTOR`].
const COARSE: f64 = 1e-6;

/// Assumed relative error of an extremum of a signal, in units of the relative tolerance. Two extrema whose
/// difference is smaller than this error may be equal.
const EXTREMUM_ERROR: f64 = 100.0;

/// Assumed error of a derivative, in units of the square root of the relative tolerance. Here a derivative is
/// the relative change of a measure per relative change of a quantity.
///
/// If the backward and the forward derivative of a measure with equal extrema differ by less than this error,
/// the measure has no kink.
const SLOPE_ERROR: f64 = 3.0;

/// Largest component of (1 − M)⁻¹ at which flap reports derivatives. M is the monodromy matrix in units of
/// the states' typical sizes.
///
/// If a component of (1 − M)⁻¹ exceeds this limit, the orbit is so close to a fold that the errors of
/// derivatives would exceed 1e-4.
const LARGEST_RESPONSE: f64 = 1e3;

/// Component of (1 − M)⁻¹ above which flap tests if the orbit is close to a fold. Close to a fold, a small
/// error of the orbit changes the monodromy matrix M noticeably.
const LARGE_RESPONSE: f64 = 30.0;

/// Largest relative change of (1 − M)⁻¹, caused by the error of the orbit, at which flap reports derivatives.
const DOUBT: f64 = 0.02;

/// Largest relative difference between the backward and the forward difference of a measure without a kink.
/// If the measure is smooth, the backward and the forward difference differ by far less.
const SMOOTH: f64 = 1e-3;

/// Relative rounding error of a measure.
const ROUNDING: f64 = 1e-13;

/// A small change of the parameter values of a point. flap computes the derivatives of the measures in the
/// direction of this change.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// Parameter values after the change by `+size`, one for each parameter.
    pub ahead: Vec<f64>,
    /// Parameter values after the change by `-size`, one for each parameter. If a change by `-size` is
    /// impossible, the field contains the values of the point itself, and flap computes a one-sided
    /// difference.
    pub behind: Vec<f64>,
    /// Size of the change, by which differences of a measure are divided. The recommended size is
    /// [`Change::SHARE`] times the changed quantity, or [`Change::SHARE`] for relative changes.
    pub size: f64,
}

impl Change {
    /// Recommended size of a change relative to the changed quantity. The square of the recommended size is
    /// negligible, and the size is large compared with rounding errors.
    pub const SHARE: f64 = 1e-8;

    /// Returns true if the change is zero. A value of NaN means that the parameter is computed from other
    /// parameters.
    pub(crate) fn is_none(&self) -> bool {
        let mut both = self.ahead.iter().zip(&self.behind);
        both.all(|(ahead, behind)| ahead.total_cmp(behind).is_eq())
    }
}

/// Reason for a missing derivative.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum NoSlope {
    /// The orbit is too close to a fold, where derivatives are unbounded.
    Fold,
    /// The motion slides along the switching surface of the equations, or only touches this surface.
    Sliding,
    /// A parameter is at the end of its range, or the changed parameter values are impossible.
    Edge,
    /// The changed quantity is zero, so that a relative change is undefined, or the change has no effect on
    /// the parameters.
    Zero,
    /// With the tighter tolerances for derivatives, the integration of the period fails, for example because
    /// of `max_steps`.
    Lost,
    /// The measure has a kink: the backward and the forward derivative differ, or one of the two derivatives
    /// is unknown.
    Kink,
    /// The measure is missing, or flap computes no derivatives of this measure.
    Missing,
}

impl NoSlope {
    /// All reasons.
    pub const ALL: [NoSlope; 7] = [
        NoSlope::Fold,
        NoSlope::Sliding,
        NoSlope::Edge,
        NoSlope::Zero,
        NoSlope::Lost,
        NoSlope::Kink,
        NoSlope::Missing,
    ];

    /// Returns the word that flap writes for this reason, such as `fold`.
    pub fn name(self) -> &'static str {
        match self {
            NoSlope::Fold => "fold",
            NoSlope::Sliding => "sliding",
            NoSlope::Edge => "edge",
            NoSlope::Zero => "zero",
            NoSlope::Lost => "lost",
            NoSlope::Kink => "kink",
            NoSlope::Missing => "missing",
        }
    }
}

/// Derivatives of the measures of a settled motion with respect to parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct Gradient {
    /// For each change, the derivative of each column of the model, in the column's unit per unit of the change.
    pub slopes: Vec<Vec<Result<f64, NoSlope>>>,
    /// Number of evaluations of the right-hand side.
    pub rhs_evals: u64,
}

/// Returns the derivatives of the measures in the direction of each change in `changes`. The measures are the
/// measures of the orbit that begins at `state`.
pub(super) fn gradient<M: Model<N>, R: Scalar, const N: usize>(
    model: &M,
    run: &PointRun<'_>,
    state: &[f64],
    changes: &[Change],
) -> Result<Gradient, Unfinished> {
    let PointRun { backend, solver, values, interrupted } = *run;
    let changed = changes.iter().flat_map(|change| [&change.ahead, &change.behind]);
    let model =
        &changed.fold(model.variant(values), |model, values| model.with_terms_of(&model.variant(values)));
    let mut start = start_at(model, solver, values, Some(state))?;
    start.tolerance_factor = tolerance_factor(solver.rtol);
    let mut tolerances = solver.tolerances();
    tolerances.atol *= share_of_tolerance(&start.y, &start.scale);
    let (recording, outcome) = record::<M, R, N>(model, &tolerances, &start, interrupted);
    let sides = changes.iter().map(|change| sides(model, solver, change)).collect();
    let kernel =
        GradientKernel { model, solver, values, start: &start, recording: &recording, changes, sides };
    let mut gradient = if outcome.ending != Ending::Stopped {
        kernel.without(NoSlope::Lost)
    } else if outcome.switches > MANY_SWITCHES {
        kernel.without(NoSlope::Sliding)
    } else {
        backend.dispatch(kernel)
    };
    gradient.rhs_evals += outcome.rhs_evals;
    if interrupted() { Err(Unfinished::Interrupted) } else { Ok(gradient) }
}

/// Returns the factor by which the tolerances are multiplied in the first integration of the period, which
/// records the steps.
fn tolerance_factor(rtol: f64) -> f64 {
    TOLERANCE_FACTOR * (rtol / COARSE).min(1.0).sqrt()
}

/// Constants of the model and drive period (s) for changed parameter values.
type Side<C> = (C, f64);

/// Constants and drive periods after a change by `+size` and by `-size`. The value is `None` if the changed
/// parameter values are impossible, or if the change replaces the option of a choice.
type Sides<C> = Option<[Side<C>; 2]>;

/// Returns the constants and the drive periods after a change by `+size` and by `-size`.
fn sides<M: Model<N>, const N: usize>(
    model: &M,
    solver: &SolverSettings,
    change: &Change,
) -> Sides<M::Constants<f64>> {
    let side = |values: &[f64]| {
        let has_equal_choices = model.variant(values).with_terms_of(model) == *model;
        let possible = in_range(M::DESCRIPTION.parameters, values) && has_equal_choices;
        let start = start_at(model, solver, values, None).ok().filter(|_| possible)?;
        Some((start.constants, start.span))
    };
    Some([side(&change.ahead)?, side(&change.behind)?])
}

/// Initial state of an orbit, and the derivatives of this state in units of the states' typical sizes.
struct Moves<const N: usize> {
    y: [f64; N],
    along: Vec<SVector<f64, N>>,
}

/// Returns true if the value of each numeric parameter is in its allowed range. A value of NaN means that the
/// parameter is computed from other parameters.
fn in_range(parameters: &[Parameter], values: &[f64]) -> bool {
    parameters.iter().zip(values).all(|(parameter, value)| match parameter.kind {
        Kind::Number(range) | Kind::Following(range, _) => value.is_nan() || range.contains(*value),
        Kind::Choice(_) => true,
    })
}

/// The computation of derivatives. A period of the orbit is integrated several times, with small changes of
/// the initial state and of the parameters.
struct GradientKernel<'a, M: Model<N>, const N: usize> {
    model: &'a M,
    solver: &'a SolverSettings,
    values: &'a [f64],
    start: &'a Start<M::Constants<f64>, N>,
    recording: &'a [RecordedStep],
    changes: &'a [Change],
    sides: Vec<Sides<M::Constants<f64>>>,
}

impl<M: Model<N>, const N: usize> Kernel for GradientKernel<'_, M, N> {
    type Output = Gradient;

    #[inline(always)]
    fn run<I: Simd>(self, simd: I) -> Gradient {
        let GradientKernel { model, recording, .. } = self;
        let starts = self.for_responses();
        let ends = replay(simd, model, &Unobserved, recording, &starts);
        let mut periods = starts.len();
        let fold = |periods| Gradient { rhs_evals: self.rhs_evals(periods), ..self.without(NoSlope::Fold) };
        let Some(response) = self.response(&ends) else { return fold(periods) };
        if response.amax() > LARGE_RESPONSE {
            let doubted = self.in_doubt(&response, &ends[0]);
            periods += doubted.len();
            let ends = replay(simd, model, &Unobserved, recording, &doubted);
            if self.response(&ends).is_none_or(|other| (other - response).amax() > DOUBT * response.amax()) {
                return fold(periods);
            }
        }
        let moves = self.moves(&response, &ends);
        let measured = self.along(&moves);
        let signals = Quarters(SignalObserver::all(model).with_loads(self.solver.loads));
        let cycles = replay(simd, model, &signals, recording, &measured);
        let slopes = self.slopes(&measured, &cycles);
        Gradient { slopes, rhs_evals: self.rhs_evals(periods + measured.len()) }
    }
}

impl<M: Model<N>, const N: usize> GradientKernel<'_, M, N> {
    /// Returns the start of the unchanged period, starts with changed initial states, and starts with changed
    /// parameter values.
    fn for_responses(&self) -> Vec<Start<M::Constants<f64>, N>> {
        let mut starts = self.around(self.start.y);
        for side in &self.sides {
            let (constants, span) = side.map_or((self.start.constants, self.start.span), |[ahead, _]| ahead);
            starts.push(Start { constants, span, ..*self.start });
        }
        starts
    }

    /// Returns N + 1 starts of a period. The first start has the state `y`. In each of the N other starts,
    /// one component of `y` is increased by a small step.
    fn around(&self, y: [f64; N]) -> Vec<Start<M::Constants<f64>, N>> {
        let mut starts = vec![Start { y, ..*self.start }; N + 1];
        for i in 0..N {
            starts[i + 1].y[i] += SMALL * self.start.scale[i];
        }
        starts
    }

    /// Returns (1 − M)⁻¹ in units of the states' typical sizes. The monodromy matrix M is computed from
    /// `ends`, the results of the periods that begin [`around`](Self::around) a state.
    ///
    /// Returns `None` if the orbit is near a fold or beyond a fold. Beyond a fold, a Floquet multiplier is
    /// above 1.
    fn response(&self, ends: &[Repeated<(), N>]) -> Option<SMatrix<f64, N, N>> {
        let monodromy =
            SMatrix::<f64, N, N>::from_fn(|i, j| self.difference(&ends[0], &ends[j + 1], SMALL)[i]);
        let from_one = SMatrix::<f64, N, N>::identity() - monodromy;
        let response = from_one.try_inverse()?;
        let determinant = DMatrix::from_column_slice(N, N, from_one.as_slice()).determinant();
        (determinant > 0.0 && response.amax() <= LARGEST_RESPONSE).then_some(response)
    }

    /// Returns the difference of two final states in units of the states' typical sizes, divided by `size`.
    fn difference(&self, one: &Repeated<(), N>, other: &Repeated<(), N>, size: f64) -> SVector<f64, N> {
        SVector::from_fn(|i, _| (other.y[i] - one.y[i]) / (size * self.start.scale[i]))
    }

    /// Returns the step of Newton's method, in units of the states' typical sizes. `end` is the result of the
    /// period that begins at the current initial state.
    fn step(&self, response: &SMatrix<f64, N, N>, end: &Repeated<(), N>) -> SVector<f64, N> {
        let (y, scale) = (&self.start.y, &self.start.scale);
        response * SVector::<f64, N>::from_fn(|i, _| (end.y[i] - y[i]) / scale[i])
    }

    /// Returns starts of periods around a second state, which may be as close to the exact orbit as the state
    /// that the search found.
    ///
    /// The second state is the sum of the state from the search, one Newton step, and an error. The error is
    /// the largest shift of the orbit that an integration error of one tolerance per period can cause.
    fn in_doubt(
        &self,
        response: &SMatrix<f64, N, N>,
        end: &Repeated<(), N>,
    ) -> Vec<Start<M::Constants<f64>, N>> {
        let step = self.step(response, end);
        let columns = response.column_iter();
        let longest = columns.max_by(|one, other| one.norm_squared().total_cmp(&other.norm_squared()));
        let error = longest.map_or_else(SVector::zeros, nalgebra::Matrix::into_owned)
            * self.solver.settle_tol.max(self.solver.rtol);
        let moved = if step.dot(&error) < 0.0 { step - error } else { step + error };
        self.around(core::array::from_fn(|i| moved[i].mul_add(self.start.scale[i], self.start.y[i])))
    }

    /// Returns the initial state of the orbit after one Newton step, and the derivatives of this state in the
    /// direction of each change.
    ///
    /// The derivatives (1 − M)⁻¹ ∂Φ/∂p are in units of the states' typical sizes.
    fn moves(&self, response: &SMatrix<f64, N, N>, ends: &[Repeated<(), N>]) -> Moves<N> {
        let step = self.step(response, &ends[0]);
        let y = core::array::from_fn(|i| self.start.y[i] + step[i] * self.start.scale[i]);
        let changed = ends[N + 1..].iter().zip(self.changes);
        let along =
            changed.map(|(end, change)| response * self.difference(&ends[0], end, change.size)).collect();
        Moves { y, along }
    }

    /// Returns the start of the orbit, and for each change the starts of the orbits after a change by `+size`
    /// and by `-size`.
    fn along(&self, moves: &Moves<N>) -> Vec<Start<M::Constants<f64>, N>> {
        let mut starts = vec![Start { y: moves.y, ..*self.start }];
        for ((side, change), moved) in self.sides.iter().zip(self.changes).zip(&moves.along) {
            let unchanged = (self.start.constants, self.start.span);
            for ((constants, span), size) in
                side.unwrap_or([unchanged; 2]).into_iter().zip([change.size, -change.size])
            {
                let y = core::array::from_fn(|i| moves.y[i] + size * moved[i] * self.start.scale[i]);
                starts.push(Start { constants, y, span, ..*self.start });
            }
        }
        starts
    }

    /// Returns the derivative of each measure in the direction of each change, or the reason why this
    /// derivative is missing.
    fn slopes(
        &self,
        starts: &[Start<M::Constants<f64>, N>],
        cycles: &[Repeated<InQuarters<M::Signals, f64>, N>],
    ) -> Vec<Vec<Result<f64, NoSlope>>> {
        let totals: Vec<InQuarters<M::Signals, f64>> = cycles.iter().map(|cycle| cycle.totals).collect();
        let sums: Vec<Sums<M::Signals, f64>> = totals.iter().map(|(sums, _)| *sums).collect();
        let measured = self.measured(starts, &sums);
        let tolerance = self.solver.rtol * self.start.tolerance_factor;
        let (error, slope_error) = (EXTREMUM_ERROR * tolerance, SLOPE_ERROR * tolerance.sqrt());
        let with_equal = with_equal_extrema(&totals, error).map(|sums| self.measured(starts, &sums));
        let sizes = sizes::<M, N>(self.solver, &sums[0], &measured[0], self.start.span);
        let slopes = self.sides.iter().zip(self.changes).enumerate().map(|(i, (side, change))| {
            let [ahead, behind] = [2 * i + 1, 2 * i + 2];
            let meets = cycles[0].meets && cycles[ahead].meets && cycles[behind].meets;
            let jumps = || !self.model.variant(&change.ahead).has_slopes();
            let trouble = if change.is_none() {
                Some(NoSlope::Zero)
            } else if !self.model.has_slopes() || jumps() {
                Some(NoSlope::Kink)
            } else if side.is_none() {
                Some(NoSlope::Edge)
            } else if !meets {
                Some(NoSlope::Sliding)
            } else {
                None
            };
            let one_sided =
                change.behind.iter().zip(self.values).all(|(one, other)| one.total_cmp(other).is_eq());
            let columns = 0..measured[0].len();
            let slope = |j: usize| match trouble {
                _ if measured[0][j].is_nan() => Err(NoSlope::Missing),
                Some(trouble) => Err(trouble),
                None if one_sided => forward(measured[0][j], measured[ahead][j], change.size),
                None => {
                    let halves =
                        |measured: &[Vec<f64>]| Halves::of([behind, 0, ahead].map(|i| measured[i][j]));
                    let breaks = with_equal
                        .as_deref()
                        .is_some_and(|equal| halves(equal).has_corner(sizes[j], slope_error));
                    if breaks { Err(NoSlope::Kink) } else { halves(&measured).slope(sizes[j], change.size) }
                }
            };
            columns.map(slope).collect()
        });
        slopes.collect()
    }

    /// Returns the number of evaluations of the right-hand side in `periods` periods with the recorded steps.
    fn rhs_evals(&self, periods: usize) -> u64 {
        let steps =
            self.recording.len() + 2 * self.recording.iter().filter(|recorded| recorded.lands).count();
        (6 * steps * periods) as u64
    }

    /// Returns the measures of the orbits that begin at `starts`.
    fn measured(
        &self,
        starts: &[Start<M::Constants<f64>, N>],
        sums: &[Sums<M::Signals, f64>],
    ) -> Vec<Vec<f64>> {
        let measured = starts.iter().zip(sums).map(|(start, sums)| {
            measures::<M, N>(self.model, self.solver, &start.constants, sums, start.span)
        });
        measured.collect()
    }

    /// Returns a gradient in which all derivatives are missing for the given reason.
    fn without(&self, reason: NoSlope) -> Gradient {
        let signals: usize = M::Signals::TABLE.iter().map(|signal| signal.measures.len()).sum();
        let columns = signals + M::DERIVED.len() + if self.solver.loads { 6 } else { 0 };
        Gradient { slopes: vec![vec![Err(reason); columns]; self.changes.len()], rhs_evals: 0 }
    }
}

/// Returns a typical size of the values of each column. The rounding error of a column is a fraction of the
/// typical size.
///
/// The rounding error of a small mean depends on the size of the signal. The rounding error of a component of
/// a force or moment depends on the largest component.
fn sizes<M: Model<N>, const N: usize>(
    solver: &SolverSettings,
    totals: &Sums<M::Signals, f64>,
    measured: &[f64],
    period: f64,
) -> Vec<f64> {
    let mut sizes = Vec::with_capacity(measured.len());
    for (signal, cycle) in M::Signals::each(&finish::<M::Signals>(totals, period)) {
        sizes.extend(signal.measures.iter().map(|_| cycle.size() * signal.unit.factor.abs()));
    }
    sizes.extend(measured[sizes.len()..].iter().map(|value| value.abs()));
    if solver.loads {
        let loads = sizes.len() - 6;
        for part in [loads..loads + 3, loads + 3..loads + 6] {
            let largest = sizes[part.clone()].iter().copied().fold(0.0, f64::max);
            sizes[part].fill(largest);
        }
    }
    sizes
}

/// Backward and forward difference of a measure at a point.
#[derive(Clone, Copy)]
pub(super) struct Halves {
    backward: f64,
    forward: f64,
}

impl Halves {
    pub(super) fn of([behind, here, ahead]: [f64; 3]) -> Halves {
        Halves { backward: here - behind, forward: ahead - here }
    }

    /// Returns true if the backward and the forward difference are known and nearly equal. Nearly equal means
    /// equal within a relative tolerance plus the absolute `tolerance`.
    fn agree(self, tolerance: f64) -> bool {
        let Halves { backward, forward } = self;
        (forward - backward).abs() <= SMOOTH * forward.abs().max(backward.abs()) + tolerance
    }

    /// Returns the derivative of a measure. `of` is a typical size of the measure, and `size` is the size of
    /// the change.
    pub(super) fn slope(self, of: f64, size: f64) -> Result<f64, NoSlope> {
        let known = self.agree(ROUNDING * of);
        if known { Ok((self.backward + self.forward) / (2.0 * size)) } else { Err(NoSlope::Kink) }
    }

    /// Returns true if a measure has a kink. Before the call, the caller must make extrema exactly equal if
    /// they differ by less than the integration error.
    ///
    /// A measure has a kink if the backward and the forward derivative differ by more than `error`. Both
    /// derivatives are dimensionless: the change of the measure relative to its size `of`, per relative
    /// change of the parameters.
    pub(super) fn has_corner(self, of: f64, error: f64) -> bool {
        !self.agree((error * Change::SHARE + ROUNDING) * of)
    }
}

/// Returns the derivative of a measure from its value at a point and its value after the change by `+size`.
pub(super) fn forward(here: f64, ahead: f64, size: f64) -> Result<f64, NoSlope> {
    if ahead.is_nan() { Err(NoSlope::Kink) } else { Ok((ahead - here) / size) }
}
