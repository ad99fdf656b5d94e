//! Scalars: number types with a single lane.

use core::marker::PhantomData;

use super::lanes::{
    Bits, EXPONENT_BITS, Lanes, MANTISSA_BITS, OCTAVE, ONE_BITS, RECIPROCAL_BITS, ROUND, Simd, TWO_52,
    TWO_52_BITS,
};
use super::macros::{constants_on_the_right, functions_of_lanes, of_inner, operator};
use super::real::Real;

/// A scalar: `f64`, or [`Unfused`] for machines without fused multiply-add.
pub trait Scalar: Bits + Lanes<Token = OneLane<Self>, Mask = bool> {
    /// Returns the scalar with the given value.
    fn new(value: f64) -> Self;

    /// Returns the value.
    fn value(self) -> f64;

    /// Calls `work` in a function that the compiler translates into the instructions that the scalar type
    /// needs, such as a fused multiply-add.
    ///
    /// # Panics
    ///
    /// Panics if the processor does not have the instructions that the scalar type needs. On x86-64, the
    /// scalar `f64` needs AVX2. On processors without AVX2, use [`Unfused`].
    fn enter<T>(work: impl FnOnce() -> T) -> T;
}

/// An implementation of [`Simd`] for code without SIMD: the number type is the scalar `R`, with one lane.
#[derive(Clone, Copy, Debug)]
pub struct OneLane<R>(PhantomData<R>);

impl<R: Scalar> OneLane<R> {
    /// Returns the value without a check of the processor, because every processor can compute with scalars.
    pub const fn new() -> OneLane<R> {
        OneLane(PhantomData)
    }
}

impl<R: Scalar> Default for OneLane<R> {
    fn default() -> OneLane<R> {
        OneLane::new()
    }
}

impl<R: Scalar> Simd for OneLane<R> {
    type Vector = R;

    #[inline(always)]
    fn vectorize<T>(self, work: impl FnOnce() -> T) -> T {
        R::enter(work)
    }
}

impl<R: Scalar> Lanes for R {
    const LANES: usize = 1;
    type Token = OneLane<R>;

    #[inline(always)]
    fn splat(_token: OneLane<R>, c: f64) -> R {
        R::new(c)
    }

    #[inline(always)]
    fn lane(self, _lane: usize) -> f64 {
        self.value()
    }

    #[inline(always)]
    fn set_lane(&mut self, _lane: usize, value: f64) {
        *self = R::new(value);
    }

    #[inline(always)]
    fn mask(_token: OneLane<R>, bits: u64) -> bool {
        bits & 1 != 0
    }

    #[inline(always)]
    fn bits(mask: bool) -> u64 {
        u64::from(mask)
    }
}

/// The type `f64` is the scalar of [`super::Arithmetic::Fused`]: `mul_add` rounds its result once.
impl Scalar for f64 {
    #[inline(always)]
    fn new(value: f64) -> f64 {
        value
    }

    #[inline(always)]
    fn value(self) -> f64 {
        self
    }

    #[inline(always)]
    fn enter<T>(work: impl FnOnce() -> T) -> T {
        #[cfg(target_arch = "x86_64")]
        return fearless_simd::Simd::vectorize(
            fearless_simd::Level::new().as_avx2().expect("fused multiply-add needs a processor with AVX2"),
            work,
        );
        #[cfg(not(target_arch = "x86_64"))]
        work()
    }
}

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

    functions_of_lanes!();

    #[inline(always)]
    fn lt(self, other: f64) -> bool {
        self < other
    }

    #[inline(always)]
    fn select(mask: bool, yes: f64, no: f64) -> f64 {
        if mask { yes } else { no }
    }

    #[inline(always)]
    fn outlined<T>(self, work: impl FnOnce() -> T) -> T {
        // Without the instructions of `enter`, the C library computes the same bits.
        #[cfg(target_arch = "x86_64")]
        if let Some(simd) = fearless_simd::Level::new().as_avx2() {
            return fearless_simd::Simd::vectorize(simd, work);
        }
        call(work)
    }
}

impl Bits for f64 {
    #[inline(always)]
    fn flip_sign_by_lowest_bit(self, selector: f64) -> f64 {
        f64::from_bits(self.to_bits() ^ (selector.to_bits() << 63))
    }

    #[inline(always)]
    fn exponent_and_mantissa(self) -> (f64, f64) {
        let bits = self.to_bits();
        let mantissa = f64::from_bits((bits & MANTISSA_BITS) | ONE_BITS);
        // The exponent field as a whole number: its bits replace the low bits of 2^52.
        let exponent = f64::from_bits(((bits & EXPONENT_BITS) >> 52) | TWO_52_BITS) - (TWO_52 + 1023.0);
        (exponent, mantissa)
    }

    #[inline(always)]
    fn linear_log2(self) -> f64 {
        let number = f64::from_bits((self.to_bits() >> 12) | TWO_52_BITS);
        number.mul_add(OCTAVE, -TWO_52 * OCTAVE - 1023.0)
    }

    #[inline(always)]
    fn reciprocal_guess(self) -> f64 {
        f64::from_bits(RECIPROCAL_BITS.wrapping_sub(self.to_bits()))
    }

    #[inline(always)]
    fn times_power_of_two(self, k: f64) -> f64 {
        f64::from_bits(self.to_bits().wrapping_add((k + ROUND).to_bits() << 52))
    }
}

/// Calls `work` in a separate function that is not inlined.
#[inline(never)]
fn call<T>(work: impl FnOnce() -> T) -> T {
    work()
}

/// An `f64` whose `mul_add` rounds its result twice. `Unfused` is the scalar of
/// [`super::Arithmetic::Unfused`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unfused(pub f64);

operator!([] Unfused, Add::add, |a, b| Unfused(a.0 + b.0));
operator!([] Unfused, Sub::sub, |a, b| Unfused(a.0 - b.0));
operator!([] Unfused, Mul::mul, |a, b| Unfused(a.0 * b.0));
operator!([] Unfused, Div::div, |a, b| Unfused(a.0 / b.0));
operator!([] Unfused, Neg::neg, |a| Unfused(-a.0));
constants_on_the_right!([] Unfused);

impl Scalar for Unfused {
    #[inline(always)]
    fn new(value: f64) -> Unfused {
        Unfused(value)
    }

    #[inline(always)]
    fn value(self) -> f64 {
        self.0
    }

    #[inline(always)]
    fn enter<T>(work: impl FnOnce() -> T) -> T {
        work()
    }
}

impl Real for Unfused {
    type Mask = bool;

    #[inline(always)]
    fn lit(self, c: f64) -> Unfused {
        Unfused(c)
    }

    #[inline(always)]
    fn mul_add(self, a: Unfused, b: Unfused) -> Unfused {
        self * a + b
    }

    of_inner!(Unfused: abs(), sqrt(), copysign(sign));

    functions_of_lanes!();

    #[inline(always)]
    fn lt(self, other: Unfused) -> bool {
        self.0 < other.0
    }

    #[inline(always)]
    fn select(mask: bool, yes: Unfused, no: Unfused) -> Unfused {
        if mask { yes } else { no }
    }

    #[inline(always)]
    fn outlined<T>(self, work: impl FnOnce() -> T) -> T {
        call(work)
    }
}

impl Bits for Unfused {
    #[inline(always)]
    fn exponent_and_mantissa(self) -> (Unfused, Unfused) {
        let (exponent, mantissa) = self.0.exponent_and_mantissa();
        (Unfused(exponent), Unfused(mantissa))
    }

    of_inner!(Unfused: flip_sign_by_lowest_bit(selector), linear_log2(), reciprocal_guess(), times_power_of_two(k));
}
