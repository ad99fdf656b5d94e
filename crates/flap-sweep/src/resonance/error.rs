//! Reasons why no resonance is found.

use flap_core::parameter::Invalid;
use flap_core::simulate::Unfinished;

/// Reason why a search for resonances finds none.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SearchError {
    /// The tolerance (Hz) is not more than zero.
    #[error("the tolerance must be more than zero, not {0} Hz")]
    Tolerance(f64),
    /// The stroke is prescribed.
    #[error("stroke_mode is \"prescribed\": such a stroke is the same at every frequency, {0}")]
    Prescribed(&'static str),
    /// The model lacks a parameter or a measure.
    #[error("the model {0}")]
    Model(&'static str),
    /// The range has no frequencies.
    #[error(
        "there are no drive frequencies from {from} to {to} Hz: the first must be more than zero, and less than the last"
    )]
    Range {
        /// Lowest frequency (Hz).
        from: f64,
        /// Highest frequency (Hz).
        to: f64,
    },
    /// No motion of the design is periodic: the reason of one of them.
    #[error("{0}")]
    Design(String),
    /// The natural frequencies cannot be computed, or the search was interrupted.
    #[error(transparent)]
    Unfinished(#[from] Unfinished),
}

impl From<Invalid> for SearchError {
    fn from(invalid: Invalid) -> SearchError {
        SearchError::Unfinished(invalid.into())
    }
}
