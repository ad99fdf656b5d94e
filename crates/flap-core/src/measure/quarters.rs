//! Extrema of the signals in each quarter of a drive period, and time integrals of the signals over the whole
//! period.
//!
//! Signals of a symmetric motion reach equal extrema in both half strokes. A parameter that breaks the
//! symmetry raises one of the two extrema more than the other extremum. As a function of the parameter, the
//! larger extremum therefore has a kink. The two equal extrema of a symmetric motion lie in opposite
//! quarters: the two quarters begin half a drive period apart.

use core::f64::consts::{FRAC_PI_2, PI, TAU};

use super::cycle::{SignalObserver, Sums};
use super::step_polynomial::Extremum;
use crate::model::{Each, Model, SignalSet, Totals};
use crate::num::Lanes;
use crate::ode::ensemble::Observer;
use crate::ode::step::Attempt;

/// Phase at which the first quarter of the drive period begins (rad).
///
/// With this phase, a signal rarely has an extremum at the boundary between two quarters of the drive period.
/// Two extrema that are half a period apart therefore lie in opposite quarters, even if numerical errors
/// shift the extrema.
const BEGIN: f64 = -0.37;

/// Smallest and largest value of a signal in a quarter of the drive period.
type Range<R> = [R; 2];

/// Time integrals and extrema of the signals `S` over a period, and the extrema of each signal in the four
/// quarters of the period.
pub type InQuarters<S, R> = (Sums<S, R>, Each<S, [Range<R>; 4]>);

/// Observer that computes the time integrals of the signals of a model, and the extrema of the signals in
/// each quarter.
#[derive(Clone, Copy, Debug)]
pub struct Quarters<'a, M>(pub SignalObserver<'a, M>);

impl<M: Model<N>, const N: usize> Observer<M, N> for Quarters<'_, M> {
    type Totals<R: Lanes> = InQuarters<M::Signals, R>;

    #[inline(always)]
    fn nothing(&self) -> InQuarters<M::Signals, f64> {
        let ranges = M::Signals::all([[f64::INFINITY, f64::NEG_INFINITY]; 4]);
        (Observer::<M, N>::nothing(&self.0), Each(ranges))
    }

    #[inline(always)]
    fn add<R: Lanes>(
        &self,
        c: &M::Constants<R>,
        attempt: &Attempt<'_, R, N>,
        accepted: R::Mask,
        (sums, Each(ranges)): &mut InQuarters<M::Signals, R>,
    ) {
        let Attempt { t, h, .. } = *attempt;
        let Some(within) = self.0.add_step(c, attempt, accepted, sums) else { return };
        // Quarters in order of the phase: opposite quarters are two apart.
        let quarters = |extremum: Extremum<R>| {
            let phase = M::drive(c).phase(h.mul_add(extremum.place, t)) - h.lit(BEGIN);
            let [first, second, third, all] =
                [FRAC_PI_2, PI, 3.0 * FRAC_PI_2, TAU].map(|end| phase.lt(h.lit(end)));
            [first | !all, second & !first, third & !second, all & !third].map(|quarter| quarter & accepted)
        };
        M::Signals::update(
            ranges,
            [&within],
            #[inline(always)]
            |statistics, ranges, [within]| {
                if statistics.ranged {
                    let (lower, upper) = (quarters(within.min), quarters(within.max));
                    for (i, [min, max]) in ranges.iter_mut().enumerate() {
                        *min = R::select(lower[i], within.min.value.min(*min), *min);
                        *max = R::select(upper[i], within.max.value.max(*max), *max);
                    }
                }
            },
        );
    }
}

/// Corrections that make two nearly equal extrema of a signal exactly equal.
#[derive(Clone, Copy)]
struct Shifts {
    /// Index of the quarter opposite to the quarter with the largest value, and the difference between the
    /// maxima of these two quarters.
    max: Option<(usize, f64)>,
    /// Index of the quarter opposite to the quarter with the smallest value, and the difference between the
    /// minima of these two quarters.
    min: Option<(usize, f64)>,
    /// Difference between the magnitudes of the largest and the smallest value of the signal.
    gap: Option<f64>,
}

impl Shifts {
    /// Returns the corrections for extrema whose relative difference is less than `error`.
    fn of(total: &Totals<f64>, ranges: &[Range<f64>; 4], error: f64) -> Shifts {
        let gap = total.max + total.min;
        Shifts {
            max: other_half(ranges.map(|[_, max]| max), error),
            min: other_half(ranges.map(|[min, _]| -min), error),
            gap: Some(gap).filter(|gap| gap.abs() < error * total.max),
        }
    }

    fn apply(&self, mut total: Totals<f64>, ranges: &[Range<f64>; 4]) -> Totals<f64> {
        if let Some((quarter, lag)) = self.max {
            total.max = total.max.max(ranges[quarter][1] + lag);
        }
        if let Some((quarter, lag)) = self.min {
            total.min = total.min.min(ranges[quarter][0] - lag);
        }
        // The largest magnitude is the magnitude of either the largest or the smallest value.
        total.min -= self.gap.unwrap_or(0.0);
        total
    }
}

/// Returns the time integrals and extrema of `runs`, after making nearly equal extrema exactly equal. The
/// result is `None` if no extrema are nearly equal.
///
/// `runs[0]` is the motion at the point, and all later entries of `runs` are motions with slightly changed
/// parameters. If the relative difference between two extrema of a signal in `runs[0]` is less than `error`,
/// the function makes the two extrema equal. The corrections for `runs[0]` are also added to the extrema of
/// all later entries.
pub(crate) fn with_equal_extrema<S: SignalSet>(
    runs: &[InQuarters<S, f64>],
    error: f64,
) -> Option<Vec<Sums<S, f64>>> {
    let ((totals, _), ranges) = runs.first()?;
    let shifts = S::zip(&totals.0, &ranges.0, |_, total, ranges| Shifts::of(&total, &ranges, error));
    S::each(&shifts)
        .find(|(_, shifts)| shifts.max.is_some() || shifts.min.is_some() || shifts.gap.is_some())?;
    let equal = runs.iter().map(|((totals, load), ranges)| {
        let found = S::zip(&totals.0, &ranges.0, |_, total, ranges| (total, ranges));
        let equal =
            S::zip(&shifts, &found, |_, shifts: Shifts, (total, ranges)| shifts.apply(total, &ranges));
        (Each(equal), *load)
    });
    Some(equal.collect())
}

/// Returns the quarter opposite to the quarter with the largest value, and the difference between the maxima
/// of these two quarters. The result is `None` if the relative difference between the two maxima is not less
/// than `error`.
fn other_half(largest: [f64; 4], error: f64) -> Option<(usize, f64)> {
    let quarter = (0..4).max_by(|&one, &other| largest[one].total_cmp(&largest[other]))?;
    let opposite = (quarter + 2) % 4;
    let lag = largest[quarter] - largest[opposite];
    (lag < error * largest[quarter].abs()).then_some((opposite, lag))
}
