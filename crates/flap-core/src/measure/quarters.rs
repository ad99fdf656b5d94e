//! Extrema of the signals in each quarter of a drive period, beside their sums over all of it.
//!
//! Signals of a symmetric motion reach their extrema in both half strokes. A change that breaks the symmetry raises one of
//! two such extrema more than the other, so that the larger of both has a kink. Such extrema lie in opposite quarters.

use super::asked::Asked;
use super::cycle::{Signals, Sums};
use crate::model::{Model, RANGED};
use crate::num::Lanes;
use crate::ode::ensemble::Observer;
use crate::ode::step::Attempt;

/// A phase that steps do not begin at: the first quarter begins there (rad).
const BEGIN: f64 = -0.37;

/// Smallest and largest value of a signal in a quarter.
type Range<R> = [R; 2];

/// Sums over S signals, and the ranges of each in the quarters of the period.
pub type InQuarters<R, const S: usize> = (Sums<R, S>, [[Range<R>; 4]; S]);

/// Sums up the S signals of a model, and finds their extrema in each quarter.
#[derive(Clone, Copy, Debug)]
pub struct Quarters<'a, M, const S: usize>(pub Signals<'a, M, S>);

impl<M: Model<N, S>, const N: usize, const S: usize> Observer<M, N> for Quarters<'_, M, S> {
    type Totals<R: Lanes> = InQuarters<R, S>;

    #[inline(always)]
    fn nothing(&self) -> InQuarters<f64, S> {
        (Observer::<M, N>::nothing(&self.0), [[[f64::INFINITY, f64::NEG_INFINITY]; 4]; S])
    }

    #[inline(always)]
    fn add<R: Lanes>(
        &self,
        c: &M::Constants<R>,
        attempt: &Attempt<'_, R, N>,
        accepted: R::Mask,
        (sums, ranges): &mut InQuarters<R, S>,
    ) {
        let Attempt { t, h, .. } = *attempt;
        let before = *sums;
        for total in &mut sums.0 {
            (total.min, total.max) = (h.lit(f64::INFINITY), h.lit(f64::NEG_INFINITY));
        }
        self.0.add(c, attempt, accepted, sums);
        let middle = h.mul_add(h.lit(0.5), t);
        let (sin, cos) = (M::drive(c).phase(middle) - h.lit(BEGIN)).sin_cos();
        let (up, right) = (h.lit(0.0).lt(sin), h.lit(0.0).lt(cos));
        // In the order of the phase: opposite quarters are two apart.
        let quarters = [up & right, up & !right, !up & !right, !up & right];
        for &i in const { Asked::of(&M::SIGNALS, RANGED) }.positions() {
            let total = &mut sums.0[i];
            for ([min, max], quarter) in ranges[i].iter_mut().zip(quarters) {
                *min = R::select(quarter, total.min.min(*min), *min);
                *max = R::select(quarter, total.max.max(*max), *max);
            }
            total.min = total.min.min(before.0[i].min);
            total.max = total.max.max(before.0[i].max);
        }
    }
}

/// The sums of `runs` whose first is a motion and the others slight changes of it; but extrema that differ by less than an
/// `error`, as a share of them, are made equal in the motion, and shifted by as much in the others. `None` if there are no such.
pub fn with_equal_extrema<const S: usize>(
    runs: &[InQuarters<f64, S>],
    error: f64,
) -> Option<Vec<Sums<f64, S>>> {
    let (first, ranges) = runs.first()?;
    let mut equal: Vec<Sums<f64, S>> = runs.iter().map(|(sums, _)| *sums).collect();
    let mut any = false;
    for i in 0..S {
        if let Some((quarter, lag)) = other_half(ranges[i].map(|[_, max]| max), error) {
            any = true;
            for (sums, (_, ranges)) in equal.iter_mut().zip(runs) {
                sums.0[i].max = sums.0[i].max.max(ranges[i][quarter][1] + lag);
            }
        }
        if let Some((quarter, lag)) = other_half(ranges[i].map(|[min, _]| -min), error) {
            any = true;
            for (sums, (_, ranges)) in equal.iter_mut().zip(runs) {
                sums.0[i].min = sums.0[i].min.min(ranges[i][quarter][0] - lag);
            }
        }
        // Largest magnitudes are those of the largest or of the smallest value.
        let gap = first.0[i].max + first.0[i].min;
        if gap.abs() < error * first.0[i].max {
            any = true;
            for sums in &mut equal {
                sums.0[i].min -= gap;
            }
        }
    }
    any.then_some(equal)
}

/// The quarter opposite to that of the largest value, and the difference of both largest values, if it is less than an `error`.
fn other_half(largest: [f64; 4], error: f64) -> Option<(usize, f64)> {
    let quarter = (0..4).max_by(|&one, &other| largest[one].total_cmp(&largest[other]))?;
    let opposite = (quarter + 2) % 4;
    let lag = largest[quarter] - largest[opposite];
    (lag < error * largest[quarter].abs()).then_some((opposite, lag))
}
