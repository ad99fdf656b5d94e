//! An initial value problem: the equations, the beginning of a run with its tolerances and limits, and its end.

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

    /// True if the right-hand side jumps where [`Ode::switch`] changes sign. A model with such a jump sets it and implements
    /// `switch`. If it is false, `switch` is never called, and `side` is always +1.
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
    /// Its row has the status [`StepLimit`](crate::simulate::Status::StepLimit), or an infinite error estimate. This includes
    /// a motion that begins on the surface, at rest with a drive that begins at zero: give the initial state a small rate.
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

/// The beginning of a run.
#[derive(Clone, Copy, Debug)]
pub struct Start<C, const N: usize> {
    /// The run's constants.
    pub constants: C,
    /// The initial state.
    pub y: [f64; N],
    /// Length of a span (s).
    pub span: f64,
    /// Typical size of each state; absolute tolerances are multiples of it.
    pub scale: [f64; N],
    /// Factor on both tolerances: 1 for most runs, less for one that is integrated more finely than others, more for one that
    /// is integrated more coarsely.
    pub tolerance_factor: f64,
    /// Size of the change of each state whose response is integrated, where responses are.
    pub change: [f64; N],
}

impl<C, const N: usize> Start<C, N> {
    /// A run with the tolerances that are asked for.
    pub const fn new(constants: C, y: [f64; N], span: f64, scale: [f64; N]) -> Start<C, N> {
        Start { constants, y, span, scale, tolerance_factor: 1.0, change: scale }
    }
}

/// Tolerances and limits.
#[derive(Clone, Copy, Debug)]
pub struct Tolerances {
    /// Relative tolerance.
    pub rtol: f64,
    /// Absolute tolerance, in units of [`Start::scale`]. It is more than zero: without it a state of exactly zero has a
    /// tolerance of zero, and the run ends as [`Ending::Diverged`].
    pub atol: f64,
    /// Attempted steps within one span after which a run is given up.
    pub max_steps: u32,
}

impl Tolerances {
    /// The absolute tolerances of a run with this [`Start::tolerance_factor`], given the sizes of its states.
    pub(super) fn absolute<const N: usize>(&self, tolerance_factor: f64, scale: &[f64; N]) -> [f64; N] {
        let atol = self.atol * tolerance_factor;
        scale.map(|scale| atol * scale)
    }
}

/// Right-hand sides evaluated to find the first step size.
const START_RHS_EVALS: u64 = 2;

/// Steps within a span between two questions to an [`Interrupt`]: a few milliseconds of work.
pub(crate) const INTERRUPT_STEPS: u32 = 4096;

/// The smallest step, as a fraction of the span, before a run counts as stuck.
pub(crate) const MIN_STEP: f64 = 1e-14;

/// A step this close to the end of the span is stretched to land on it.
pub(crate) const STRETCH: f64 = 1.01;

/// The reason for which a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// The caller stopped it, at the end of a span or by an [`Interrupt`].
    Stopped,
    /// The state or its derivative became infinite or not a number.
    Diverged,
    /// Too many steps within one span, or steps too small to advance time.
    StepLimit,
}

impl Ending {
    /// The ending of a run that failed in a step with this squared error.
    pub(crate) fn of_failure(error_squared: f64) -> Ending {
        if error_squared.is_finite() { Ending::StepLimit } else { Ending::Diverged }
    }
}

/// The ending of a run and its cost.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Outcome {
    /// The reason for which it ended.
    pub ending: Ending,
    /// Attempted steps, rejected ones included.
    pub attempts: u64,
    /// Evaluations of the right-hand side: six per attempted step, one per switch, and those of the start.
    pub rhs_evals: u64,
    /// Crossings of the switching surface.
    pub switches: u64,
}

impl Outcome {
    pub(crate) fn new<O: Ode<N>, const N: usize>(ending: Ending, attempts: u64, switches: u64) -> Outcome {
        // The side on which a run begins takes one more.
        let start = START_RHS_EVALS + u64::from(O::SWITCHES);
        Outcome { ending, attempts, rhs_evals: start + 6 * attempts + switches, switches }
    }
}

/// A question to the caller: true to end a run before it is done. It is asked at the end of each span, and every few
/// thousand steps within one. Once true, it must stay true.
pub type Interrupt<'a> = &'a dyn Fn() -> bool;

/// An [`Interrupt`] that never comes.
pub fn never() -> bool {
    false
}
