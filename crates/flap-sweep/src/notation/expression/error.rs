//! Mistakes in expressions.

use std::fmt;
use std::ops::Range;

use super::scope::Kind;

/// A mistake in an expression, with its place in the text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExpressionError {
    /// Position of the bytes with the mistake in the text. The range is empty if the mistake is missing text.
    pub span: Range<usize>,
    /// Kind of the mistake, for callers with more specific advice.
    pub mistake: Mistake,
    /// Message.
    pub message: String,
    /// Allowed forms or advice, if there are allowed forms or advice for this mistake.
    pub help: Option<String>,
}

/// A kind of mistake in an expression.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Mistake {
    /// An unknown name.
    UnknownName(String),
    /// A choice is compared with an element that is not a text in quotes.
    NotInQuotes,
    /// Another element in place of an operator, or text that begins like a number but is not a number, such as `2x`.
    NoOperator,
    /// A condition in place of a number, or a number in place of a condition.
    Mismatch,
    /// A mistake of another kind.
    Other,
}

impl ExpressionError {
    /// Returns a mistake of the kind [`Mistake::Other`] without help.
    pub(super) fn new(span: Range<usize>, message: impl Into<String>) -> ExpressionError {
        ExpressionError { span, mistake: Mistake::Other, message: message.into(), help: None }
    }

    /// Returns the mistake of an expression that is not of the kind `wanted`.
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

    /// Returns the mistake with the help text `help`.
    pub(super) fn helps(self, help: impl Into<String>) -> ExpressionError {
        ExpressionError { help: Some(help.into()), ..self }
    }

    /// Returns an error of this kind with the given mistake.
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
