//! Extrema of the signals in each quarter of a drive period, beside their sums over all of it.
//!
//! Signals of a symmetric motion reach their extrema in both half strokes. A change that breaks the symmetry raises one of
//! two such extrema more than the other, so that the larger of both has a kink. Such extrema lie in opposite quarters.

use core::f64::consts::{FRAC_PI_2, PI, TAU};

use super::cycle::{Signals, Sums};
use super::step_polynomial::Extremum;
use crate::model::{Each, Model, SignalSet, Totals};
use crate::num::Lanes;
use crate::ode::ensemble::Observer;
use crate::ode::step::Attempt;

/// The phase at which the first quarter begins (rad): one that is unlikely for extrema, of which two that are half a period
/// apart have to be in opposite quarters.
const BEGIN: f64 = -0.37;

/// Smallest and largest value of a signal in a quarter.
type Range<R> = [R; 2];

/// Sums over the signals `S`, and the ranges of each in the quarters of the period.
pub type InQuarters<S, R> = (Sums<S, R>, Each<S, [Range<R>; 4]>);

/// Sums up the signals of a model, and finds their extrema in each quarter.
#[derive(Clone, Copy, Debug)]
pub struct Quarters<'a, M>(pub Signals<'a, M>);

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
        // In the order of the phase: opposite quarters are two apart.
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
            |taken, ranges, [within]| {
                if taken.ranged {
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

/// The shifts that make the extrema of a signal equal.
#[derive(Clone, Copy)]
struct Shifts {
    /// The quarter opposite to that of the largest value, and the difference of both largest values.
    max: Option<(usize, f64)>,
    /// The same of the smallest values.
    min: Option<(usize, f64)>,
    /// The difference of the magnitudes of the largest and the smallest value.
    gap: Option<f64>,
}

impl Shifts {
    /// The shifts of extrema that differ by less than an `error`, as a share of them.
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
        // Largest magnitudes are those of the largest or of the smallest value.
        total.min -= self.gap.unwrap_or(0.0);
        total
    }
}

/// The sums of `runs` whose first is a motion and the others slight changes of it; but extrema that differ by less than an
/// `error`, as a share of them, are made equal in the motion, and shifted by as much in the others. `None` if there are no such.
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

/// The quarter opposite to that of the largest value, and the difference of both largest values, if it is less than an `error`.
fn other_half(largest: [f64; 4], error: f64) -> Option<(usize, f64)> {
    let quarter = (0..4).max_by(|&one, &other| largest[one].total_cmp(&largest[other]))?;
    let opposite = (quarter + 2) % 4;
    let lag = largest[quarter] - largest[opposite];
    (lag < error * largest[quarter].abs()).then_some((opposite, lag))
}
