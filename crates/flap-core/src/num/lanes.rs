//! Single lanes of numbers, which the integrator needs beyond [`Real`], the instructions that compute them, and the binary
//! representation, of which the elementary functions make use.

use super::real::Real;

/// A [`Real`] in the binary64 format of IEEE 754, whose sign and exponent can be reached.
pub trait Bits: Real {
    /// `self` with its sign flipped where the lowest bit of the representation of `selector` is set.
    fn flip_sign_by_lowest_bit(self, selector: Self) -> Self;

    /// Splits a normal positive number into `(e, m)` with `self = 2^e m` and `m` in [1, 2).
    /// For NaN and infinity `e` is 1024 and `m` finite.
    fn exponent_and_mantissa(self) -> (Self, Self);

    /// log2 of a normal positive number: exact for powers of two, linear between them and up to 0.087 too small. 1024 or
    /// more for NaN and infinity, −1023 for 0.
    fn linear_log2(self) -> Self;

    /// A guess at the reciprocal of a normal positive number up to 2^1022, 0 to 12.5 % too large.
    fn reciprocal_guess(self) -> Self;

    /// `self * 2^k` by adding to the exponent, with `k` a whole number and no overflow.
    fn times_power_of_two(self, k: Self) -> Self;
}

/// One or more independent numbers, one per lane. `f64` is the case of one lane.
pub trait Lanes: Real + Bits {
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

    /// One bit per lane of `mask`, lane 0 in the lowest.
    fn bits(mask: Self::Mask) -> u64;

    /// Does the work in an outlined function, compiled once however many callers it has, where that saves the
    /// compiler more than it costs the processor: with SIMD instructions, whose many layers are inlined.
    fn outlined<T>(self, work: impl FnOnce() -> T) -> T;

    /// 1/x of a normal positive number up to 2^1022; relative errors stay below 1.74·10^-3.
    #[inline(always)]
    fn rough_reciprocal(self) -> Self {
        let guess = self.reciprocal_guess();
        // Newton's step, with coefficients that make errors as large below as above.
        guess * (self * guess).mul_add(self.lit(-0.887_348_353_552_859_6), self.lit(1.885_615_251_299_826_8))
    }

    /// 2^x for |x| up to 700, exact for whole numbers; relative errors stay below 2.0·10^-3.
    #[inline(always)]
    fn rough_exp2(self) -> Self {
        let k = self.round_ties_even();
        let r = self - k;
        let slope = r.mul_add(r.lit(0.2398), r.lit(0.703));
        slope.mul_add(r, r.lit(1.0)).times_power_of_two(k)
    }

    /// The nearest multiple of 1/8, for |x| up to 2^48.
    #[inline(always)]
    fn round_to_eighths(self) -> Self {
        (self + ROUND * 0.125) - ROUND * 0.125
    }
}

/// Proof that the processor has a set of instructions: SIMD, or [`OneLane`](super::OneLane) for scalars.
pub trait Simd: Copy {
    /// The lanes that are computed with them: two registers of `f64`, or one scalar.
    type Vector: Lanes<Token = Self>;

    /// Calls `work` from a function in which the instructions are enabled. What is called there must be
    /// `#[inline(always)]` to be compiled with them.
    fn vectorize<T>(self, work: impl FnOnce() -> T) -> T;
}

/// SIMD lanes: 16 with AVX-512, 8 with AVX2, 4 with SSE2 and NEON.
pub type Vector<S> = <S as Simd>::Vector;

/// 1.5 · 2^52: adding it rounds to a whole number, whose two's complement then is in the low bits.
pub(super) const ROUND: f64 = 6_755_399_441_055_744.0;

pub(super) const MANTISSA_BITS: u64 = 0x000f_ffff_ffff_ffff;
pub(super) const EXPONENT_BITS: u64 = 0x7ff0_0000_0000_0000;
pub(super) const ONE_BITS: u64 = 0x3ff0_0000_0000_0000;
/// The representations of a power of two and of its reciprocal add up to this.
pub(super) const RECIPROCAL_BITS: u64 = 0x7fe0_0000_0000_0000;
/// An octave of [`Bits::linear_log2`], over the lowest bit of a representation without its last 12 bits.
pub(super) const OCTAVE: f64 = 1.0 / 1_099_511_627_776.0;
pub(super) const TWO_52: f64 = 4_503_599_627_370_496.0;
pub(super) const TWO_52_BITS: u64 = 0x4330_0000_0000_0000;
