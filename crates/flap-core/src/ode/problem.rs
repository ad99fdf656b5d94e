//! Types for an initial value problem: the equations, the start of a run, the tolerances, and the ending of a
//! run.

use crate::num::{Lanes, PerLane, Real};

/// A system of N first-order ordinary differential equations, ẏ = f(c, u(c, t), y).
///
/// `c` are constants, which may differ from run to run. `u` are inputs that depend on time alone. If two
/// stages of a step have the same time, the inputs are evaluated only once. The innermost loop of the
/// integration calls the functions for `u` and `f`. The functions for `u` and `f` must not allocate memory or
/// panic, and may only call functions that are `#[inline(always)]`.
pub trait Ode<const N: usize>: Sync {
    /// Constants of a run.
    type Constants<R: Real>: PerLane<R, One = Self::Constants<f64>>;

    /// Inputs of the equations that depend on time alone, such as the drive voltage.
    type Input<R: Real>: Copy;

    /// True if the right-hand side jumps where [`Ode::switch`] changes sign.
    ///
    /// A model whose right-hand side jumps sets `SWITCHES` to true and implements `switch`. If `SWITCHES` is
    /// false, `switch` is never called, and `side` is always +1.
    const SWITCHES: bool = false;

    /// Returns the inputs at time `t` (s).
    fn input<R: Real>(&self, c: &Self::Constants<R>, t: R) -> Self::Input<R>;

    /// Returns the derivative ẏ on one `side` of the surface on which [`Ode::switch`] is zero.
    ///
    /// `side` is the sign of `switch`, +1 or −1. In the equations, use `side` instead of the sign of
    /// `switch`. For example, a friction torque that opposes the velocity is `-friction * side`. `side` is
    /// constant within a step. The integrator changes `side` when the motion reaches the surface.
    fn rhs<R: Real>(&self, c: &Self::Constants<R>, u: &Self::Input<R>, side: R, y: &[R; N]) -> [R; N];

    /// True if [`Ode::is_plain`] returns true for some values of the type `Self`, which select different
    /// forms of the equations. The compiler then compiles the steps with [`Ode::plain_rhs`] separately from
    /// the steps with [`Ode::rhs`].
    const HAS_PLAIN: bool = false;

    /// Returns true if [`Ode::plain_rhs`] computes the derivative ẏ for the form of the equations that `self`
    /// selects.
    #[inline(always)]
    fn is_plain(&self) -> bool {
        false
    }

    /// Returns the derivative ẏ if [`Ode::is_plain`] is true. The result equals the result of [`Ode::rhs`] to
    /// the last bit. The function contains no terms that are needed only if `is_plain` is false, because more
    /// code would slow down the steps.
    #[inline(always)]
    fn plain_rhs<R: Real>(&self, c: &Self::Constants<R>, u: &Self::Input<R>, side: R, y: &[R; N]) -> [R; N] {
        self.rhs(c, u, side, y)
    }

    /// Returns the next time after `t` (s) at which the inputs are not smooth, for example at the edge of a
    /// square wave.
    ///
    /// The result is infinite if the inputs are smooth at all times after `t`. A step always ends at each
    /// time at which the inputs are not smooth.
    #[inline(always)]
    fn next_break<R: Real>(&self, c: &Self::Constants<R>, t: R) -> R {
        let _ = c;
        t.lit(f64::INFINITY)
    }

    /// Returns the switching function and its derivative with respect to time, at the state `y` with the
    /// derivative `dy`.
    ///
    /// The switching function must be continuous along a motion, but its derivative may jump. For a friction
    /// torque that opposes the velocity `y[1]`, return `[y[1], dy[1]]`.
    ///
    /// A motion that stays on the surface, such as a stroke that sticks due to friction, crosses the surface
    /// again and again in short steps. The row of a motion that stays on the surface has the status
    /// [`StepLimit`](crate::simulate::Status::StepLimit), or an infinite error estimate. A motion that begins
    /// on the surface, at rest and with a drive that begins at zero, also needs too many short steps. Instead
    /// of rest on the surface, choose an initial state with a small rate.
    #[inline(always)]
    fn switch<R: Real>(&self, c: &Self::Constants<R>, y: &[R; N], dy: &[R; N]) -> [R; 2] {
        let _ = (c, dy);
        [y[0].lit(1.0), y[0].lit(0.0)]
    }
}

/// Returns the inputs [`Ode::input`] at time `t`. The code is not inlined, for the reason given at [`slope`].
#[inline(always)]
pub(crate) fn input<O: Ode<N>, R: Lanes, const N: usize>(ode: &O, c: &O::Constants<R>, t: R) -> O::Input<R> {
    t.outlined(
        #[inline(always)]
        || ode.input(c, t),
    )
}

/// Returns the derivative [`Ode::rhs`].
///
/// The code is not inlined, because inlining a model's right-hand side into each stage of each step takes
/// minutes of compile time.
#[inline(always)]
pub(crate) fn slope<O: Ode<N>, R: Lanes, const N: usize>(
    ode: &O,
    c: &O::Constants<R>,
    u: &O::Input<R>,
    side: R,
    y: &[R; N],
) -> [R; N] {
    if O::HAS_PLAIN && ode.is_plain() {
        return side.outlined(
            #[inline(always)]
            || ode.plain_rhs(c, u, side, y),
        );
    }
    side.outlined(
        #[inline(always)]
        || ode.rhs(c, u, side, y),
    )
}

/// Start of a run.
#[derive(Clone, Copy, Debug)]
pub struct Start<C, const N: usize> {
    /// Constants of the run.
    pub constants: C,
    /// Initial state.
    pub y: [f64; N],
    /// Length of a time span (s).
    pub span: f64,
    /// Typical size of each component of the state. The absolute tolerances are multiples of the typical
    /// sizes.
    pub scale: [f64; N],
    /// Factor by which the relative and the absolute tolerance are multiplied. The factor is 1 for most runs,
    /// less than 1 for more accurate runs, and more than 1 for less accurate runs.
    pub tolerance_factor: f64,
    /// Size of the change of each component of the initial state, if the responses to these changes are
    /// integrated.
    pub change: [f64; N],
}

impl<C, const N: usize> Start<C, N> {
    /// Returns the start of a run with the tolerance factor 1.
    pub const fn new(constants: C, y: [f64; N], span: f64, scale: [f64; N]) -> Start<C, N> {
        Start { constants, y, span, scale, tolerance_factor: 1.0, change: scale }
    }

    /// Returns a copy of this start, but with the given `constants`.
    pub(crate) fn with<D>(&self, constants: D) -> Start<D, N> {
        let Start { y, span, scale, tolerance_factor, change, .. } = *self;
        Start { constants, y, span, scale, tolerance_factor, change }
    }
}

/// Tolerances of the integration, and the limit for the number of steps.
#[derive(Clone, Copy, Debug)]
pub struct Tolerances {
    /// Relative tolerance.
    pub rtol: f64,
    /// Absolute tolerance, in units of [`Start::scale`].
    ///
    /// `atol` must be more than zero. If `atol` is zero, a state of exactly zero has a tolerance of zero, and
    /// the run ends with [`Ending::Diverged`].
    pub atol: f64,
    /// Largest number of attempted steps within one time span.
    pub max_steps: u32,
}

impl Tolerances {
    /// Returns the absolute tolerances of a run, given its [`Start::tolerance_factor`] and the typical sizes
    /// `scale` of its states.
    pub(super) fn absolute<const N: usize>(&self, tolerance_factor: f64, scale: &[f64; N]) -> [f64; N] {
        let atol = self.atol * tolerance_factor;
        scale.map(|scale| atol * scale)
    }
}

/// Number of evaluations of the right-hand side for the choice of the first step size.
const START_RHS_EVALS: u64 = 2;

/// Number of steps within a time span between two calls of an [`Interrupt`], which are a few milliseconds
/// apart.
pub(crate) const INTERRUPT_STEPS: u32 = 4096;

/// Smallest step size, as a fraction of the time span. A run ends if its step size falls below this limit.
pub(crate) const MIN_STEP: f64 = 1e-14;

/// Largest factor by which a step may be lengthened so that it ends exactly at the end of the time span.
pub(crate) const STRETCH: f64 = 1.01;

/// Reason for the end of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// The caller stopped the run, at the end of a time span or by an [`Interrupt`].
    Stopped,
    /// The state or its derivative became infinite or not a number.
    Diverged,
    /// The run needed too many steps within one time span, or its step size became too small.
    StepLimit,
}

impl Ending {
    /// Returns the ending of a run that failed in a step with the given squared error.
    pub(crate) fn of_failure(error_squared: f64) -> Ending {
        if error_squared.is_finite() { Ending::StepLimit } else { Ending::Diverged }
    }
}

/// Reason for the end of a run, and the numbers of steps and evaluations of the run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Outcome {
    /// Reason for the end.
    pub ending: Ending,
    /// Number of attempted steps, including rejected steps.
    pub attempts: u64,
    /// Number of evaluations of the right-hand side. Each attempted step needs six evaluations, each crossing
    /// of the switching surface needs one, and the start needs two or three.
    pub rhs_evals: u64,
    /// Number of crossings of the switching surface.
    pub switches: u64,
}

impl Outcome {
    pub(crate) fn new<O: Ode<N>, const N: usize>(ending: Ending, attempts: u64, switches: u64) -> Outcome {
        // A switching system needs one more evaluation to choose the side on which a run begins.
        let start = START_RHS_EVALS + u64::from(O::SWITCHES);
        Outcome { ending, attempts, rhs_evals: start + 6 * attempts + switches, switches }
    }
}

/// Callback that returns true to end a run early.
///
/// The integrator calls the callback at the end of each time span, and after every few thousand steps within
/// a time span. After the callback has returned true once, it must always return true.
pub type Interrupt<'a> = &'a dyn Fn() -> bool;

/// An [`Interrupt`] that never ends a run.
pub fn never() -> bool {
    false
}
