//! Parameters of the drive, which are part of the parameter table of each model.

use crate::parameter::Kind::{Choice, Number};
use crate::parameter::Range::{Any, NonNegative, Positive};

crate::choice! {
    /// Periodic shapes that a waveform can have.
    pub enum Shape {
        /// sin θ.
        Sine = "sine",
        /// A sine with a second and a third harmonic: sin θ + h₂ sin(2θ + p₂) + h₃ sin(3θ + p₃).
        Harmonics = "harmonics",
        /// A square wave between −1 and 1. Each rise and each fall of the square wave has the shape of a sine
        /// from −90° to 90°.
        Square = "square",
    }
}

crate::choice! {
    /// Quantity that the drive prescribes: the voltage or the stroke.
    pub enum StrokeMode {
        /// The drive prescribes the voltage: the stroke results from the equations of motion.
        Free = "free",
        /// The drive prescribes the stroke: the stroke equals the prescribed waveform. Only the pitch results from the
        /// equations of motion.
        Prescribed = "prescribed",
    }
}

crate::parameters! {
    /// Parameters of the waveform.
    pub struct WaveformParameters {
        /// Shape of the drive over a period: a sine, a sine with second and third harmonic, or a square wave with
        /// finite rise time.
        drive_shape: Shape = ("", "", Choice(Shape::NAMES)),
        /// Amplitude of the second harmonic of the drive, relative to the amplitude of the first harmonic, for
        /// drive_shape = "harmonics".
        drive_second_harmonic: f64 = ("", "", Number(Any)),
        /// Phase p_2 of the second harmonic in the drive sin(w t) + h_2 sin(2 w t + p_2), for drive_shape =
        /// "harmonics". Here w is the angular drive frequency, t is the time, and h_2 is
        /// drive_second_harmonic.
        drive_second_phase: f64 = ("rad", "", Number(Any)),
        /// Amplitude of the third harmonic of the drive, relative to the amplitude of the first harmonic, for
        /// drive_shape = "harmonics".
        drive_third_harmonic: f64 = ("", "", Number(Any)),
        /// Phase p_3 of the third harmonic in the drive sin(w t) + h_3 sin(3 w t + p_3), for drive_shape =
        /// "harmonics". Here w is the angular drive frequency, t is the time, and h_3 is
        /// drive_third_harmonic.
        drive_third_phase: f64 = ("rad", "", Number(Any)),
        /// Rise time of the square wave as a fraction of the drive period, for drive_shape = "square". The fall time
        /// equals the rise time. The value of drive_rise is at most 0.5.
        drive_rise: f64 = ("", "", Number(Positive)),
    }
}

impl WaveformParameters {
    /// A sine.
    pub const SINE: WaveformParameters = WaveformParameters::new(Shape::Sine);

    /// Returns a waveform without harmonics. If `drive_shape` is a square wave, each rise and each fall takes
    /// a twentieth of the period.
    pub const fn new(drive_shape: Shape) -> WaveformParameters {
        WaveformParameters {
            drive_shape,
            drive_second_harmonic: 0.0,
            drive_second_phase: 0.0,
            drive_third_harmonic: 0.0,
            drive_third_phase: 0.0,
            drive_rise: 0.05,
        }
    }
}

crate::parameters! {
    /// Parameters of a prescribed stroke.
    pub struct StrokeParameters {
        /// Selects whether the stroke is driven by the actuator or prescribed. A prescribed stroke is
        /// stroke_amplitude times the waveform of the drive, and the force for this motion is not limited.
        /// The pitch always results from the equations of motion, whether the stroke is prescribed or not.
        stroke_mode: StrokeMode = ("", "", Choice(StrokeMode::NAMES)),
        /// Amplitude of the prescribed stroke, for stroke_mode = "prescribed".
        stroke_amplitude: f64 = ("rad", "", Number(NonNegative)),
    }
}

impl StrokeParameters {
    /// A stroke that is driven by the actuator. If you set `stroke_mode` to "prescribed", the amplitude of the stroke
    /// is 10°.
    pub const FREE: StrokeParameters =
        StrokeParameters { stroke_mode: StrokeMode::Free, stroke_amplitude: 10.0_f64.to_radians() };

    /// Returns a prescribed stroke of the given amplitude (rad).
    pub const fn prescribed(stroke_amplitude: f64) -> StrokeParameters {
        StrokeParameters { stroke_mode: StrokeMode::Prescribed, stroke_amplitude }
    }

    /// Returns the constant part and the amplitude of the prescribed quantity: the `voltage` (V) or the stroke (rad).
    pub fn levels(&self, voltage: [f64; 2]) -> [f64; 2] {
        match self.stroke_mode {
            StrokeMode::Free => voltage,
            StrokeMode::Prescribed => [0.0, self.stroke_amplitude],
        }
    }
}
