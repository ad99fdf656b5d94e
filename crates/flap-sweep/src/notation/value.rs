//! Parses values of parameters from text, and checks the values against the range or the options of the
//! parameter.

use flap_core::parameter::{Kind, Parameter, Range};

use super::units::{self, UnitError};

/// Reason why a text or a number is not a valid value of a parameter.
#[derive(Clone, Debug, PartialEq)]
pub enum ValueError {
    /// The text is not the name of an option.
    NoOption {
        /// The text.
        text: String,
        /// Options of the parameter.
        options: Vec<String>,
    },
    /// The text is not a quantity with the parameter's dimension.
    NoQuantity(UnitError),
    /// The number is outside the parameter's range.
    OutOfRange {
        /// The number in SI units.
        value: f64,
        /// Range of the parameter.
        allowed: Range,
    },
}

impl ValueError {
    /// Returns the message about the parameter called `name`. If a number is out of range, the message
    /// contains the text `shown` of the number.
    pub fn message(&self, name: &str, shown: &str) -> String {
        match self {
            ValueError::NoOption { text, .. } => format!("`{name}` has no option `{text}`"),
            ValueError::NoQuantity(error) => error.message(&format!("`{name}`")),
            ValueError::OutOfRange { allowed, .. } => {
                format!("`{name}` must be {}, not {}", allowed.describe(), shown.trim_end())
            }
        }
    }

    /// Returns advice for the user, if there is advice for this mistake.
    pub fn help(&self) -> Option<String> {
        match self {
            ValueError::NoOption { options, .. } => Some(format!("options: {}", options.join(", "))),
            ValueError::NoQuantity(error) => error.help(),
            ValueError::OutOfRange { .. } => None,
        }
    }
}

/// Rule for the units of numbers in text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UnitOf<'a> {
    /// The text must contain a unit, unless the parameter is a pure number.
    Text,
    /// The text contains a unit, or is a number in SI units.
    TextOrSi,
    /// The text is a cell of a table, and contains a number without a unit. The variant contains the unit of
    /// the table's column.
    Column(&'a str),
}

/// Parses a value of `parameter` from `text`. The value is a number in SI units, or the index of an option.
///
/// # Errors
/// [`ValueError`] if the text names no option, does not have the parameter's dimension, or is out of range.
pub fn of_text(parameter: &Parameter, text: &str, unit: UnitOf<'_>) -> Result<f64, ValueError> {
    if let Kind::Choice(options) = parameter.kind {
        let index = options.iter().position(|option| *option == text);
        return index.map(|index| index as f64).ok_or_else(|| no_option(text, options));
    }
    let number = match unit {
        UnitOf::Text => units::parse_as(text, parameter.unit),
        UnitOf::TextOrSi => units::parse_or_si(text, parameter.unit),
        UnitOf::Column(unit) => units::parse_as(&format!("{text} {unit}"), parameter.unit),
    };
    of_number(parameter, number.map_err(ValueError::NoQuantity)?)
}

fn no_option(text: &str, options: &[&str]) -> ValueError {
    let options = options.iter().copied().map(str::to_owned).collect();
    ValueError::NoOption { text: text.to_owned(), options }
}

/// Returns `value` if it is allowed for `parameter`. The value is a number in SI units, or the index of an
/// option.
///
/// # Errors
/// [`ValueError::OutOfRange`] if the number is out of range, [`ValueError::NoOption`] if no option has this index.
pub fn of_number(parameter: &Parameter, value: f64) -> Result<f64, ValueError> {
    match parameter.kind {
        Kind::Number(allowed) | Kind::Following(allowed, _) if !allowed.contains(value) => {
            Err(ValueError::OutOfRange { value, allowed })
        }
        Kind::Choice(options) if !(0..options.len()).any(|index| index as f64 == value) => {
            Err(no_option(&value.to_string(), options))
        }
        Kind::Number(_) | Kind::Following(..) | Kind::Choice(_) => Ok(value),
    }
}
