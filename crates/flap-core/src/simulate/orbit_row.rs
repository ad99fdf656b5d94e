//! The row of an orbit, and the error estimate of the row.
//!
//! flap computes the measures of an orbit at two tolerances: the tolerance of the row, and a middle
//! tolerance. The middle tolerance is 64 times the tolerance of the row. The error of the integration is
//! about proportional to the tolerance. The expected error of the row is therefore about 1/64 of the
//! difference between the two results. The difference between the two results may be small by chance, so the
//! error estimate is 0.6 times the difference, not 1/64.

use super::row::{Row, Status};
use super::settings::SolverSettings;
use crate::measure::cycle::{SumsOf, finish};
use crate::model::{Model, Principal, SignalCycle, SignalSet, SignalsOf};
use crate::ode::{Start, input, slope};

/// A motion counts as rest if no state changes per period by more than this fraction of the largest state.
const REST: f64 = 1e-11;

/// A signal certainly oscillates if its range is larger than this fraction of the signal's size.
const SWINGS: f64 = 1e-6;

/// Times at which flap checks if the wing is at rest, as fractions of the drive period. A drive with few
/// harmonics is nonzero at one or more of these times.
const REST_TIMES: [f64; 4] = [0.0, 0.137, 0.412, 0.789];

/// Error estimate of a measure, divided by the difference between its values at the middle tolerance and at
/// the row's tolerance.
const SHARE: f64 = 0.6;

/// A measure is negligible if it is smaller than this fraction of its signal's size. The relative error of a
/// negligible measure is its error divided by the fraction of the signal's size.
const NOTHING: f64 = 1e-3;

/// Smallest error estimate of a row, in units of the relative tolerance. The smallest error estimate covers
/// the error of extrema that lie between the ends of two steps.
const LEAST: f64 = 5.0;

/// If a motion crosses the switching surface more than this number of times in a period, the motion counts as
/// sliding along the surface.
///
/// A motion that does not slide crosses the switching surface twice in a period, or a few times more. If the
/// tolerance is reduced, the error of a sliding motion decreases more slowly than the order of the
/// integration method predicts.
pub(super) const MANY_SWITCHES: u64 = 16;

/// A period of an orbit, with the sums from which flap computes the measures of the row.
pub(super) struct MeasuredOrbit<'a, T, const N: usize> {
    /// State at the beginning of the period.
    pub(super) y: &'a [f64; N],
    pub(super) sums: &'a T,
    /// Sums over the orbit that was found at the middle tolerances, if this orbit is known.
    pub(super) middle: Option<&'a T>,
    /// Number of crossings of the switching surface.
    pub(super) switches: u64,
    /// Relative tolerance.
    pub(super) rtol: f64,
}

/// Returns the row of an orbit, and the largest error of the row that smaller tolerances would reduce. The
/// caller adds the costs of the computation, such as the number of drive periods.
pub(super) fn row_of<M: Model<N>, const N: usize>(
    model: &M,
    solver: &SolverSettings,
    start: &Start<M::Constants<f64>, N>,
    orbit: &MeasuredOrbit<'_, SumsOf<M, N>, N>,
) -> (Row, f64) {
    let measures = measures(model, solver, &start.constants, orbit.sums, start.span);
    // A motion with an infinite measure has diverged.
    if measures.iter().any(|measure| measure.is_infinite()) {
        return (Row::empty(Status::Diverged), 0.0);
    }
    let cycle = |sums| on_orbit::<M, N>(sums, start.span);
    let fine = cycle(orbit.sums);
    let middle = orbit.middle.map(cycle);
    let slides = orbit.switches > MANY_SWITCHES;
    let difference = middle.map_or(f64::INFINITY, |middle| difference::<M, N>(&fine, &middle));
    let estimate = if slides { f64::INFINITY } else { (SHARE * difference).max(LEAST * orbit.rtol) };
    let audit = M::energy_audit(&fine).abs();
    // If the audit is not finite, the power is zero or unknown, and there is nothing to compare.
    let doubt = if slides { 0.0 } else { estimate.max(if audit.is_finite() { audit } else { 0.0 }) };
    (Row { measures, error_estimate: estimate, period: 1, ..Row::empty(Status::Periodic) }, doubt)
}

/// Returns true if the wing is at rest on this orbit: no signal oscillates, and the states change only by
/// rounding errors.
pub(super) fn is_at_rest<M: Model<N>, const N: usize>(
    model: &M,
    start: &Start<M::Constants<f64>, N>,
    orbit: &MeasuredOrbit<'_, SumsOf<M, N>, N>,
) -> bool {
    !swings::<M, N>(&on_orbit::<M, N>(orbit.sums, start.span)) && is_still(model, start, orbit.y)
}

/// Returns the measures of a periodic cycle, one per column, and the mean load if `solver.loads` is set.
pub(super) fn measures<M: Model<N>, const N: usize>(
    model: &M,
    solver: &SolverSettings,
    c: &M::Constants<f64>,
    totals: &SumsOf<M, N>,
    period: f64,
) -> Vec<f64> {
    let mut measures = values(model, c, &on_orbit::<M, N>(totals, period));
    if solver.loads {
        measures.extend(totals.1.map(|sum| sum / period));
    }
    measures
}

/// Returns the mean, the extrema and similar quantities of each signal over a periodic cycle.
fn on_orbit<M: Model<N>, const N: usize>(
    totals: &SumsOf<M, N>,
    period: f64,
) -> SignalsOf<M::Signals, SignalCycle> {
    let mut cycle = finish::<M::Signals>(totals, period);
    M::balance_energy(&mut cycle);
    cycle
}

/// Returns the values of the columns, which are computed from the `cycle` of each signal.
fn values<M: Model<N>, const N: usize>(
    model: &M,
    c: &M::Constants<f64>,
    cycle: &SignalsOf<M::Signals, SignalCycle>,
) -> Vec<f64> {
    let mut values = Vec::new();
    for (signal, cycle) in M::Signals::each(cycle) {
        values.extend(signal.measures.iter().map(|&measure| cycle.measure(measure) * signal.unit.factor));
    }
    // A derived column without a finite value, such as a ratio to zero, is empty.
    let finite = |value: f64| if value.is_finite() { value } else { f64::NAN };
    values.extend(M::DERIVED.iter().map(|derived| finite((derived.value)(model, c, cycle))));
    values
}

/// Returns the largest relative difference of the model's principal measures between two orbits.
///
/// Principal measures are for example stroke, pitch, lift and power. If a measure is negligible compared with
/// its signal, the difference of the measure is divided by a fraction of the signal's size.
fn difference<M: Model<N>, const N: usize>(
    fine: &SignalsOf<M::Signals, SignalCycle>,
    middle: &SignalsOf<M::Signals, SignalCycle>,
) -> f64 {
    let mut largest = 0.0_f64;
    for ((signal, fine), (_, middle)) in M::Signals::each(fine).zip(M::Signals::each(middle)) {
        let Some(principal) = signal.principal else { continue };
        let [value, other] = [fine, middle].map(|cycle| cycle.measure(principal.measure()));
        let difference = (other - value).abs();
        // With a prescribed stroke the power is unknown, and for a wing at rest all measures are zero.
        if difference > 0.0 {
            largest = largest.max(difference / value.abs().max(NOTHING * fine.size()));
        }
    }
    largest
}

/// Returns true if a signal oscillates whose first harmonic is a principal measure. If a signal oscillates,
/// the motion is not at rest, and no check of the states is needed.
fn swings<M: Model<N>, const N: usize>(cycle: &SignalsOf<M::Signals, SignalCycle>) -> bool {
    M::Signals::each(cycle).any(|(signal, cycle)| {
        signal.principal == Some(Principal::First) && cycle.max - cycle.min > SWINGS * cycle.size()
    })
}

/// Returns true if the state `y` is a state of rest, except for rounding errors.
///
/// The rates of all states are computed at several times of the drive period. The largest rate, multiplied by
/// the period, must be at most a tiny fraction of the largest state. The unit of each state is its typical
/// size.
fn is_still<M: Model<N>, const N: usize>(
    model: &M,
    start: &Start<M::Constants<f64>, N>,
    y: &[f64; N],
) -> bool {
    let largest = |of: &[f64; N]| (0..N).fold(0.0, |size: f64, i| size.max(of[i].abs() / start.scale[i]));
    let limit = REST * largest(y);
    REST_TIMES.iter().all(|share| {
        let u = input(model, &start.constants, share * start.span);
        let rate = slope(model, &start.constants, &u, 1.0, y);
        largest(&rate) * start.span <= limit
    })
}
