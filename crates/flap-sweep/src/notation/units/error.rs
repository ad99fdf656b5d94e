//! Mistakes in quantities.

use std::fmt;
use std::ops::Range;

/// A quantity that cannot be used, with the place of the mistake in its text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnitError {
    /// Bytes of the text at fault.
    pub span: Range<usize>,
    /// The mistake.
    pub problem: Problem,
}

/// A mistake in a quantity.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Problem {
    /// The text does not start with a number.
    NoNumber,
    /// The number is not one, such as `1e-3e`.
    BadNumber(String),
    /// The number is infinite or not a number.
    NotFinite(String),
    /// The number, as written, is beyond the largest 64-bit float.
    TooLarge(String),
    /// The number, as written, is not zero but too small for a 64-bit float.
    TooSmall(String),
    /// A number without a unit where there must be one.
    NoUnit {
        /// The SI unit wanted.
        wanted: String,
        /// Ways to write it.
        usual: Vec<String>,
    },
    /// There is no such unit.
    UnknownUnit {
        /// As written.
        unit: String,
        /// The unit that may have been meant.
        nearest: Option<String>,
        /// Ways to write the unit wanted; empty for a pure number.
        usual: Vec<String>,
    },
    /// The unit is not put together properly.
    BadUnit(&'static str),
    /// The unit wanted is not one of flap, and the unit as written is another.
    NotConverted {
        /// The unit as written.
        unit: String,
        /// The unit wanted.
        wanted: String,
    },
    /// The unit measures something else.
    Mismatch {
        /// The unit as written.
        unit: String,
        /// The quantity that it measures, such as `a time`.
        measures: String,
        /// The SI unit wanted; empty for a pure number.
        wanted: String,
        /// Ways to write it; empty for a pure number.
        usual: Vec<String>,
    },
}

impl UnitError {
    /// The message, with `what` as the name of the value.
    pub fn message(&self, what: &str) -> String {
        match &self.problem {
            Problem::NoNumber => format!("{what} must start with a number"),
            Problem::BadNumber(text) => format!("`{text}` is not a number"),
            Problem::NotFinite(text) => format!("{what} cannot be `{text}`: values are finite"),
            Problem::TooLarge(text) => format!("`{text}` is too large for {what} (largest about 1.8e308)"),
            Problem::TooSmall(text) => {
                format!("`{text}` is too small for {what} (smallest but zero about 4.9e-324)")
            }
            Problem::NoUnit { .. } => format!("{what} needs a unit"),
            Problem::UnknownUnit { unit, .. } => format!("unknown unit `{unit}`"),
            Problem::BadUnit(expected) => format!("malformed unit: expected {expected}"),
            Problem::NotConverted { unit, wanted } => {
                format!("`{unit}` cannot be converted into `{wanted}`, the unit of {what} in its model")
            }
            Problem::Mismatch { unit, measures, wanted, .. } => {
                let wanted =
                    if wanted.is_empty() { "a pure number".to_owned() } else { format!("in {wanted}") };
                format!("`{unit}` is {measures}, but {what} is {wanted}")
            }
        }
    }

    /// Advice, if there is any.
    pub fn help(&self) -> Option<String> {
        match &self.problem {
            Problem::NoNumber => {
                Some("write a bare number, or a number with its unit such as \"200 V\"".to_owned())
            }
            Problem::BadNumber(_) => {
                Some("numbers look like 12, 0.5 or 1.5e-6, with a space before the unit".to_owned())
            }
            Problem::NoUnit { wanted, usual } => {
                Some(format!("add a unit: {}; or write a bare number in {wanted}", usual.join(", ")))
            }
            Problem::UnknownUnit { nearest: Some(nearest), .. } => Some(format!("did you mean `{nearest}`?")),
            Problem::NotConverted { wanted, .. } => Some(format!("write the number in {wanted}")),
            Problem::BadUnit(_) => Some("units look like V, N*m/rad, mm^2 or kg/(m*s)".to_owned()),
            Problem::UnknownUnit { usual, .. } | Problem::Mismatch { usual, .. } if usual.is_empty() => {
                Some("write a bare number, or use %".to_owned())
            }
            Problem::UnknownUnit { usual, .. } | Problem::Mismatch { usual, .. } => {
                Some(format!("use {}", usual.join(", ")))
            }
            Problem::NotFinite(_) | Problem::TooLarge(_) | Problem::TooSmall(_) => None,
        }
    }
}

impl fmt::Display for UnitError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message("the value"))?;
        self.help().map_or(Ok(()), |help| write!(f, "; {help}"))
    }
}

impl std::error::Error for UnitError {}
