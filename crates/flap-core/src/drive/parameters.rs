//! Parameters of the drive, as parts of a model's table.

use crate::parameter::Kind::{Choice, Number};
use crate::parameter::Range::{Any, NonNegative, Positive};

crate::choice! {
    /// Periodic shapes of a waveform.
    pub enum Shape {
        /// sin θ.
        Sine = "sine",
        /// sin θ + h₂ sin(2θ + p₂) + h₃ sin(3θ + p₃).
        Harmonics = "harmonics",
        /// ±1, with edges of a half sine wave.
        Square = "square",
    }
}

crate::choice! {
    /// Quantity that the drive prescribes.
    pub enum StrokeMode {
        /// The voltage: the stroke follows from the equations of motion.
        Free = "free",
        /// The stroke: it follows the waveform exactly. Only the pitch follows from the equations of motion.
        Prescribed = "prescribed",
    }
}

crate::parameters! {
    /// Parameters of the waveform.
    pub struct WaveformParameters {
        /// Shape of the drive voltage over a period: a sine, a sine with second and third harmonic, or a square wave with finite rise time.
        drive_shape: Shape = ("", "", Choice(Shape::NAMES)),
        /// Amplitude of the second harmonic relative to the first. Only for drive_shape = "harmonics".
        drive_second_harmonic: f64 = ("", "", Number(Any)),
        /// Phase by which the second harmonic leads the sine of twice the drive's phase.
        drive_second_phase: f64 = ("rad", "", Number(Any)),
        /// Amplitude of the third harmonic relative to the first. Only for drive_shape = "harmonics".
        drive_third_harmonic: f64 = ("", "", Number(Any)),
        /// Phase by which the third harmonic leads the sine of three times the drive's phase.
        drive_third_phase: f64 = ("rad", "", Number(Any)),
        /// Rise and fall time of the square wave, as a fraction of the period, up to 0.5. Only for drive_shape = "square".
        drive_rise: f64 = ("", "", Number(Positive)),
    }
}

impl WaveformParameters {
    /// A sine.
    pub const SINE: WaveformParameters = WaveformParameters::new(Shape::Sine);

    /// Returns a waveform without harmonics. The edges of a square wave take a twentieth of the period.
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
        /// Motion of the stroke: driven by the actuator, or prescribed as stroke_amplitude times the drive's waveform
        /// (the force that this takes is not limited). The pitch is free in both.
        stroke_mode: StrokeMode = ("", "", Choice(StrokeMode::NAMES)),
        /// Amplitude of the prescribed stroke. Only for stroke_mode = "prescribed".
        stroke_amplitude: f64 = ("rad", "", Number(NonNegative)),
    }
}

impl StrokeParameters {
    /// A stroke that is driven by the actuator. The amplitude, 10°, applies if `stroke_mode` is set to prescribed.
    pub const FREE: StrokeParameters =
        StrokeParameters { stroke_mode: StrokeMode::Free, stroke_amplitude: 10.0_f64.to_radians() };

    /// Returns a prescribed stroke of this amplitude (rad).
    pub const fn prescribed(stroke_amplitude: f64) -> StrokeParameters {
        StrokeParameters { stroke_mode: StrokeMode::Prescribed, stroke_amplitude }
    }

    /// Returns constant part and amplitude of the driven quantity: the `voltage` (V), or the prescribed stroke (rad).
    pub fn levels(&self, voltage: [f64; 2]) -> [f64; 2] {
        match self.stroke_mode {
            StrokeMode::Free => voltage,
            StrokeMode::Prescribed => [0.0, self.stroke_amplitude],
        }
    }
}
