//! Elementary functions on lanes: polynomials, the same bits on every machine of an arithmetic class.
//!
//! Sine and cosine use the kernel polynomials of FreeBSD's msun (`k_sin.c`, `k_cos.c`; Sun Microsystems,
//! 1993), the logarithm that of `e_log.c`; the exponential is a Taylor polynomial on |r| ≤ ½ ln 2.

use super::lanes::{Lanes, ROUND};

/// π/2 in three parts. The first two have 33 significant bits, so their products with whole numbers
/// up to 2^20 are exact.
const HALF_PI: [f64; 3] = [1.570_796_326_734_125_6, 6.077_100_506_303_966e-11, 2.022_266_248_795_950_7e-21];

const SIN: [f64; 6] = [
    -1.666_666_666_666_663_2e-1,
    8.333_333_333_322_49e-3,
    -1.984_126_982_985_795e-4,
    2.755_731_370_707_007e-6,
    -2.505_076_025_340_686_3e-8,
    1.589_690_995_211_55e-10,
];

const COS: [f64; 6] = [
    4.166_666_666_666_66e-2,
    -1.388_888_888_887_411e-3,
    2.480_158_728_947_673e-5,
    -2.755_731_435_139_066_3e-7,
    2.087_572_321_298_175e-9,
    -1.135_964_755_778_819_5e-11,
];

/// Horner's rule: c₀ + x (c₁ + x (c₂ + …)).
#[inline(always)]
fn polynomial<R: Lanes, const N: usize>(x: R, c: &[f64; N]) -> R {
    let mut sum = x.lit(c[N - 1]);
    for i in (0..N - 1).rev() {
        sum = sum.mul_add(x, x.lit(c[i]));
    }
    sum
}

/// Sine and cosine of `x` (rad), for |x| up to 10^6.
#[inline(always)]
pub fn sin_cos<R: Lanes>(x: R) -> (R, R) {
    // The nearest multiple of π/2: `rounded` holds its number k in the low bits, `k` as a float.
    let rounded = x.mul_add(x.lit(core::f64::consts::FRAC_2_PI), x.lit(ROUND));
    let k = rounded - ROUND;
    let mut r = k.mul_add(k.lit(-HALF_PI[0]), x);
    r = k.mul_add(k.lit(-HALF_PI[1]), r);
    r = k.mul_add(k.lit(-HALF_PI[2]), r);

    let z = r * r;
    let sin_r = (z * r).mul_add(polynomial(z, &SIN), r);
    let cos_r = (z * z).mul_add(polynomial(z, &COS), z.mul_add(z.lit(-0.5), z.lit(1.0)));

    // Quadrant k mod 4: odd k swaps the two, bit 1 of k flips the sine, bit 1 of k + 1 the cosine.
    let odd = rounded.is_bit0_set();
    let sin = R::select(odd, cos_r, sin_r).flip_sign_by_bit1(rounded);
    let cos = R::select(odd, sin_r, cos_r).flip_sign_by_bit1(rounded + 1.0);
    (sin, cos)
}

/// ln 2 in two parts; the first has 33 significant bits.
const LN_2: [f64; 2] = [6.931_471_803_691_238e-1, 1.908_214_929_270_587_7e-10];

/// 1/n! for n = 1 … 13.
const EXP: [f64; 13] = [
    1.0,
    1.0 / 2.0,
    1.0 / 6.0,
    1.0 / 24.0,
    1.0 / 120.0,
    1.0 / 720.0,
    1.0 / 5040.0,
    1.0 / 40320.0,
    1.0 / 362_880.0,
    1.0 / 3_628_800.0,
    1.0 / 39_916_800.0,
    1.0 / 479_001_600.0,
    1.0 / 6_227_020_800.0,
];

/// A whole number k and r with x = k ln 2 + r, |r| ≤ ½ ln 2.
#[inline(always)]
fn reduce<R: Lanes>(x: R) -> (R, R) {
    let k = x.mul_add(x.lit(core::f64::consts::LOG2_E), x.lit(ROUND)) - ROUND;
    let mut r = k.mul_add(k.lit(-LN_2[0]), x);
    r = k.mul_add(k.lit(-LN_2[1]), r);
    (k, r)
}

/// e^x for |x| up to 700.
#[inline(always)]
pub fn exp<R: Lanes>(x: R) -> R {
    let (k, r) = reduce(x);
    polynomial(r, &EXP).mul_add(r, r.lit(1.0)).times_power_of_two(k)
}

/// e^x − 1 for |x| up to 700, accurate for small x too.
#[inline(always)]
pub fn exp_m1<R: Lanes>(x: R) -> R {
    let (k, r) = reduce(x);
    let power = r.lit(1.0).times_power_of_two(k);
    // 2^k (e^r − 1) + (2^k − 1)
    (polynomial(r, &EXP) * r).mul_add(power, power - 1.0)
}

/// Coefficients of s², s⁴, … in (ln((1 + s)/(1 − s)) − 2s)/s.
const LN: [f64; 7] = [
    6.666_666_666_666_735e-1,
    3.999_999_999_940_942e-1,
    2.857_142_874_366_239e-1,
    2.222_219_843_214_978_4e-1,
    1.818_357_216_161_805e-1,
    1.531_383_769_920_937_3e-1,
    1.479_819_860_511_658_6e-1,
];

/// Natural logarithm of a normal positive number. Finite (about 710) for NaN and infinity.
#[inline(always)]
pub fn ln<R: Lanes>(x: R) -> R {
    let (e, m) = x.exponent_and_mantissa();
    // m to [√½, √2), so that f = m − 1 is small and the two parts of the sum do not cancel.
    let large = m.lit(core::f64::consts::SQRT_2).lt(m);
    let m = R::select(large, m * 0.5, m);
    let e = R::select(large, e + 1.0, e);

    let f = m - 1.0;
    let s = f / (f + 2.0);
    let z = s * s;
    let rest = z * polynomial(z, &LN);
    let half_square = f * f * 0.5;
    // ln m = f − (f²/2 − s (f²/2 + rest)), with e ln 2 added from its small part up.
    let small = s.mul_add(half_square + rest, e * LN_2[1]);
    e.mul_add(e.lit(LN_2[0]), f - (half_square - small))
}

/// ln(1 + x) for x > −1 with 1 + x a normal number, accurate for small x too.
#[inline(always)]
pub fn ln_1p<R: Lanes>(x: R) -> R {
    let sum = x + 1.0;
    // What rounding the sum has lost. Far from 1 the logarithm does not notice.
    let lost = x - (sum - 1.0);
    ln(sum) + R::select(sum.lt(sum.lit(2.0)), lost, lost.lit(0.0))
}
