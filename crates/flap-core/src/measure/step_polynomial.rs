//! Interpolation of a signal within an integration step, from five values of the signal.

use crate::num::Real;

/// A signal within an integration step or within a part of an integration step. The fields are five
/// equidistant values, and the quartic polynomial through these values.
pub(super) struct StepPolynomial<R> {
    values: [R; 5],
    /// Coefficients a to d of the polynomial m + a x + b x² + c x³ + d x⁴. m is the middle value of the
    /// signal, and x is from −2 to 2.
    polynomial: [R; 4],
}

impl<R: Real> StepPolynomial<R> {
    #[inline(always)]
    pub(super) fn through(values: [R; 5]) -> StepPolynomial<R> {
        let [f0, f1, f2, f3, f4] = values;
        // Odd and even parts, and their differences.
        let (odd_1, odd_2) = ((f3 - f1) * 0.5, (f4 - f0) * 0.5);
        let (even_1, even_2) = ((f3 + f1) * 0.5 - f2, (f4 + f0) * 0.5 - f2);
        let polynomial = [
            (odd_1 * 8.0 - odd_2) * (1.0 / 6.0),
            (even_1 * 16.0 - even_2) * (1.0 / 12.0),
            (odd_2 - odd_1 * 2.0) * (1.0 / 6.0),
            (even_2 - even_1 * 4.0) * (1.0 / 12.0),
        ];
        StepPolynomial { values, polynomial }
    }

    /// Returns the value of the polynomial at x.
    #[inline(always)]
    fn at(&self, x: R) -> R {
        let [a, b, c, d] = self.polynomial;
        x.mul_add(x.mul_add(x.mul_add(x.mul_add(d, c), b), a), self.values[2])
    }

    /// Returns the smallest and the largest value of the polynomial. The function compares the values at the
    /// five given points and at two stationary points.
    ///
    /// The stationary points are the vertices of two parabolas, one in each half of the step. The error of
    /// the value of an extremum is proportional to the square of the error of its position.
    #[inline(always)]
    pub(super) fn extrema(&self) -> [Extremum<R>; 2] {
        let [first, second] = self.halves();
        let [first, second] = [first.vertex(), second.vertex()];
        let [f0, f1, f2, f3, f4] = self.values;
        let x = f0.lit(1.0);
        let [mut min, mut max] = [Extremum { value: f0, place: x * -2.0 }; 2];
        for (value, place) in [
            (f1, -x),
            (f2, x * 0.0),
            (f3, x),
            (f4, x * 2.0),
            (self.at(first), first),
            (self.at(second), second),
        ] {
            let other = Extremum { value, place };
            min = min.or_smaller(other);
            max = max.or_larger(other);
        }
        [min, max]
    }

    /// Returns the mean of the positive part of the signal.
    #[inline(always)]
    pub(super) fn positive_mean(&self) -> R {
        let [first, second] = self.halves();
        (first.positive_mean() + second.positive_mean()) * 0.5
    }

    #[inline(always)]
    fn halves(&self) -> [Parabola<R>; 2] {
        let [f0, f1, f2, f3, f4] = self.values;
        [Parabola::through(-1.0, f0, f1, f2), Parabola::through(1.0, f2, f3, f4)]
    }
}

/// An extremum of a signal: its value and its position. The position is a value of the polynomial's variable
/// x, or a fraction of the step.
#[derive(Clone, Copy)]
pub(super) struct Extremum<R> {
    pub(super) value: R,
    pub(super) place: R,
}

impl<R: Real> Extremum<R> {
    /// Returns the extremum with its position converted to a fraction of the step. The polynomial covers the
    /// fraction `share` of the step, and the centre of the polynomial is at the fraction `middle`.
    #[inline(always)]
    pub(super) fn within(self, middle: f64, share: f64) -> Extremum<R> {
        Extremum { place: self.place * (0.25 * share) + middle, ..self }
    }

    /// Returns `self` or `other`: the extremum with the smaller value. The result is `other` if the two
    /// values are equal or if one value is NaN.
    #[inline(always)]
    pub(super) fn or_smaller(self, other: Extremum<R>) -> Extremum<R> {
        let place = R::select(self.value.lt(other.value), self.place, other.place);
        Extremum { value: self.value.min(other.value), place }
    }

    /// Returns `self` or `other`: the extremum with the larger value. The result is `other` if the two values
    /// are equal or if one value is NaN.
    #[inline(always)]
    pub(super) fn or_larger(self, other: Extremum<R>) -> Extremum<R> {
        let place = R::select(other.value.lt(self.value), self.place, other.place);
        Extremum { value: self.value.max(other.value), place }
    }
}

/// A parabola through three values of a signal: middle + slope x + ½ curvature x², with x from −1 to 1.
#[derive(Clone, Copy)]
struct Parabola<R> {
    /// Value of the polynomial's variable x (from −2 to 2) at the middle of the parabola.
    centre: f64,
    middle: R,
    slope: R,
    curvature: R,
}

impl<R: Real> Parabola<R> {
    #[inline(always)]
    fn through(centre: f64, begin: R, middle: R, end: R) -> Parabola<R> {
        Parabola { centre, middle, slope: (end - begin) * 0.5, curvature: begin + end - middle * 2.0 }
    }

    /// Returns the position of the parabola's vertex, as a value of the polynomial's variable x. If the
    /// vertex lies outside the parabola's interval, the result is the middle of the interval.
    #[inline(always)]
    fn vertex(&self) -> R {
        let inside = self.slope.abs().lt(self.curvature.abs());
        let zero = self.slope.lit(0.0);
        let curvature = R::select(inside, self.curvature, self.curvature.lit(1.0));
        R::select(inside, -self.slope / curvature, zero) + self.centre
    }

    /// Returns the mean of the positive part of the signal.
    #[inline(always)]
    fn positive_mean(&self) -> R {
        let Parabola { middle, slope, curvature, .. } = *self;
        let (zero, one) = (middle.lit(0.0), middle.lit(1.0));
        let discriminant = slope * slope - curvature * middle * 2.0;
        // Roots without cancellation. Without real roots, both are the vertex. For a straight line the first root is
        // infinite.
        let q = -(slope + discriminant.max(zero).sqrt().copysign(slope));
        let first = q / curvature;
        let second = R::select(discriminant.lt(zero), first, middle * 2.0 / q);
        let (first, second) = (first.max(-one).min(one), second.max(-one).min(one));
        let between = self.antiderivative(first.max(second)) - self.antiderivative(first.min(second));
        let all = middle * 2.0 + curvature * (1.0 / 3.0);
        let opens_upwards = zero.lt(one.copysign(curvature));
        R::select(opens_upwards, all - between, between) * 0.5
    }

    #[inline(always)]
    fn antiderivative(&self, x: R) -> R {
        x * x.mul_add(x.mul_add(self.curvature * (1.0 / 6.0), self.slope * 0.5), self.middle)
    }
}
