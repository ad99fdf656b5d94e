//! The scalar of processors without fused multiply-add.

use core::ops::{Add, Div, Mul, Neg, Sub};

use super::functions;
use super::lanes::Lanes;
use super::real::Real;

/// A single `f64` whose `mul_add` rounds twice: the scalar of [`super::Arithmetic::Unfused`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unfused(pub f64);

impl Add for Unfused {
    type Output = Unfused;
    #[inline(always)]
    fn add(self, rhs: Unfused) -> Unfused {
        Unfused(self.0 + rhs.0)
    }
}

impl Sub for Unfused {
    type Output = Unfused;
    #[inline(always)]
    fn sub(self, rhs: Unfused) -> Unfused {
        Unfused(self.0 - rhs.0)
    }
}

impl Mul for Unfused {
    type Output = Unfused;
    #[inline(always)]
    fn mul(self, rhs: Unfused) -> Unfused {
        Unfused(self.0 * rhs.0)
    }
}

impl Div for Unfused {
    type Output = Unfused;
    #[inline(always)]
    fn div(self, rhs: Unfused) -> Unfused {
        Unfused(self.0 / rhs.0)
    }
}

impl Neg for Unfused {
    type Output = Unfused;
    #[inline(always)]
    fn neg(self) -> Unfused {
        Unfused(-self.0)
    }
}

impl Add<f64> for Unfused {
    type Output = Unfused;
    #[inline(always)]
    fn add(self, rhs: f64) -> Unfused {
        Unfused(self.0 + rhs)
    }
}

impl Sub<f64> for Unfused {
    type Output = Unfused;
    #[inline(always)]
    fn sub(self, rhs: f64) -> Unfused {
        Unfused(self.0 - rhs)
    }
}

impl Mul<f64> for Unfused {
    type Output = Unfused;
    #[inline(always)]
    fn mul(self, rhs: f64) -> Unfused {
        Unfused(self.0 * rhs)
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

    #[inline(always)]
    fn abs(self) -> Unfused {
        Unfused(self.0.abs())
    }

    #[inline(always)]
    fn sqrt(self) -> Unfused {
        Unfused(self.0.sqrt())
    }

    #[inline(always)]
    fn copysign(self, sign: Unfused) -> Unfused {
        Unfused(self.0.copysign(sign.0))
    }

    #[inline(always)]
    fn lt(self, other: Unfused) -> bool {
        self.0 < other.0
    }

    #[inline(always)]
    fn select(mask: bool, yes: Unfused, no: Unfused) -> Unfused {
        if mask { yes } else { no }
    }

    #[inline(always)]
    fn sin(self) -> Unfused {
        functions::sin(self)
    }

    #[inline(always)]
    fn sin_cos(self) -> (Unfused, Unfused) {
        functions::sin_cos(self)
    }

    #[inline(always)]
    fn exp(self) -> Unfused {
        functions::exp(self)
    }

    #[inline(always)]
    fn exp_m1(self) -> Unfused {
        functions::exp_m1(self)
    }

    #[inline(always)]
    fn ln(self) -> Unfused {
        functions::ln(self)
    }

    #[inline(always)]
    fn ln_1p(self) -> Unfused {
        functions::ln_1p(self)
    }
}

impl Lanes for Unfused {
    const LANES: usize = 1;
    type Token = ();

    #[inline(always)]
    fn splat((): (), c: f64) -> Unfused {
        Unfused(c)
    }

    #[inline(always)]
    fn lane(self, _lane: usize) -> f64 {
        self.0
    }

    #[inline(always)]
    fn set_lane(&mut self, _lane: usize, value: f64) {
        self.0 = value;
    }

    #[inline(always)]
    fn mask((): (), bits: u64) -> bool {
        bits & 1 != 0
    }

    #[inline(always)]
    fn apart<T>(self, work: impl FnOnce() -> T) -> T {
        work()
    }

    #[inline(always)]
    fn bits(mask: bool) -> u64 {
        u64::from(mask)
    }

    #[inline(always)]
    fn and(a: bool, b: bool) -> bool {
        a && b
    }

    #[inline(always)]
    fn flip_sign_by_lowest_bit(self, selector: Unfused) -> Unfused {
        Unfused(self.0.flip_sign_by_lowest_bit(selector.0))
    }

    #[inline(always)]
    fn exponent_and_mantissa(self) -> (Unfused, Unfused) {
        let (exponent, mantissa) = self.0.exponent_and_mantissa();
        (Unfused(exponent), Unfused(mantissa))
    }

    #[inline(always)]
    fn times_power_of_two(self, k: Unfused) -> Unfused {
        Unfused(self.0.times_power_of_two(k.0))
    }
}
