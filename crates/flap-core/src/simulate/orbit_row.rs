//! The row of an orbit, from its measured period, and the estimate of its error.
//!
//! An orbit is measured twice: at the tolerances of the row, and at the middle tolerances of the search, which are coarser by
//! a factor of 64. The error of the method is about proportional to its tolerance, so about a sixty-fourth of the difference
//! would be expected as the error. A single difference may be small by chance, so six tenths of it count.

use super::row::{Row, Status};
use super::settings::SolverSettings;
use crate::measure::cycle::{SumsOf, finish};
use crate::model::{Model, Principal, SignalCycle, SignalSet, SignalsOf};
use crate::ode::{Start, input, slope};

/// The largest change per period of a motion that counts as rest, as a share of its largest state.
const REST: f64 = 1e-11;

/// The smallest range of a signal that certainly swings, as a share of the signal's size.
const SWINGS: f64 = 1e-6;

/// Times at which a motion at rest has no rate, as shares of the drive period: no drive of few harmonics is zero at all.
const REST_TIMES: [f64; 4] = [0.0, 0.137, 0.412, 0.789];

/// The share of the difference between both orbits that counts as error.
const SHARE: f64 = 0.6;

/// The share of its signal's size below which a measure counts as nothing beside the signal: its error is then relative to
/// this share of the size.
const NOTHING: f64 = 1e-3;

/// The least error that a row is said to have, in units of the relative tolerance: about that of finding extrema between
/// the ends of steps.
const LEAST: f64 = 5.0;

/// Crossings of the switching surface in a period beyond which the motion counts as sliding along the surface: others
/// cross it twice, or some times more. The error of a sliding motion does not fall as the method's does.
pub(super) const MANY_SWITCHES: u64 = 16;

/// The measured period of an orbit.
pub(super) struct MeasuredOrbit<'a, T, const N: usize> {
    /// The state at its beginning.
    pub(super) y: &'a [f64; N],
    pub(super) sums: &'a T,
    /// Sums over the orbit of the middle tolerances, if they are known.
    pub(super) middle: Option<&'a T>,
    /// Crossings of the switching surface.
    pub(super) switches: u64,
    /// The relative tolerance.
    pub(super) rtol: f64,
}

/// The row of an orbit, without its costs, and the largest of its errors that finer tolerances would reduce.
pub(super) fn row_of<M: Model<N>, const N: usize>(
    model: &M,
    solver: &SolverSettings,
    start: &Start<M::Constants<f64>, N>,
    orbit: &MeasuredOrbit<'_, SumsOf<M, N>, N>,
) -> (Row, f64) {
    let measures = measures(model, solver, &start.constants, orbit.sums, start.span);
    // A signal with an infinite measure has diverged as far as numbers go.
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
    // An audit that is not a number compares nothing: the power is zero or not known.
    let doubt = if slides { 0.0 } else { estimate.max(if audit.is_nan() { 0.0 } else { audit }) };
    (Row { measures, error_estimate: estimate, period: 1, ..Row::empty(Status::Periodic) }, doubt)
}

/// True if an orbit is no motion at all: no signal swings, and the states do not move but for rounding.
pub(super) fn is_at_rest<M: Model<N>, const N: usize>(
    model: &M,
    start: &Start<M::Constants<f64>, N>,
    orbit: &MeasuredOrbit<'_, SumsOf<M, N>, N>,
) -> bool {
    !swings::<M, N>(&on_orbit::<M, N>(orbit.sums, start.span)) && is_still(model, start, orbit.y)
}

/// The measures of a periodic cycle, one per column, and the mean load if `solver` asks for it.
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

/// The signals of a periodic cycle.
fn on_orbit<M: Model<N>, const N: usize>(
    totals: &SumsOf<M, N>,
    period: f64,
) -> SignalsOf<M::Signals, SignalCycle> {
    let mut cycle = finish::<M::Signals>(totals, period);
    M::balance_energy(&mut cycle);
    cycle
}

/// The values of the columns, from the signals of a periodic cycle.
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

/// The largest difference of the model's principal measures, such as stroke, pitch, lift and power, between two orbits:
/// relative to the measure, or to a share of its signal's size if the measure is nothing beside that.
fn difference<M: Model<N>, const N: usize>(
    fine: &SignalsOf<M::Signals, SignalCycle>,
    middle: &SignalsOf<M::Signals, SignalCycle>,
) -> f64 {
    let mut largest = 0.0_f64;
    for ((signal, fine), (_, middle)) in M::Signals::each(fine).zip(M::Signals::each(middle)) {
        let Some(principal) = signal.principal else { continue };
        let [value, other] = [fine, middle].map(|cycle| cycle.measure(principal.measure()));
        let difference = (other - value).abs();
        // A prescribed stroke has no power, and a wing at rest nothing.
        if difference > 0.0 {
            largest = largest.max(difference / value.abs().max(NOTHING * fine.size()));
        }
    }
    largest
}

/// True if a signal with a principal first harmonic varies: then the motion is not at rest, and its states need not be looked
/// at.
fn swings<M: Model<N>, const N: usize>(cycle: &SignalsOf<M::Signals, SignalCycle>) -> bool {
    M::Signals::each(cycle).any(|(signal, cycle)| {
        signal.principal == Some(Principal::First) && cycle.max - cycle.min > SWINGS * cycle.size()
    })
}

/// True if a motion from the state `y` does not move, but for rounding: at several times of the drive period, no state
/// changes in a period by more than a tiny share of the largest state, in units of their typical sizes.
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
