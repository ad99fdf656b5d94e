//! Signals over one drive period: means, extrema, first harmonics.
//!
//! Means and harmonics are quadratures advanced with the stages of each step: exact to the order of the
//! integration, not sums over samples. They stand outside the error norm. Extrema come from the parabola
//! through a signal's values at the beginning, middle and end of each step.

use crate::model::{Model, SignalCycle};
use crate::num::Lanes;
use crate::ode::dense::interpolate;
use crate::ode::ensemble::Observer;
use crate::ode::step::Step;
use crate::ode::tableau::{B, C};

crate::per_lane! {
    /// What has been summed up of one signal so far.
    pub struct Totals {
        /// ∫ s dt.
        pub integral,
        /// ∫ s² dt.
        pub square,
        /// ∫ max(s, 0) dt.
        pub positive,
        /// ∫ s cos ωt dt.
        pub cosine,
        /// ∫ s sin ωt dt.
        pub sine,
        /// Largest value.
        pub max,
        /// Smallest value.
        pub min,
    }
}

/// Sums up the S signals of a model along a run.
#[derive(Clone, Copy, Debug, Default)]
pub struct Signals<const S: usize>;

impl<M: Model<N, S>, const N: usize, const S: usize> Observer<M, N> for Signals<S> {
    type Totals<R: Lanes> = [Totals<R>; S];

    #[inline(always)]
    fn nothing(&self) -> [Totals<f64>; S] {
        let nothing = Totals {
            integral: 0.0,
            square: 0.0,
            positive: 0.0,
            cosine: 0.0,
            sine: 0.0,
            max: f64::NEG_INFINITY,
            min: f64::INFINITY,
        };
        [nothing; S]
    }

    #[inline(always)]
    fn add<R: Lanes>(
        &self,
        model: &M,
        c: &M::Constants<R>,
        t: R,
        h: R,
        side: R,
        step: &Step<R, N>,
        accepted: R::Mask,
        totals: &mut [Totals<R>; S],
    ) {
        let zero = h.lit(0.0);
        let mut sums = *totals;

        // Quadrature: B has no weight on stages 2 and 7.
        for stage in [0, 2, 3, 4, 5] {
            let at = h.mul_add(h.lit(C[stage]), t);
            let weight = h * B[stage];
            let (sin, cos) = (M::drive_rate(c) * at).sin_cos();
            let values = model.signals(c, &model.input(c, at), side, &step.y[stage], &step.k[stage]);
            for i in 0..S {
                let part = values[i] * weight;
                sums[i].integral = sums[i].integral + part;
                sums[i].square = part.mul_add(values[i], sums[i].square);
                sums[i].positive = values[i].max(zero).mul_add(weight, sums[i].positive);
                sums[i].cosine = part.mul_add(cos, sums[i].cosine);
                sums[i].sine = part.mul_add(sin, sums[i].sine);
            }
        }

        let begin = model.signals(c, &model.input(c, t), side, &step.y[0], &step.k[0]);
        let y_middle = interpolate(step, h, zero.lit(0.5));
        let input = model.input(c, h.mul_add(h.lit(0.5), t));
        let middle = model.signals(c, &input, side, &y_middle, &model.rhs(c, &input, side, &y_middle));
        let end = model.signals(c, &model.input(c, t + h), side, &step.y[6], &step.k[6]);
        for i in 0..S {
            let vertex = vertex(begin[i], middle[i], end[i]);
            let max = begin[i].max(middle[i]).max(end[i]).max(vertex);
            let min = begin[i].min(middle[i]).min(end[i]).min(vertex);
            sums[i].max = max.max(sums[i].max);
            sums[i].min = min.min(sums[i].min);
        }

        for i in 0..S {
            let (old, new) = (totals[i], sums[i]);
            totals[i] = Totals {
                integral: R::select(accepted, new.integral, old.integral),
                square: R::select(accepted, new.square, old.square),
                positive: R::select(accepted, new.positive, old.positive),
                cosine: R::select(accepted, new.cosine, old.cosine),
                sine: R::select(accepted, new.sine, old.sine),
                max: R::select(accepted, new.max, old.max),
                min: R::select(accepted, new.min, old.min),
            };
        }
    }
}

/// The value at the vertex of the parabola through three equidistant values, if it lies between the outer
/// two; otherwise the middle value.
#[inline(always)]
fn vertex<R: Lanes>(begin: R, middle: R, end: R) -> R {
    // f(x) = middle + slope x + ½ bend x², x from −1 to 1.
    let slope = (end - begin) * 0.5;
    let bend = begin + end - middle * 2.0;
    let inside = slope.abs().lt(bend.abs());
    let safe_bend = R::select(inside, bend, bend.lit(1.0));
    R::select(inside, middle - slope * slope / safe_bend * 0.5, middle)
}

/// The cycle's measures from its totals, for a period of `period` seconds.
pub fn finish<const S: usize>(totals: &[Totals<f64>; S], period: f64) -> [SignalCycle; S] {
    totals.map(|total| SignalCycle {
        mean: total.integral / period,
        mean_square: total.square / period,
        positive_mean: total.positive / period,
        // X = (2/T) ∫ x e^{−iωt} dt
        first: [2.0 * total.cosine / period, -2.0 * total.sine / period],
        max: total.max,
        min: total.min,
    })
}
