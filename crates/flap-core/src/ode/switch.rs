//! Right-hand sides that jump where a switching function changes sign.
//!
//! The equations are integrated on one side of the surface at a time: the side stays fixed within a step, so
//! that every step sees a smooth right-hand side. When an accepted step ends on the other side, the crossing
//! is located on the cubic through the function's values and rates at both ends, and the step is taken again up
//! to the crossing. A step that lands more than a thousandth of an ordinary step from the surface is taken again, with the
//! size that Newton's step gives. There the side is changed, with a fresh first slope.
//!
//! Two crossings within one step leave the function's sign as it was. They are found where the function approaches zero at the
//! beginning of the step and departs from zero at its end, and the cubic has a minimum on the other side: the step is taken
//! again up to this minimum, beyond the first crossing.

use super::step::Step;
use super::variation::{Varied, crossed, slopes_outlined};
use super::{Ode, STRETCH, input, slope};
use crate::num::{Lanes, Real};

/// A step lands on the surface where it ends within this fraction of an ordinary step. The cubic mostly errs by far less.
const LANDED: f64 = 1e-3;

/// The most corrections of a step that lands beside the surface.
const CORRECTIONS: f64 = 3.0;

/// A step that no correction has brought nearer lands within this fraction all the same.
const REACHED: f64 = 1e-2;

/// The largest distance from the surface, as a fraction of an ordinary step, from which the size is corrected.
const NEAR: f64 = 0.1;

/// The smallest fraction of a step after which the function may have its minimum for two crossings within the step.
const EARLIEST: f64 = 1e-2;

/// The position of a run relative to its switching surface, remembered from step to step.
#[derive(Clone, Copy)]
pub(super) struct Switching<R: Lanes> {
    /// The side of the surface on which the right-hand side is evaluated: +1 or −1.
    pub(super) side: R,
    /// The switching function and its rate at the beginning of the step.
    pub(super) value: [R; 2],
    /// The step is being taken again, up to a crossing.
    pub(super) heading: R::Mask,
    /// The number of times that the size of that step has been corrected.
    pub(super) corrections: R,
    /// The step size to go on with after the crossing.
    pub(super) resume: R,
}

/// The judgement of an attempted step with regard to the surface.
#[derive(Clone, Copy)]
pub(super) struct Crossing<R: Lanes> {
    /// The step is accepted all the same.
    pub(super) accepted: R::Mask,
    /// The step size to go on with.
    pub(super) h: R,
    /// The step ends on the surface, where the side has changed: the first slope is to be renewed.
    pub(super) arrived: R::Mask,
}

impl<R: Lanes> Switching<R> {
    /// The memory of a run that begins at `y`, before its side is known.
    #[inline(always)]
    pub(super) fn new(like: R) -> Switching<R> {
        let zero = like.lit(0.0);
        let none = zero.lt(zero);
        Switching { side: like.lit(1.0), value: [zero; 2], heading: none, corrections: zero, resume: zero }
    }

    /// Chooses the side at the beginning of a run; on the surface, that to which the motion goes.
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

    /// Judges a step that the error control has `accepted` or not, and that goes on with step size `h_next`.
    #[inline(always)]
    pub(super) fn judge<O: Ode<N>, const N: usize>(
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
        // Right after a crossing the function is zero but for rounding, and the rate tells the side.
        let inward = begin_rate * self.side;
        let began_inside = zero.lt(inside_begin) | zero.lt(inward.mul_add(h * LANDED, inside_begin));
        // A step that leaves its side is taken again, up to the surface.
        let leaves = accepted & outside & began_inside & !self.heading;
        // So is one that lands beside it.
        let slack = end_rate.abs() * self.resume;
        let lands = inside_end.abs().lt(slack * LANDED);
        let beside = accepted
            & self.heading
            & self.corrections.lt(h.lit(CORRECTIONS))
            & !lands
            & inside_end.abs().lt(slack * NEAR);
        // Approaches and departs.
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
        // Arrived: on the way to the surface and there, or on the wrong side from the beginning.
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

/// The factor by which a step may be stretched to land on the end of its span: 1 on the way to a crossing.
#[inline(always)]
pub(super) fn landing_stretch<R: Lanes>(switching: &Switching<R>) -> R {
    let one = switching.side.lit(1.0);
    R::select(switching.heading, one, one.lit(STRETCH))
}

/// The size with which a step of size `h` ends on the surface, given the switching function and its rate at its end: Newton's
/// step.
#[inline(always)]
pub(super) fn landing_size<R: Real>(h: R, [value, rate]: [R; 2]) -> R {
    h - value / rate
}

/// The state and the first slope of a run that has arrived at its surface at time `t` (s), on its new `side`.
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

/// g₀ + d₀ θ + b θ² + a θ³: the switching function over the fraction θ of a step.
struct Cubic<R> {
    end: R,
    value: R,
    slope: R,
    a: R,
    b: R,
}

impl<R: Real> Cubic<R> {
    /// The cubic with values and slopes `[g, d]` at 0 and 1.
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

    /// The fraction of the step at which the cubic, times `side`, has its minimum. Not a number if it has none.
    #[inline(always)]
    fn minimum(&self, side: R) -> R {
        let Cubic { slope, a, b, .. } = self;
        -(*slope) / (*b + side * (*b * *b - *a * *slope * 3.0).sqrt())
    }

    /// The zero of a cubic that leaves `side`. Newton's iteration begins on the chord, or at the end where the cubic first goes
    /// away from zero: it may begin at zero.
    #[inline(always)]
    fn root(&self, side: R) -> R {
        let zero = side.lit(0.0);
        let end_slope = self.a * 3.0 + self.b * 2.0 + self.slope;
        // Where it departs from zero again at the end, the zero is before the minimum.
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
