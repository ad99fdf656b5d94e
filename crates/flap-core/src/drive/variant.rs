//! The part of the drive that is equal in all lanes: the waveform and the prescribed quantity.

use core::f64::consts::FRAC_PI_2;

use super::constants::{DriveConstants, Wave};
use super::parameters::{Shape, StrokeMode, WaveformParameters};
use super::samples::Samples;
use crate::num::Real;
use crate::parameter::Invalid;

/// Shape of the drive over time.
#[derive(Clone, Debug, PartialEq)]
pub enum Waveform {
    /// A periodic shape. Each point has its own values of the parameters of the shape, such as the rise time.
    Shape(Shape),
    /// Samples of one period.
    Samples(Samples),
    /// A sine wave whose frequency changes at a constant rate.
    Chirp,
}

/// The part of a drive that is equal for all points that flap integrates at the same time in lanes.
#[derive(Clone, Debug, PartialEq)]
pub struct Drive {
    /// Shape of the drive over time.
    pub waveform: Waveform,
    /// Quantity that the drive prescribes.
    pub stroke: StrokeMode,
}

impl Drive {
    /// A sinusoidal voltage.
    pub const SINE: Drive = Drive { waveform: Waveform::Shape(Shape::Sine), stroke: StrokeMode::Free };

    /// A prescribed sinusoidal stroke.
    pub(crate) const PRESCRIBED: Drive = Drive { stroke: StrokeMode::Prescribed, ..Drive::SINE };

    /// Returns the drive of a point with the given shape and stroke mode. If the waveform of `self` consists
    /// of samples, the result has the same samples, and the argument `shape` has no effect.
    #[must_use]
    pub fn of_point(&self, shape: Shape, stroke: StrokeMode) -> Drive {
        let waveform = match &self.waveform {
            Waveform::Samples(samples) => Waveform::Samples(samples.clone()),
            Waveform::Shape(_) | Waveform::Chirp => Waveform::Shape(shape),
        };
        Drive { waveform, stroke }
    }

    /// Returns a copy of the drive with the given `waveform`.
    #[must_use]
    pub(crate) fn with_waveform(&self, waveform: Waveform) -> Drive {
        Drive { waveform, stroke: self.stroke }
    }

    /// Returns true if the drive prescribes the stroke instead of the voltage.
    #[inline(always)]
    pub fn prescribes_stroke(&self) -> bool {
        self.stroke == StrokeMode::Prescribed
    }

    /// Checks that the rise and the fall of a square wave fit into the period, and that a prescribed stroke
    /// is not a square wave.
    ///
    /// # Errors
    /// An error if a square wave has a rise time of more than 0.5 of the period. A square wave is also an
    /// error if the drive prescribes the stroke.
    pub fn check(&self, waveform: &WaveformParameters) -> Result<(), Invalid> {
        if self.waveform != Waveform::Shape(Shape::Square) {
            return Ok(());
        }
        if self.prescribes_stroke() {
            return Err(Invalid::new(
                "stroke_mode is \"prescribed\": the stroke cannot jump as a square wave does: choose another drive_shape",
            ));
        }
        if waveform.drive_rise > 0.5 {
            let rise = waveform.drive_rise;
            return Err(Invalid::new(format!("drive_rise is {rise}: a square wave allows at most 0.5")));
        }
        Ok(())
    }

    /// Returns the value of the waveform with unit amplitude at the time `t` (s) after the beginning of a
    /// period.
    #[inline(always)]
    pub(crate) fn wave<R: Real>(&self, c: &DriveConstants<R>, t: R) -> Wave<R> {
        match &self.waveform {
            Waveform::Shape(Shape::Sine) => c.sine(t),
            Waveform::Shape(Shape::Harmonics) => c.harmonics(t),
            Waveform::Shape(Shape::Square) => c.square(t),
            Waveform::Samples(samples) => {
                let frequency = c.half_period.lit(0.5) / c.half_period;
                let [value, rate, bend] = samples.at(t * frequency);
                Wave { value, rate: rate * frequency, bend: bend * frequency * frequency }
            }
            Waveform::Chirp => c.chirp(t),
        }
    }

    /// Returns the voltage (V), or the prescribed stroke (rad), at time `t` (s) of a period.
    #[inline(always)]
    pub fn at<R: Real>(&self, c: &DriveConstants<R>, t: R) -> Wave<R> {
        self.wave(c, t).scaled(c.bias, c.amplitude)
    }

    /// Returns the next time after `t` (s) at which a derivative of the waveform jumps. The result is
    /// infinite if no derivative of the waveform jumps.
    ///
    /// For a waveform from samples, the result is infinite, because the spline and its first two derivatives
    /// do not jump.
    #[inline(always)]
    pub fn next_break<R: Real>(&self, c: &DriveConstants<R>, t: R) -> R {
        match &self.waveform {
            Waveform::Shape(Shape::Square) => c.next_edge(t),
            Waveform::Shape(Shape::Sine | Shape::Harmonics) | Waveform::Samples(_) | Waveform::Chirp => {
                t.lit(f64::INFINITY)
            }
        }
    }

    /// Returns true if the waveform in the second half of each period is the negative of the waveform in the first
    /// half.
    pub(crate) fn is_symmetric(&self, c: &DriveConstants<f64>) -> bool {
        match &self.waveform {
            Waveform::Shape(Shape::Sine | Shape::Square) => true,
            Waveform::Shape(Shape::Harmonics) => c.second == [0.0; 2],
            Waveform::Samples(_) | Waveform::Chirp => false,
        }
    }

    /// Returns the mean of the waveform over a period. The mean is zero unless the waveform consists of samples.
    #[inline(always)]
    pub(crate) fn mean(&self) -> f64 {
        match &self.waveform {
            Waveform::Samples(samples) => samples.mean(),
            Waveform::Shape(_) | Waveform::Chirp => 0.0,
        }
    }

    /// Returns the phase (rad) of the first harmonic of the waveform, relative to a cosine.
    pub(crate) fn first_phase(&self) -> f64 {
        match &self.waveform {
            Waveform::Samples(samples) => samples.first_phase(),
            Waveform::Shape(_) | Waveform::Chirp => -FRAC_PI_2,
        }
    }

    /// Returns the mean voltage (V), or the mean prescribed stroke (rad), over a period.
    #[inline(always)]
    pub fn mean_voltage<R: Real>(&self, c: &DriveConstants<R>) -> R {
        c.bias + c.amplitude * self.mean()
    }

    /// Returns the smallest and the largest value of the waveform over a period.
    pub(crate) fn range(&self, c: &DriveConstants<f64>) -> [f64; 2] {
        match &self.waveform {
            Waveform::Shape(_) | Waveform::Chirp => c.range,
            Waveform::Samples(samples) => samples.range(),
        }
    }

    /// Returns the smallest and the largest voltage (V) over a period. The two voltages are NaN if the drive
    /// prescribes the stroke.
    pub(crate) fn voltage_range(&self, c: &DriveConstants<f64>) -> [f64; 2] {
        if self.prescribes_stroke() {
            return [f64::NAN; 2];
        }
        self.range(c).map(|wave| c.bias + c.amplitude * wave)
    }

    /// Returns the largest magnitude of the voltage (V) over a period. The result is NaN if the stroke is
    /// prescribed.
    pub(crate) fn largest_voltage(&self, c: &DriveConstants<f64>) -> f64 {
        let [low, high] = self.voltage_range(c);
        high.max(-low)
    }
}
