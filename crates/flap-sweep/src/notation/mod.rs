//! Reads and writes numbers, units, times and formulas as text.

pub mod expression;
pub mod text;
pub mod time;
pub mod units;
pub mod value;

pub use text::nearest;

/// A message about a mistake of the user, with advice.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct UserError {
    /// Description of the mistake.
    pub message: String,
    /// Advice.
    pub help: Option<String>,
}

impl UserError {
    /// Returns an error with the given message. `help` is the advice, if there is advice.
    pub(crate) fn new(message: String, help: Option<&str>) -> UserError {
        UserError { message, help: help.map(str::to_owned) }
    }

    /// Returns the mistake and the advice in one line.
    pub fn line(&self) -> String {
        match &self.help {
            Some(help) => format!("{}: {help}", self.message),
            None => self.message.clone(),
        }
    }
}
