//! The trait that the numbers in the equations of models implement.

use core::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

/// A real number, or one real number per SIMD lane, with all operations that a model's equations need.
///
/// Write equations with the ordinary operators, and write literals on the right of an operator (`x * 0.5 + 1.0`).
/// Comparisons return a mask. Combine masks with `&`, `|` and `!`, and use [`Real::select`] instead of `if`.
///
/// Your own types may also implement this trait, for example dual numbers for automatic differentiation.
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
    /// Result of a comparison in each lane.
    type Mask: Copy + BitAnd<Output = Self::Mask> + BitOr<Output = Self::Mask> + Not<Output = Self::Mask>;

    /// Returns the constant `c`, of the same type as `self`.
    fn lit(self, c: f64) -> Self;

    /// Returns `self * a + b`, rounded once if the processor supports it (see [`super::Arithmetic`]).
    fn mul_add(self, a: Self, b: Self) -> Self;

    /// Returns the absolute value.
    fn abs(self) -> Self;

    /// Returns the square root.
    fn sqrt(self) -> Self;

    /// Returns the magnitude of `self` with the sign of `sign`.
    fn copysign(self, sign: Self) -> Self;

    /// Returns the nearest whole number, for |x| up to 2^51. Ties are rounded to the even number.
    fn round_ties_even(self) -> Self;

    /// Returns sine and cosine of an angle (rad), for |x| up to 10^6, with errors below 10^-15.
    fn sin_cos(self) -> (Self, Self);

    /// Returns e^x. The result is infinite for x > 709.78, zero for x < −708.39 (where e^x is a subnormal
    /// number), and NaN for NaN.
    fn exp(self) -> Self;

    /// Returns e^x − 1. The result is also accurate for x near zero. The result is infinite for x > 709.78,
    /// and NaN for NaN.
    fn exp_m1(self) -> Self;

    /// Returns the natural logarithm. The result is −∞ for 0 and subnormal numbers, and NaN for negative numbers and
    /// for NaN.
    fn ln(self) -> Self;

    /// Returns ln(1 + x). The result is also accurate for x near zero. The result is −∞ for x = −1, and NaN
    /// for x < −1 and for NaN.
    fn ln_1p(self) -> Self;

    /// Returns a mask that is true in the lanes with `self < other`. The mask is false in lanes in which one
    /// of the two numbers is NaN.
    fn lt(self, other: Self) -> Self::Mask;

    /// Returns `yes` in the lanes in which `mask` is true, and `no` in the other lanes.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;

    /// Calls `table` with the value of `self` in each lane, and returns the numbers that `table` returns. The
    /// derivatives of the returned numbers with respect to `self` count as zero.
    fn look_up<const N: usize>(self, table: impl Fn(f64) -> [f64; N]) -> [Self; N];

    /// Calls `work`. Scalars and SIMD types do not inline the call, so that the compiler compiles `work` only
    /// once.
    #[inline(always)]
    fn outlined<T>(self, work: impl FnOnce() -> T) -> T {
        work()
    }

    /// Returns the smaller of two numbers. The result is `other` if one of the numbers is NaN.
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self::select(self.lt(other), self, other)
    }

    /// Returns the larger of two numbers. The result is `other` if one of the numbers is NaN.
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self::select(other.lt(self), self, other)
    }

    /// Returns the sine of an angle (rad), which equals the sine of [`Real::sin_cos`] to the last bit.
    #[inline(always)]
    fn sin(self) -> Self {
        self.sin_cos().0
    }

    /// Returns the angle (rad) between the x axis and the line from the origin to the point (`x`, `self`).
    /// Both coordinates must be zero or more. The angle is zero if both coordinates are zero. The error of
    /// the angle is below 10^-15.
    #[inline(always)]
    fn angle_over(self, x: Self) -> Self {
        angle_over(self, x)
    }

    /// Returns [`Real::exp`] of a number from −708 to 709. The function does not check the number. For all
    /// numbers outside the range from −708 to 709, the result is unspecified.
    #[inline(always)]
    fn exp_of_ordinary(self) -> Self {
        self.exp()
    }

    /// Returns [`Real::exp_m1`] of a number from −708 to 709. The function does not check the number. For all
    /// numbers outside the range from −708 to 709, the result is unspecified.
    #[inline(always)]
    fn exp_m1_of_ordinary(self) -> Self {
        self.exp_m1()
    }

    /// Returns [`Real::ln`] of a normal positive number. The function does not check the number. For numbers
    /// that are not normal and positive, the result is unspecified.
    #[inline(always)]
    fn ln_of_normal(self) -> Self {
        self.ln()
    }

    /// Returns [`Real::ln_1p`] of a number x > −1, if 1 + x is a normal number up to 10^300. The function
    /// does not check `self`. If 1 + x is not a normal positive number up to 10^300, the result is
    /// unspecified.
    #[inline(always)]
    fn ln_1p_of_normal(self) -> Self {
        self.ln_1p()
    }
}

/// Coefficients of a rational function of x² that approximates (arctan x − x)/x³, for |x| up to tan(π/8).
///
/// The first array contains the coefficients of the numerator. The second array contains the coefficients of
/// the denominator, except the leading coefficient 1. The coefficients are in descending order of the powers
/// (Cephes, `atan.c`; Moshier, 1995).
const ARCTAN: [[f64; 5]; 2] = [
    [
        -8.750_608_600_031_904e-1,
        -1.615_753_718_733_365e1,
        -7.500_855_792_314_705e1,
        -1.228_866_684_490_136_1e2,
        -6.485_021_904_942_025e1,
    ],
    [
        2.485_846_490_142_306_3e1,
        1.650_270_098_316_988_5e2,
        4.328_810_604_912_903e2,
        4.853_903_996_359_137e2,
        1.945_506_571_482_614e2,
    ],
];

/// tan(π/8).
const TAN_PI_8: f64 = 0.414_213_562_373_095_05;

/// [`Real::angle_over`].
#[inline(always)]
fn angle_over<R: Real>(y: R, x: R) -> R {
    let (zero, one) = (y.lit(0.0), y.lit(1.0));
    let steep = x.lt(y);
    let (short, long) = (x.min(y), x.max(y));
    let known = zero.lt(long);
    // The angle of the ratio is at most π/4. Beyond π/8, arctan t = π/4 + arctan((t − 1)/(t + 1)).
    let large = (long * TAN_PI_8).lt(short);
    let above = R::select(large, short - long, short);
    let below = R::select(large, short + long, R::select(known, long, one));
    let t = above / below;
    let z = t * t;
    let [numerator, denominator] = ARCTAN;
    let mut p = z.lit(numerator[0]);
    let mut q = z + denominator[0];
    for i in 1..5 {
        p = p.mul_add(z, z.lit(numerator[i]));
        q = q.mul_add(z, z.lit(denominator[i]));
    }
    let arctan = (t * z).mul_add(p / q, t);
    let angle = R::select(large, arctan + core::f64::consts::FRAC_PI_4, arctan);
    R::select(steep, -angle + core::f64::consts::FRAC_PI_2, angle)
}
