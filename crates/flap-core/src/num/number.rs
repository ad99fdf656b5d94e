//! Arithmetic: the operations that the processor has.

use core::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

/// A number, or one number per SIMD lane, with the arithmetic of [`Real`](super::Real).
///
/// Equations are written with the ordinary operators; literals go on the right (`x * 0.5 + 1.0`). Comparisons give a mask,
/// masks are combined with `&`, `|` and `!`, and [`Number::select`] takes the place of `if`.
pub trait Number:
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
    type Mask: Copy + BitAnd<Output = Self::Mask> + BitOr<Output = Self::Mask> + Not<Output = Self::Mask>;

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

    /// The mask of `self < other`; false if either is NaN.
    fn lt(self, other: Self) -> Self::Mask;

    /// `yes` where `mask` holds, `no` elsewhere.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;

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
