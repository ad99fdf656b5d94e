//! Integration of motions together with their responses to small changes of the initial state.
//!
//! The step sizes depend on the errors of the states and of the responses. At a kink of a force, the
//! derivative of the force jumps, and the responses have larger errors than the states.
//!
//! The time derivatives of the responses to the initial state are forward differences of the right-hand side.
//! The differences use changes of about 1e-7 of the states' typical sizes. The errors of the time derivatives
//! are about 1e-7 times the second derivative of the right-hand side, plus rounding errors of about 1e-9. At
//! a jump of the right-hand side, the responses also jump, because a changed motion reaches the switching
//! surface earlier or later.

use super::{Ode, slope};
use crate::num::{Lanes, Real};

/// Size of the changes in the finite differences, relative to [`Start::change`](super::Start::change). The
/// errors of the finite differences, including rounding errors, are far below any tolerance.
const SMALL: f64 = 1e-7;

/// Typical size of a response, divided by the change of the initial state that causes the response.
///
/// By default, the absolute tolerance is a hundredth of the relative tolerance. With a typical size of 100,
/// the tolerance of a response near zero is the relative tolerance times the change of the initial state.
pub(super) const RESPONSE_SCALE: f64 = 100.0;

/// A quantity of a motion, and the same quantity of the motion's responses to D changes of the initial state.
/// D is the number of components of the state, or 0 for a motion without responses.
#[derive(Clone, Copy, Debug)]
pub(super) struct Varied<T, const D: usize> {
    pub(super) motion: T,
    pub(super) responses: [T; D],
}

impl<T> Varied<T, 0> {
    /// Returns the quantity `motion` of a motion whose responses are not computed.
    #[inline(always)]
    pub(super) fn alone(motion: T) -> Self {
        Varied { motion, responses: [] }
    }
}

/// Returns [`Ode::plain_rhs`] if `PLAIN` is true, and [`Ode::rhs`] otherwise.
#[inline(always)]
fn rhs<O: Ode<N>, R: Real, const PLAIN: bool, const N: usize>(
    ode: &O,
    c: &O::Constants<R>,
    u: &O::Input<R>,
    side: R,
    y: &[R; N],
) -> [R; N] {
    if PLAIN { ode.plain_rhs(c, u, side, y) } else { ode.rhs(c, u, side, y) }
}

/// Returns the time derivatives of the state and of its responses. [`Ode::plain_rhs`] computes these
/// derivatives if `PLAIN` is true, and [`Ode::rhs`] otherwise.
#[inline(always)]
pub(super) fn slopes<O: Ode<N>, R: Real, const PLAIN: bool, const N: usize, const D: usize>(
    ode: &O,
    c: &O::Constants<R>,
    u: &O::Input<R>,
    side: R,
    y: &Varied<[R; N], D>,
) -> Varied<[R; N], D> {
    if D == 0 {
        // Without this, the loop below would copy states.
        return Varied { motion: rhs::<O, R, PLAIN, N>(ode, c, u, side, &y.motion), responses: y.responses };
    }
    let mut out = *y;
    // A loop, so that the right-hand side is compiled once, as in a step.
    for i in 0..=D {
        let state = if i == 0 { y.motion } else { changed(&y.motion, &y.responses[i - 1]) };
        let slope = rhs::<O, R, PLAIN, N>(ode, c, u, side, &state);
        if i == 0 {
            out.motion = slope;
        } else {
            for j in 0..N {
                out.responses[i - 1][j] = (slope[j] - out.motion[j]) * (1.0 / SMALL);
            }
        }
    }
    out
}

/// Calls [`slopes`] without inlining, for the reason given at [`slope`].
#[inline(always)]
pub(super) fn slopes_outlined<O: Ode<N>, R: Real, const N: usize, const D: usize>(
    ode: &O,
    c: &O::Constants<R>,
    u: &O::Input<R>,
    side: R,
    y: &Varied<[R; N], D>,
) -> Varied<[R; N], D> {
    if O::HAS_PLAIN && ode.is_plain() {
        return side.outlined(
            #[inline(always)]
            || slopes::<O, R, true, N, D>(ode, c, u, side, y),
        );
    }
    side.outlined(
        #[inline(always)]
        || slopes::<O, R, false, N, D>(ode, c, u, side, y),
    )
}

/// Returns the state and its responses right after the motion has crossed the switching surface. `side` is
/// the new side of the motion.
///
/// A change w of the state changes the switching function by dg, and therefore the time of the crossing by
/// −dg/ġ. Between the old and the new time of the crossing, the changed motion has the time derivative on the
/// opposite side of the surface:
///
/// ```text
/// w⁺ = w + (f⁺ − f⁻) dg/ġ⁻
/// ```
#[inline(always)]
pub(super) fn crossed<O: Ode<N>, R: Lanes, const N: usize, const D: usize>(
    ode: &O,
    c: &O::Constants<R>,
    u: &O::Input<R>,
    side: R,
    y: &Varied<[R; N], D>,
) -> Varied<[R; N], D> {
    let mut out = *y;
    if D > 0 {
        let y = &y.motion;
        let [before, after] = [slope(ode, c, u, -side, y), slope(ode, c, u, side, y)];
        let [value, rate] = ode.switch(c, y, &before);
        for response in &mut out.responses {
            let [moved, _] = ode.switch(c, &changed(y, response), &before);
            let earlier = (moved - value) * (1.0 / SMALL) / rate;
            for j in 0..N {
                response[j] = response[j] + (after[j] - before[j]) * earlier;
            }
        }
    }
    out
}

/// Returns the state with a small change in the direction of a response.
#[inline(always)]
fn changed<R: Real, const N: usize>(y: &[R; N], response: &[R; N]) -> [R; N] {
    let mut out = *y;
    for j in 0..N {
        out[j] = response[j].mul_add(y[j].lit(SMALL), y[j]);
    }
    out
}
