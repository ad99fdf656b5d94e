//! One step of the integration method: stages, new state, error estimate. The code contains no step-size
//! control and does not allocate memory.

use super::Ode;
use super::tableau::{self, A, B, C, E, STAGES};
use super::variation::{Varied, slopes, slopes_outlined};
use crate::num::Real;

/// A step of the integration: its initial state, and the results of the last attempt to compute the step.
#[derive(Clone, Copy, Debug)]
pub struct Step<R, const N: usize> {
    /// State at each stage. The first state is the state at the beginning of the step, and the last state is
    /// the state at the end.
    pub y: [[R; N]; STAGES],
    /// Slope at each stage. The slope at the last stage is also the slope at the first stage of the next
    /// step.
    pub k: [[R; N]; STAGES],
    /// Estimated error of the new state.
    pub error: [R; N],
}

/// An attempted step and its position in time.
#[derive(Clone, Copy, Debug)]
pub struct Attempt<'a, R, const N: usize> {
    /// Time from the beginning of the time span to the beginning of the step (s).
    pub t: R,
    /// Step size (s).
    pub h: R,
    /// Side of the switching surface on which the step lies: +1 or −1.
    pub side: R,
    /// Stages of the step.
    pub step: &'a Step<R, N>,
}

impl<R: Real, const N: usize> Attempt<'_, R, N> {
    /// Returns the time integral of quantities over the step, by the quadrature weights of the integration
    /// method. `value` returns the quantities, given the index of a stage and the time of this stage.
    #[inline(always)]
    pub fn integral<const M: usize>(&self, value: impl Fn(usize, R) -> [R; M]) -> [R; M] {
        let Attempt { t, h, .. } = *self;
        let mut sums = [h.lit(0.0); M];
        // Stages 2 and 7 have weight zero.
        for stage in [0, 2, 3, 4, 5] {
            let values = value(stage, h.mul_add(h.lit(C[stage]), t));
            for i in 0..M {
                sums[i] = values[i].mul_add(h * B[stage], sums[i]);
            }
        }
        sums
    }
}

impl<R: Real, const N: usize> Step<R, N> {
    /// Returns a step that begins at the state `y` with the slope `k1`, before the first attempt.
    #[inline(always)]
    pub fn new(y: [R; N], k1: [R; N]) -> Step<R, N> {
        Step { y: [y; STAGES], k: [k1; STAGES], error: y }
    }

    /// Attempts the step with size `h` from time `t`, on one `side` of a switching surface. An attempt
    /// evaluates the right-hand side six times.
    #[inline(always)]
    pub fn attempt<O: Ode<N>>(&mut self, ode: &O, c: &O::Constants<R>, t: R, h: R, side: R) {
        self.attempt_with(&mut [], ode, c, t, h, side);
    }

    /// Attempts the step for the state and for its `responses`, as [`Step::attempt`] does for the state
    /// alone.
    #[inline(always)]
    pub(super) fn attempt_with<O: Ode<N>, const D: usize>(
        &mut self,
        responses: &mut [Step<R, N>; D],
        ode: &O,
        c: &O::Constants<R>,
        t: R,
        h: R,
        side: R,
    ) {
        if O::HAS_PLAIN && ode.is_plain() {
            self.stages::<O, true, D>(responses, ode, c, t, h, side);
        } else if O::HAS_PLAIN {
            // Out of line, so that this code does not slow down the steps of plain variants.
            h.outlined(
                #[inline(always)]
                || self.stages::<O, false, D>(responses, ode, c, t, h, side),
            );
        } else {
            self.stages::<O, false, D>(responses, ode, c, t, h, side);
        }
    }

    /// Computes the stages and the error of the step.
    #[inline(always)]
    fn stages<O: Ode<N>, const PLAIN: bool, const D: usize>(
        &mut self,
        responses: &mut [Step<R, N>; D],
        ode: &O,
        c: &O::Constants<R>,
        t: R,
        h: R,
        side: R,
    ) {
        // The inputs of different stages are independent of each other, so they are computed together. For inputs of
        // many numbers, this would also compute numbers that the right-hand side does not use. Stages 6 and 7 share
        // their time, the end of the step.
        let ahead = size_of::<O::Input<R>>() <= AHEAD * size_of::<R>();
        let mut inputs = [ode.input(c, h.mul_add(h.lit(C[1]), t)); STAGES - 2];
        if ahead {
            for i in 1..STAGES - 2 {
                inputs[i] = ode.input(c, h.mul_add(h.lit(C[i + 1]), t));
            }
        }
        // A loop, so that the right-hand side is compiled once. Six copies take minutes to compile and are not
        // faster.
        let mut last = Varied { motion: self.k[0], responses: [self.k[0]; D] };
        for i in 0..D {
            last.responses[i] = responses[i].k[0];
        }
        for stage in 1..STAGES {
            let mut y = last;
            y.motion = self.state(stage, h, &last.motion);
            for i in 0..D {
                y.responses[i] = responses[i].state(stage, h, &last.responses[i]);
            }
            let at = if ahead { stage.min(STAGES - 2) - 1 } else { 0 };
            if !ahead && stage > 1 && C[stage] != C[stage - 1] {
                inputs[0] = ode.input(c, h.mul_add(h.lit(C[stage]), t));
            }
            last = if O::HAS_PLAIN && !PLAIN {
                // Out of line, so that the terms of other variants are compiled once.
                slopes_outlined(ode, c, &inputs[at], side, &y)
            } else {
                slopes::<O, R, PLAIN, N, D>(ode, c, &inputs[at], side, &y)
            };
            (self.y[stage], self.k[stage]) = (y.motion, last.motion);
            for i in 0..D {
                (responses[i].y[stage], responses[i].k[stage]) = (y.responses[i], last.responses[i]);
            }
        }
        let zero = [h.lit(0.0); N];
        self.error = combine(&zero, h, &self.k, &E, STAGES);
        for response in responses {
            response.error = combine(&zero, h, &response.k, &E, STAGES);
        }
    }

    /// Returns the state at a stage, given the slope at the previous stage.
    #[inline(always)]
    fn state(&self, stage: usize, h: R, last: &[R; N]) -> [R; N] {
        let mut y = combine(&self.y[0], h, &self.k, &A[stage], stage - 1);
        // The last slope is added last, because the other terms are ready before it.
        let weight = h * A[stage][stage - 1];
        for i in 0..N {
            y[i] = last[i].mul_add(weight, y[i]);
        }
        y
    }

    /// Returns the state at the fraction `theta` of the step, by the fourth-order continuous extension of DOPRI5
    /// (Hairer I, section II.6). The step has the size `h`.
    ///
    /// ```text
    /// y(θ) = y₀ + θ (Δy + (1 − θ) (b + θ (Δy − h k₇ − b + (1 − θ) h Σ dᵢ kᵢ)))   with b = h k₁ − Δy
    /// ```
    #[inline(always)]
    pub fn interpolate(&self, h: R, theta: R) -> [R; N] {
        let Step { y, k, .. } = self;
        let rest = -theta + 1.0;
        let mut out = y[0];
        for i in 0..N {
            let change = y[6][i] - y[0][i];
            let bend = h * k[0][i] - change;
            let mut fourth = k[0][i] * tableau::D[0];
            for s in 2..STAGES {
                fourth = k[s][i].mul_add(h.lit(tableau::D[s]), fourth);
            }
            let skew = change - h * k[6][i] - bend;
            let inner = theta.mul_add((rest * h).mul_add(fourth, skew), bend);
            out[i] = theta.mul_add(rest.mul_add(inner, change), y[0][i]);
        }
        out
    }

    /// Replaces the initial state by the state at the end of the step, in the lanes in which the step was
    /// `accepted`.
    #[inline(always)]
    pub(crate) fn advance(&mut self, accepted: R::Mask) {
        for i in 0..N {
            self.y[0][i] = R::select(accepted, self.y[STAGES - 1][i], self.y[0][i]);
            self.k[0][i] = R::select(accepted, self.k[STAGES - 1][i], self.k[0][i]);
        }
    }
}

/// Largest number of input values for which the inputs of all stages of a step are computed together.
const AHEAD: usize = 3;

/// Number of state components that are summed together, so that the sums stay in registers.
const BLOCK: usize = 4;

/// Returns y + h Σ wⱼ kⱼ, where the sum contains the first `count` slopes kⱼ.
#[inline(always)]
fn combine<R: Real, const N: usize, const W: usize>(
    y: &[R; N],
    h: R,
    k: &[[R; N]; STAGES],
    weights: &[f64; W],
    count: usize,
) -> [R; N] {
    let mut out = *y;
    let whole = N / BLOCK * BLOCK;
    for first in (0..whole).step_by(BLOCK) {
        add::<R, N, W, BLOCK>(&mut out, h, k, weights, count, first);
    }
    for one in whole..N {
        add::<R, N, W, 1>(&mut out, h, k, weights, count, one);
    }
    out
}

/// Adds h Σ wⱼ kⱼ to `SIZE` components of `y`, starting with the component `first`.
#[inline(always)]
fn add<R: Real, const N: usize, const W: usize, const SIZE: usize>(
    y: &mut [R; N],
    h: R,
    k: &[[R; N]; STAGES],
    weights: &[f64; W],
    count: usize,
    first: usize,
) {
    let mut sum = [h.lit(0.0); SIZE];
    for j in 0..W {
        if j == count {
            break;
        }
        if weights[j] == 0.0 {
            continue;
        }
        let weight = h.lit(weights[j]);
        for i in 0..SIZE {
            sum[i] = k[j][first + i].mul_add(weight, sum[i]);
        }
    }
    for i in 0..SIZE {
        y[first + i] = sum[i].mul_add(h, y[first + i]);
    }
}
