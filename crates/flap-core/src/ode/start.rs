//! Computation of the derivative ẏ at the beginning of a run, and of the first step size.

use super::norm::add_squares;
use super::variation::{Varied, slopes_outlined};
use super::{Ode, input};
use crate::num::Lanes;

/// Returns the derivative ẏ at time 0 and the first step size, by the algorithm of Hairer I, section II.4.
///
/// `atol` contains the absolute tolerances of states and of responses. The algorithm evaluates the right-hand
/// side twice. If the state or the derivative ẏ is very small, for example at rest, the trial step is a
/// ten-thousandth of the time span.
#[inline(always)]
pub(super) fn first_step<O: Ode<N>, R: Lanes, const N: usize, const D: usize>(
    ode: &O,
    c: &O::Constants<R>,
    side: R,
    y: &Varied<[R; N], D>,
    span: R,
    atol: [&[R; N]; 2],
    rtol: R,
) -> (Varied<[R; N], D>, R) {
    let zero = span.lit(0.0);
    let k1 = slopes_outlined(ode, c, &input(ode, c, zero), side, y);

    let size_y = weighted_norm(y, y, atol, rtol);
    let size_k = weighted_norm(&k1, y, atol, rtol);
    let tiny = zero.lit(1e-5);
    let unknown_y = size_y.lt(tiny);
    let unknown_k = size_k.lt(tiny);
    let trial = size_y / size_k * 0.01;
    let h0 = R::select(unknown_y, span * 1e-4, R::select(unknown_k, span * 1e-4, trial));
    let h0 = h0.min(span);

    // An explicit Euler step estimates the rate of change of the slope.
    let mut y1 = *y;
    for i in 0..N {
        y1.motion[i] = k1.motion[i].mul_add(h0, y.motion[i]);
        for j in 0..D {
            y1.responses[j][i] = k1.responses[j][i].mul_add(h0, y.responses[j][i]);
        }
    }
    let k_euler = slopes_outlined(ode, c, &input(ode, c, h0), side, &y1);
    let mut change = k1;
    for i in 0..N {
        change.motion[i] = k_euler.motion[i] - k1.motion[i];
        for j in 0..D {
            change.responses[j][i] = k_euler.responses[j][i] - k1.responses[j][i];
        }
    }
    let curvature = weighted_norm(&change, y, atol, rtol) / h0;

    // h1 = (0.01 / max(slope, curvature))^(1/5)
    let largest = size_k.max(curvature).max(zero.lit(1e-15));
    let h1 = ((largest.lit(0.01) / largest).ln_of_normal() * 0.2).exp_of_ordinary();
    (k1, (h0 * 100.0).min(h1).min(span))
}

/// Returns the root mean square of the components of `x`, each divided by its tolerance at the state `y`.
#[inline(always)]
fn weighted_norm<R: Lanes, const N: usize, const D: usize>(
    x: &Varied<[R; N], D>,
    y: &Varied<[R; N], D>,
    [atol, atol_of_responses]: [&[R; N]; 2],
    rtol: R,
) -> R {
    let mut sum = add_squares(rtol.lit(0.0), &x.motion, [&y.motion; 2], atol, rtol);
    for i in 0..D {
        sum = add_squares(sum, &x.responses[i], [&y.responses[i]; 2], atol_of_responses, rtol);
    }
    (sum * (1.0 / (N * (1 + D)) as f64)).sqrt()
}

/// Returns the first step size of the next time span. `last` is the first step size of the last time span,
/// and `proposed` is the step size that the controller proposes.
///
/// All time spans of a periodic motion should be integrated with the same steps. With equal steps, the states
/// at the ends of the time spans converge if the motion converges. If the steps differed, the states at the
/// ends of successive time spans would differ by the integration error. The result is therefore `last`,
/// unless `last` and `proposed` differ by a factor of two or more.
#[inline(always)]
pub(super) fn span_step(last: f64, proposed: f64) -> f64 {
    if 0.5 * last < proposed && proposed < 2.0 * last { last } else { proposed }
}
