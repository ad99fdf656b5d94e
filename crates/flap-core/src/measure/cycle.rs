//! Signals over one drive period: means, extrema, first harmonics.
//!
//! Means and harmonics are quadratures advanced with the stages of each step: exact to the order of the
//! integration, not sums over samples. They stand outside the error norm. Extrema come from the polynomial through a
//! signal's values at five places of each step; the positive part of a signal, in steps where it changes sign, from
//! parabolas through three of them each. Of each signal, only what its measures need is found.

use super::asked::Asked;
use super::course::Course;
use crate::model::Measure::{First, Magnitude, Rms, Supply};
use crate::model::{Instant, Measure, Model, RANGED, Signal, SignalCycle};
use crate::num::Lanes;
use crate::ode::dense::interpolate;
use crate::ode::ensemble::Observer;
use crate::ode::step::Attempt;
use crate::ode::tableau::{B, C};
use crate::ode::{input, slope};

/// Measures for which the positive part is integrated.
const RECTIFIED: &[Measure] = &[Supply, Magnitude];
/// Measures for which the square is integrated.
const SQUARED: &[Measure] = &[Rms];
/// Measures for which the first harmonic is integrated.
const HARMONIC: &[Measure] = &[First];

crate::per_lane! {
    /// Sums over one signal so far.
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

/// Sums over S signals so far, and the time integrals of the load at the wing's shoulder, see
/// [`Load::at_shoulder`](crate::model::Load::at_shoulder).
pub type Sums<R, const S: usize> = ([Totals<R>; S], [R; 6]);

/// Sums up the S signals of a model along a run.
#[derive(Clone, Copy, Debug)]
pub struct Signals<'a, M, const S: usize> {
    model: &'a M,
    /// True to look for largest and smallest values and positive parts, which takes most of the work. If false, they have
    /// no meaning.
    extrema: bool,
    /// True to integrate the load too. If false, it is zero.
    loads: bool,
}

impl<'a, M, const S: usize> Signals<'a, M, S> {
    /// Sums up everything.
    pub fn all(model: &'a M) -> Self {
        Signals { model, extrema: true, loads: false }
    }

    /// Sums up means and first harmonics.
    pub fn means(model: &'a M) -> Self {
        Signals { model, extrema: false, loads: false }
    }

    /// The same, with the load if `loads` says so.
    #[must_use]
    pub fn with_loads(self, loads: bool) -> Self {
        Signals { loads, ..self }
    }
}

impl<M: Model<N, S>, const N: usize, const S: usize> Observer<M, N> for Signals<'_, M, S> {
    type Totals<R: Lanes> = Sums<R, S>;

    #[inline(always)]
    fn nothing(&self) -> Sums<f64, S> {
        let nothing = Totals {
            integral: 0.0,
            square: 0.0,
            positive: 0.0,
            cosine: 0.0,
            sine: 0.0,
            max: f64::NEG_INFINITY,
            min: f64::INFINITY,
        };
        ([nothing; S], [0.0; 6])
    }

    #[inline(always)]
    fn add<R: Lanes>(
        &self,
        c: &M::Constants<R>,
        attempt: &Attempt<'_, R, N>,
        accepted: R::Mask,
        (totals, load): &mut Sums<R, S>,
    ) {
        let model = self.model;
        let Attempt { t, h, side, step } = *attempt;
        let zero = h.lit(0.0);
        let mut sums = *totals;
        let mut positive = [zero; S];
        let mut begin = [zero; S];

        // Quadrature: B has no weight on stages 2 and 7.
        for stage in [0, 2, 3, 4, 5] {
            let at = h.mul_add(h.lit(C[stage]), t);
            let weight = h * B[stage];
            let (sin, cos) = M::drive(c).phase(at).sin_cos();
            let u = input(model, c, at);
            let instant = Instant { input: &u, side, y: &step.y[stage], dy: &step.k[stage] };
            let values = signals(model, c, instant);
            if stage == 0 {
                begin = values;
            }
            for i in 0..S {
                sums[i].integral = sums[i].integral + values[i] * weight;
            }
            for &i in const { Asked::of(&M::SIGNALS, SQUARED) }.positions() {
                let part = values[i] * weight;
                sums[i].square = part.mul_add(values[i], sums[i].square);
            }
            for &i in const { Asked::of(&M::SIGNALS, HARMONIC) }.positions() {
                let part = values[i] * weight;
                sums[i].cosine = part.mul_add(cos, sums[i].cosine);
                sums[i].sine = part.mul_add(sin, sums[i].sine);
            }
            for &i in const { Asked::of(&M::SIGNALS, RECTIFIED) }.positions() {
                positive[i] = values[i].max(zero).mul_add(weight, positive[i]);
            }
        }

        if self.extrema {
            let courses = courses(model, c, attempt, begin);
            for &i in const { Asked::of(&M::SIGNALS, RANGED) }.positions() {
                sums[i].max = courses[i].max.max(sums[i].max);
                sums[i].min = courses[i].min.min(sums[i].min);
            }
            for &i in const { Asked::of(&M::SIGNALS, RECTIFIED) }.positions() {
                let changes_sign = (courses[i].max * courses[i].min).lt(zero);
                let part = R::select(changes_sign, courses[i].positive_mean * h, positive[i]);
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
        if self.loads {
            let sums = impulse(model, c, attempt);
            for i in 0..6 {
                load[i] = R::select(accepted, load[i] + sums[i], load[i]);
            }
        }
    }
}

/// The time integral of the load over a step. In a function of its own, see [`slope`].
#[inline(always)]
fn impulse<M: Model<N, S>, R: Lanes, const N: usize, const S: usize>(
    model: &M,
    c: &M::Constants<R>,
    attempt: &Attempt<'_, R, N>,
) -> [R; 6] {
    attempt.h.apart(
        #[inline(always)]
        || {
            let Attempt { t, h, side, step } = *attempt;
            let mut sums = [h.lit(0.0); 6];
            for stage in [0, 2, 3, 4, 5] {
                let u = input(model, c, h.mul_add(h.lit(C[stage]), t));
                let load = model.load(c, Instant { input: &u, side, y: &step.y[stage], dy: &step.k[stage] });
                let load = load.at_shoulder();
                for i in 0..6 {
                    sums[i] = load[i].mul_add(h * B[stage], sums[i]);
                }
            }
            sums
        },
    )
}

/// The range of a signal within a step, and its positive part.
#[derive(Clone, Copy)]
struct Within<R> {
    max: R,
    min: R,
    /// Mean of the positive part.
    positive_mean: R,
}

/// Ranges and positive parts of the signals within a step, found part by part (see [`Model::parts`]), given the signals
/// at its beginning.
#[inline(always)]
fn courses<M: Model<N, S>, R: Lanes, const N: usize, const S: usize>(
    model: &M,
    c: &M::Constants<R>,
    attempt: &Attempt<'_, R, N>,
    mut begin: [R; S],
) -> [Within<R>; S] {
    let Attempt { t, h, side, step } = *attempt;
    let last = Instant { input: &input(model, c, t + h), side, y: &step.y[6], dy: &step.k[6] };
    let last = signals(model, c, last);
    let mut all = begin.map(|value| Within { max: value, min: value, positive_mean: value.lit(0.0) });
    let parts = model.parts();
    let share = 1.0 / f64::from(parts);
    for part in 0..parts {
        let place = |quarter: f64| (f64::from(part) + quarter) * share;
        let first = between(model, c, attempt, place(0.25));
        let middle = between(model, c, attempt, place(0.5));
        let third = between(model, c, attempt, place(0.75));
        let end = if part + 1 == parts { last } else { between(model, c, attempt, place(1.0)) };
        for &i in const { Asked::of(&M::SIGNALS, RANGED) }.positions() {
            let course = Course::through([begin[i], first[i], middle[i], third[i], end[i]]);
            let [min, max] = course.range();
            all[i].max = max.max(all[i].max);
            all[i].min = min.min(all[i].min);
        }
        for &i in const { Asked::of(&M::SIGNALS, RECTIFIED) }.positions() {
            let course = Course::through([begin[i], first[i], middle[i], third[i], end[i]]);
            all[i].positive_mean = all[i].positive_mean + course.positive_mean() * share;
        }
        begin = end;
    }
    all
}

/// The signals at the fraction `theta` of a step.
#[inline(always)]
fn between<M: Model<N, S>, R: Lanes, const N: usize, const S: usize>(
    model: &M,
    c: &M::Constants<R>,
    attempt: &Attempt<'_, R, N>,
    theta: f64,
) -> [R; S] {
    let Attempt { t, h, side, step } = *attempt;
    let at = h.mul_add(h.lit(theta), t);
    let y = interpolate(step, h, h.lit(theta));
    let u = input(model, c, at);
    let dy = if M::SIGNALS_OF_SLOPES { slope(model, c, &u, side, &y) } else { [h.lit(f64::NAN); N] };
    signals(model, c, Instant { input: &u, side, y: &y, dy: &dy })
}

/// The signals at an instant. Called here for the sake of the compiler, see [`slope`].
#[inline(always)]
fn signals<M: Model<N, S>, R: Lanes, const N: usize, const S: usize>(
    model: &M,
    c: &M::Constants<R>,
    at: Instant<'_, R, M::Input<R>, N>,
) -> [R; S] {
    at.side.apart(
        #[inline(always)]
        || model.signals(c, at),
    )
}

/// The signals of the model `M` over a cycle of `period` seconds, from its sums.
pub fn finish<M: Model<N, S>, const N: usize, const S: usize>(
    (totals, _): &Sums<f64, S>,
    period: f64,
) -> [SignalCycle; S] {
    core::array::from_fn(|i| {
        let total = &totals[i];
        // An unknown signal has no extremes and no positive part: maxima leave out values that are not numbers.
        let known = |taken: &[bool; S], value: f64| {
            if taken[i] && !total.integral.is_nan() { value } else { f64::NAN }
        };
        let squared = const { &taken(&M::SIGNALS, SQUARED) };
        let rectified = const { &taken(&M::SIGNALS, RECTIFIED) };
        let harmonic = const { &taken(&M::SIGNALS, HARMONIC) };
        let ranged = const { &taken(&M::SIGNALS, RANGED) };
        SignalCycle {
            mean: total.integral / period,
            mean_square: known(squared, total.square / period),
            positive_mean: known(rectified, total.positive / period),
            // X = (2/T) ∫ x e^{−iωt} dt
            first: [2.0 * total.cosine / period, -2.0 * total.sine / period]
                .map(|part| known(harmonic, part)),
            max: known(ranged, total.max),
            min: known(ranged, total.min),
        }
    })
}

/// For each signal, true if one of the `measures` is taken of it.
const fn taken<const S: usize>(signals: &[Signal; S], measures: &[Measure]) -> [bool; S] {
    let mut taken = [false; S];
    let mut i = 0;
    while i < S {
        taken[i] = signals[i].takes_one_of(measures);
        i += 1;
    }
    taken
}
