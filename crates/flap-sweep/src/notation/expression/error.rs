//! Mistakes in expressions.

use std::fmt;
use std::ops::Range;

use super::evaluate;
use super::scope::Kind;
use crate::notation::{nearest, text};

/// A mistake in an expression, with its place in the text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExpressionError {
    /// Position of the bytes with the mistake in the text. The range is empty if the mistake is missing text.
    pub span: Range<usize>,
    /// Mistake.
    pub problem: ExpressionProblem,
}

const IS_CONDITION: &str = "this is a condition, not a number";
const IS_NUMBER: &str = "this is a number, not a condition";

/// A mistake in an expression.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ExpressionProblem {
    /// The text is empty.
    #[error("the expression is empty")]
    Empty,
    /// A character that has no meaning in expressions.
    #[error("`{}` is not allowed in an expression", .0.escape_debug())]
    Character(char),
    /// Text that begins like a number but is not a number, such as `2x`.
    #[error("`{0}` is not a number")]
    BadNumber(String),
    /// A number above the largest 64-bit float.
    #[error("the number is too large (largest about 1.8e308)")]
    TooLarge,
    /// Text without a closing quote.
    #[error("a closing quote is missing")]
    OpenQuote,
    /// The expression requires another element at this position.
    #[error("expected {0}")]
    Expected(&'static str),
    /// An operator of another language, with the operator of expressions to use instead.
    #[error("`{0}` is not an operator")]
    Foreign(&'static str, &'static str),
    /// A comparison of a comparison, such as `1 < x < 2`.
    #[error("comparisons cannot be chained")]
    Chain,
    /// A condition in place of a number, or a number in place of a condition. Contains the expected kind.
    #[error("{}", if *.0 == Kind::Number { IS_CONDITION } else { IS_NUMBER })]
    Mismatch(Kind),
    /// Parentheses and operators nested too deeply.
    #[error("the expression is nested too deeply")]
    TooDeep,
    /// An unknown name.
    #[error("unknown name `{name}`")]
    UnknownName {
        /// The name.
        name: String,
        /// The most similar known name.
        nearest: Option<String>,
    },
    /// An unknown function.
    #[error("there is no function `{0}`")]
    UnknownFunction(String),
    /// A function name without parentheses.
    #[error("`{0}` is a function")]
    BareFunction(String),
    /// A function with too few or too many arguments.
    #[error("`{name}` takes {takes}")]
    Arguments {
        /// Name of the function.
        name: String,
        /// Expected arguments, such as `one argument`.
        takes: &'static str,
    },
    /// A choice in place of a number.
    #[error("`{name}` is a choice between options, not a number")]
    ChoiceAsNumber {
        /// Name of the choice.
        name: String,
        /// First option of the choice.
        first: String,
    },
    /// A comparison of a choice with text that is not the name of an option of this choice.
    #[error("`{name}` has no option `{option}`")]
    UnknownOption {
        /// Name of the choice.
        name: String,
        /// Text with which the choice is compared.
        option: String,
        /// Options of the choice.
        options: Vec<String>,
    },
    /// A parameter that is not set and is computed from other parameters.
    #[error("`{name}` is not set")]
    Unset {
        /// Name of the parameter.
        name: String,
        /// Description of the parameters from which the value is computed.
        follows: &'static str,
    },
}

/// Returns the reason why an unset parameter has no number.
fn why_unset(follows: &str) -> String {
    text::no_default(follows).unwrap_or_else(|| format!("it follows other parameters ({follows})"))
}

impl ExpressionError {
    /// Returns the message.
    pub fn message(&self) -> String {
        self.problem.to_string()
    }

    /// Returns the allowed forms or advice, if there are allowed forms or advice for this mistake.
    pub fn help(&self) -> Option<String> {
        let did_you_mean = |name: &str| format!("did you mean `{name}`?");
        match &self.problem {
            ExpressionProblem::BadNumber(_) => {
                Some("numbers look like 12, 0.5 or 1.5e-6; products need a `*`".to_owned())
            }
            ExpressionProblem::Expected("an operator") => {
                Some("values are in SI units and written without them; products need a `*`".to_owned())
            }
            ExpressionProblem::Foreign(_, right) => Some(format!("write {right}")),
            ExpressionProblem::Chain => Some("join two comparisons: 1 < x and x < 2".to_owned()),
            ExpressionProblem::Mismatch(Kind::Condition) => {
                Some("conditions compare numbers with < <= > >= == or !=".to_owned())
            }
            ExpressionProblem::UnknownName { nearest, .. } => nearest.as_deref().map(did_you_mean),
            ExpressionProblem::UnknownFunction(name) if name == "log" => {
                Some("write ln for the natural logarithm, or log10".to_owned())
            }
            ExpressionProblem::UnknownFunction(name) => {
                let known: Vec<&str> = evaluate::names().collect();
                let listed = || format!("functions: {}", known.join(", "));
                Some(nearest(name, known.iter().copied()).map_or_else(listed, did_you_mean))
            }
            ExpressionProblem::BareFunction(name) => Some(format!("write {name}(…)")),
            ExpressionProblem::ChoiceAsNumber { name, first } => {
                Some(format!("compare it with an option: {name} == '{first}'"))
            }
            ExpressionProblem::UnknownOption { option, options, .. } => Some(
                nearest(option, options.iter().map(String::as_str))
                    .map_or_else(|| format!("options: {}", options.join(", ")), did_you_mean),
            ),
            ExpressionProblem::Unset { name, follows } if name.contains('.') => {
                Some(format!("{}, so that there is no number to use", why_unset(follows)))
            }
            ExpressionProblem::Unset { name, follows } => {
                Some(format!("{}: set `{name}` under [params] to use it here", why_unset(follows)))
            }
            _ => None,
        }
    }
}

impl fmt::Display for ExpressionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message())?;
        self.help().map_or(Ok(()), |help| write!(f, "; {help}"))
    }
}

impl std::error::Error for ExpressionError {}
