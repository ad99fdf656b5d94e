//! Mistakes in expressions.

use std::fmt;
use std::ops::Range;

use super::function;
use super::scope::Kind;
use crate::notation::nearest;

/// A mistake in an expression, with its place in the text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExpressionError {
    /// Bytes of the text at fault. May be empty where something is missing.
    pub span: Range<usize>,
    /// The mistake.
    pub problem: Problem,
}

/// A mistake in an expression.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Problem {
    /// There is nothing.
    Empty,
    /// A character that means nothing.
    Character(char),
    /// A number that is not one, such as `2x`.
    BadNumber(String),
    /// A number beyond the largest 64-bit float.
    TooLarge,
    /// Text without the quote that ends it.
    OpenQuote,
    /// Something else should stand here.
    Expected(&'static str),
    /// An operator of other languages, with the one to write.
    Foreign(&'static str, &'static str),
    /// A comparison of a comparison, such as `1 < x < 2`.
    Chain,
    /// A condition where there must be a number, or the other way round.
    Mismatch {
        /// The kind that there must be.
        wanted: Kind,
    },
    /// Parentheses and operators nested too deeply.
    TooDeep,
    /// A name that stands for nothing.
    UnknownName {
        /// The name.
        name: String,
        /// The name that may have been meant.
        nearest: Option<String>,
    },
    /// A function that does not exist.
    UnknownFunction {
        /// The name.
        name: String,
    },
    /// A function without its parentheses.
    BareFunction(String),
    /// A function with too few or too many arguments.
    Arguments {
        /// The function.
        name: String,
        /// The arguments that it takes, such as `one argument`.
        takes: &'static str,
    },
    /// A choice where there must be a number.
    ChoiceAsNumber {
        /// The name.
        name: String,
        /// Its options.
        options: &'static [&'static str],
    },
    /// A comparison of a choice with text that is none of its options.
    UnknownOption {
        /// The name.
        name: String,
        /// The text that it is compared with.
        option: String,
        /// Its options.
        options: &'static [&'static str],
    },
    /// A number that is not set and follows others.
    Unset {
        /// The name.
        name: String,
        /// The others that it follows, in words.
        follows: &'static str,
    },
}

impl ExpressionError {
    /// The message.
    pub fn message(&self) -> String {
        match &self.problem {
            Problem::Empty => "the expression is empty".to_owned(),
            Problem::Character(character) => {
                format!("`{}` means nothing in an expression", character.escape_debug())
            }
            Problem::BadNumber(text) => format!("`{text}` is not a number"),
            Problem::TooLarge => "the number is too large for a 64-bit float".to_owned(),
            Problem::OpenQuote => "a closing quote is missing".to_owned(),
            Problem::Expected(what) => format!("expected {what}"),
            Problem::Foreign(written, _) => format!("`{written}` is not an operator"),
            Problem::Chain => "comparisons cannot be chained".to_owned(),
            Problem::Mismatch { wanted: Kind::Number } => "this is a condition, not a number".to_owned(),
            Problem::Mismatch { wanted: Kind::Condition } => "this is a number, not a condition".to_owned(),
            Problem::TooDeep => "the expression is nested too deeply".to_owned(),
            Problem::UnknownName { name, .. } => format!("unknown name `{name}`"),
            Problem::UnknownFunction { name } => format!("there is no function `{name}`"),
            Problem::BareFunction(name) => format!("`{name}` is a function"),
            Problem::Arguments { name, takes } => format!("`{name}` takes {takes}"),
            Problem::ChoiceAsNumber { name, .. } => {
                format!("`{name}` is a choice between options, not a number")
            }
            Problem::UnknownOption { name, option, .. } => format!("`{name}` has no option `{option}`"),
            Problem::Unset { name, .. } => format!("`{name}` has no value of its own"),
        }
    }

    /// Allowed forms or advice, if there are any.
    pub fn help(&self) -> Option<String> {
        let did_you_mean = |name: &str| format!("did you mean `{name}`?");
        match &self.problem {
            Problem::BadNumber(_) => {
                Some("numbers look like 12, 0.5 or 1.5e-6; products need a `*`".to_owned())
            }
            Problem::Expected("an operator") => {
                Some("values are in SI units and written without them; products need a `*`".to_owned())
            }
            Problem::Foreign(_, right) => Some(format!("write {right}")),
            Problem::Chain => Some("join two comparisons: 1 < x and x < 2".to_owned()),
            Problem::Mismatch { wanted: Kind::Condition } => {
                Some("conditions compare numbers with < <= > >= == or !=".to_owned())
            }
            Problem::UnknownName { nearest, .. } => nearest.as_deref().map(did_you_mean),
            Problem::UnknownFunction { name } if name == "log" => {
                Some("write ln for the natural logarithm, or log10".to_owned())
            }
            Problem::UnknownFunction { name } => {
                let known: Vec<&str> = function::names().collect();
                let listed = || format!("functions: {}", known.join(", "));
                Some(nearest(name, known.iter().copied()).map_or_else(listed, did_you_mean))
            }
            Problem::BareFunction(name) => Some(format!("write {name}(…)")),
            Problem::ChoiceAsNumber { name, options } => {
                let first = options.first().copied().unwrap_or_default();
                Some(format!("compare it with an option: {name} == '{first}'"))
            }
            Problem::UnknownOption { option, options, .. } => Some(
                nearest(option, options.iter().copied())
                    .map_or_else(|| format!("options: {}", options.join(", ")), did_you_mean),
            ),
            Problem::Unset { name, follows } if name.contains('.') => {
                Some(format!("it follows others ({follows}), so that there is no number to use"))
            }
            Problem::Unset { name, follows } => {
                Some(format!("it follows others ({follows}): set `{name}` under [params] to use it here"))
            }
            Problem::Empty
            | Problem::Character(_)
            | Problem::TooLarge
            | Problem::OpenQuote
            | Problem::Expected(_)
            | Problem::Mismatch { wanted: Kind::Number }
            | Problem::TooDeep
            | Problem::Arguments { .. } => None,
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
