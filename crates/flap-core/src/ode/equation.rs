//! A system of ordinary differential equations.

use crate::num::{Lanes, PerLane, Real};

/// A system of N first-order ordinary differential equations, ẏ = f(c, u(c, t), y).
///
/// `c` are constants, which may differ from run to run; `u` are inputs that depend on time alone, evaluated once where
/// stages share a time. Both functions are called in the innermost loop: they must not
/// allocate or panic, and every function they call must be `#[inline(always)]`.
pub trait Ode<const N: usize>: Sync {
    /// Constants of a run.
    type Constants<R: Real>: PerLane<R, One = Self::Constants<f64>>;

    /// Inputs that depend on time alone: the drive.
    type Input<R: Real>: Copy;

    /// True if the right-hand side jumps where [`Ode::switch`] changes sign. A model with such a jump sets it and implements `switch`.
    const SWITCHES: bool = false;

    /// The inputs at time `t` (s).
    fn input<R: Real>(&self, c: &Self::Constants<R>, t: R) -> Self::Input<R>;

    /// The derivative ẏ on one `side` of the surface on which [`Ode::switch`] is zero.
    ///
    /// `side` is the sign of `switch`, +1 or −1. Use it where the equations contain this sign: a friction torque against the
    /// rate, for example, is `-friction * side`. It stays fixed within a step, and the integrator changes it on the surface.
    fn rhs<R: Real>(&self, c: &Self::Constants<R>, u: &Self::Input<R>, side: R, y: &[R; N]) -> [R; N];

    /// The next time after `t` (s) at which the inputs are not smooth, such as the edge of a square wave; infinite if
    /// there is none. Steps end there.
    #[inline(always)]
    fn next_break<R: Real>(&self, c: &Self::Constants<R>, t: R) -> R {
        let _ = c;
        t.lit(f64::INFINITY)
    }

    /// The switching function and its derivative by time, at a state with derivative `dy`.
    ///
    /// The function is continuous along a motion; its derivative may jump. For a friction torque against the rate `y[1]`,
    /// return `[y[1], dy[1]]`.
    ///
    /// A motion that stays on the surface, such as a stroke that sticks by friction, crosses it again and again in short steps.
    /// Its row has the status [`StepLimit`](crate::simulate::Status::StepLimit), or an infinite error estimate.
    #[inline(always)]
    fn switch<R: Real>(&self, c: &Self::Constants<R>, y: &[R; N], dy: &[R; N]) -> [R; 2] {
        let _ = (c, dy);
        [y[0].lit(1.0), y[0].lit(0.0)]
    }
}

/// The inputs [`Ode::input`] at time `t`. Integrators call it here, for the same reason as [`slope`].
#[inline(always)]
pub(crate) fn input<O: Ode<N>, R: Lanes, const N: usize>(ode: &O, c: &O::Constants<R>, t: R) -> O::Input<R> {
    t.outlined(
        #[inline(always)]
        || ode.input(c, t),
    )
}

/// The derivative [`Ode::rhs`].
///
/// Integrators call it here, not there: inlined into each stage of each step, a model's right-hand side takes the
/// compiler minutes.
#[inline(always)]
pub(crate) fn slope<O: Ode<N>, R: Lanes, const N: usize>(
    ode: &O,
    c: &O::Constants<R>,
    u: &O::Input<R>,
    side: R,
    y: &[R; N],
) -> [R; N] {
    side.outlined(
        #[inline(always)]
        || ode.rhs(c, u, side, y),
    )
}
