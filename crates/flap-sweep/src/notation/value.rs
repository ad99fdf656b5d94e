//! Values of parameters: read from text, and checked against the parameter's range or options.

use flap_core::parameter::{Kind, Parameter, Range};

use super::units::{self, UnitError};

/// A text or number that is not a value of a parameter.
#[derive(Clone, Debug, PartialEq)]
pub enum ValueError {
    /// The text names none of the options.
    NoOption {
        /// The text.
        text: String,
        /// The options of the parameter.
        options: &'static [&'static str],
    },
    /// The text is not a quantity of the parameter's dimension.
    NoQuantity(UnitError),
    /// The number is out of the parameter's range.
    OutOfRange {
        /// The number in SI units.
        value: f64,
        /// The range of the parameter.
        allowed: Range,
    },
}

impl ValueError {
    /// The message about the parameter called `name`, which shows a number that is out of range as `shown`.
    pub fn message(&self, name: &str, shown: &str) -> String {
        match self {
            ValueError::NoOption { text, .. } => format!("`{name}` has no option `{text}`"),
            ValueError::NoQuantity(error) => error.message(&format!("`{name}`")),
            ValueError::OutOfRange { allowed, .. } => {
                format!("`{name}` must be {}, not {}", allowed.describe(), shown.trim_end())
            }
        }
    }

    /// The line on what to do, if there is one.
    pub fn help(&self) -> Option<String> {
        match self {
            ValueError::NoOption { options, .. } => Some(format!("options: {}", options.join(", "))),
            ValueError::NoQuantity(error) => error.help(),
            ValueError::OutOfRange { .. } => None,
        }
    }
}

/// The unit of numbers in a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UnitOf<'a> {
    /// The text has the unit, unless the parameter is a pure number.
    Text,
    /// The text has the unit, or is a bare number in SI units.
    TextOrSi,
    /// The text has no unit: it is this one.
    Column(&'a str),
}

/// The value of `parameter` that `text` says: a number in SI units, or the index of an option.
///
/// # Errors
/// [`ValueError`] if the text names no option, is not a quantity of the parameter's dimension, or is out of range.
pub fn of_text(parameter: &Parameter, text: &str, unit: UnitOf<'_>) -> Result<f64, ValueError> {
    if let Kind::Choice(options) = parameter.kind {
        let index = options.iter().position(|option| *option == text);
        let error = || ValueError::NoOption { text: text.to_owned(), options };
        return index.map(|index| index as f64).ok_or_else(error);
    }
    let number = match unit {
        UnitOf::Text => units::parse_as(text, parameter.unit),
        UnitOf::TextOrSi => units::parse_as(text, "").or_else(|_| units::parse_as(text, parameter.unit)),
        UnitOf::Column(unit) => units::parse_as(&format!("{text} {unit}"), parameter.unit),
    };
    of_number(parameter, number.map_err(ValueError::NoQuantity)?)
}

/// The number itself, if `parameter` takes it: a number in SI units, or the index of an option.
///
/// # Errors
/// [`ValueError::OutOfRange`] if the number is out of range, [`ValueError::NoOption`] if it is the index of no option.
pub fn of_number(parameter: &Parameter, value: f64) -> Result<f64, ValueError> {
    match parameter.kind {
        Kind::Number(allowed) | Kind::Following(allowed, _) if !allowed.contains(value) => {
            Err(ValueError::OutOfRange { value, allowed })
        }
        Kind::Choice(options) if !(0..options.len()).any(|index| index as f64 == value) => {
            Err(ValueError::NoOption { text: value.to_string(), options })
        }
        Kind::Number(_) | Kind::Following(..) | Kind::Choice(_) => Ok(value),
    }
}
