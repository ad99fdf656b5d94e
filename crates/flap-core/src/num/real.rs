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

    /// e^x, for |x| up to 700.
    #[inline(always)]
    fn exp(self) -> Self {
        functions::exp(self)
    }

    /// e^x − 1, for |x| up to 700, accurate for small x too.
    #[inline(always)]
    fn exp_m1(self) -> Self {
        functions::exp_m1(self)
    }

    /// Natural logarithm of a normal positive number.
    #[inline(always)]
    fn ln(self) -> Self {
        functions::ln(self)
    }

    /// ln(1 + x) for x > −1, accurate for small x too.
    #[inline(always)]
    fn ln_1p(self) -> Self {
        functions::ln_1p(self)
    }
}

impl<F: Float> Real for F {}
