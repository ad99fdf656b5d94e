//! The drive as the lanes of an ensemble share it: its waveform, and the quantity that it sets.

use super::constants::{DriveConstants, Wave};
use super::parameters::{Shape, StrokeMode, WaveformParameters};
use super::samples::Samples;
use crate::num::Real;
use crate::parameter::Invalid;

/// A course over time.
#[derive(Clone, Debug, PartialEq)]
pub enum Waveform {
    /// A periodic shape.
    Shape(Shape),
    /// Samples of a period.
    Samples(Samples),
    /// sin θ with a frequency that changes steadily.
    Chirp,
}

/// The part of a drive that all points in the lanes of an ensemble share.
#[derive(Clone, Debug, PartialEq)]
pub struct Drive {
    /// Its course over time.
    pub waveform: Waveform,
    /// The quantity that it sets.
    pub stroke: StrokeMode,
}

impl Default for Drive {
    /// A sinusoidal voltage.
    fn default() -> Drive {
        Drive::SINE
    }
}

impl Drive {
    /// A sinusoidal voltage.
    pub const SINE: Drive = Drive { waveform: Waveform::Shape(Shape::Sine), stroke: StrokeMode::Free };

    /// A prescribed stroke.
    pub(crate) const PRESCRIBED: Drive = Drive { stroke: StrokeMode::Prescribed, ..Drive::SINE };

    /// The drive of a point, with this one's samples if it has any.
    #[must_use]
    pub fn of_point(&self, shape: Shape, stroke: StrokeMode) -> Drive {
        let waveform = match &self.waveform {
            Waveform::Samples(samples) => Waveform::Samples(samples.clone()),
            Waveform::Shape(_) | Waveform::Chirp => Waveform::Shape(shape),
        };
        Drive { waveform, stroke }
    }

    /// The drive with another waveform.
    #[must_use]
    pub(crate) fn with_waveform(&self, waveform: Waveform) -> Drive {
        Drive { waveform, stroke: self.stroke }
    }

    /// True if the drive sets the stroke, not the voltage.
    #[inline(always)]
    pub fn prescribes_stroke(&self) -> bool {
        self.stroke == StrokeMode::Prescribed
    }

    /// Refuses a rise time that leaves a square wave no time to be flat, and a prescribed stroke with jumps in its
    /// acceleration.
    ///
    /// # Errors
    /// `Together` if the waveform is a square wave, and rises in more than 0.5 of its period or is to be the stroke.
    pub fn check(&self, waveform: &WaveformParameters) -> Result<(), Invalid> {
        if self.waveform != Waveform::Shape(Shape::Square) {
            return Ok(());
        }
        if self.prescribes_stroke() {
            return Err(Invalid::together(
                &["stroke_mode", "drive_shape"],
                "stroke_mode is \"prescribed\": a wing cannot follow a square wave; choose another drive_shape",
            ));
        }
        if waveform.drive_rise > 0.5 {
            let rise = waveform.drive_rise;
            return Err(Invalid::together(
                &["drive_rise", "drive_shape"],
                format!("drive_rise is {rise}; a square wave rises in at most 0.5 of its period"),
            ));
        }
        Ok(())
    }

    /// The waveform, of unit amplitude, at time `t` (s) of its period, from 0 to its end.
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

    /// The voltage (V), or the prescribed stroke (rad), at time `t` (s) of a period.
    #[inline(always)]
    pub fn at<R: Real>(&self, c: &DriveConstants<R>, t: R) -> Wave<R> {
        self.wave(c, t).scaled(c.bias, c.amplitude)
    }

    /// The next time after `t` (s) at which a derivative of the waveform jumps; infinite if there is none. Between samples
    /// the second derivative is continuous: that is smooth enough for the step-size control.
    #[inline(always)]
    pub fn next_break<R: Real>(&self, c: &DriveConstants<R>, t: R) -> R {
        match &self.waveform {
            Waveform::Shape(Shape::Square) => c.next_edge(t),
            Waveform::Shape(Shape::Sine | Shape::Harmonics) | Waveform::Samples(_) | Waveform::Chirp => {
                t.lit(f64::INFINITY)
            }
        }
    }

    /// True if the second half of each period is the negative of the first.
    pub(crate) fn is_symmetric(&self, c: &DriveConstants<f64>) -> bool {
        match &self.waveform {
            Waveform::Shape(Shape::Sine | Shape::Square) => true,
            Waveform::Shape(Shape::Harmonics) => c.second == [0.0; 2],
            Waveform::Samples(_) | Waveform::Chirp => false,
        }
    }

    /// The mean of the waveform over a period: zero but for samples.
    #[inline(always)]
    pub(crate) fn mean(&self) -> f64 {
        match &self.waveform {
            Waveform::Samples(samples) => samples.mean(),
            Waveform::Shape(_) | Waveform::Chirp => 0.0,
        }
    }

    /// The mean voltage (V), or prescribed stroke (rad), over a period.
    #[inline(always)]
    pub fn mean_voltage<R: Real>(&self, c: &DriveConstants<R>) -> R {
        c.bias + c.amplitude * self.mean()
    }

    /// The smallest and largest value of the waveform over a period.
    pub(crate) fn range(&self, c: &DriveConstants<f64>) -> [f64; 2] {
        match &self.waveform {
            Waveform::Shape(_) | Waveform::Chirp => c.range,
            Waveform::Samples(samples) => samples.range(),
        }
    }

    /// The smallest and largest voltage (V) over a period; not numbers where the stroke is prescribed.
    pub(crate) fn voltage_range(&self, c: &DriveConstants<f64>) -> [f64; 2] {
        if self.prescribes_stroke() {
            return [f64::NAN; 2];
        }
        self.range(c).map(|wave| c.bias + c.amplitude * wave)
    }

    /// The largest magnitude of the voltage (V) over a period; not a number where the stroke is prescribed.
    pub(crate) fn largest_voltage(&self, c: &DriveConstants<f64>) -> f64 {
        let [low, high] = self.voltage_range(c);
        high.max(-low)
    }
}
