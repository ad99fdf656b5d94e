//! The numbers of models' equations.

use super::float::Float;
use super::functions;
use super::number::Number;

/// A real number, or one real number per SIMD lane: all that a model's equations ask for.
pub trait Real: Number {
    /// Sine of an angle in radians, for |x| up to 10^6; errors stay below 10^-15.
    fn sin(self) -> Self;

    /// Sine and cosine of an angle in radians, for |x| up to 10^6; errors stay below 10^-15.
    fn sin_cos(self) -> (Self, Self);

    /// e^x, for |x| up to 700.
    fn exp(self) -> Self;

    /// e^x − 1, for |x| up to 700, accurate for small x too.
    fn exp_m1(self) -> Self;

    /// Natural logarithm of a normal positive number.
    fn ln(self) -> Self;

    /// ln(1 + x) for x > −1, accurate for small x too.
    fn ln_1p(self) -> Self;
}

impl<F: Float> Real for F {
    #[inline(always)]
    fn sin(self) -> F {
        functions::sin(self)
    }

    #[inline(always)]
    fn sin_cos(self) -> (F, F) {
        functions::sin_cos(self)
    }

    #[inline(always)]
    fn exp(self) -> F {
        functions::exp(self)
    }

    #[inline(always)]
    fn exp_m1(self) -> F {
        functions::exp_m1(self)
    }

    #[inline(always)]
    fn ln(self) -> F {
        functions::ln(self)
    }

    #[inline(always)]
    fn ln_1p(self) -> F {
        functions::ln_1p(self)
    }
}
