//! The beginning of a run, its tolerances and its limits.

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
    /// tolerance of zero, and the run ends as [`Ending::Diverged`](super::Ending::Diverged).
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

/// Steps within a span between two questions to an [`Interrupt`]: a few milliseconds of work.
pub(crate) const INTERRUPT_STEPS: u32 = 4096;

/// The smallest step, as a fraction of the span, before a run counts as stuck.
pub(crate) const MIN_STEP: f64 = 1e-14;

/// A step this close to the end of the span is stretched to land on it.
pub(crate) const STRETCH: f64 = 1.01;
