//! Elementary functions for scalars and SIMD vectors, computed by polynomials. The results on two machines
//! are equal to the last bit if both machines, or none of them, have a fused multiply-add.
//!
//! Sine, cosine and exponential are minimax polynomials. The polynomial of the exponential is valid for
//! arguments r with |r| ≤ ½ ln 2. The logarithm uses the method of `e_log.c` in FreeBSD's library msun (Sun
//! Microsystems, 1993).

use super::lanes::{Bits, ROUND};
use super::real::Real;

/// π as the sum of two numbers. The first number has 33 significant bits, so its products with whole numbers
/// up to 2^20 are exact. The sum of the two numbers differs from π by less than 10^-26.
const PI: [f64; 2] = [3.141_592_653_468_251_2, 1.215_420_101_301_238_4e-10];

/// Coefficients of z, z², … in a polynomial for sin √z / √z − 1. For angles √z up to a quarter turn, the
/// error of the polynomial is below 4·10^-17.
const SIN: [f64; 8] = [
    -0.166_666_666_666_666_66,
    0.008_333_333_333_333_316,
    -0.000_198_412_698_412_549_66,
    2.755_731_921_916_083_3e-6,
    -2.505_210_761_669_045e-8,
    1.605_897_729_274_264_3e-10,
    -7.643_969_663_988_074e-13,
    2.731_436_876_937_989_3e-15,
];

/// Coefficients of z², z³, … in a polynomial for cos √z − 1 + z/2. For angles √z up to a quarter turn, the
/// error of the polynomial is below 7·10^-17.
const COS: [f64; 7] = [
    0.041_666_666_666_666_66,
    -0.001_388_888_888_888_476_5,
    2.480_158_729_891_222e-5,
    -2.755_731_857_310_729_6e-7,
    2.087_668_153_639_063e-9,
    -1.146_625_136_921_544_4e-11,
    4.646_422_837_808_079_4e-14,
];

/// Returns the polynomial c₀ + c₁ x + c₂ x² + …, given x and x².
///
/// The method is Horner's rule in x², applied to pairs of coefficients. The method needs as many operations
/// as Horner's rule in x, but its chain of dependent operations is half as long.
#[inline(always)]
fn polynomial<R: Bits, const N: usize>(x: R, square: R, c: &[f64; N]) -> R {
    let pair = |i: usize| {
        let low = x.lit(c[i]);
        if i + 1 < N { x.mul_add(x.lit(c[i + 1]), low) } else { low }
    };
    let mut i = (N - 1) / 2 * 2;
    let mut sum = pair(i);
    while i > 0 {
        i -= 2;
        sum = sum.mul_add(square, pair(i));
    }
    sum
}

/// Divides the angle `x` into a whole number of half turns and a remainder r with |r| ≤ π/2. Returns the
/// number of half turns plus the constant [`ROUND`], and the remainder.
///
/// The lowest bit in the bit pattern of the first result is set if the number of half turns is odd.
#[inline(always)]
fn half_turns<R: Bits>(x: R) -> (R, R) {
    let rounded = x.mul_add(x.lit(core::f64::consts::FRAC_1_PI), x.lit(ROUND));
    let k = rounded - ROUND;
    let mut r = k.mul_add(k.lit(-PI[0]), x);
    r = k.mul_add(k.lit(-PI[1]), r);
    (rounded, r)
}

/// Returns the sine of `x` (rad), for |x| up to 10^6.
#[inline(always)]
pub(super) fn sin<R: Bits>(x: R) -> R {
    let (odd, r) = half_turns(x);
    let z = r * r;
    (z * r).mul_add(polynomial(z, z * z, &SIN), r).flip_sign_by_lowest_bit(odd)
}

/// Returns sine and cosine of `x` (rad), for |x| up to 10^6.
#[inline(always)]
pub(super) fn sin_cos<R: Bits>(x: R) -> (R, R) {
    let (odd, r) = half_turns(x);
    let z = r * r;
    let zz = z * z;
    let sin = (z * r).mul_add(polynomial(z, zz, &SIN), r);
    let cos = zz.mul_add(polynomial(z, zz, &COS), z.mul_add(z.lit(-0.5), z.lit(1.0)));
    (sin.flip_sign_by_lowest_bit(odd), cos.flip_sign_by_lowest_bit(odd))
}

/// ln 2 as the sum of two numbers, of which the first number has 33 significant bits.
const LN_2: [f64; 2] = [6.931_471_803_691_238e-1, 1.908_214_929_270_587_7e-10];

/// Coefficients of 1, r, r², … in a polynomial for (e^r − 1)/r. For |r| up to ½ ln 2, the error of the
/// polynomial is below 3·10^-17.
///
/// The first coefficient is exactly 1, which makes the result accurate for small r.
const EXP: [f64; 11] = [
    1.0,
    0.500_000_000_000_000_7,
    0.166_666_666_666_666_96,
    0.041_666_666_666_562_5,
    0.008_333_333_333_293_249,
    0.001_388_888_893_615_144_1,
    0.000_198_412_699_868_442_82,
    2.480_149_978_715_675_8e-5,
    2.755_711_697_104_583e-6,
    2.762_821_657_964_224_7e-7,
    2.516_134_467_493_302_5e-8,
];

/// Returns a whole number k and a remainder r, with x = k ln 2 + r and |r| ≤ ½ ln 2.
#[inline(always)]
fn reduce<R: Bits>(x: R) -> (R, R) {
    let k = x.mul_add(x.lit(core::f64::consts::LOG2_E), x.lit(ROUND)) - ROUND;
    let mut r = k.mul_add(k.lit(-LN_2[0]), x);
    r = k.mul_add(k.lit(-LN_2[1]), r);
    (k, r)
}

/// Smallest argument whose exponential is infinite: ln(2^1024), rounded up.
const EXP_MAX: f64 = 709.782_712_893_384_1;

/// Smallest argument whose exponential is a normal floating-point number: ln(2^-1022).
const EXP_MIN: f64 = -708.396_418_532_264_1;

/// [`Real::exp`].
#[inline(always)]
pub(super) fn exp<R: Bits>(x: R) -> R {
    // Infinity for large arguments, NaN for NaN.
    let beyond = x * f64::INFINITY;
    let power = R::select(x.lt(x.lit(EXP_MAX)), exp_of_ordinary(x), beyond);
    R::select(x.lt(x.lit(EXP_MIN)), x.lit(0.0), power)
}

/// [`Real::exp_of_ordinary`].
#[inline(always)]
pub(super) fn exp_of_ordinary<R: Bits>(x: R) -> R {
    let (k, r) = reduce(x);
    polynomial(r, r * r, &EXP).mul_add(r, r.lit(1.0)).times_power_of_two(k)
}

/// [`Real::exp_m1`].
#[inline(always)]
pub(super) fn exp_m1<R: Bits>(x: R) -> R {
    // Below −40 the result rounds to −1. NaN remains NaN.
    let (k, r) = reduce(x.lit(-40.0).max(x));
    // Half of 2^k, because 2^k itself may overflow although the result is finite.
    let half = r.lit(0.5).times_power_of_two(k);
    let power = (polynomial(r, r * r, &EXP) * r).mul_add(half, half - 0.5) * 2.0;
    R::select(x.lt(x.lit(EXP_MAX)), power, x * f64::INFINITY)
}

/// [`Real::exp_m1_of_ordinary`].
#[inline(always)]
pub(super) fn exp_m1_of_ordinary<R: Bits>(x: R) -> R {
    let (k, r) = reduce(x);
    let power = r.lit(1.0).times_power_of_two(k);
    // 2^k (e^r − 1) + (2^k − 1)
    (polynomial(r, r * r, &EXP) * r).mul_add(power, power - 1.0)
}

/// Coefficients of s², s⁴, … in a polynomial for (ln((1 + s)/(1 − s)) − 2s)/s.
const LN: [f64; 7] = [
    6.666_666_666_666_735e-1,
    3.999_999_999_940_942e-1,
    2.857_142_874_366_239e-1,
    2.222_219_843_214_978_4e-1,
    1.818_357_216_161_805e-1,
    1.531_383_769_920_937_3e-1,
    1.479_819_860_511_658_6e-1,
];

/// [`Real::ln`].
#[inline(always)]
pub(super) fn ln<R: Bits>(x: R) -> R {
    let none = R::select(x.lt(x.lit(0.0)), x.lit(f64::NAN), x.lit(f64::NEG_INFINITY));
    let finite = R::select(x.lt(x.lit(f64::MIN_POSITIVE)), none, ln_of_normal(x));
    // The logarithm of infinity is infinity, of NaN NaN.
    R::select(x.lt(x.lit(f64::INFINITY)), finite, x)
}

/// [`Real::ln_of_normal`].
#[inline(always)]
pub(super) fn ln_of_normal<R: Bits>(x: R) -> R {
    let (e, m) = x.exponent_and_mantissa();
    // m is scaled to [√½, √2). Then f = m − 1 is small, and the two parts of the sum do not cancel.
    let large = m.lit(core::f64::consts::SQRT_2).lt(m);
    let m = R::select(large, m * 0.5, m);
    let e = R::select(large, e + 1.0, e);

    let f = m - 1.0;
    let s = f / (f + 2.0);
    let z = s * s;
    let rest = z * polynomial(z, z * z, &LN);
    let half_square = f * f * 0.5;
    // ln m = f − (f²/2 − s (f²/2 + rest)). e ln 2 is added starting with its small part.
    let small = s.mul_add(half_square + rest, e * LN_2[1]);
    e.mul_add(e.lit(LN_2[0]), f - (half_square - small))
}

/// [`Real::ln_1p`].
#[inline(always)]
pub(super) fn ln_1p<R: Bits>(x: R) -> R {
    let is_usual = x.lit(-1.0).lt(x) & x.lt(x.lit(1e300));
    R::select(is_usual, ln_1p_of_normal(x), ln(x + 1.0))
}

/// [`Real::ln_1p_of_normal`].
#[inline(always)]
pub(super) fn ln_1p_of_normal<R: Bits>(x: R) -> R {
    // (1 + x)/2^e is between √½ and √2, and equals (1 + s)/(1 − s).
    let (e, _) = ((x + 1.0) * core::f64::consts::SQRT_2).exponent_and_mantissa();
    let power = x.lit(1.0).times_power_of_two(e);
    let s = (x - (power - 1.0)) / (x + (power + 1.0));
    let z = s * s;
    let rest = z * polynomial(z, z * z, &LN);
    // 2s + s rest. e ln 2 is added starting with its small part.
    let small = s.mul_add(rest, e * LN_2[1]);
    e.mul_add(e.lit(LN_2[0]), s.mul_add(s.lit(2.0), small))
}

/// [`Real::round_ties_even`].
#[inline(always)]
pub(super) fn round_ties_even<R: Real>(x: R) -> R {
    (x + ROUND) - ROUND
}
