//! A number type that is one AVX-512 register, with eight lanes of `f64`.
//!
//! The crate `fearless_simd` supports AVX-512 only on processors since Ice Lake and Zen 4. This module needs only the
//! instructions of the first server processors with AVX-512 (Skylake-SP, 2017), which are common in clusters.

#![expect(unsafe_code, reason = "an Avx512 exists only where its instructions do, and they touch no memory")]

use core::arch::x86_64::{
    __m512d, __m512i, __mmask8, _CMP_LT_OQ, _mm512_abs_pd, _mm512_add_epi64, _mm512_add_pd, _mm512_and_si512,
    _mm512_castpd_si512, _mm512_castsi512_pd, _mm512_cmp_pd_mask, _mm512_div_pd, _mm512_fmadd_pd,
    _mm512_mask_blend_pd, _mm512_max_pd, _mm512_min_pd, _mm512_mul_pd, _mm512_or_si512, _mm512_set1_epi64,
    _mm512_set1_pd, _mm512_slli_epi64, _mm512_sqrt_pd, _mm512_srli_epi64, _mm512_sub_epi64, _mm512_sub_pd,
    _mm512_ternarylogic_epi64, _mm512_xor_si512,
};
use core::mem::transmute;

use super::lanes::{
    Bits, EXPONENT_BITS, Lanes, MANTISSA_BITS, OCTAVE, ONE_BITS, RECIPROCAL_BITS, ROUND, Simd, TWO_52,
    TWO_52_BITS,
};
use super::macros::{constants_on_the_right, functions_of_lanes, operator};
use super::pair::Pair;
use super::real::Real;

/// Proof that the processor has the instructions AVX-512 F, DQ, BW, VL and CD, FMA and BMI2. Code can create
/// this value only after a check of the processor.
#[derive(Clone, Copy, Debug)]
pub(super) struct Avx512(());

impl Avx512 {
    /// Returns the proof if the processor has the AVX-512 instructions, and `None` otherwise.
    pub(super) fn detect() -> Option<Avx512> {
        let has = is_x86_feature_detected!("avx512f")
            && is_x86_feature_detected!("avx512dq")
            && is_x86_feature_detected!("avx512bw")
            && is_x86_feature_detected!("avx512vl")
            && is_x86_feature_detected!("avx512cd")
            && is_x86_feature_detected!("fma")
            && is_x86_feature_detected!("bmi2");
        has.then_some(Avx512(()))
    }
}

impl Simd for Avx512 {
    type Vector = Pair<F64x8>;

    #[inline(always)]
    fn vectorize<T>(self, work: impl FnOnce() -> T) -> T {
        #[target_feature(enable = "avx512f,avx512dq,avx512bw,avx512vl,avx512cd,fma,bmi2")]
        fn vectorize_avx512<T>(work: impl FnOnce() -> T) -> T {
            work()
        }
        // SAFETY: `self` proves that the processor has these instructions.
        unsafe { vectorize_avx512(work) }
    }
}

/// Eight lanes.
#[derive(Clone, Copy, Debug)]
pub(super) struct F64x8(__m512d);

/// Calls an AVX-512 intrinsic in an `unsafe` block.
///
/// SAFETY: every value of [`F64x8`] originates from [`F64x8::splat`]. This function requires an [`Avx512`],
/// which exists only if the processor has the AVX-512 instructions.
macro_rules! intrinsic {
    ($call:expr) => {
        unsafe { $call }
    };
}

impl F64x8 {
    #[inline(always)]
    fn broadcast(c: f64) -> F64x8 {
        F64x8(intrinsic!(_mm512_set1_pd(c)))
    }

    #[inline(always)]
    fn to_array(self) -> [f64; 8] {
        // SAFETY: both types consist of eight numbers, for which all bits are valid.
        unsafe { transmute(self.0) }
    }

    #[inline(always)]
    fn to_bits(self) -> __m512i {
        intrinsic!(_mm512_castpd_si512(self.0))
    }

    #[inline(always)]
    fn from_bits(bits: __m512i) -> F64x8 {
        F64x8(intrinsic!(_mm512_castsi512_pd(bits)))
    }

    #[inline(always)]
    fn all(bits: u64) -> __m512i {
        intrinsic!(_mm512_set1_epi64(bits.cast_signed()))
    }
}

operator!([] F64x8, Add::add, |a, b| F64x8(intrinsic!(_mm512_add_pd(a.0, b.0))));
operator!([] F64x8, Sub::sub, |a, b| F64x8(intrinsic!(_mm512_sub_pd(a.0, b.0))));
operator!([] F64x8, Mul::mul, |a, b| F64x8(intrinsic!(_mm512_mul_pd(a.0, b.0))));
operator!([] F64x8, Div::div, |a, b| F64x8(intrinsic!(_mm512_div_pd(a.0, b.0))));
operator!([] F64x8, Neg::neg, |a| Self::from_bits(intrinsic!(_mm512_xor_si512(a.to_bits(), Self::all(SIGN_BIT)))));
constants_on_the_right!([] F64x8);

impl Real for F64x8 {
    type Mask = __mmask8;

    #[inline(always)]
    fn lit(self, c: f64) -> Self {
        Self::broadcast(c)
    }

    #[inline(always)]
    fn mul_add(self, a: Self, b: Self) -> Self {
        F64x8(intrinsic!(_mm512_fmadd_pd(self.0, a.0, b.0)))
    }

    #[inline(always)]
    fn abs(self) -> Self {
        F64x8(intrinsic!(_mm512_abs_pd(self.0)))
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        F64x8(intrinsic!(_mm512_sqrt_pd(self.0)))
    }

    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        // Truth table of a bitwise select: bits of the first operand where the third is set, otherwise bits of the
        // second.
        const CHOOSE: i32 = 0xE4;
        let (magnitude, sign) = (self.to_bits(), sign.to_bits());
        Self::from_bits(intrinsic!(_mm512_ternarylogic_epi64::<CHOOSE>(sign, magnitude, Self::all(SIGN_BIT))))
    }

    functions_of_lanes!();

    #[inline(always)]
    fn lt(self, other: Self) -> __mmask8 {
        intrinsic!(_mm512_cmp_pd_mask::<_CMP_LT_OQ>(self.0, other.0))
    }

    #[inline(always)]
    fn select(mask: __mmask8, yes: Self, no: Self) -> Self {
        F64x8(intrinsic!(_mm512_mask_blend_pd(mask, no.0, yes.0)))
    }

    #[inline(always)]
    fn outlined<T>(self, work: impl FnOnce() -> T) -> T {
        // The value `self` is proof enough, see `intrinsic`.
        Avx512(()).vectorize(work)
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        F64x8(intrinsic!(_mm512_min_pd(self.0, other.0)))
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        F64x8(intrinsic!(_mm512_max_pd(self.0, other.0)))
    }
}

impl Lanes for F64x8 {
    const LANES: usize = 8;
    type Token = Avx512;

    #[inline(always)]
    fn splat(_token: Avx512, c: f64) -> Self {
        Self::broadcast(c)
    }

    #[inline(always)]
    fn lane(self, lane: usize) -> f64 {
        self.to_array()[lane]
    }

    #[inline(always)]
    fn set_lane(&mut self, lane: usize, value: f64) {
        // SAFETY: both types consist of eight numbers of the same size, for which all bits are valid. `to_array`
        // would copy all lanes.
        let lanes = unsafe { &mut *(&raw mut self.0).cast::<[f64; 8]>() };
        lanes[lane] = value;
    }

    #[inline(always)]
    fn mask(_token: Avx512, bits: u64) -> __mmask8 {
        (bits & 0xff) as __mmask8
    }

    #[inline(always)]
    fn bits(mask: __mmask8) -> u64 {
        u64::from(mask)
    }
}

impl Bits for F64x8 {
    #[inline(always)]
    fn flip_sign_by_lowest_bit(self, selector: Self) -> Self {
        let sign = intrinsic!(_mm512_slli_epi64::<63>(selector.to_bits()));
        Self::from_bits(intrinsic!(_mm512_xor_si512(self.to_bits(), sign)))
    }

    #[inline(always)]
    fn exponent_and_mantissa(self) -> (Self, Self) {
        let bits = self.to_bits();
        let kept = |mask| intrinsic!(_mm512_and_si512(bits, Self::all(mask)));
        let mantissa = intrinsic!(_mm512_or_si512(kept(MANTISSA_BITS), Self::all(ONE_BITS)));
        let field = intrinsic!(_mm512_srli_epi64::<52>(kept(EXPONENT_BITS)));
        let exponent = Self::from_bits(intrinsic!(_mm512_or_si512(field, Self::all(TWO_52_BITS))));
        (exponent - (TWO_52 + 1023.0), Self::from_bits(mantissa))
    }

    #[inline(always)]
    fn linear_log2(self) -> Self {
        let octaves = intrinsic!(_mm512_srli_epi64::<12>(self.to_bits()));
        let number = Self::from_bits(intrinsic!(_mm512_or_si512(octaves, Self::all(TWO_52_BITS))));
        number.mul_add(Self::broadcast(OCTAVE), Self::broadcast(-TWO_52 * OCTAVE - 1023.0))
    }

    #[inline(always)]
    fn reciprocal_guess(self) -> Self {
        Self::from_bits(intrinsic!(_mm512_sub_epi64(Self::all(RECIPROCAL_BITS), self.to_bits())))
    }

    #[inline(always)]
    fn times_power_of_two(self, k: Self) -> Self {
        let k = intrinsic!(_mm512_slli_epi64::<52>((k + ROUND).to_bits()));
        Self::from_bits(intrinsic!(_mm512_add_epi64(self.to_bits(), k)))
    }
}

const SIGN_BIT: u64 = 1 << 63;
