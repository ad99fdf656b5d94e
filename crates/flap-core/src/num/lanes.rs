//! Access to single lanes and to the binary representation of numbers, and the instructions that compute lanes.
//!
//! The integrator needs the former beyond [`Real`], the elementary functions the latter.

use super::real::Real;

/// A [`Real`] in the binary64 format of IEEE 754, with access to sign and exponent.
pub trait Bits: Real {
    /// Returns `self` with its sign flipped if the lowest bit of the representation of `selector` is set.
    fn flip_sign_by_lowest_bit(self, selector: Self) -> Self;

    /// Returns `(e, m)` with `self = 2^e m` and `m` in [1, 2), for a normal positive number.
    ///
    /// For NaN and infinity, `e` is 1024 and `m` is finite.
    fn exponent_and_mantissa(self) -> (Self, Self);

    /// Returns log2 of a normal positive number: exact for powers of two, linear between them, and up to 0.087 too
    /// small.
    ///
    /// 1024 or more for NaN and infinity, −1023 for 0.
    fn linear_log2(self) -> Self;

    /// Returns an estimate of the reciprocal of a normal positive number up to 2^1022. It is 0 to 12.5 % too large.
    fn reciprocal_guess(self) -> Self;

    /// Returns `self * 2^k` by adding to the exponent. `k` must be a whole number, and the result must not overflow.
    fn times_power_of_two(self, k: Self) -> Self;
}

/// One or more independent numbers, one per lane. `f64` has one lane.
pub trait Lanes: Real + Bits {
    /// Number of lanes.
    const LANES: usize;

    /// Proof that the processor has the instructions of this type.
    type Token: Copy;

    /// Returns `c` in every lane.
    fn splat(token: Self::Token, c: f64) -> Self;

    /// Returns the number in one lane.
    fn lane(self, lane: usize) -> f64;

    /// Replaces the number in one lane.
    fn set_lane(&mut self, lane: usize, value: f64);

    /// Returns the mask that is true in the lanes whose bits are set in `bits`, with lane 0 in the lowest bit.
    fn mask(token: Self::Token, bits: u64) -> Self::Mask;

    /// Returns one bit per lane of `mask`, with lane 0 in the lowest bit.
    fn bits(mask: Self::Mask) -> u64;

    /// Returns 1/x of a normal positive number up to 2^1022, with relative errors below 1.74·10^-3.
    #[inline(always)]
    fn rough_reciprocal(self) -> Self {
        let guess = self.reciprocal_guess();
        // Newton's step. The coefficients balance the largest errors above and below.
        guess * (self * guess).mul_add(self.lit(-0.887_348_353_552_859_6), self.lit(1.885_615_251_299_826_8))
    }

    /// Returns 2^x for |x| up to 700, exact for whole numbers, with relative errors below 2.0·10^-3.
    #[inline(always)]
    fn rough_exp2(self) -> Self {
        let k = self.round_ties_even();
        let r = self - k;
        let slope = r.mul_add(r.lit(0.2398), r.lit(0.703));
        slope.mul_add(r, r.lit(1.0)).times_power_of_two(k)
    }

    /// Returns the nearest multiple of 1/8, for |x| up to 2^48.
    #[inline(always)]
    fn round_to_eighths(self) -> Self {
        (self + ROUND * 0.125) - ROUND * 0.125
    }
}

/// Proof that the processor has a set of instructions: SIMD, or [`OneLane`](super::OneLane) for scalars.
pub trait Simd: Copy {
    /// Lanes of these instructions: two registers of `f64`, or one scalar.
    type Vector: Lanes<Token = Self>;

    /// Calls `work` in a function in which the instructions are enabled. Functions that `work` calls must be
    /// `#[inline(always)]` to be compiled with them.
    fn vectorize<T>(self, work: impl FnOnce() -> T) -> T;
}

/// Lanes: 16 with AVX-512, 8 with AVX2, 4 with NEON, 1 with scalars.
pub type Vector<S> = <S as Simd>::Vector;

/// 1.5 · 2^52. Adding it rounds to a whole number, whose two's complement is then in the low bits.
pub(super) const ROUND: f64 = 6_755_399_441_055_744.0;

pub(super) const MANTISSA_BITS: u64 = 0x000f_ffff_ffff_ffff;
pub(super) const EXPONENT_BITS: u64 = 0x7ff0_0000_0000_0000;
pub(super) const ONE_BITS: u64 = 0x3ff0_0000_0000_0000;
/// Sum of the representations of a power of two and of its reciprocal.
pub(super) const RECIPROCAL_BITS: u64 = 0x7fe0_0000_0000_0000;
/// One octave of [`Bits::linear_log2`], in units of the lowest bit of a representation without its last 12 bits.
pub(super) const OCTAVE: f64 = 1.0 / 1_099_511_627_776.0;
pub(super) const TWO_52: f64 = 4_503_599_627_370_496.0;
pub(super) const TWO_52_BITS: u64 = 0x4330_0000_0000_0000;
