//! Waveforms of unit amplitude. All begin to rise through zero (but for harmonics) at the beginning of a period.

use core::f64::consts::PI;

use crate::num::Real;
use crate::parameter::Slot;

/// The shape of a waveform.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Shape {
    /// sin θ.
    #[default]
    Sine,
    /// sin θ + h₂ sin(2θ + p₂) + h₃ sin(3θ + p₃).
    Harmonics,
    /// ±1, with edges of a half sine wave.
    Square,
    /// sin θ with a frequency that changes steadily. Not a choice of parameters, as it is not periodic.
    Chirp,
}

impl Shape {
    /// Names of the periodic shapes, in the order of their values.
    pub const NAMES: &'static [&'static str] = &["sine", "harmonics", "square"];
}

impl Slot for Shape {
    fn take(values: &mut impl Iterator<Item = f64>) -> Shape {
        let shapes = [Shape::Sine, Shape::Harmonics, Shape::Square];
        values.next().and_then(|value| crate::parameter::option(&shapes, value)).unwrap_or_default()
    }

    fn put(&self, values: &mut Vec<f64>) {
        values.push(f64::from(*self as u8));
    }
}

/// A waveform at a time.
#[derive(Clone, Copy, Debug)]
pub struct Wave<R> {
    /// Value.
    pub value: R,
    /// Rate of change (1/s).
    pub rate: R,
    /// Rate of change of that (1/s²).
    pub bend: R,
}

crate::per_lane! {
    /// What shapes a waveform, per design point.
    pub struct Waveform<R> {
        /// Angular frequency (rad/s); of a chirp, at the beginning.
        pub rate: R,
        /// Rate of change of the angular frequency (rad/s²), zero but for a chirp.
        pub growth: R,
        /// Second harmonic: factors of sin 2θ and cos 2θ.
        pub second: [R; 2],
        /// Third harmonic: factors of sin 3θ and cos 3θ.
        pub third: [R; 2],
        /// Square wave: half the period (s).
        pub half_period: R,
        /// Square wave: half the rise time (s).
        pub half_rise: R,
    }
}

impl Waveform<f64> {
    /// A waveform of `frequency` (Hz); relative amplitudes and phases (rad) of the second and third harmonic;
    /// rise time as a fraction of the period.
    pub fn new(frequency: f64, harmonics: [f64; 2], phases: [f64; 2], rise: f64) -> Waveform<f64> {
        let harmonic = |i: usize| {
            let (sin, cos) = Real::sin_cos(phases[i] % (2.0 * PI));
            [harmonics[i] * cos, harmonics[i] * sin]
        };
        Waveform {
            rate: 2.0 * PI * frequency,
            growth: 0.0,
            second: harmonic(0),
            third: harmonic(1),
            half_period: 0.5 / frequency,
            half_rise: 0.5 * rise / frequency,
        }
    }

    /// The smallest and largest value over a period.
    pub fn range(&self, shape: Shape) -> [f64; 2] {
        if shape != Shape::Harmonics {
            return [-1.0, 1.0];
        }
        // Sampled finely enough for five digits: between samples a third harmonic moves by 1e-5 of its size.
        let period = 2.0 * self.half_period;
        let values = (0..2000).map(|i| self.at(shape, period * f64::from(i) / 2000.0).value);
        values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(v), high.max(v)])
    }

    /// A sine that begins at `frequency` (Hz) and changes by `rate` (Hz/s).
    pub fn chirp(frequency: f64, rate: f64) -> Waveform<f64> {
        Waveform { growth: 2.0 * PI * rate, ..Waveform::new(frequency, [0.0; 2], [0.0; 2], 0.5) }
    }
}

impl<R: Real> Waveform<R> {
    /// The phase θ (rad) at time `t` (s).
    #[inline(always)]
    pub fn phase(&self, t: R) -> R {
        (self.growth * t).mul_add(t.lit(0.5), self.rate) * t
    }

    /// The waveform at time `t` (s) of its period, from 0 to its end.
    #[inline(always)]
    pub fn at(&self, shape: Shape, t: R) -> Wave<R> {
        match shape {
            Shape::Sine => {
                let (sin, cos) = (self.rate * t).sin_cos();
                Wave { value: sin, rate: self.rate * cos, bend: -(self.rate * self.rate * sin) }
            }
            Shape::Harmonics => self.harmonics(t),
            Shape::Square => self.square(t),
            Shape::Chirp => {
                let (sin, cos) = self.phase(t).sin_cos();
                let rate = self.growth * t + self.rate;
                Wave { value: sin, rate: rate * cos, bend: self.growth * cos - rate * rate * sin }
            }
        }
    }

    /// The next time after `t` at which a derivative of the waveform jumps: the edges of a square wave begin and
    /// end there. Infinite if there is none.
    #[inline(always)]
    pub fn next_break(&self, shape: Shape, t: R) -> R {
        let never = t.lit(f64::INFINITY);
        if shape != Shape::Square {
            return never;
        }
        let period = self.half_period * 2.0;
        let mut next = never;
        for edge in [
            period - self.half_rise,
            self.half_period + self.half_rise,
            self.half_period - self.half_rise,
            self.half_rise,
        ] {
            next = R::select(t.lt(edge), edge, next);
        }
        next
    }

    #[inline(always)]
    fn harmonics(&self, t: R) -> Wave<R> {
        let (sin, cos) = (self.rate * t).sin_cos();
        let (sin_2, cos_2) = (sin * cos * 2.0, cos * cos * 2.0 - 1.0);
        let (sin_3, cos_3) = (sin_2 * cos + cos_2 * sin, cos_2 * cos - sin_2 * sin);
        let [a_2, b_2] = self.second;
        let [a_3, b_3] = self.third;
        Wave {
            value: sin + a_2 * sin_2 + b_2 * cos_2 + a_3 * sin_3 + b_3 * cos_3,
            rate: self.rate * (cos + (a_2 * cos_2 - b_2 * sin_2) * 2.0 + (a_3 * cos_3 - b_3 * sin_3) * 3.0),
            bend: -(self.rate
                * self.rate
                * (sin + (a_2 * sin_2 + b_2 * cos_2) * 4.0 + (a_3 * sin_3 + b_3 * cos_3) * 9.0)),
        }
    }

    /// Edges at 0, at half the period and at its end, each a sine from −90° to 90°.
    #[inline(always)]
    fn square(&self, t: R) -> Wave<R> {
        let zero = t.lit(0.0);
        let one = t.lit(1.0);
        let from_middle = t - self.half_period;
        let first_half = from_middle.lt(zero);
        let level = R::select(first_half, one, -one);
        // Distance to the nearest edge, and whether it grows with time.
        let to_outer = self.half_period - from_middle.abs();
        let to_middle = from_middle.abs();
        let outer_nearer = to_outer.lt(to_middle);
        let distance = R::select(outer_nearer, to_outer, to_middle);
        let away = R::select(outer_nearer, level, -level);

        let on_edge = distance.lt(self.half_rise);
        let slope = one / self.half_rise * (0.5 * PI);
        let (sin, cos) = (R::select(on_edge, distance, zero) * slope).sin_cos();
        Wave {
            value: R::select(on_edge, level * sin, level),
            rate: R::select(on_edge, level * away * cos * slope, zero),
            bend: R::select(on_edge, -(level * sin * slope * slope), zero),
        }
    }
}
