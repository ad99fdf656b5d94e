//! Voltage waveforms.

use crate::num::Real;

/// A voltage and its rate of change.
#[derive(Clone, Copy, Debug)]
pub struct Voltage<R> {
    /// Voltage (V).
    pub value: R,
    /// Rate of change (V/s).
    pub rate: R,
}

/// `bias + amplitude sin(rate · t)`, with `rate` in rad/s.
#[inline(always)]
pub fn biased_sine<R: Real>(bias: R, amplitude: R, rate: R, t: R) -> Voltage<R> {
    let (sin, cos) = (rate * t).sin_cos();
    Voltage { value: amplitude.mul_add(sin, bias), rate: amplitude * rate * cos }
}
