//! Dual numbers: numbers with their derivatives along D directions.

use std::array;
use std::ops::{Add, Div, Mul, Neg, Sub};

use flap_core::num::Real;

/// A number and its derivatives.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Dual<R, const D: usize> {
    pub(crate) value: R,
    pub(crate) slopes: [R; D],
}

impl<R: Real, const D: usize> Dual<R, D> {
    /// A number that does not change.
    #[inline(always)]
    pub(crate) fn constant(value: R) -> Dual<R, D> {
        Dual { value, slopes: [value.lit(0.0); D] }
    }

    /// A number that changes along one direction at this rate.
    pub(crate) fn along(value: R, direction: usize, rate: R) -> Dual<R, D> {
        let mut dual = Dual::constant(value);
        dual.slopes[direction] = rate;
        dual
    }

    /// A function of `self` with this value and this derivative.
    #[inline(always)]
    fn chain(self, value: R, derivative: R) -> Dual<R, D> {
        self.with(
            value,
            #[inline(always)]
            |slope, _| slope * derivative,
        )
    }

    /// A number with this value. `slope` returns a derivative from the derivative of `self` and from its direction.
    #[inline(always)]
    fn with(self, value: R, slope: impl Fn(R, usize) -> R) -> Dual<R, D> {
        let mut slopes = self.slopes;
        for i in 0..D {
            slopes[i] = slope(slopes[i], i);
        }
        Dual { value, slopes }
    }
}

/// +1 or −1.
#[inline(always)]
fn sign<R: Real>(x: R) -> R {
    x.lit(1.0).copysign(x)
}

impl<R: Real, const D: usize> Add for Dual<R, D> {
    type Output = Dual<R, D>;
    #[inline(always)]
    fn add(self, other: Dual<R, D>) -> Dual<R, D> {
        self.with(
            self.value + other.value,
            #[inline(always)]
            |slope, i| slope + other.slopes[i],
        )
    }
}

impl<R: Real, const D: usize> Sub for Dual<R, D> {
    type Output = Dual<R, D>;
    #[inline(always)]
    fn sub(self, other: Dual<R, D>) -> Dual<R, D> {
        self.with(
            self.value - other.value,
            #[inline(always)]
            |slope, i| slope - other.slopes[i],
        )
    }
}

impl<R: Real, const D: usize> Mul for Dual<R, D> {
    type Output = Dual<R, D>;
    #[inline(always)]
    fn mul(self, other: Dual<R, D>) -> Dual<R, D> {
        self.with(
            self.value * other.value,
            #[inline(always)]
            |slope, i| slope.mul_add(other.value, self.value * other.slopes[i]),
        )
    }
}

impl<R: Real, const D: usize> Div for Dual<R, D> {
    type Output = Dual<R, D>;
    #[inline(always)]
    fn div(self, other: Dual<R, D>) -> Dual<R, D> {
        let inverse = self.value.lit(1.0) / other.value;
        let value = self.value * inverse;
        self.with(
            value,
            #[inline(always)]
            |slope, i| (slope - value * other.slopes[i]) * inverse,
        )
    }
}

impl<R: Real, const D: usize> Neg for Dual<R, D> {
    type Output = Dual<R, D>;
    #[inline(always)]
    fn neg(self) -> Dual<R, D> {
        self.with(
            -self.value,
            #[inline(always)]
            |slope, _| -slope,
        )
    }
}

impl<R: Real, const D: usize> Add<f64> for Dual<R, D> {
    type Output = Dual<R, D>;
    #[inline(always)]
    fn add(self, c: f64) -> Dual<R, D> {
        Dual { value: self.value + c, ..self }
    }
}

impl<R: Real, const D: usize> Sub<f64> for Dual<R, D> {
    type Output = Dual<R, D>;
    #[inline(always)]
    fn sub(self, c: f64) -> Dual<R, D> {
        Dual { value: self.value - c, ..self }
    }
}

impl<R: Real, const D: usize> Mul<f64> for Dual<R, D> {
    type Output = Dual<R, D>;
    #[inline(always)]
    fn mul(self, c: f64) -> Dual<R, D> {
        self.with(
            self.value * c,
            #[inline(always)]
            |slope, _| slope * c,
        )
    }
}

impl<R: Real, const D: usize> Real for Dual<R, D> {
    type Mask = R::Mask;

    #[inline(always)]
    fn lit(self, c: f64) -> Self {
        Dual::constant(self.value.lit(c))
    }

    #[inline(always)]
    fn mul_add(self, a: Self, b: Self) -> Self {
        self.with(
            self.value.mul_add(a.value, b.value),
            #[inline(always)]
            |slope, i| slope.mul_add(a.value, self.value.mul_add(a.slopes[i], b.slopes[i])),
        )
    }

    #[inline(always)]
    fn abs(self) -> Self {
        self.chain(self.value.abs(), sign(self.value))
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.chain(root, root.lit(0.5) / root)
    }

    #[inline(always)]
    fn copysign(self, other: Self) -> Self {
        self.chain(self.value.copysign(other.value), sign(self.value) * sign(other.value))
    }

    #[inline(always)]
    fn round_ties_even(self) -> Self {
        Dual::constant(self.value.round_ties_even())
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = self.value.sin_cos();
        (self.chain(sin, cos), self.chain(cos, -sin))
    }

    #[inline(always)]
    fn exp(self) -> Self {
        let exp = self.value.exp();
        self.chain(exp, exp)
    }

    #[inline(always)]
    fn exp_m1(self) -> Self {
        let exp_m1 = self.value.exp_m1();
        self.chain(exp_m1, exp_m1 + 1.0)
    }

    #[inline(always)]
    fn ln(self) -> Self {
        self.chain(self.value.ln(), self.value.lit(1.0) / self.value)
    }

    #[inline(always)]
    fn ln_1p(self) -> Self {
        self.chain(self.value.ln_1p(), self.value.lit(1.0) / (self.value + 1.0))
    }

    #[inline(always)]
    fn exp_of_ordinary(self) -> Self {
        let exp = self.value.exp_of_ordinary();
        self.chain(exp, exp)
    }

    #[inline(always)]
    fn exp_m1_of_ordinary(self) -> Self {
        let exp_m1 = self.value.exp_m1_of_ordinary();
        self.chain(exp_m1, exp_m1 + 1.0)
    }

    #[inline(always)]
    fn ln_1p_of_normal(self) -> Self {
        self.chain(self.value.ln_1p_of_normal(), self.value.lit(1.0) / (self.value + 1.0))
    }

    #[inline(always)]
    fn lt(self, other: Self) -> R::Mask {
        self.value.lt(other.value)
    }

    #[inline(always)]
    fn select(mask: R::Mask, yes: Self, no: Self) -> Self {
        yes.with(
            R::select(mask, yes.value, no.value),
            #[inline(always)]
            |slope, i| R::select(mask, slope, no.slopes[i]),
        )
    }

    #[inline(always)]
    fn look_up<const N: usize>(self, table: impl Fn(f64) -> [f64; N]) -> [Self; N] {
        let entries = self.value.look_up(table);
        array::from_fn(
            #[inline(always)]
            |i| Dual::constant(entries[i]),
        )
    }
}

/// The derivatives that dual numbers compute are the analytical derivatives of functions of one number.
#[test]
fn derivatives_of_functions_are_those_of_calculus() {
    let at = |x: f64| Dual::<f64, 1>::along(x, 0, 1.0);
    for x in [0.3, 1.7, 5.1] {
        let dual = at(x);
        let expected = [
            (dual.sin_cos().0, x.cos()),
            (dual.sin_cos().1, -x.sin()),
            (Real::sin(dual), x.cos()),
            (dual.exp(), x.exp()),
            (dual.exp_m1(), x.exp()),
            (dual.ln(), 1.0 / x),
            (dual.ln_1p(), 1.0 / (1.0 + x)),
            (dual.sqrt(), 0.5 / x.sqrt()),
            ((-dual).abs(), 1.0),
            (dual.copysign(-dual), -1.0),
            (dual.round_ties_even(), 0.0),
            (dual * dual, 2.0 * x),
            (dual.mul_add(dual, dual), 2.0 * x + 1.0),
            (dual.lit(1.0) / dual, -1.0 / (x * x)),
            ((dual - 2.0) * 3.0 + 1.0, 3.0),
            (dual.max(dual.lit(1.0)), if x > 1.0 { 1.0 } else { 0.0 }),
            (dual.min(dual.lit(1.0)), if x > 1.0 { 0.0 } else { 1.0 }),
        ];
        for (i, (found, derivative)) in expected.into_iter().enumerate() {
            let error = (found.slopes[0] - derivative).abs();
            assert!(error <= 1e-14 * derivative.abs(), "function {i} at {x}: {error:e}");
        }
    }
}
