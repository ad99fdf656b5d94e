//! Traits for access to single lanes, for access to the bits of numbers, and for sets of SIMD instructions.
//!
//! The integrator reads and changes single lanes, and the elementary functions read and change the bits of
//! numbers. The trait [`Real`] contains no operations on single lanes or bits.

use super::real::Real;

/// A [`Real`] in the binary64 format of IEEE 754, with functions that read and change the sign and the exponent.
pub trait Bits: Real {
    /// Returns `self`, with the opposite sign if the lowest bit of the bit pattern of `selector` is set.
    fn flip_sign_by_lowest_bit(self, selector: Self) -> Self;

    /// Returns the exponent `e` and the mantissa `m` of a normal positive number, with `self = 2^e m` and `m`
    /// in [1, 2).
    ///
    /// For NaN and infinity, `e` is 1024 and `m` is finite.
    fn exponent_and_mantissa(self) -> (Self, Self);

    /// Returns an approximation of log2 of a normal positive number. The approximation is exact for powers of
    /// two, linear between powers of two, and up to 0.087 too small.
    ///
    /// The result is 1024 or more for NaN and infinity, and −1023 for 0.
    fn linear_log2(self) -> Self;

    /// Returns an estimate of the reciprocal of a normal positive number up to 2^1022. The estimate is 0 to 12.5 % too
    /// large.
    fn reciprocal_guess(self) -> Self;

    /// Returns `self * 2^k`, computed by an addition to the exponent. `k` must be a whole number, and the result must
    /// not overflow.
    fn times_power_of_two(self, k: Self) -> Self;
}

/// One or more independent numbers, one for each lane. The type `f64` has one lane.
pub trait Lanes: Real + Bits {
    /// Number of lanes.
    const LANES: usize;

    /// Type of a value that proves that the processor has the instructions of this number type.
    type Token: Copy;

    /// Returns a number with the value `c` in every lane.
    fn splat(token: Self::Token, c: f64) -> Self;

    /// Returns the number in one lane.
    fn lane(self, lane: usize) -> f64;

    /// Replaces the number in one lane.
    fn set_lane(&mut self, lane: usize, value: f64);

    /// Returns a mask that is true in the lanes whose bits are set in `bits`. The lowest bit is the bit of
    /// lane 0.
    fn mask(token: Self::Token, bits: u64) -> Self::Mask;

    /// Returns a number with one bit for each lane. The bit of a lane is set if `mask` is true in this lane.
    /// The lowest bit is the bit of lane 0.
    fn bits(mask: Self::Mask) -> u64;

    /// Returns an approximation of 1/x for a normal positive number x up to 2^1022. The relative error is
    /// below 1.74·10^-3.
    #[inline(always)]
    fn rough_reciprocal(self) -> Self {
        let guess = self.reciprocal_guess();
        // Newton's step. The coefficients balance the largest errors above and below.
        guess * (self * guess).mul_add(self.lit(-0.887_348_353_552_859_6), self.lit(1.885_615_251_299_826_8))
    }

    /// Returns an approximation of 2^x for |x| up to 700. The approximation is exact for whole numbers, and
    /// has a relative error below 2.0·10^-3 for other numbers.
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

/// A value that proves that the processor has a set of SIMD instructions. For computations on scalars, use
/// the type [`OneLane`](super::OneLane).
pub trait Simd: Copy {
    /// Number type that the instructions compute with: two registers of `f64`, or one scalar.
    type Vector: Lanes<Token = Self>;

    /// Calls `work` in a function that the compiler translates into the SIMD instructions. Write
    /// `#[inline(always)]` before each function that `work` calls, so that the compiler also translates this
    /// function into the SIMD instructions.
    fn vectorize<T>(self, work: impl FnOnce() -> T) -> T;
}

/// Number type for the instructions `S`. The number type has 16 lanes with AVX-512, 8 lanes with AVX2, 4
/// lanes with NEON, and 1 lane with scalars.
pub type Vector<S> = <S as Simd>::Vector;

/// The number 1.5 · 2^52. If this number is added to x, the low bits of the sum contain x, rounded to a whole
/// number, in two's complement.
pub(super) const ROUND: f64 = 6_755_399_441_055_744.0;

pub(super) const MANTISSA_BITS: u64 = 0x000f_ffff_ffff_ffff;
pub(super) const EXPONENT_BITS: u64 = 0x7ff0_0000_0000_0000;
pub(super) const ONE_BITS: u64 = 0x3ff0_0000_0000_0000;
/// Sum of the bit patterns of a power of two and of its reciprocal.
pub(super) const RECIPROCAL_BITS: u64 = 0x7fe0_0000_0000_0000;
/// Change of [`Bits::linear_log2`] if the upper 52 bits of the number, read as an integer, increase by 1.
pub(super) const OCTAVE: f64 = 1.0 / 1_099_511_627_776.0;
pub(super) const TWO_52: f64 = 4_503_599_627_370_496.0;
pub(super) const TWO_52_BITS: u64 = 0x4330_0000_0000_0000;
