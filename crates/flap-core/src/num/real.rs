//! The numbers of models' equations.

use core::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

/// A real number, or one real number per SIMD lane: all that a model's equations use.
///
/// Equations are written with the ordinary operators; literals go on the right (`x * 0.5 + 1.0`). Comparisons give a mask,
/// masks are combined with `&`, `|` and `!`, and [`Real::select`] takes the place of `if`.
///
/// Other types may implement it, for example dual numbers, which carry derivatives along.
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

    /// The nearest whole number, the even one of two, for |x| up to 2^51.
    fn round_ties_even(self) -> Self;

    /// Sine and cosine of an angle in radians, for |x| up to 10^6; errors stay below 10^-15.
    fn sin_cos(self) -> (Self, Self);

    /// e^x: infinite above 709.78, zero below −708.39 (where it would be subnormal), NaN for NaN.
    fn exp(self) -> Self;

    /// e^x − 1, accurate for small x too: infinite above 709.78, NaN for NaN.
    fn exp_m1(self) -> Self;

    /// Natural logarithm: −∞ for 0 and subnormal numbers, NaN for negative numbers and NaN.
    fn ln(self) -> Self;

    /// ln(1 + x), accurate for small x too: −∞ for −1, NaN for smaller numbers and NaN.
    fn ln_1p(self) -> Self;

    /// The mask of `self < other`; false if either is NaN.
    fn lt(self, other: Self) -> Self::Mask;

    /// `yes` where `mask` holds, `no` elsewhere.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;

    /// The entries of a table at `self`, lane by lane. They are constants: a table has steps, no slopes.
    fn look_up<const N: usize>(self, table: impl Fn(f64) -> [f64; N]) -> [Self; N];

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

    /// Sine of an angle in radians, with the bits of [`Real::sin_cos`].
    #[inline(always)]
    fn sin(self) -> Self {
        self.sin_cos().0
    }

    /// [`Real::exp`] of a number from −708 to 709. Beyond, the bits have no meaning: no instruction checks the range.
    #[inline(always)]
    fn exp_of_ordinary(self) -> Self {
        self.exp()
    }

    /// [`Real::exp_m1`] of a number from −708 to 709. Beyond, the bits have no meaning: no instruction checks the range.
    #[inline(always)]
    fn exp_m1_of_ordinary(self) -> Self {
        self.exp_m1()
    }

    /// [`Real::ln`] of a normal positive number. For other numbers the bits have no meaning: no instruction checks them.
    #[inline(always)]
    fn ln_of_normal(self) -> Self {
        self.ln()
    }

    /// [`Real::ln_1p`] of x > −1 with 1 + x a normal number up to 10^300. For other numbers the bits have no meaning: no
    /// instruction checks them.
    #[inline(always)]
    fn ln_1p_of_normal(self) -> Self {
        self.ln_1p()
    }
}
