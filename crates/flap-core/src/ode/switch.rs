//! Right-hand sides that jump where a switching function changes sign.
//!
//! The equations are integrated on one side of the surface at a time. The side is constant within a step, so every
//! step has a smooth right-hand side.
//!
//! If an accepted step ends on the other side, the crossing is located on a cubic through the function's values and
//! rates at both ends. The step is then repeated up to the crossing. If it ends more than a thousandth of an ordinary
//! step from the surface, it is repeated with the size from Newton's step. On the surface, the side is changed and
//! the first slope is computed again.
//!
//! Two crossings within one step leave the function's sign unchanged. The function then approaches zero at
//! the beginning of the step and departs from it at the end. If the cubic also has a minimum on the other side, the
//! step is repeated up to this minimum, beyond the first crossing.

use super::step::Step;
use super::variation::{Varied, crossed, slopes_outlined};
use super::{Ode, STRETCH, input, slope};
use crate::num::{Lanes, Real};

/// A step lands on the surface if it ends within this fraction of an ordinary step. The cubic's error is usually far
/// smaller.
const LANDED: f64 = 1e-3;

/// Largest number of corrections of a step that ends beside the surface.
const CORRECTIONS: f64 = 3.0;

/// Fraction within which a step also counts as landed, if corrections bring it no nearer.
const REACHED: f64 = 1e-2;

/// Largest distance from the surface, as a fraction of an ordinary step, at which the step size is corrected.
const NEAR: f64 = 0.1;

/// Smallest fraction of a step at which a minimum of the function indicates two crossings within the step.
const EARLIEST: f64 = 1e-2;

/// Position of a run relative to its switching surface, from step to step.
#[derive(Clone, Copy)]
pub(super) struct Switching<R: Lanes> {
    /// Side of the surface on which the right-hand side is evaluated: +1 or −1.
    pub(super) side: R,
    /// Switching function and its rate at the beginning of the step.
    pub(super) value: [R; 2],
    /// True if the step is being repeated up to a crossing.
    pub(super) heading: R::Mask,
    /// Number of corrections of the size of this step.
    pub(super) corrections: R,
    /// Step size after the crossing.
    pub(super) resume: R,
}

/// Decision on an attempted step near the surface.
#[derive(Clone, Copy)]
pub(super) struct Crossing<R: Lanes> {
    /// True if the step is accepted.
    pub(super) accepted: R::Mask,
    /// Next step size.
    pub(super) h: R,
    /// True if the step ends on the surface, where the side changes and the first slope must be computed again.
    pub(super) arrived: R::Mask,
}

impl<R: Lanes> Switching<R> {
    /// Returns the memory of a run before its side is determined.
    #[inline(always)]
    pub(super) fn new(like: R) -> Switching<R> {
        let zero = like.lit(0.0);
        let none = zero.lt(zero);
        Switching { side: like.lit(1.0), value: [zero; 2], heading: none, corrections: zero, resume: zero }
    }

    /// Returns the memory at the beginning of a run. On the surface, the side is the one that the motion enters.
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

    /// Returns the decision on a step. `accepted` is the result of the error control, `h_next` its next step size.
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

/// Returns the factor by which a step may be stretched to end with its span: 1 if a crossing is its target.
#[inline(always)]
pub(super) fn landing_stretch<R: Lanes>(switching: &Switching<R>) -> R {
    let one = switching.side.lit(1.0);
    R::select(switching.heading, one, one.lit(STRETCH))
}

/// Returns the size with which a step of size `h` ends on the surface, by Newton's step.
///
/// The arguments are the switching function and its rate at the end of the step.
#[inline(always)]
pub(super) fn landing_size<R: Real>(h: R, [value, rate]: [R; 2]) -> R {
    h - value / rate
}

/// Returns state and first slope of a run that has arrived at its surface at time `t` (s), on its new `side`.
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

/// The switching function over the fraction θ of a step: g₀ + d₀ θ + b θ² + a θ³.
struct Cubic<R> {
    end: R,
    value: R,
    slope: R,
    a: R,
    b: R,
}

impl<R: Real> Cubic<R> {
    /// Returns the cubic with values and slopes `[g, d]` at 0 and 1.
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

    /// Returns the fraction of the step at which the cubic, times `side`, has its minimum; NaN if there is none.
    #[inline(always)]
    fn minimum(&self, side: R) -> R {
        let Cubic { slope, a, b, .. } = self;
        -(*slope) / (*b + side * (*b * *b - *a * *slope * 3.0).sqrt())
    }

    /// Returns the zero of a cubic that leaves `side`.
    ///
    /// Newton's iteration begins on the chord. If the cubic begins at zero or departs from zero first, it begins at
    /// that end.
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
