//! Drive voltages.

mod waveform;

pub use waveform::{Shape, Wave, Waveform};

use crate::num::Real;

/// A voltage and its rate of change.
#[derive(Clone, Copy, Debug)]
pub struct Voltage<R> {
    /// Voltage (V).
    pub value: R,
    /// Rate of change (V/s).
    pub rate: R,
}

impl<R: Real> Wave<R> {
    /// The voltage `bias + amplitude · wave`.
    #[inline(always)]
    pub fn voltage(&self, bias: R, amplitude: R) -> Voltage<R> {
        Voltage { value: amplitude.mul_add(self.value, bias), rate: amplitude * self.rate }
    }
}
