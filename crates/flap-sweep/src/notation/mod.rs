//! Numbers, units, times and formulas as text.

pub mod expression;
pub mod quantity;
pub mod text;
pub mod time;
pub mod units;
pub mod value;

pub use text::nearest;

/// A mistake of the user, with advice.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct UserError {
    /// Description of the mistake.
    pub message: String,
    /// Advice.
    pub help: Option<String>,
}
