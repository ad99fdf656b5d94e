//! Signals over one drive period: means, extrema, first harmonics.
//!
//! Means and harmonics are quadratures advanced with the stages of each step: exact to the order of the
//! integration, not sums over samples. They stand outside the error norm. Extrema, and the positive part of a
//! signal in steps where it changes sign, come from the parabola through its values at the beginning, middle
//! and end of the step.

use crate::model::{Measure, Model, Signal, SignalCycle};
use crate::num::Lanes;
use crate::ode::dense::interpolate;
use crate::ode::ensemble::Observer;
use crate::ode::slope;
use crate::ode::step::Attempt;
use crate::ode::tableau::{B, C};

crate::per_lane! {
    /// What has been summed up of one signal so far.
    pub struct Totals<R> {
        /// ∫ s dt.
        pub integral: R,
        /// ∫ s² dt.
        pub square: R,
        /// ∫ max(s, 0) dt.
        pub positive: R,
        /// ∫ s cos ωt dt.
        pub cosine: R,
        /// ∫ s sin ωt dt.
        pub sine: R,
        /// Largest value.
        pub max: R,
        /// Smallest value.
        pub min: R,
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
        attempt: &Attempt<'_, R, N>,
        accepted: R::Mask,
        totals: &mut [Totals<R>; S],
    ) {
        let Attempt { t, h, side, step } = *attempt;
        let zero = h.lit(0.0);
        let mut sums = *totals;
        let mut positive = [zero; S];

        // Quadrature: B has no weight on stages 2 and 7.
        for stage in [0, 2, 3, 4, 5] {
            let at = h.mul_add(h.lit(C[stage]), t);
            let weight = h * B[stage];
            let (sin, cos) = model.drive_phase(c, at).sin_cos();
            let values = signals(model, c, at, side, &step.y[stage], &step.k[stage]);
            for i in 0..S {
                let part = values[i] * weight;
                sums[i].integral = sums[i].integral + part;
                sums[i].square = part.mul_add(values[i], sums[i].square);
                positive[i] = values[i].max(zero).mul_add(weight, positive[i]);
                sums[i].cosine = part.mul_add(cos, sums[i].cosine);
                sums[i].sine = part.mul_add(sin, sums[i].sine);
            }
        }

        let begin = signals(model, c, t, side, &step.y[0], &step.k[0]);
        let y_middle = interpolate(step, h, zero.lit(0.5));
        let half = h.mul_add(h.lit(0.5), t);
        let slope_middle = slope(model, c, &model.input(c, half), side, &y_middle);
        let middle = signals(model, c, half, side, &y_middle, &slope_middle);
        let end = signals(model, c, t + h, side, &step.y[6], &step.k[6]);
        for i in 0..S {
            let parabola = Parabola::through(begin[i], middle[i], end[i]);
            let vertex = parabola.vertex();
            let max = begin[i].max(middle[i]).max(end[i]);
            let min = begin[i].min(middle[i]).min(end[i]);
            sums[i].max = max.max(vertex).max(sums[i].max);
            sums[i].min = min.min(vertex).min(sums[i].min);
            if needs_positive_part(&M::SIGNALS[i]) {
                let changes_sign = (max * min).lt(zero);
                let part = R::select(changes_sign, parabola.positive_mean() * h, positive[i]);
                sums[i].positive = sums[i].positive + part;
            }
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

/// The signals at time `t`. Called here for the sake of the compiler, see [`slope`].
#[inline(always)]
fn signals<M: Model<N, S>, R: Lanes, const N: usize, const S: usize>(
    model: &M,
    c: &M::Constants<R>,
    t: R,
    side: R,
    y: &[R; N],
    dy: &[R; N],
) -> [R; S] {
    t.apart(
        #[inline(always)]
        || model.signals(c, &model.input(c, t), side, y, dy),
    )
}

fn needs_positive_part(signal: &Signal) -> bool {
    signal.measures.iter().any(|measure| matches!(measure, Measure::Supply | Measure::Magnitude))
}

/// A signal within a step: middle + slope x + ½ bend x², with x from −1 to 1.
#[derive(Clone, Copy)]
struct Parabola<R> {
    begin: R,
    middle: R,
    end: R,
    slope: R,
    bend: R,
}

impl<R: Lanes> Parabola<R> {
    #[inline(always)]
    fn through(begin: R, middle: R, end: R) -> Parabola<R> {
        Parabola { begin, middle, end, slope: (end - begin) * 0.5, bend: begin + end - middle * 2.0 }
    }

    /// The value at the vertex if that lies within the step, otherwise the middle value.
    #[inline(always)]
    fn vertex(&self) -> R {
        let inside = self.slope.abs().lt(self.bend.abs());
        let bend = R::select(inside, self.bend, self.bend.lit(1.0));
        R::select(inside, self.middle - self.slope * self.slope / bend * 0.5, self.middle)
    }

    /// The mean over the step of the positive part, for at most one change of sign in each half.
    #[inline(always)]
    fn positive_mean(&self) -> R {
        let (zero, one) = (self.middle.lit(0.0), self.middle.lit(1.0));
        (self.positive_area(-one, self.begin, zero, self.middle)
            + self.positive_area(zero, self.middle, one, self.end))
            * 0.5
    }

    /// ∫ of the positive part from `x0` to `x1`, where the parabola has the values `f0` and `f1`.
    #[inline(always)]
    fn positive_area(&self, x0: R, f0: R, x1: R, f1: R) -> R {
        let mut root = x0 + f0 / (f0 - f1) * (x1 - x0);
        for _ in 0..3 {
            let value = root.mul_add(root.mul_add(self.bend * 0.5, self.slope), self.middle);
            let slope = root.mul_add(self.bend, self.slope);
            root = (root - value / slope).max(x0).min(x1);
        }
        let zero = root.lit(0.0);
        let from = R::select(zero.lt(f0), x0, root);
        let to = R::select(zero.lt(f1), x1, root);
        self.antiderivative(to) - self.antiderivative(from)
    }

    #[inline(always)]
    fn antiderivative(&self, x: R) -> R {
        x * x.mul_add(x.mul_add(self.bend * (1.0 / 6.0), self.slope * 0.5), self.middle)
    }
}

/// The cycle's measures from its totals, for a period of `period` seconds.
pub fn finish<const S: usize>(totals: &[Totals<f64>; S], period: f64) -> [SignalCycle; S] {
    totals.map(|total| {
        // What is unknown has no extremes and no positive part: maxima leave out what is not a number.
        let known = |value: f64| if total.integral.is_nan() { f64::NAN } else { value };
        SignalCycle {
            mean: total.integral / period,
            mean_square: total.square / period,
            positive_mean: known(total.positive / period),
            // X = (2/T) ∫ x e^{−iωt} dt
            first: [2.0 * total.cosine / period, -2.0 * total.sine / period],
            max: known(total.max),
            min: known(total.min),
        }
    })
}
