//! The scalar of processors without fused multiply-add.

use super::bits::Bits;
use super::functions_of_lanes::functions_of_lanes;
use super::operators::{constants_on_the_right, of_inner, operator};
use super::real::Real;
use super::scalar::Scalar;

/// A single `f64` whose `mul_add` rounds twice: the scalar of [`super::Arithmetic::Unfused`].
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
}

impl Bits for Unfused {
    #[inline(always)]
    fn exponent_and_mantissa(self) -> (Unfused, Unfused) {
        let (exponent, mantissa) = self.0.exponent_and_mantissa();
        (Unfused(exponent), Unfused(mantissa))
    }

    of_inner!(Unfused: flip_sign_by_lowest_bit(selector), linear_log2(), reciprocal_guess(), times_power_of_two(k));
}
