//! Measures of signals over one drive period: means, extrema, first harmonics.
//!
//! flap computes means and harmonics as integrals over time, from the values at the stages of each step. The
//! integrals have the same order of accuracy as the integration method. The errors of the integrals do not
//! affect the step size. Extrema are computed from a polynomial through five values of the signal in each
//! step. If a signal changes its sign within a step, flap computes the mean of the signal's positive part
//! from two parabolas. Each of the two parabolas passes through three values of the signal in the step. For
//! each signal, flap computes only the quantities that the measures of this signal need.

use super::step_polynomial::{Extremum, StepPolynomial};
use crate::model::{Each, Instant, Model, SecondHalf, SignalCycle, SignalSet, SignalsOf, Statistics, Totals};
use crate::num::Lanes;
use crate::ode::ensemble::Observer;
use crate::ode::step::Attempt;
use crate::ode::tableau::{B, C};
use crate::ode::{input, slope};

/// Copies values from `sum` to `total`, in the lanes in which the step was `accepted`. The argument
/// `statistics` selects the values that are copied.
#[inline(always)]
fn replace<R: Lanes>(total: &mut Totals<R>, statistics: Statistics, accepted: R::Mask, sum: &Totals<R>) {
    total.integral = R::select(accepted, sum.integral, total.integral);
    if statistics.squared {
        total.square = R::select(accepted, sum.square, total.square);
    }
    if statistics.harmonic {
        total.cosine = R::select(accepted, sum.cosine, total.cosine);
        total.sine = R::select(accepted, sum.sine, total.sine);
    }
    if statistics.rectified {
        total.positive = R::select(accepted, sum.positive, total.positive);
    }
    if statistics.ranged {
        total.max = R::select(accepted, sum.max, total.max);
        total.min = R::select(accepted, sum.min, total.min);
    }
}

/// Time integrals and extrema of each signal of the set `S`, and the time integrals of the load at the wing's
/// shoulder.
///
/// [`Load::at_shoulder`](crate::model::Load::at_shoulder) describes the components of the load.
pub type Sums<S, R> = (Each<S, Totals<R>>, [R; 6]);

/// Returns the time integrals and extrema over a whole period, computed from the time integrals and extrema
/// over the first half.
///
/// The function `second_half` computes the time integrals and extrema of the signals over the second half of
/// the period. The stroke, the force and the moment in the second half of the period are mirror images of
/// their values in the first half.
pub(crate) fn over_both_halves<S: SignalSet>(
    (Each(first), load): &Sums<S, f64>,
    second_half: SecondHalf<S>,
) -> Sums<S, f64> {
    let totals = S::zip(first, &second_half(first), |_, first, second| first.with(second));
    let [_, along_span, lift, about_x, ..] = load.map(|sum| 2.0 * sum);
    (Each(totals), [0.0, along_span, lift, about_x, 0.0, 0.0])
}

/// Time integrals and extrema of the signals of the model `M`, in one lane.
pub(crate) type SumsOf<M, const N: usize> = Sums<<M as Model<N>>::Signals, f64>;

/// Observer that computes time integrals and extrema of the signals of a model during an integration.
#[derive(Clone, Copy, Debug)]
pub struct SignalObserver<'a, M> {
    model: &'a M,
    /// True if the observer computes extrema and positive parts, which takes most of the observer's computing
    /// time. If `extrema` is false, the extrema and the positive parts are undefined.
    extrema: bool,
    /// True if the observer also integrates the load at the shoulder. If `loads` is false, the integral of
    /// the load is zero.
    loads: bool,
}

impl<'a, M> SignalObserver<'a, M> {
    /// Returns an observer that computes all time integrals and extrema of the signals, but not the integral
    /// of the load.
    pub fn all(model: &'a M) -> Self {
        SignalObserver { model, extrema: true, loads: false }
    }

    /// Returns an observer that computes means and first harmonics, but no extrema and no positive parts.
    pub(crate) fn means(model: &'a M) -> Self {
        SignalObserver { model, extrema: false, loads: false }
    }

    /// Returns a copy of the observer. The copy integrates the load if `loads` is true.
    #[must_use]
    pub(crate) fn with_loads(self, loads: bool) -> Self {
        SignalObserver { loads, ..self }
    }

    /// Adds the contribution of a step to the sums, as [`Observer::add`] does. If the observer computes
    /// extrema, the result contains the extrema of each signal within the step.
    #[inline(always)]
    pub(super) fn add_step<R: Lanes, const N: usize>(
        &self,
        c: &M::Constants<R>,
        attempt: &Attempt<'_, R, N>,
        accepted: R::Mask,
        (Each(totals), load): &mut Sums<M::Signals, R>,
    ) -> Option<SignalsOf<M::Signals, Within<R>>>
    where
        M: Model<N>,
    {
        let model = self.model;
        let Attempt { t, h, side, step } = *attempt;
        let zero = h.lit(0.0);
        let mut sums = *totals;
        let mut positive = M::Signals::all(zero);
        let mut begin = M::Signals::all(zero);

        // Stages 2 and 7 have weight zero in B.
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
            M::Signals::update(
                &mut sums,
                [&values],
                #[inline(always)]
                |statistics, sum, [value]| {
                    let part = value * weight;
                    sum.integral = sum.integral + part;
                    if statistics.squared {
                        sum.square = part.mul_add(value, sum.square);
                    }
                    if statistics.harmonic {
                        sum.cosine = part.mul_add(cos, sum.cosine);
                        sum.sine = part.mul_add(sin, sum.sine);
                    }
                },
            );
            M::Signals::update(
                &mut positive,
                [&values],
                #[inline(always)]
                |statistics, sum, [value]| {
                    if statistics.rectified {
                        *sum = value.max(zero).mul_add(weight, *sum);
                    }
                },
            );
        }

        let mut ranges = None;
        if self.extrema {
            let within = within(model, c, attempt, begin);
            M::Signals::update(
                &mut positive,
                [&within],
                #[inline(always)]
                |statistics, part, [Within { min, max, positive_mean }]| {
                    if statistics.rectified {
                        let changes_sign = (max.value * min.value).lt(zero);
                        *part = R::select(changes_sign, positive_mean * h, *part);
                    }
                },
            );
            M::Signals::update(
                &mut sums,
                [&within],
                #[inline(always)]
                |statistics, sum, [Within { min, max, .. }]| {
                    if statistics.ranged {
                        sum.max = max.value.max(sum.max);
                        sum.min = min.value.min(sum.min);
                    }
                },
            );
            M::Signals::update(
                &mut sums,
                [&positive],
                #[inline(always)]
                |statistics, sum, [part]| {
                    if statistics.rectified {
                        sum.positive = sum.positive + part;
                    }
                },
            );
            ranges = Some(within);
        }

        M::Signals::update(
            totals,
            [&sums],
            #[inline(always)]
            |statistics, total, [sum]| replace(total, statistics, accepted, &sum),
        );
        if self.loads {
            let sums = impulse(model, c, attempt);
            for i in 0..6 {
                load[i] = R::select(accepted, load[i] + sums[i], load[i]);
            }
        }
        ranges
    }
}

impl<M: Model<N>, const N: usize> Observer<M, N> for SignalObserver<'_, M> {
    type Totals<R: Lanes> = Sums<M::Signals, R>;

    #[inline(always)]
    fn nothing(&self) -> Sums<M::Signals, f64> {
        let nothing = Totals {
            integral: 0.0,
            square: 0.0,
            positive: 0.0,
            cosine: 0.0,
            sine: 0.0,
            max: f64::NEG_INFINITY,
            min: f64::INFINITY,
        };
        (Each(M::Signals::all(nothing)), [0.0; 6])
    }

    #[inline(always)]
    fn add<R: Lanes>(
        &self,
        c: &M::Constants<R>,
        attempt: &Attempt<'_, R, N>,
        accepted: R::Mask,
        totals: &mut Sums<M::Signals, R>,
    ) {
        self.add_step(c, attempt, accepted, totals);
    }
}

/// Returns the time integral of the load over a step. The code is not inlined, for the reason given at
/// [`slope`].
#[inline(always)]
fn impulse<M: Model<N>, R: Lanes, const N: usize>(
    model: &M,
    c: &M::Constants<R>,
    attempt: &Attempt<'_, R, N>,
) -> [R; 6] {
    attempt.h.outlined(
        #[inline(always)]
        || model.impulse(c, attempt),
    )
}

/// Extrema of a signal within a step, their positions as fractions of the step, and the mean of the signal's
/// positive part.
#[derive(Clone, Copy)]
pub(super) struct Within<R> {
    pub(super) min: Extremum<R>,
    pub(super) max: Extremum<R>,
    positive_mean: R,
}

/// Returns extrema and positive parts of the signals within a step, given the signals at the beginning of the
/// step.
///
/// A model can divide the step into several parts (see [`Model::parts`]). flap computes the extrema
/// separately in each part.
#[inline(always)]
fn within<M: Model<N>, R: Lanes, const N: usize>(
    model: &M,
    c: &M::Constants<R>,
    attempt: &Attempt<'_, R, N>,
    mut begin: SignalsOf<M::Signals, R>,
) -> SignalsOf<M::Signals, Within<R>> {
    let Attempt { t, h, side, step } = *attempt;
    let last = Instant { input: &input(model, c, t + h), side, y: &step.y[6], dy: &step.k[6] };
    let last = signals(model, c, last);
    let zero = h.lit(0.0);
    let mut all = M::Signals::map(
        &begin,
        #[inline(always)]
        |_, value| {
            let first = Extremum { value, place: zero };
            Within { min: first, max: first, positive_mean: zero }
        },
    );
    let parts = model.parts();
    let share = 1.0 / f64::from(parts);
    for part in 0..parts {
        let place = |quarter: f64| (f64::from(part) + quarter) * share;
        let first = between(model, c, attempt, place(0.25));
        let middle = between(model, c, attempt, place(0.5));
        let third = between(model, c, attempt, place(0.75));
        let end = if part + 1 == parts { last } else { between(model, c, attempt, place(1.0)) };
        M::Signals::update(
            &mut all,
            [&begin, &first, &middle, &third, &end],
            #[inline(always)]
            |statistics, within, values| {
                let polynomial = StepPolynomial::through(values);
                if statistics.ranged {
                    let [min, max] = polynomial.extrema();
                    within.min = min.within(place(0.5), share).or_smaller(within.min);
                    within.max = max.within(place(0.5), share).or_larger(within.max);
                }
                if statistics.rectified {
                    within.positive_mean = within.positive_mean + polynomial.positive_mean() * share;
                }
            },
        );
        begin = end;
    }
    all
}

/// Returns the signals within a step, at the fraction `theta` of the step size.
#[inline(always)]
fn between<M: Model<N>, R: Lanes, const N: usize>(
    model: &M,
    c: &M::Constants<R>,
    attempt: &Attempt<'_, R, N>,
    theta: f64,
) -> SignalsOf<M::Signals, R> {
    let Attempt { t, h, side, step } = *attempt;
    let at = h.mul_add(h.lit(theta), t);
    let y = step.interpolate(h, h.lit(theta));
    let u = input(model, c, at);
    let dy = if M::SIGNALS_OF_SLOPES { slope(model, c, &u, side, &y) } else { [h.lit(f64::NAN); N] };
    signals(model, c, Instant { input: &u, side, y: &y, dy: &dy })
}

/// Returns the signals at an instant. The code is not inlined, for the reason given at [`slope`].
#[inline(always)]
fn signals<M: Model<N>, R: Lanes, const N: usize>(
    model: &M,
    c: &M::Constants<R>,
    at: Instant<'_, R, M::Input<R>, N>,
) -> SignalsOf<M::Signals, R> {
    if M::HAS_PLAIN && model.is_plain() {
        return at.side.outlined(
            #[inline(always)]
            || model.plain_signals(c, at),
        );
    }
    at.side.outlined(
        #[inline(always)]
        || model.signals(c, at),
    )
}

/// Returns means, extrema and harmonics of the signals `S` over a cycle of `period` seconds, given the time
/// integrals and extrema of the signals over this cycle.
pub fn finish<S: SignalSet>((Each(totals), _): &Sums<S, f64>, period: f64) -> S::Of<SignalCycle> {
    S::map(totals, |statistics, total: Totals<f64>| {
        // A signal that is not a number has no extrema and no positive part: `max` alone would skip NaN.
        let known =
            |computed: bool, value: f64| if computed && !total.integral.is_nan() { value } else { f64::NAN };
        SignalCycle {
            mean: total.integral / period,
            mean_square: known(statistics.squared, total.square / period),
            positive_mean: known(statistics.rectified, total.positive / period),
            // X = (2/T) ∫ x e^{−iωt} dt
            first: [2.0 * total.cosine / period, -2.0 * total.sine / period]
                .map(|part| known(statistics.harmonic, part)),
            max: known(statistics.ranged, total.max),
            min: known(statistics.ranged, total.min),
        }
    })
}
