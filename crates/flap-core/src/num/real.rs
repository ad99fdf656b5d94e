//! What a model may do with a number.

use core::ops::{Add, Div, Mul, Neg, Sub};

/// A real number, or one real number per SIMD lane.
///
/// Model code is written with the ordinary operators; literals go on the right (`x * 0.5 + 1.0`).
/// Comparisons give a mask, and [`Real::select`] takes the place of `if`.
pub trait Real:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + Add<f64, Output = Self>
    + Sub<f64, Output = Self>
    + Mul<f64, Output = Self>
{
    /// The truth of a comparison, lane by lane.
    type Mask: Copy;

    /// The constant `c`, of the same kind as `self`.
    fn lit(self, c: f64) -> Self;

    /// `self * a + b`, rounded once where the processor can (see [`super::Arithmetic`]).
    fn mul_add(self, a: Self, b: Self) -> Self;

    /// Absolute value.
    fn abs(self) -> Self;

    /// Square root.
    fn sqrt(self) -> Self;

    /// The magnitude of `self` with the sign of `sign`.
    fn copysign(self, sign: Self) -> Self;

    /// Whether `self < other`; false if either is NaN.
    fn lt(self, other: Self) -> Self::Mask;

    /// `yes` where `mask` holds, `no` elsewhere.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;

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

    /// The smaller of two numbers; `other` if either is NaN.
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self::select(self.lt(other), self, other)
    }

    /// The larger of two numbers; `other` if either is NaN.
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self::select(other.lt(self), self, other)
    }
}
