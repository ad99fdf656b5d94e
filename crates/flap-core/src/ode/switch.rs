//! Integration of equations whose right-hand side jumps where a switching function changes sign.
//!
//! The switching function is zero on the switching surface. The equations are integrated on one side of this
//! surface at a time. The side is constant within a step, so every step has a smooth right-hand side.
//!
//! If an accepted step ends on the opposite side of the surface, the integrator computes the crossing from a
//! cubic polynomial. The polynomial has the values and the rates of the switching function at the two ends of
//! the step. The integrator then computes the step again, with a step size that ends at the crossing. If this
//! step ends more than a thousandth of an ordinary step away from the surface, Newton's method corrects the
//! step size again. When a step ends on the surface, the integrator changes the side, and computes the
//! derivative ẏ at the beginning of the next step again.
//!
//! Two crossings within one step do not change the sign of the switching function at the end of the step. The
//! switching function then moves towards zero at the beginning of the step, and away from zero at the end. If
//! the minimum of the cubic polynomial lies on the opposite side of the surface, the integrator computes the
//! step again up to this minimum.

use super::step::Step;
use super::variation::{Varied, crossed, slopes_outlined};
use super::{Ode, STRETCH, input, slope};
use crate::num::{Lanes, Real};

/// If the time between the end of a step and the crossing is below this limit, the step counts as ending on
/// the surface. The limit is a fraction of an ordinary step size. The error of the cubic polynomial is
/// usually far smaller than this limit.
const LANDED: f64 = 1e-3;

/// Largest number of corrections of the step size for a step that ends near the surface, but not on the
/// surface.
const CORRECTIONS: f64 = 3.0;

/// After the last correction of the step size, this limit replaces the limit [`LANDED`].
const REACHED: f64 = 1e-2;

/// The step size is corrected only if the time between the end of the step and the crossing is below this
/// limit. The limit is a fraction of an ordinary step size.
const NEAR: f64 = 0.1;

/// A minimum of the switching function indicates two crossings within a step only if the minimum lies after
/// this fraction of the step.
const EARLIEST: f64 = 1e-2;

/// Values about a run and its switching surface that are kept from one step to the next.
#[derive(Clone, Copy)]
pub(super) struct Switching<R: Lanes> {
    /// Side of the surface on which the right-hand side is evaluated: +1 or −1.
    pub(super) side: R,
    /// Value and rate of the switching function at the beginning of the step.
    pub(super) value: [R; 2],
    /// True if the integrator computes the step again, with a step size that ends at a crossing.
    pub(super) heading: R::Mask,
    /// Number of times that the size of the current step has been corrected.
    pub(super) corrections: R,
    /// Step size with which the run continues after the crossing.
    pub(super) resume: R,
}

/// Decision on an attempted step near the switching surface.
#[derive(Clone, Copy)]
pub(super) struct Crossing<R: Lanes> {
    /// True if the step is accepted.
    pub(super) accepted: R::Mask,
    /// Next step size.
    pub(super) h: R,
    /// True if the step ends on the switching surface. When a step ends on the surface, the side changes, and
    /// the derivative ẏ at the beginning of the next step must be computed again.
    pub(super) arrived: R::Mask,
}

impl<R: Lanes> Switching<R> {
    /// Returns the initial values for a run, before the integrator has determined the side of the run.
    #[inline(always)]
    pub(super) fn new(like: R) -> Switching<R> {
        let zero = like.lit(0.0);
        let none = zero.lt(zero);
        Switching { side: like.lit(1.0), value: [zero; 2], heading: none, corrections: zero, resume: zero }
    }

    /// Returns the side, and the value and the rate of the switching function, at the beginning of a run. If
    /// a run begins on the switching surface, its side is the side that the motion enters.
    #[inline(always)]
    pub(super) fn begin<O: Ode<N>, const N: usize>(ode: &O, c: &O::Constants<R>, y: &[R; N]) -> Switching<R> {
        let mut memory = Switching::new(y[0]);
        if O::SWITCHES {
            let zero = y[0].lit(0.0);
            let k = slope(ode, c, &input(ode, c, zero), memory.side, y);
            let [value, rate] = ode.switch(c, y, &k);
            let off_surface = zero.lt(value.abs());
            memory.side = memory.side.copysign(R::select(off_surface, value, rate));
        }
        memory
    }

    /// Returns the decision on a step. `accepted` is the decision of the step-size controller, and `h_next`
    /// is the next step size that the controller proposes.
    #[inline(always)]
    pub(super) fn decide<O: Ode<N>, const N: usize>(
        &mut self,
        ode: &O,
        c: &O::Constants<R>,
        tried: &Step<R, N>,
        h: R,
        accepted: R::Mask,
        h_next: R,
    ) -> Crossing<R> {
        let zero = h.lit(0.0);
        let [begin, begin_rate] = self.value;
        let [end, end_rate] = ode.switch(c, &tried.y[6], &tried.k[6]);

        let (inside_begin, inside_end) = (begin * self.side, end * self.side);
        let outside = inside_end.lt(zero);
        // Right after a crossing the function is zero except for rounding, so the sign of the rate decides.
        let inward = begin_rate * self.side;
        let began_inside = zero.lt(inside_begin) | zero.lt(inward.mul_add(h * LANDED, inside_begin));
        // A step that leaves its side is repeated up to the surface.
        let leaves = accepted & outside & began_inside & !self.heading;
        // A step that ends beside the surface is repeated too.
        let slack = end_rate.abs() * self.resume;
        let lands = inside_end.abs().lt(slack * LANDED);
        let beside = accepted
            & self.heading
            & self.corrections.lt(h.lit(CORRECTIONS))
            & !lands
            & inside_end.abs().lt(slack * NEAR);
        // The function approaches zero, then departs from it.
        let turns = accepted & !outside & !self.heading & inward.lt(zero) & zero.lt(end_rate * self.side);
        let heading = leaves | beside;
        let mut again = heading;
        let mut size = h;
        if R::bits(heading | turns) != 0 {
            let cubic = Cubic::new([begin, begin_rate * h], [end, end_rate * h]);
            let bottom = cubic.minimum(self.side);
            let dips = turns & (cubic.at(bottom) * self.side).lt(zero) & bottom.lit(EARLIEST).lt(bottom);
            let on_surface = landing_size(h, [end, end_rate]).max(h * 0.5).min(h * 2.0);
            size = R::select(leaves, cubic.root(self.side) * h, size);
            size = R::select(beside, on_surface, size);
            size = R::select(dips, bottom * h, size);
            again = heading | dips;
        }
        // Arrived: on the surface after a repeated step, or on the wrong side from the beginning.
        let near = inside_end.lt(slack * REACHED);
        let stray = outside & !began_inside & !self.heading;
        let kept = accepted & !again;
        let arrived = kept & ((self.heading & near) | stray);

        let resumed = R::select(kept & self.heading, h_next.max(self.resume), h_next);
        let crossing = Crossing { accepted: kept, h: R::select(again, size, resumed), arrived };
        self.resume = R::select(leaves, h_next, self.resume);
        self.corrections = R::select(beside, self.corrections + 1.0, zero);
        self.heading = heading;
        self.side = R::select(arrived, -self.side, self.side);
        self.value = [R::select(kept, end, begin), R::select(kept, end_rate, begin_rate)];
        crossing
    }
}

/// Returns the largest factor by which a step may be lengthened so that it ends at the end of the time span.
/// The factor is 1 if the step is repeated up to a crossing.
#[inline(always)]
pub(super) fn landing_stretch<R: Lanes>(switching: &Switching<R>) -> R {
    let one = switching.side.lit(1.0);
    R::select(switching.heading, one, one.lit(STRETCH))
}

/// Returns the step size with which a step ends on the switching surface, by one Newton step from the step
/// size `h`.
///
/// `value` and `rate` are the switching function and its rate at the end of the step with the size `h`.
#[inline(always)]
pub(super) fn landing_size<R: Real>(h: R, [value, rate]: [R; 2]) -> R {
    h - value / rate
}

/// Returns the state of a run that has reached its switching surface at time `t` (s), and the derivative ẏ on
/// the new side. `side` is the new side of the run.
#[inline(always)]
pub(super) fn cross<O: Ode<N>, R: Lanes, const N: usize, const D: usize>(
    ode: &O,
    c: &O::Constants<R>,
    t: R,
    side: R,
    y: &Varied<[R; N], D>,
) -> [Varied<[R; N], D>; 2] {
    let u = input(ode, c, t);
    let y = crossed(ode, c, &u, side, y);
    [y, slopes_outlined(ode, c, &u, side, &y)]
}

/// Cubic polynomial for the switching function at the fraction θ of a step: g₀ + d₀ θ + b θ² + a θ³.
struct Cubic<R> {
    end: R,
    value: R,
    slope: R,
    a: R,
    b: R,
}

impl<R: Real> Cubic<R> {
    /// Returns the cubic polynomial with the given values and slopes `[g, d]` at θ = 0 and θ = 1.
    #[inline(always)]
    fn new([g0, d0]: [R; 2], [g1, d1]: [R; 2]) -> Cubic<R> {
        let a = (g0 - g1) * 2.0 + d0 + d1;
        let b = (g1 - g0) * 3.0 - d0 * 2.0 - d1;
        Cubic { end: g1, value: g0, slope: d0, a, b }
    }

    #[inline(always)]
    fn at(&self, theta: R) -> R {
        theta.mul_add(theta.mul_add(theta.mul_add(self.a, self.b), self.slope), self.value)
    }

    /// Returns the fraction of the step at which the cubic polynomial, times `side`, has its minimum. The
    /// result is NaN if the polynomial has no minimum.
    #[inline(always)]
    fn minimum(&self, side: R) -> R {
        let Cubic { slope, a, b, .. } = self;
        -(*slope) / (*b + side * (*b * *b - *a * *slope * 3.0).sqrt())
    }

    /// Returns the zero of a cubic polynomial that has the sign `side` at the beginning of the step, and
    /// reaches the opposite sign.
    ///
    /// Newton's iteration usually begins at the zero of a straight line through two points of the polynomial.
    /// If the polynomial moves away from zero at the beginning of the step, Newton's iteration begins at the
    /// end of the step.
    #[inline(always)]
    fn root(&self, side: R) -> R {
        let zero = side.lit(0.0);
        let end_slope = self.a * 3.0 + self.b * 2.0 + self.slope;
        // If the cubic also departs from zero at the end, the zero is before the minimum.
        let departs = zero.lt(end_slope * side);
        let one = side.lit(1.0);
        let bottom = self.minimum(side);
        let [far, value] = [R::select(departs, bottom, one), R::select(departs, self.at(bottom), self.end)];
        let chord = self.value / (self.value - value) * far;
        let mut theta = R::select(zero.lt(self.slope * side) & !departs, one, chord);
        for _ in 0..4 {
            let slope = theta.mul_add(theta.mul_add(self.a * 3.0, self.b * 2.0), self.slope);
            theta = theta - self.at(theta) / slope;
            theta = theta.max(theta.lit(1e-3)).min(far);
        }
        theta
    }
}
