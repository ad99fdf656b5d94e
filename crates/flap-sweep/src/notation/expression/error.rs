//! Mistakes in expressions.

use std::fmt;
use std::ops::Range;

use super::scope::Kind;

/// A mistake in an expression, with its position in the text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExpressionError {
    /// Byte range of the mistake in the text. The range is empty if text is missing at this position.
    pub span: Range<usize>,
    /// Kind of the mistake. For some kinds of mistakes, the caller replaces `help` by more specific
    /// advice.
    pub mistake: Mistake,
    /// Message.
    pub message: String,
    /// Advice for the user, such as a correct way to write the expression; `None` if there is no advice.
    pub help: Option<String>,
}

/// A kind of mistake in an expression.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Mistake {
    /// An unknown name.
    UnknownName(String),
    /// A choice is compared with something that is not in quotes, as in `arms == axis`.
    NotInQuotes,
    /// An operator is missing, as in `2 x`, or a text begins like a number but is not a number, as in `2x`.
    NoOperator,
    /// A condition is used as a number, or a number is used as a condition.
    Mismatch,
    /// A mistake that no other variant describes, for example an operator that is not allowed.
    Other,
}

impl ExpressionError {
    /// Returns an error of the kind [`Mistake::Other`] without advice.
    pub(super) fn new(span: Range<usize>, message: impl Into<String>) -> ExpressionError {
        ExpressionError { span, mistake: Mistake::Other, message: message.into(), help: None }
    }

    /// Returns the error for a number where a condition is expected, or for a condition where a number is
    /// expected. `wanted` is the expected type.
    pub fn mismatch(span: Range<usize>, wanted: Kind) -> ExpressionError {
        let (message, help) = match wanted {
            Kind::Number => ("this is a condition, not a number", None),
            Kind::Condition => (
                "this is a number, not a condition",
                Some("conditions compare numbers with < <= > >= == or !=".to_owned()),
            ),
        };
        ExpressionError { mistake: Mistake::Mismatch, help, ..ExpressionError::new(span, message) }
    }

    /// Returns this error with the advice `help`.
    pub(super) fn helps(self, help: impl Into<String>) -> ExpressionError {
        ExpressionError { help: Some(help.into()), ..self }
    }

    /// Returns this error with the kind `mistake`.
    pub(super) fn of(self, mistake: Mistake) -> ExpressionError {
        ExpressionError { mistake, ..self }
    }
}

impl fmt::Display for ExpressionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)?;
        self.help.as_ref().map_or(Ok(()), |help| write!(f, "; {help}"))
    }
}

impl std::error::Error for ExpressionError {}
