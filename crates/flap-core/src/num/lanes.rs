//! What the integrator needs of numbers beyond [`Real`]: access to single lanes, masks, and bits.

use super::functions;
use super::real::Real;

/// One or more independent numbers, one per lane. `f64` is the case of one lane.
pub trait Lanes: Real {
    /// Number of lanes.
    const LANES: usize;

    /// Proof that the instructions exist which this type uses.
    type Token: Copy;

    /// `c` in every lane.
    fn splat(token: Self::Token, c: f64) -> Self;

    /// The number in one lane.
    fn lane(self, lane: usize) -> f64;

    /// Replaces the number in one lane.
    fn set_lane(&mut self, lane: usize, value: f64);

    /// The mask whose lanes hold where the bits of `bits` are set, lane 0 in the lowest bit.
    fn mask(token: Self::Token, bits: u64) -> Self::Mask;

    /// Does the work in a function of its own, compiled once however many callers it has, where that saves the
    /// compiler more than it costs the processor: with SIMD instructions, whose many layers are inlined.
    fn apart<T>(self, work: impl FnOnce() -> T) -> T;

    /// One bit per lane of `mask`, lane 0 in the lowest.
    fn bits(mask: Self::Mask) -> u64;

    /// Lanes in which both masks hold.
    fn and(a: Self::Mask, b: Self::Mask) -> Self::Mask;

    /// `self` with its sign flipped where the lowest bit of the representation of `selector` is set.
    fn flip_sign_by_lowest_bit(self, selector: Self) -> Self;

    /// Splits a normal positive number into `(e, m)` with `self = 2^e m` and `m` in [1, 2).
    /// For NaN and infinity `e` is 1024 and `m` finite.
    fn exponent_and_mantissa(self) -> (Self, Self);

    /// `self * 2^k` by adding to the exponent, with `k` a whole number and no overflow.
    fn times_power_of_two(self, k: Self) -> Self;
}

/// One number at a time: `f64`, or [`Unfused`](super::Unfused) for machines without fused multiply-add.
pub trait Scalar: Lanes<Token = (), Mask = bool> {
    /// Does the work with the instructions that this arithmetic is fast on. Results do not depend on it.
    fn enter<T>(work: impl FnOnce() -> T) -> T;
}

/// 1.5 · 2^52: adding it rounds to a whole number, whose two's complement then is in the low bits.
pub(super) const ROUND: f64 = 6_755_399_441_055_744.0;

/// A single `f64` with fused multiply-add: the scalar of [`super::Arithmetic::Fused`].
impl Real for f64 {
    type Mask = bool;

    #[inline(always)]
    fn lit(self, c: f64) -> f64 {
        c
    }

    #[inline(always)]
    fn mul_add(self, a: f64, b: f64) -> f64 {
        f64::mul_add(self, a, b)
    }

    #[inline(always)]
    fn abs(self) -> f64 {
        f64::abs(self)
    }

    #[inline(always)]
    fn sqrt(self) -> f64 {
        f64::sqrt(self)
    }

    #[inline(always)]
    fn copysign(self, sign: f64) -> f64 {
        f64::copysign(self, sign)
    }

    #[inline(always)]
    fn lt(self, other: f64) -> bool {
        self < other
    }

    #[inline(always)]
    fn select(mask: bool, yes: f64, no: f64) -> f64 {
        if mask { yes } else { no }
    }

    #[inline(always)]
    fn sin(self) -> f64 {
        functions::sin(self)
    }

    #[inline(always)]
    fn sin_cos(self) -> (f64, f64) {
        functions::sin_cos(self)
    }

    #[inline(always)]
    fn exp(self) -> f64 {
        functions::exp(self)
    }

    #[inline(always)]
    fn exp_m1(self) -> f64 {
        functions::exp_m1(self)
    }

    #[inline(always)]
    fn ln(self) -> f64 {
        functions::ln(self)
    }

    #[inline(always)]
    fn ln_1p(self) -> f64 {
        functions::ln_1p(self)
    }
}

impl Lanes for f64 {
    const LANES: usize = 1;
    type Token = ();

    #[inline(always)]
    fn splat((): (), c: f64) -> f64 {
        c
    }

    #[inline(always)]
    fn lane(self, _lane: usize) -> f64 {
        self
    }

    #[inline(always)]
    fn set_lane(&mut self, _lane: usize, value: f64) {
        *self = value;
    }

    #[inline(always)]
    fn mask((): (), bits: u64) -> bool {
        bits & 1 != 0
    }

    #[inline(always)]
    fn apart<T>(self, work: impl FnOnce() -> T) -> T {
        work()
    }

    #[inline(always)]
    fn bits(mask: bool) -> u64 {
        u64::from(mask)
    }

    #[inline(always)]
    fn and(a: bool, b: bool) -> bool {
        a && b
    }

    #[inline(always)]
    fn flip_sign_by_lowest_bit(self, selector: f64) -> f64 {
        f64::from_bits(self.to_bits() ^ (selector.to_bits() << 63))
    }

    #[inline(always)]
    fn exponent_and_mantissa(self) -> (f64, f64) {
        let bits = self.to_bits();
        let mantissa = f64::from_bits((bits & MANTISSA_BITS) | ONE_BITS);
        // The exponent field as a whole number: its bits below those of 2^52.
        let exponent = f64::from_bits(((bits & EXPONENT_BITS) >> 52) | TWO_52_BITS) - (TWO_52 + 1023.0);
        (exponent, mantissa)
    }

    #[inline(always)]
    fn times_power_of_two(self, k: f64) -> f64 {
        f64::from_bits(self.to_bits().wrapping_add((k + ROUND).to_bits() << 52))
    }
}

pub(super) const MANTISSA_BITS: u64 = 0x000f_ffff_ffff_ffff;
pub(super) const EXPONENT_BITS: u64 = 0x7ff0_0000_0000_0000;
pub(super) const ONE_BITS: u64 = 0x3ff0_0000_0000_0000;
pub(super) const TWO_52: f64 = 4_503_599_627_370_496.0;
pub(super) const TWO_52_BITS: u64 = 0x4330_0000_0000_0000;
