//! The binary representation of numbers, of which the elementary functions make use.

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
