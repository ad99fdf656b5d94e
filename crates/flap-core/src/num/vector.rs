//! SIMD lanes: two native registers of `f64`.
//!
//! Two registers per value rather than one, because a right-hand side is a long chain of dependent
//! operations and a second, independent chain fills the processor's waiting time.

use core::ops::{Add, Div, Mul, Neg, Sub};

use fearless_simd::{Bytes, Select, Simd, SimdBase, SimdFloat, SimdFrom, SimdMask};

use super::functions;
use super::lanes::{EXPONENT_BITS, Lanes, MANTISSA_BITS, ONE_BITS, ROUND, TWO_52, TWO_52_BITS};
use super::real::Real;

/// 16 lanes with AVX-512, 8 with AVX2, 4 with SSE2 and NEON.
#[derive(Clone, Copy, Debug)]
pub struct Vector<S: Simd> {
    lo: S::f64s,
    hi: S::f64s,
}

/// Which lanes of a [`Vector`] a comparison holds for.
#[derive(Clone, Copy)]
pub struct VectorMask<S: Simd> {
    lo: S::mask64s,
    hi: S::mask64s,
}

impl<S: Simd> Vector<S> {
    const HALF: usize = S::f64s::LEN;

    #[inline(always)]
    fn map_bits(self, f: impl Fn(S::u64s) -> S::u64s) -> Vector<S> {
        Vector {
            lo: f(self.lo.bitcast::<S::u64s>()).bitcast::<S::f64s>(),
            hi: f(self.hi.bitcast::<S::u64s>()).bitcast::<S::f64s>(),
        }
    }
}

impl<S: Simd> Add for Vector<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, rhs: Self) -> Self {
        Vector { lo: self.lo + rhs.lo, hi: self.hi + rhs.hi }
    }
}

impl<S: Simd> Sub for Vector<S> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, rhs: Self) -> Self {
        Vector { lo: self.lo - rhs.lo, hi: self.hi - rhs.hi }
    }
}

impl<S: Simd> Mul for Vector<S> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, rhs: Self) -> Self {
        Vector { lo: self.lo * rhs.lo, hi: self.hi * rhs.hi }
    }
}

impl<S: Simd> Div for Vector<S> {
    type Output = Self;
    #[inline(always)]
    fn div(self, rhs: Self) -> Self {
        Vector { lo: self.lo / rhs.lo, hi: self.hi / rhs.hi }
    }
}

impl<S: Simd> Neg for Vector<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Vector { lo: -self.lo, hi: -self.hi }
    }
}

impl<S: Simd> Add<f64> for Vector<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, rhs: f64) -> Self {
        Vector { lo: self.lo + rhs, hi: self.hi + rhs }
    }
}

impl<S: Simd> Sub<f64> for Vector<S> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, rhs: f64) -> Self {
        Vector { lo: self.lo - rhs, hi: self.hi - rhs }
    }
}

impl<S: Simd> Mul<f64> for Vector<S> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, rhs: f64) -> Self {
        Vector { lo: self.lo * rhs, hi: self.hi * rhs }
    }
}

impl<S: Simd> Real for Vector<S> {
    type Mask = VectorMask<S>;

    #[inline(always)]
    fn lit(self, c: f64) -> Self {
        use fearless_simd::ExtractToken;
        Self::splat(self.lo.token(), c)
    }

    #[inline(always)]
    fn mul_add(self, a: Self, b: Self) -> Self {
        Vector { lo: self.lo.mul_add(a.lo, b.lo), hi: self.hi.mul_add(a.hi, b.hi) }
    }

    #[inline(always)]
    fn abs(self) -> Self {
        Vector { lo: self.lo.abs(), hi: self.hi.abs() }
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Vector { lo: self.lo.sqrt(), hi: self.hi.sqrt() }
    }

    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        Vector { lo: self.lo.copysign(sign.lo), hi: self.hi.copysign(sign.hi) }
    }

    #[inline(always)]
    fn lt(self, other: Self) -> VectorMask<S> {
        VectorMask { lo: self.lo.simd_lt(other.lo), hi: self.hi.simd_lt(other.hi) }
    }

    #[inline(always)]
    fn select(mask: VectorMask<S>, yes: Self, no: Self) -> Self {
        Vector { lo: mask.lo.select(yes.lo, no.lo), hi: mask.hi.select(yes.hi, no.hi) }
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

impl<S: Simd> Lanes for Vector<S> {
    const LANES: usize = 2 * Self::HALF;
    type Token = S;

    #[inline(always)]
    fn splat(token: S, c: f64) -> Self {
        let half = S::f64s::simd_from(token, c);
        Vector { lo: half, hi: half }
    }

    #[inline(always)]
    fn lane(self, lane: usize) -> f64 {
        if lane < Self::HALF { self.lo[lane] } else { self.hi[lane - Self::HALF] }
    }

    #[inline(always)]
    fn set_lane(&mut self, lane: usize, value: f64) {
        if lane < Self::HALF {
            self.lo[lane] = value;
        } else {
            self.hi[lane - Self::HALF] = value;
        }
    }

    #[inline(always)]
    fn mask(token: S, bits: u64) -> VectorMask<S> {
        let low = (1_u64 << Self::HALF) - 1;
        VectorMask {
            lo: S::mask64s::from_bitmask(token, bits & low),
            hi: S::mask64s::from_bitmask(token, (bits >> Self::HALF) & low),
        }
    }

    #[inline(always)]
    fn apart<T>(self, work: impl FnOnce() -> T) -> T {
        use fearless_simd::ExtractToken;
        self.lo.token().vectorize(work)
    }

    #[inline(always)]
    fn bits(mask: VectorMask<S>) -> u64 {
        mask.lo.to_bitmask() | (mask.hi.to_bitmask() << Self::HALF)
    }

    #[inline(always)]
    fn and(a: VectorMask<S>, b: VectorMask<S>) -> VectorMask<S> {
        VectorMask { lo: a.lo & b.lo, hi: a.hi & b.hi }
    }

    #[inline(always)]
    fn is_bit0_set(self) -> VectorMask<S> {
        let lo = self.lo.bitcast::<S::u64s>() & 1;
        let hi = self.hi.bitcast::<S::u64s>() & 1;
        VectorMask { lo: lo.simd_eq(1), hi: hi.simd_eq(1) }
    }

    #[inline(always)]
    fn flip_sign_by_bit1(self, selector: Self) -> Self {
        // Bit 1 moved to the sign bit, everything else cleared.
        let sign = selector.map_bits(
            #[inline(always)]
            |bits| (bits >> 1) << 63,
        );
        Vector {
            lo: (self.lo.bitcast::<S::u64s>() ^ sign.lo.bitcast::<S::u64s>()).bitcast::<S::f64s>(),
            hi: (self.hi.bitcast::<S::u64s>() ^ sign.hi.bitcast::<S::u64s>()).bitcast::<S::f64s>(),
        }
    }

    #[inline(always)]
    fn exponent_and_mantissa(self) -> (Self, Self) {
        let mantissa = self.map_bits(
            #[inline(always)]
            |bits| (bits & MANTISSA_BITS) | ONE_BITS,
        );
        let exponent = self.map_bits(
            #[inline(always)]
            |bits| ((bits & EXPONENT_BITS) >> 52) | TWO_52_BITS,
        );
        (exponent - (TWO_52 + 1023.0), mantissa)
    }

    #[inline(always)]
    fn times_power_of_two(self, k: Self) -> Self {
        let k = k + ROUND;
        Vector {
            lo: (self.lo.bitcast::<S::u64s>() + (k.lo.bitcast::<S::u64s>() << 52)).bitcast::<S::f64s>(),
            hi: (self.hi.bitcast::<S::u64s>() + (k.hi.bitcast::<S::u64s>() << 52)).bitcast::<S::f64s>(),
        }
    }
}
