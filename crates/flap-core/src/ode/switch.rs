//! Right-hand sides that jump where a switching function changes sign.
//!
//! The equations are integrated on one side of the surface at a time: the side stays fixed within a step, so
//! that every step sees a smooth right-hand side. When an accepted step ends on the other side, the crossing
//! is located on the cubic through the function's values and rates at both ends, the step is taken again up
//! to the crossing, and the side is changed there, with a fresh first slope.

use super::step::Step;
use super::{Ode, STRETCH, input, slope};
use crate::num::{Lanes, Real};

/// A crossing counts as reached when it is less than this fraction of an ordinary step away. The cubic errs by
/// far less: this only catches crossings that it could not find.
const REACHED: f64 = 1e-2;

/// The position of a run relative to its switching surface, remembered from step to step.
#[derive(Clone, Copy)]
pub struct Switching<R: Lanes> {
    /// The side of the surface on which the right-hand side is evaluated: +1 or −1.
    pub side: R,
    /// The switching function and its rate at the beginning of the step.
    pub value: [R; 2],
    /// The step is being taken again, up to a crossing.
    pub heading: R::Mask,
    /// The step size to go on with after the crossing.
    pub resume: R,
}

/// The judgement of an attempted step with regard to the surface.
#[derive(Clone, Copy)]
pub struct Crossing<R: Lanes> {
    /// The step is accepted all the same.
    pub accepted: R::Mask,
    /// The step size to go on with.
    pub h: R,
    /// The step ends on the surface, where the side has changed: the first slope is to be renewed.
    pub arrived: R::Mask,
}

impl<R: Lanes> Switching<R> {
    /// The memory of a run that begins at `y`, before its side is known.
    #[inline(always)]
    pub fn new(like: R) -> Switching<R> {
        let zero = like.lit(0.0);
        Switching { side: like.lit(1.0), value: [zero; 2], heading: zero.lt(zero), resume: zero }
    }

    /// Chooses the side at the beginning of a run; on the surface, that to which the motion goes.
    #[inline(always)]
    pub fn begin<O: Ode<N>, const N: usize>(ode: &O, c: &O::Constants<R>, y: &[R; N]) -> Switching<R> {
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
    pub fn judge<O: Ode<N>, const N: usize>(
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

        let outside = (end * self.side).lt(zero);
        let began_inside = zero.lt(begin * self.side);
        // A step that leaves its side is taken again, up to the surface.
        let leaves = accepted & outside & began_inside & !self.heading;
        let theta = hermite_root(begin, begin_rate * h, end, end_rate * h);
        // Arrived: on the way to the surface and there, or on the wrong side from the beginning.
        let near = (end * self.side).lt(end_rate.abs() * self.resume * REACHED);
        let stray = outside & !began_inside & !self.heading;
        let kept = accepted & !leaves;
        let arrived = kept & ((self.heading & near) | stray);

        let resumed = R::select(kept & self.heading, h_next.max(self.resume), h_next);
        let crossing = Crossing { accepted: kept, h: R::select(leaves, theta * h, resumed), arrived };
        self.resume = R::select(leaves, h_next, self.resume);
        self.heading = leaves;
        self.side = R::select(arrived, -self.side, self.side);
        self.value = [R::select(kept, end, begin), R::select(kept, end_rate, begin_rate)];
        crossing
    }
}

/// The factor by which a step may be stretched to land on the end of its span: 1 on the way to a crossing.
#[inline(always)]
pub fn landing_stretch<R: Lanes>(switching: &Switching<R>) -> R {
    let one = switching.side.lit(1.0);
    R::select(switching.heading, one, one.lit(STRETCH))
}

/// The zero in [0, 1] of the cubic with values `g0`, `g1` of opposite sign and slopes `d0`, `d1` at 0 and 1.
#[inline(always)]
fn hermite_root<R: Real>(g0: R, d0: R, g1: R, d1: R) -> R {
    // g0 + d0 θ + b θ² + a θ³
    let a = (g0 - g1) * 2.0 + d0 + d1;
    let b = (g1 - g0) * 3.0 - d0 * 2.0 - d1;
    let mut theta = g0 / (g0 - g1);
    for _ in 0..4 {
        let value = theta.mul_add(theta.mul_add(theta.mul_add(a, b), d0), g0);
        let slope = theta.mul_add(theta.mul_add(a * 3.0, b * 2.0), d0);
        theta = theta - value / slope;
        theta = theta.max(theta.lit(1e-3)).min(theta.lit(1.0));
    }
    theta
}
