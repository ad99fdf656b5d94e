//! The design and the options from which an answer is computed, the flag that stops the computation, and the
//! reasons why an answer fails.

use std::sync::atomic::{AtomicBool, Ordering};

use flap_core::simulate::Unfinished;
use flap_sweep::run::{RunError, RunOptions};

use crate::opened::Opened;
use crate::request::Refused;

/// The design and the options of an answer, and the flag that stops the computation.
pub(crate) struct AnswerContext<'a> {
    pub(crate) opened: &'a Opened,
    pub(crate) options: RunOptions,
    /// The stop flag, which is set when the connection is closed.
    pub(crate) stop: &'a AtomicBool,
}

impl AnswerContext<'_> {
    /// Returns [`Refused::Cancelled`] if nobody waits for the answer.
    pub(super) fn check_wanted(&self) -> Result<(), Refused> {
        if self.stop.load(Ordering::Relaxed) { Err(Refused::Cancelled) } else { Ok(()) }
    }
}

/// Converts the error of a computation of rows into the reason why an answer fails.
impl From<RunError> for Refused {
    fn from(error: RunError) -> Refused {
        Refused::Fault(error.to_string())
    }
}

/// Returns the reason why a motion could not be computed.
pub(super) fn unfinished(reason: Unfinished) -> Refused {
    match reason {
        Unfinished::Interrupted => Refused::Cancelled,
        Unfinished::Invalid(reason) => Refused::impossible(reason.to_string()),
    }
}
