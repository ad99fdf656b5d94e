//! A quantity that changes over time, with its derivatives.

use crate::num::Real;

/// A quantity at a time: a wave of unit amplitude, a voltage (V), or a prescribed stroke (rad).
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
    /// A quantity whose second derivative does not matter, such as a voltage.
    #[inline(always)]
    pub fn with_rate(value: R, rate: R) -> Wave<R> {
        Wave { value, rate, bend: value.lit(0.0) }
    }

    /// The quantity `bias + amplitude · self`.
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
    /// The quantity with this value, rate and second derivative.
    fn from([value, rate, bend]: [R; 3]) -> Wave<R> {
        Wave { value, rate, bend }
    }
}
