//! One SIMD register of `f64`, of the sets of instructions that `fearless_simd` knows.

use core::ops::{Add, Div, Mul, Neg, Sub};

use fearless_simd::{Bytes, ExtractToken, Select, Simd, SimdBase, SimdFloat, SimdFrom, SimdMask};

use super::functions;
use super::lanes::{EXPONENT_BITS, Lanes, MANTISSA_BITS, ONE_BITS, ROUND, TWO_52, TWO_52_BITS};
use super::real::Real;

/// 4 lanes with AVX2, 2 with SSE2 and NEON.
#[derive(Clone, Copy, Debug)]
pub struct Register<S: Simd>(S::f64s);

/// Which lanes of a [`Register`] a comparison holds for.
#[derive(Clone, Copy)]
pub struct RegisterMask<S: Simd>(S::mask64s);

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

impl<S: Simd> Add for Register<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, rhs: Self) -> Self {
        Register(self.0 + rhs.0)
    }
}

impl<S: Simd> Sub for Register<S> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, rhs: Self) -> Self {
        Register(self.0 - rhs.0)
    }
}

impl<S: Simd> Mul for Register<S> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, rhs: Self) -> Self {
        Register(self.0 * rhs.0)
    }
}

impl<S: Simd> Div for Register<S> {
    type Output = Self;
    #[inline(always)]
    fn div(self, rhs: Self) -> Self {
        Register(self.0 / rhs.0)
    }
}

impl<S: Simd> Neg for Register<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Register(-self.0)
    }
}

impl<S: Simd> Add<f64> for Register<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, rhs: f64) -> Self {
        Register(self.0 + rhs)
    }
}

impl<S: Simd> Sub<f64> for Register<S> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, rhs: f64) -> Self {
        Register(self.0 - rhs)
    }
}

impl<S: Simd> Mul<f64> for Register<S> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, rhs: f64) -> Self {
        Register(self.0 * rhs)
    }
}

impl<S: Simd> Real for Register<S> {
    type Mask = RegisterMask<S>;

    #[inline(always)]
    fn lit(self, c: f64) -> Self {
        Self::splat(self.0.token(), c)
    }

    #[inline(always)]
    fn mul_add(self, a: Self, b: Self) -> Self {
        Register(self.0.mul_add(a.0, b.0))
    }

    #[inline(always)]
    fn abs(self) -> Self {
        Register(self.0.abs())
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Register(self.0.sqrt())
    }

    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        Register(self.0.copysign(sign.0))
    }

    #[inline(always)]
    fn lt(self, other: Self) -> RegisterMask<S> {
        RegisterMask(self.0.simd_lt(other.0))
    }

    #[inline(always)]
    fn select(mask: RegisterMask<S>, yes: Self, no: Self) -> Self {
        Register(mask.0.select(yes.0, no.0))
    }

    #[cfg(target_arch = "x86_64")]
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        // One instruction with the very meaning; other architectures' treat NaN in other ways.
        Register(self.0.min(other.0))
    }

    #[cfg(target_arch = "x86_64")]
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Register(self.0.max(other.0))
    }

    #[inline(always)]
    fn sin(self) -> Self {
        functions::sin(self)
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        functions::sin_cos(self)
    }

    #[inline(always)]
    fn exp(self) -> Self {
        functions::exp(self)
    }

    #[inline(always)]
    fn exp_m1(self) -> Self {
        functions::exp_m1(self)
    }

    #[inline(always)]
    fn ln(self) -> Self {
        functions::ln(self)
    }

    #[inline(always)]
    fn ln_1p(self) -> Self {
        functions::ln_1p(self)
    }
}

impl<S: Simd> Lanes for Register<S> {
    const LANES: usize = S::f64s::LEN;
    type Token = S;

    #[inline(always)]
    fn splat(token: S, c: f64) -> Self {
        Register(S::f64s::simd_from(token, c))
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
    fn mask(token: S, bits: u64) -> RegisterMask<S> {
        RegisterMask(S::mask64s::from_bitmask(token, bits))
    }

    #[inline(always)]
    fn apart<T>(self, work: impl FnOnce() -> T) -> T {
        self.0.token().vectorize(work)
    }

    #[inline(always)]
    fn bits(mask: RegisterMask<S>) -> u64 {
        mask.0.to_bitmask()
    }

    #[inline(always)]
    fn and(a: RegisterMask<S>, b: RegisterMask<S>) -> RegisterMask<S> {
        RegisterMask(a.0 & b.0)
    }

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
    fn times_power_of_two(self, k: Self) -> Self {
        Self::from_bits(self.to_bits() + ((k + ROUND).to_bits() << 52))
    }
}
