//! Constants of a point's drive, and the formulas of the waveforms.
//!
//! At the beginning of a period, the sine, the square wave and the chirp are zero and rise.

use core::f64::consts::PI;

use super::parameters::{Shape, WaveformParameters};
use crate::num::Real;

/// Value of the drive at one instant, with its derivatives. The value is a wave of unit amplitude, a voltage
/// (V), or a prescribed stroke (rad).
#[derive(Clone, Copy, Debug)]
pub struct Wave<R> {
    /// Value.
    pub value: R,
    /// Rate of change (1/s).
    pub rate: R,
    /// Second derivative (1/s²).
    pub bend: R,
}

impl<R: Real> Wave<R> {
    /// Returns a wave with the given value and rate. The second derivative is set to zero, because the
    /// equations do not contain the second derivative of a voltage.
    #[inline(always)]
    pub fn with_rate(value: R, rate: R) -> Wave<R> {
        Wave { value, rate, bend: value.lit(0.0) }
    }

    /// Returns `bias + amplitude · self`.
    #[inline(always)]
    pub(crate) fn scaled(&self, bias: R, amplitude: R) -> Wave<R> {
        Wave {
            value: amplitude.mul_add(self.value, bias),
            rate: amplitude * self.rate,
            bend: amplitude * self.bend,
        }
    }
}

impl<R> From<[R; 3]> for Wave<R> {
    /// Returns the wave with the given value, rate and second derivative.
    fn from([value, rate, bend]: [R; 3]) -> Wave<R> {
        Wave { value, rate, bend }
    }
}

crate::per_lane! {
    /// Constants of the drive of a design point.
    pub struct DriveConstants<R> {
        /// Constant part of the voltage (V). The constant part is zero if the stroke is prescribed.
        pub bias: R,
        /// Amplitude of the voltage (V), or of the prescribed stroke (rad).
        pub amplitude: R,
        /// Angular frequency of the drive (rad/s). For a chirp, `rate` is the angular frequency at the
        /// beginning.
        pub rate: R,
        /// Rate of change of the angular frequency (rad/s²). The angular frequency is constant for all
        /// waveforms except a chirp.
        pub growth: R,
        /// Factors of sin 2θ and cos 2θ in the second harmonic.
        pub second: [R; 2],
        /// Factors of sin 3θ and cos 3θ in the third harmonic.
        pub third: [R; 2],
        /// Half of the period (s).
        pub half_period: R,
        /// Half of the rise time of the square wave (s).
        pub half_rise: R,
        /// Smallest and largest value of the waveform over a period.
        pub range: [R; 2],
    }
}

impl DriveConstants<f64> {
    /// Returns the constants of a drive with the given `frequency` (Hz), waveform, constant part and
    /// amplitude. The unit of constant part and amplitude is V for a voltage, and rad for a prescribed
    /// stroke.
    pub fn new(
        frequency: f64,
        waveform: &WaveformParameters,
        [bias, amplitude]: [f64; 2],
    ) -> DriveConstants<f64> {
        let p = waveform;
        let harmonic = |amplitude: f64, phase: f64| {
            let (sin, cos) = Real::sin_cos(phase % (2.0 * PI));
            [amplitude * cos, amplitude * sin]
        };
        let mut constants = DriveConstants {
            bias,
            amplitude,
            rate: 2.0 * PI * frequency,
            growth: 0.0,
            second: harmonic(p.drive_second_harmonic, p.drive_second_phase),
            third: harmonic(p.drive_third_harmonic, p.drive_third_phase),
            half_period: 0.5 / frequency,
            half_rise: 0.5 * p.drive_rise / frequency,
            range: [-1.0, 1.0],
        };
        if p.drive_shape == Shape::Harmonics {
            constants.range = constants.range_of_harmonics();
        }
        constants
    }

    /// Returns the drive with a chirp as its waveform. The frequency of the chirp begins at `frequency` (Hz)
    /// and changes at the constant `rate` (Hz/s).
    #[must_use]
    pub(crate) fn chirped(&self, frequency: f64, rate: f64) -> DriveConstants<f64> {
        let levels = [self.bias, self.amplitude];
        let sine = DriveConstants::new(frequency, &WaveformParameters::SINE, levels);
        DriveConstants { growth: 2.0 * PI * rate, ..sine }
    }

    /// Returns the drive with a constant `voltage` (V).
    #[must_use]
    pub(crate) fn still(&self, voltage: f64) -> DriveConstants<f64> {
        DriveConstants { bias: voltage, amplitude: 0.0, rate: 0.0, ..*self }
    }

    /// Returns the length of a period (s).
    pub fn period(&self) -> f64 {
        2.0 * self.half_period
    }

    /// Returns the frequency (Hz).
    pub(crate) fn frequency(&self) -> f64 {
        self.rate / (2.0 * PI)
    }

    fn range_of_harmonics(&self) -> [f64; 2] {
        // 2,000 samples give five digits: between samples a third harmonic changes by 1e-5 of its amplitude.
        let values = (0..2000).map(|i| self.harmonics(self.period() * f64::from(i) / 2000.0).value);
        values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(v), high.max(v)])
    }
}

impl<R: Real> DriveConstants<R> {
    /// Returns the phase θ (rad) at time `t` (s).
    #[inline(always)]
    pub fn phase(&self, t: R) -> R {
        (self.growth * t).mul_add(t.lit(0.5), self.rate) * t
    }

    #[inline(always)]
    pub(super) fn sine(&self, t: R) -> Wave<R> {
        let (sin, cos) = (self.rate * t).sin_cos();
        Wave { value: sin, rate: self.rate * cos, bend: -(self.rate * self.rate * sin) }
    }

    #[inline(always)]
    pub(super) fn chirp(&self, t: R) -> Wave<R> {
        let (sin, cos) = self.phase(t).sin_cos();
        let rate = self.growth * t + self.rate;
        Wave { value: sin, rate: rate * cos, bend: self.growth * cos - rate * rate * sin }
    }

    #[inline(always)]
    pub(super) fn harmonics(&self, t: R) -> Wave<R> {
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

    /// Returns the square wave and its first two time derivatives at time `t` (s). The square wave rises at
    /// the beginning and at the end of the period, and falls in the middle of the period. Each rise and each
    /// fall has the shape of a sine from −90° to 90°.
    #[inline(always)]
    pub(super) fn square(&self, t: R) -> Wave<R> {
        let zero = t.lit(0.0);
        let one = t.lit(1.0);
        let from_middle = t - self.half_period;
        let first_half = from_middle.lt(zero);
        let level = R::select(first_half, one, -one);
        // Distance to the nearest edge, and the sign of its rate of change.
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

    /// Returns the next time after `t` at which a derivative of the square wave jumps, because a rise or a
    /// fall begins or ends. The result is infinite if the derivatives do not jump after `t`.
    #[inline(always)]
    pub(super) fn next_edge(&self, t: R) -> R {
        let period = self.half_period * 2.0;
        let mut next = t.lit(f64::INFINITY);
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
}
