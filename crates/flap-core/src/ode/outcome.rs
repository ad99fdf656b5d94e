//! The end of a run.

use super::equation::Ode;
use super::start;

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
        let start = start::RHS_EVALS + u64::from(O::SWITCHES);
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
