//! Derivatives of the measures of a settled motion.
//!
//! If the parameter p changes, the state y₀ at the beginning of the orbit's period changes too. It is a fixed point
//! of the period's map, y₀ = Φ(p, y₀), so
//!
//! ```text
//! dy₀/dp = (1 − M)⁻¹ ∂Φ/∂p   with the monodromy matrix M = ∂Φ/∂y₀
//! dm/dp  = (m(p + δ, y₀ + δ dy₀/dp) − m(p − δ, y₀ − δ dy₀/dp)) / 2δ
//! ```
//!
//! All periods repeat the steps of one period ([`replay`](crate::ode::replay)), so Φ and m are smooth and δ can be
//! small.
//!
//! The two-sided differences follow the orbit. They stay exact where one of ∂m/∂y₀ has a kink, such as the largest
//! magnitude of a symmetric motion. A kink along the orbit's own path is detected, because the two halves of the
//! difference differ. For this test, extrema that are equal within the integration error are made exactly equal
//! ([`quarters`](crate::measure::quarters)).

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

/// Change of the state in units of its typical size. Its square is negligible, and it is large compared with
/// rounding.
const SMALL: f64 = 1e-8;

/// Factor on the tolerances for the choice of steps. Near a resonance, derivatives of a period are much larger than
/// its states, and so are their errors.
const TOLERANCE_FACTOR: f64 = 0.1;

/// Largest `rtol` at which errors of derivatives are in proportion to errors of the measures. They decrease more
/// slowly.
const COARSE: f64 = 1e-6;

/// Error of an extremum in units of the tolerance. Extrema that differ by less may be equal.
const EXTREMUM_ERROR: f64 = 100.0;

/// Error of derivatives in units of the root of the tolerance, per relative change and relative to the measure.
///
/// If the derivatives of equal extrema differ by less, there is no kink.
const SLOPE_ERROR: f64 = 3.0;

/// Largest component of (1 − M)⁻¹, in units of the states' typical sizes, at which derivatives are reported.
///
/// Above it, the orbit is so close to a fold that derivatives would have errors of 1e-4 and more.
const LARGEST_RESPONSE: f64 = 1e3;

/// Component of (1 − M)⁻¹ above which the orbit is tested for a fold. There, the error of the orbit changes M
/// noticeably.
const LARGE_RESPONSE: f64 = 30.0;

/// Largest relative change of (1 − M)⁻¹ by the error of the orbit.
const DOUBT: f64 = 0.02;

/// Largest relative difference of the two halves of a difference. For a smooth measure it is far smaller.
const SMOOTH: f64 = 1e-3;

/// Relative rounding error of a measure.
const ROUNDING: f64 = 1e-13;

/// A change of a point along which derivatives are computed.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// One value per parameter, at the point changed by `+size`.
    pub ahead: Vec<f64>,
    /// The same at `-size`; or the values of the point itself, for a one-sided difference where a negative change is
    /// impossible.
    pub behind: Vec<f64>,
    /// Size of the change, in the unit of the derivatives: [`Change::SHARE`] of the quantity.
    pub size: f64,
}

impl Change {
    /// Recommended relative size of a change: its square is negligible, and it is large compared with rounding.
    pub const SHARE: f64 = 1e-8;

    /// Returns true if the change is zero. NaN is a parameter that follows others.
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
    /// The motion slides along its switching surface, or touches it.
    Sliding,
    /// A parameter is at the end of its range, or the changed point is impossible.
    Edge,
    /// The quantity is zero, so a relative change is undefined, or the change has no effect.
    Zero,
    /// The period cannot be integrated with tighter tolerances within the limit on steps.
    Lost,
    /// The measure has a kink: the derivatives on both sides differ, or their difference cannot be determined.
    Kink,
    /// The measure itself is missing, or its derivative is not computed.
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

    /// Returns the word for the reason in rows.
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

/// Derivatives of the measures of a settled motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Gradient {
    /// For each change, the derivative of each column of the model, in the column's unit per unit of the change.
    pub slopes: Vec<Vec<Result<f64, NoSlope>>>,
    /// Number of right-hand sides evaluated.
    pub rhs_evals: u64,
}

/// Returns derivatives along `changes` of the orbit that begins at `state`.
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

/// Returns the factor on the tolerances of a recorded period.
fn tolerance_factor(rtol: f64) -> f64 {
    TOLERANCE_FACTOR * (rtol / COARSE).min(1.0).sqrt()
}

/// Constants and drive period of a changed point.
type Side<C> = (C, f64);

/// Points on both sides of a point along a change; `None` if one of them is impossible or has other choices.
type Sides<C> = Option<[Side<C>; 2]>;

/// Returns the points on both sides of a point.
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

/// First state of an orbit, and its derivatives in units of the states' typical sizes.
struct Moves<const N: usize> {
    y: [f64; N],
    along: Vec<SVector<f64, N>>,
}

/// Returns true if all numbers are in the ranges of their parameters. NaN is a number that follows others.
fn in_range(parameters: &[Parameter], values: &[f64]) -> bool {
    parameters.iter().zip(values).all(|(parameter, value)| match parameter.kind {
        Kind::Number(range) | Kind::Following(range, _) => value.is_nan() || range.contains(*value),
        Kind::Choice(_) => true,
    })
}

/// The computation of derivatives from a period of an orbit, which is repeated with changes.
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
    /// Returns the starts of the period, of periods from changed states, and of periods with changed quantities.
    fn for_responses(&self) -> Vec<Start<M::Constants<f64>, N>> {
        let mut starts = self.around(self.start.y);
        for side in &self.sides {
            let (constants, span) = side.map_or((self.start.constants, self.start.span), |[ahead, _]| ahead);
            starts.push(Start { constants, span, ..*self.start });
        }
        starts
    }

    /// Returns the start of a period from a state, and starts from states that differ from it in one component.
    fn around(&self, y: [f64; N]) -> Vec<Start<M::Constants<f64>, N>> {
        let mut starts = vec![Start { y, ..*self.start }; N + 1];
        for i in 0..N {
            starts[i + 1].y[i] += SMALL * self.start.scale[i];
        }
        starts
    }

    /// Returns (1 − M)⁻¹ in units of the scales, from the ends of the periods [`around`](Self::around) a state.
    ///
    /// `None` near a fold and beyond it, where a multiplier is above 1.
    fn response(&self, ends: &[Repeated<(), N>]) -> Option<SMatrix<f64, N, N>> {
        let monodromy =
            SMatrix::<f64, N, N>::from_fn(|i, j| self.difference(&ends[0], &ends[j + 1], SMALL)[i]);
        let from_one = SMatrix::<f64, N, N>::identity() - monodromy;
        let response = from_one.try_inverse()?;
        let determinant = DMatrix::from_column_slice(N, N, from_one.as_slice()).determinant();
        (determinant > 0.0 && response.amax() <= LARGEST_RESPONSE).then_some(response)
    }

    /// Returns the difference of two final states per `size`, in units of the scales.
    fn difference(&self, one: &Repeated<(), N>, other: &Repeated<(), N>, size: f64) -> SVector<f64, N> {
        SVector::from_fn(|i, _| (other.y[i] - one.y[i]) / (size * self.start.scale[i]))
    }

    /// Returns Newton's step, in units of the scales, from a period with this end.
    fn step(&self, response: &SMatrix<f64, N, N>, end: &Repeated<(), N>) -> SVector<f64, N> {
        let (y, scale) = (&self.start.y, &self.start.scale);
        response * SVector::<f64, N>::from_fn(|i, _| (end.y[i] - y[i]) / scale[i])
    }

    /// Returns periods around a state that may be as accurate as the orbit of the search.
    ///
    /// It is one Newton step away from it, plus the largest distance by which an error of one tolerance per period
    /// moves an orbit.
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

    /// Returns the orbit's first state, after one Newton step, and its derivatives along each change.
    ///
    /// The derivatives are in units of the scales: (1 − M)⁻¹ ∂Φ/∂p.
    fn moves(&self, response: &SMatrix<f64, N, N>, ends: &[Repeated<(), N>]) -> Moves<N> {
        let step = self.step(response, &ends[0]);
        let y = core::array::from_fn(|i| self.start.y[i] + step[i] * self.start.scale[i]);
        let changed = ends[N + 1..].iter().zip(self.changes);
        let along =
            changed.map(|(end, change)| response * self.difference(&ends[0], end, change.size)).collect();
        Moves { y, along }
    }

    /// Returns the starts of the orbit and of the orbits on both sides of it along each change.
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

    /// Returns the derivatives of the measures.
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

    /// Returns the number of right-hand sides of `periods` periods on the recorded steps.
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

    /// Returns a gradient without derivatives, for this reason.
    fn without(&self, reason: NoSlope) -> Gradient {
        let signals: usize = M::Signals::TABLE.iter().map(|signal| signal.measures.len()).sum();
        let columns = signals + M::DERIVED.len() + if self.solver.loads { 6 } else { 0 };
        Gradient { slopes: vec![vec![Err(reason); columns]; self.changes.len()], rhs_evals: 0 }
    }
}

/// Returns the sizes of the columns, to which rounding errors are relative.
///
/// The rounding error of a small mean depends on the size of its signal. The rounding error of a component of a force
/// or moment depends on the other components.
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

/// Differences of a measure behind and ahead of a point.
#[derive(Clone, Copy)]
pub(super) struct Halves {
    backward: f64,
    forward: f64,
}

impl Halves {
    pub(super) fn of([behind, here, ahead]: [f64; 3]) -> Halves {
        Halves { backward: here - behind, forward: ahead - here }
    }

    /// Returns true if both differences are known and equal, within a relative tolerance plus `tolerance`.
    fn agree(self, tolerance: f64) -> bool {
        let Halves { backward, forward } = self;
        (forward - backward).abs() <= SMOOTH * forward.abs().max(backward.abs()) + tolerance
    }

    /// Returns the derivative of a measure of size `of`.
    pub(super) fn slope(self, of: f64, size: f64) -> Result<f64, NoSlope> {
        let known = self.agree(ROUNDING * of);
        if known { Ok((self.backward + self.forward) / (2.0 * size)) } else { Err(NoSlope::Kink) }
    }

    /// Returns true if a measure with equalised extrema has a kink.
    ///
    /// The derivatives on both sides then differ by more than their `error`, per relative change and relative to the
    /// measure.
    pub(super) fn has_corner(self, of: f64, error: f64) -> bool {
        !self.agree((error * Change::SHARE + ROUNDING) * of)
    }
}

/// Returns the derivative of a measure from its values at a point and ahead of it.
pub(super) fn forward(here: f64, ahead: f64, size: f64) -> Result<f64, NoSlope> {
    if ahead.is_nan() { Err(NoSlope::Kink) } else { Ok((ahead - here) / size) }
}
