//! The solution between the ends of a step: the fourth-order continuous extension of DOPRI5.

use super::step::Step;
use super::tableau::D;
use crate::num::Real;

/// The state at `t + theta h` with `theta` in [0, 1]; Hairer I, section II.6.
///
/// ```text
/// y(θ) = y₀ + θ (Δy + (1 − θ) (b + θ (Δy − h k₇ − b + (1 − θ) h Σ dᵢ kᵢ)))   with b = h k₁ − Δy
/// ```
#[inline(always)]
pub fn interpolate<R: Real, const N: usize>(step: &Step<R, N>, h: R, theta: R) -> [R; N] {
    let rest = -theta + 1.0;
    let mut out = step.y[0];
    for i in 0..N {
        let change = step.y[6][i] - step.y[0][i];
        let bend = h * step.k[0][i] - change;
        let mut fourth = step.k[0][i] * D[0];
        for s in 2..D.len() {
            fourth = step.k[s][i].mul_add(h.lit(D[s]), fourth);
        }
        let skew = change - h * step.k[6][i] - bend;
        let inner = theta.mul_add((rest * h).mul_add(fourth, skew), bend);
        out[i] = theta.mul_add(rest.mul_add(inner, change), step.y[0][i]);
    }
    out
}
