//! The numbers of models' equations.

use super::float::Float;
use super::functions;

/// A real number, or one real number per SIMD lane: all that a model's equations ask for.
pub trait Real: Float {
    /// Sine of an angle in radians, for |x| up to 10^6; errors stay below 10^-15.
    #[inline(always)]
    fn sin(self) -> Self {
        functions::sin(self)
    }

    /// Sine and cosine of an angle in radians, for |x| up to 10^6; errors stay below 10^-15.
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        functions::sin_cos(self)
    }

    /// e^x: infinite above 709.78, zero below −708.39 (where it would be subnormal), NaN for NaN.
    #[inline(always)]
    fn exp(self) -> Self {
        functions::exp(self)
    }

    /// e^x − 1, accurate for small x too: infinite above 709.78, NaN for NaN.
    #[inline(always)]
    fn exp_m1(self) -> Self {
        functions::exp_m1(self)
    }

    /// Natural logarithm: −∞ for 0 and subnormal numbers, NaN for negative numbers and NaN.
    #[inline(always)]
    fn ln(self) -> Self {
        functions::ln(self)
    }

    /// ln(1 + x), accurate for small x too: −∞ for −1, NaN for smaller numbers and NaN.
    #[inline(always)]
    fn ln_1p(self) -> Self {
        functions::ln_1p(self)
    }
}

impl<F: Float> Real for F {}
