//! What drives a wing over time: voltages, or the stroke itself.

mod samples;
mod source;
mod waveform;

pub use samples::{Repeat, Samples};
pub use source::{Source, StrokeMode};
pub use waveform::{Shape, Wave, Waveform};

use crate::num::Real;

/// A driven quantity with its rates of change: a voltage (V), or a prescribed stroke (rad).
#[derive(Clone, Copy, Debug)]
pub struct Driven<R> {
    /// Value.
    pub value: R,
    /// Rate of change (1/s).
    pub rate: R,
    /// Rate of change of that (1/s²).
    pub bend: R,
}

impl<R: Real> Driven<R> {
    /// A quantity whose second derivative does not matter, such as a voltage.
    #[inline(always)]
    pub fn with_rate(value: R, rate: R) -> Driven<R> {
        Driven { value, rate, bend: value.lit(0.0) }
    }
}

impl<R: Real> Wave<R> {
    /// The quantity `bias + amplitude · wave`.
    #[inline(always)]
    pub fn drive(&self, bias: R, amplitude: R) -> Driven<R> {
        Driven {
            value: amplitude.mul_add(self.value, bias),
            rate: amplitude * self.rate,
            bend: amplitude * self.bend,
        }
    }
}
