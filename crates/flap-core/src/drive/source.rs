//! What generates the drive over time, and what it drives.

use super::samples::Samples;
use super::waveform::{Shape, Wave, Waveform};
use crate::num::{Lanes, Real};
use crate::parameter::Invalid;

crate::choice! {
    /// What the drive moves.
    pub enum StrokeMode {
        /// The voltage: the stroke follows from the equations of motion.
        Free = "free",
        /// The stroke itself, which follows the waveform whatever that takes; the pitch answers.
        Prescribed = "prescribed",
    }
}

/// What all points that share lanes have in common of their drives.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Source {
    /// The shape of the waveform, unless there are samples.
    pub shape: Shape,
    /// What it drives.
    pub stroke: StrokeMode,
    /// Samples in place of a shape.
    pub samples: Option<Samples>,
}

impl Source {
    /// A sine that drives the voltage.
    pub const SINE: Source = Source { shape: Shape::Sine, stroke: StrokeMode::Free, samples: None };

    /// The same with samples for a waveform.
    pub fn sampled(&self, samples: Samples) -> Source {
        Source { samples: Some(samples), ..self.clone() }
    }

    /// A prescribed stroke.
    pub const PRESCRIBED: Source = Source { stroke: StrokeMode::Prescribed, ..Source::SINE };

    /// The source of a point, with this one's samples if it has any.
    pub fn of_point(&self, shape: Shape, stroke: StrokeMode) -> Source {
        Source { shape, stroke, samples: self.samples.clone() }
    }

    /// The same, for a chirp.
    pub fn chirped(&self) -> Source {
        Source { shape: Shape::Chirp, stroke: self.stroke, samples: None }
    }

    /// Whether the stroke is prescribed.
    #[inline(always)]
    pub fn prescribes_stroke(&self) -> bool {
        self.stroke == StrokeMode::Prescribed
    }

    /// Refuses a rise time, as a fraction of the period, that leaves a square wave no time to be flat; and a
    /// prescribed stroke with jumps in its acceleration.
    ///
    /// # Errors
    /// If `rise` is above 0.5 and the shape is a square wave, or a square wave is to be the stroke.
    pub fn check(&self, rise: f64) -> Result<(), Invalid> {
        if self.samples.is_some() || self.shape != Shape::Square {
            return Ok(());
        }
        if self.prescribes_stroke() {
            return Err(Invalid::together(
                &["stroke_mode", "drive_shape"],
                "stroke_mode is \"prescribed\": a square wave is no motion of a wing, choose another drive_shape",
            ));
        }
        if rise > 0.5 {
            return Err(Invalid::together(
                &["drive_rise", "drive_shape"],
                format!("drive_rise is {rise}; a square wave rises in at most 0.5 of its period"),
            ));
        }
        Ok(())
    }

    /// The wave at time `t` (s) of its period, from 0 to its end.
    #[inline(always)]
    pub fn at<R: Lanes>(&self, waveform: &Waveform<R>, t: R) -> Wave<R> {
        match &self.samples {
            None => waveform.at(self.shape, t),
            Some(samples) => {
                let frequency = waveform.half_period.lit(0.5) / waveform.half_period;
                let [value, rate, bend] = samples.at(t * frequency);
                Wave { value, rate: rate * frequency, bend: bend * frequency * frequency }
            }
        }
    }

    /// The next time after `t` at which a derivative of the wave jumps; infinite if there is none. Between samples
    /// the second derivative is continuous: that is smooth enough for the step-size control.
    #[inline(always)]
    pub fn next_break<R: Real>(&self, waveform: &Waveform<R>, t: R) -> R {
        match &self.samples {
            None => waveform.next_break(self.shape, t),
            Some(_) => t.lit(f64::INFINITY),
        }
    }

    /// The smallest and largest value over a period.
    pub fn range(&self, waveform: &Waveform<f64>) -> [f64; 2] {
        match &self.samples {
            None => waveform.range(self.shape),
            Some(samples) => samples.range(),
        }
    }
}
