//! An initial value problem: equations, start of a run, tolerances and limits, and ending.

use crate::num::{Lanes, PerLane, Real};

/// A system of N first-order ordinary differential equations, ẏ = f(c, u(c, t), y).
///
/// `c` are constants, which may differ from run to run. `u` are inputs that depend on time alone. They are evaluated
/// once for stages at equal times. The innermost loop calls both functions: they must not allocate or panic, and
/// every function that they call must be `#[inline(always)]`.
pub trait Ode<const N: usize>: Sync {
    /// Constants of a run.
    type Constants<R: Real>: PerLane<R, One = Self::Constants<f64>>;

    /// Inputs that depend on time alone: the drive.
    type Input<R: Real>: Copy;

    /// True if the right-hand side jumps where [`Ode::switch`] changes sign.
    ///
    /// A model with such a jump sets it to true and implements `switch`. If it is false, `switch` is never called,
    /// and `side` is always +1.
    const SWITCHES: bool = false;

    /// Returns the inputs at time `t` (s).
    fn input<R: Real>(&self, c: &Self::Constants<R>, t: R) -> Self::Input<R>;

    /// Returns the derivative ẏ on one `side` of the surface on which [`Ode::switch`] is zero.
    ///
    /// `side` is the sign of `switch`, +1 or −1. Use it in the equations in place of this sign: a friction torque
    /// against the rate, for example, is `-friction * side`. The side is constant within a step; the integrator
    /// changes it on the surface.
    fn rhs<R: Real>(&self, c: &Self::Constants<R>, u: &Self::Input<R>, side: R, y: &[R; N]) -> [R; N];

    /// True if some variants are [plain](Ode::is_plain), so that the steps of plain variants are compiled separately.
    const HAS_PLAIN: bool = false;

    /// Returns true if [`Ode::plain_rhs`] is the derivative of this variant.
    #[inline(always)]
    fn is_plain(&self) -> bool {
        false
    }

    /// Returns the derivative of a plain variant, with the bits of [`Ode::rhs`] but without the code of other variants, which
    /// would slow down the steps.
    #[inline(always)]
    fn plain_rhs<R: Real>(&self, c: &Self::Constants<R>, u: &Self::Input<R>, side: R, y: &[R; N]) -> [R; N] {
        self.rhs(c, u, side, y)
    }

    /// Returns the next time after `t` (s) at which the inputs are not smooth, such as the edge of a square wave.
    ///
    /// Infinite if there is none. Steps end at these times.
    #[inline(always)]
    fn next_break<R: Real>(&self, c: &Self::Constants<R>, t: R) -> R {
        let _ = c;
        t.lit(f64::INFINITY)
    }

    /// Returns the switching function and its derivative with respect to time, at a state with derivative `dy`.
    ///
    /// The function is continuous along a motion; its derivative may jump. For a friction torque against the rate `y[1]`,
    /// return `[y[1], dy[1]]`.
    ///
    /// A motion that stays on the surface, such as a stroke that sticks due to friction, crosses it again and again
    /// in short steps. Its row has the status [`StepLimit`](crate::simulate::Status::StepLimit), or an infinite error
    /// estimate. The same happens if a motion begins on the surface, at rest with a drive that begins at zero. In
    /// this case, choose an initial state with a small rate.
    #[inline(always)]
    fn switch<R: Real>(&self, c: &Self::Constants<R>, y: &[R; N], dy: &[R; N]) -> [R; 2] {
        let _ = (c, dy);
        [y[0].lit(1.0), y[0].lit(0.0)]
    }
}

/// Returns the inputs [`Ode::input`] at time `t`. Kept out of line for the reason given at [`slope`].
#[inline(always)]
pub(crate) fn input<O: Ode<N>, R: Lanes, const N: usize>(ode: &O, c: &O::Constants<R>, t: R) -> O::Input<R> {
    t.outlined(
        #[inline(always)]
        || ode.input(c, t),
    )
}

/// Returns the derivative [`Ode::rhs`].
///
/// Kept out of line: inlining a model's right-hand side into each stage of each step takes minutes of compile time.
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
    /// Length of a span (s).
    pub span: f64,
    /// Typical size of each state. Absolute tolerances are multiples of it.
    pub scale: [f64; N],
    /// Factor on both tolerances: 1 for most runs, smaller for finer integration, larger for coarser integration.
    pub tolerance_factor: f64,
    /// Size of the change of each initial state, if responses are integrated.
    pub change: [f64; N],
}

impl<C, const N: usize> Start<C, N> {
    /// Returns a run with unscaled tolerances.
    pub const fn new(constants: C, y: [f64; N], span: f64, scale: [f64; N]) -> Start<C, N> {
        Start { constants, y, span, scale, tolerance_factor: 1.0, change: scale }
    }

    /// Returns the same run with other constants.
    pub(crate) fn with<D>(self, constants: D) -> Start<D, N> {
        let Start { y, span, scale, tolerance_factor, change, .. } = self;
        Start { constants, y, span, scale, tolerance_factor, change }
    }
}

/// Tolerances and limits.
#[derive(Clone, Copy, Debug)]
pub struct Tolerances {
    /// Relative tolerance.
    pub rtol: f64,
    /// Absolute tolerance, in units of [`Start::scale`].
    ///
    /// It must be more than zero. Otherwise a state of exactly zero has a tolerance of zero, and the run ends as
    /// [`Ending::Diverged`].
    pub atol: f64,
    /// Largest number of attempted steps within one span.
    pub max_steps: u32,
}

impl Tolerances {
    /// Returns the absolute tolerances of a run with this [`Start::tolerance_factor`] and these sizes of its states.
    pub(super) fn absolute<const N: usize>(&self, tolerance_factor: f64, scale: &[f64; N]) -> [f64; N] {
        let atol = self.atol * tolerance_factor;
        scale.map(|scale| atol * scale)
    }
}

/// Number of right-hand sides evaluated for the first step size.
const START_RHS_EVALS: u64 = 2;

/// Number of steps within a span between two calls of an [`Interrupt`]: a few milliseconds of work.
pub(crate) const INTERRUPT_STEPS: u32 = 4096;

/// Smallest step, as a fraction of the span. A smaller step ends the run.
pub(crate) const MIN_STEP: f64 = 1e-14;

/// Factor by which a step may be stretched to end exactly at the end of the span.
pub(crate) const STRETCH: f64 = 1.01;

/// Reason for the end of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// The caller stopped the run, at the end of a span or by an [`Interrupt`].
    Stopped,
    /// The state or its derivative became infinite or not a number.
    Diverged,
    /// Too many steps within one span, or steps too small to advance time.
    StepLimit,
}

impl Ending {
    /// Returns the ending of a run that failed in a step with this squared error.
    pub(crate) fn of_failure(error_squared: f64) -> Ending {
        if error_squared.is_finite() { Ending::StepLimit } else { Ending::Diverged }
    }
}

/// Ending and cost of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Outcome {
    /// Reason for the end.
    pub ending: Ending,
    /// Number of attempted steps, including rejected steps.
    pub attempts: u64,
    /// Number of evaluations of the right-hand side: six per attempted step, one per switch, and the evaluations of
    /// the start.
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
/// It is called at the end of each span, and every few thousand steps within one. After it has returned true, it must
/// always return true.
pub type Interrupt<'a> = &'a dyn Fn() -> bool;

/// An [`Interrupt`] that never ends a run.
pub fn never() -> bool {
    false
}
