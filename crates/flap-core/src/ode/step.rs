//! One step of the method: stages, new state, error estimate. No policy, no allocation.

use super::tableau::{A, C, E, STAGES};
use super::{Ode, input, slope};
use crate::num::Lanes;

/// What one attempted step found.
#[derive(Clone, Copy, Debug)]
pub struct Step<R, const N: usize> {
    /// State at each stage: the old state first, the new one last.
    pub y: [[R; N]; STAGES],
    /// Slope at each stage. The last is the first of the next step.
    pub k: [[R; N]; STAGES],
    /// Estimated error of the new state.
    pub error: [R; N],
}

/// An attempted step and where it is.
#[derive(Clone, Copy, Debug)]
pub struct Attempt<'a, R, const N: usize> {
    /// Time within the span at which the step begins (s).
    pub t: R,
    /// Its size (s).
    pub h: R,
    /// The side of the switching surface it is on.
    pub side: R,
    /// Its stages.
    pub step: &'a Step<R, N>,
}

/// Attempts a step of size `h` from `y` at `t`, where the slope is `k1`, on one `side` of a switching surface.
/// Evaluates six right-hand sides.
#[inline(always)]
pub fn step<O: Ode<N>, R: Lanes, const N: usize>(
    ode: &O,
    c: &O::Constants<R>,
    t: R,
    h: R,
    side: R,
    y: &[R; N],
    k1: &[R; N],
) -> Step<R, N> {
    let at = |stage: usize| h.mul_add(h.lit(C[stage]), t);

    // Written out stage by stage: as a loop it would index slopes at run time and keep them in memory.
    let y2 = combine(y, h, &[k1], &A[1]);
    let k2 = slope(ode, c, &input(ode, c, at(1)), side, &y2);
    let y3 = combine(y, h, &[k1, &k2], &A[2]);
    let k3 = slope(ode, c, &input(ode, c, at(2)), side, &y3);
    let y4 = combine(y, h, &[k1, &k2, &k3], &A[3]);
    let k4 = slope(ode, c, &input(ode, c, at(3)), side, &y4);
    let y5 = combine(y, h, &[k1, &k2, &k3, &k4], &A[4]);
    let k5 = slope(ode, c, &input(ode, c, at(4)), side, &y5);
    let y6 = combine(y, h, &[k1, &k2, &k3, &k4, &k5], &A[5]);
    // Stages 6 and 7 are both at the end of the step and share its inputs.
    let end = input(ode, c, at(5));
    let k6 = slope(ode, c, &end, side, &y6);
    let y7 = combine(y, h, &[k1, &k2, &k3, &k4, &k5, &k6], &A[6]);
    let k7 = slope(ode, c, &end, side, &y7);

    let zero = [h.lit(0.0); N];
    let error = combine(&zero, h, &[k1, &k2, &k3, &k4, &k5, &k6, &k7], &E);
    Step { y: [*y, y2, y3, y4, y5, y6, y7], k: [*k1, k2, k3, k4, k5, k6, k7], error }
}

/// y + h Σ wⱼ kⱼ, leaving out slopes of weight zero.
#[inline(always)]
fn combine<R: Lanes, const N: usize, const S: usize>(
    y: &[R; N],
    h: R,
    slopes: &[&[R; N]; S],
    weights: &[f64],
) -> [R; N] {
    let mut out = *y;
    for i in 0..N {
        let mut sum = slopes[0][i] * weights[0];
        for j in 1..S {
            if weights[j] != 0.0 {
                sum = slopes[j][i].mul_add(h.lit(weights[j]), sum);
            }
        }
        out[i] = sum.mul_add(h, y[i]);
    }
    out
}
