//! A number type that is one SIMD register of `f64`, for the instruction sets that the crate `fearless_simd`
//! supports.

use fearless_simd::{Bytes, ExtractToken, Select, Simd, SimdBase, SimdFloat, SimdFrom, SimdMask};

use super::lanes::{
    self, Bits, EXPONENT_BITS, Lanes, MANTISSA_BITS, OCTAVE, ONE_BITS, RECIPROCAL_BITS, ROUND, TWO_52,
    TWO_52_BITS,
};
use super::macros::{constants_on_the_right, functions_of_lanes, of_inner, operator};
use super::pair::Pair;
use super::real::Real;

/// A value that proves that the processor has the SIMD instructions of the type `S`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Instructions<S>(pub(super) S);

impl<S: Simd> lanes::Simd for Instructions<S> {
    type Vector = Pair<Register<S>>;

    #[inline(always)]
    fn vectorize<T>(self, work: impl FnOnce() -> T) -> T {
        self.0.vectorize(work)
    }
}

/// One SIMD register. The register has 4 lanes with AVX2, and 2 lanes with NEON.
#[derive(Clone, Copy, Debug)]
pub(super) struct Register<S: Simd>(S::f64s);

impl<S: Simd> Register<S> {
    #[inline(always)]
    fn to_bits(self) -> S::u64s {
        self.0.bitcast()
    }

    #[inline(always)]
    fn from_bits(bits: S::u64s) -> Register<S> {
        Register(bits.bitcast())
    }
}

operator!([S: Simd] Register<S>, Add::add, |a, b| Register(a.0 + b.0));
operator!([S: Simd] Register<S>, Sub::sub, |a, b| Register(a.0 - b.0));
operator!([S: Simd] Register<S>, Mul::mul, |a, b| Register(a.0 * b.0));
operator!([S: Simd] Register<S>, Div::div, |a, b| Register(a.0 / b.0));
operator!([S: Simd] Register<S>, Neg::neg, |a| Register(-a.0));
constants_on_the_right!([S: Simd] Register<S>);

impl<S: Simd> Real for Register<S> {
    type Mask = S::mask64s;

    #[inline(always)]
    fn lit(self, c: f64) -> Self {
        Register(S::f64s::simd_from(self.0.token(), c))
    }

    of_inner!(Register: mul_add(a, b), abs(), sqrt(), copysign(sign));

    functions_of_lanes!();

    #[inline(always)]
    fn lt(self, other: Self) -> S::mask64s {
        self.0.simd_lt(other.0)
    }

    #[inline(always)]
    fn select(mask: S::mask64s, yes: Self, no: Self) -> Self {
        Register(mask.select(yes.0, no.0))
    }

    #[inline(always)]
    fn outlined<T>(self, work: impl FnOnce() -> T) -> T {
        self.0.token().vectorize(work)
    }

    // These compile to one instruction each, with the required result for NaN. Other architectures treat NaN
    // differently.
    #[cfg(target_arch = "x86_64")]
    of_inner!(Register: min(other), max(other));
}

impl<S: Simd> Lanes for Register<S> {
    const LANES: usize = S::f64s::LEN;
    type Token = Instructions<S>;

    #[inline(always)]
    fn splat(token: Instructions<S>, c: f64) -> Self {
        Register(S::f64s::simd_from(token.0, c))
    }

    #[inline(always)]
    fn lane(self, lane: usize) -> f64 {
        self.0[lane]
    }

    #[inline(always)]
    fn set_lane(&mut self, lane: usize, value: f64) {
        self.0[lane] = value;
    }

    #[inline(always)]
    fn mask(token: Instructions<S>, bits: u64) -> S::mask64s {
        S::mask64s::from_bitmask(token.0, bits)
    }

    #[inline(always)]
    fn bits(mask: S::mask64s) -> u64 {
        mask.to_bitmask()
    }
}

impl<S: Simd> Bits for Register<S> {
    #[inline(always)]
    fn flip_sign_by_lowest_bit(self, selector: Self) -> Self {
        Self::from_bits(self.to_bits() ^ (selector.to_bits() << 63))
    }

    #[inline(always)]
    fn exponent_and_mantissa(self) -> (Self, Self) {
        let mantissa = Self::from_bits((self.to_bits() & MANTISSA_BITS) | ONE_BITS);
        let exponent = Self::from_bits(((self.to_bits() & EXPONENT_BITS) >> 52) | TWO_52_BITS);
        (exponent - (TWO_52 + 1023.0), mantissa)
    }

    #[inline(always)]
    fn linear_log2(self) -> Self {
        let number = Self::from_bits((self.to_bits() >> 12) | TWO_52_BITS);
        number.mul_add(number.lit(OCTAVE), number.lit(-TWO_52 * OCTAVE - 1023.0))
    }

    #[inline(always)]
    fn reciprocal_guess(self) -> Self {
        Self::from_bits(S::u64s::simd_from(self.0.token(), RECIPROCAL_BITS) - self.to_bits())
    }

    #[inline(always)]
    fn times_power_of_two(self, k: Self) -> Self {
        Self::from_bits(self.to_bits() + ((k + ROUND).to_bits() << 52))
    }
}
