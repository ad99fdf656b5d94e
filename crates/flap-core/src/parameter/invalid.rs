//! The error of parameters that are impossible.

use std::borrow::Cow;

use super::table::Range;
use crate::num::PerLane;

/// Parameters that are impossible, or a request that is.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Invalid {
    /// A value that the parameter's range excludes.
    #[error("{parameter} is {value}: not {}", allowed.describe())]
    OutOfRange {
        /// Name of the parameter.
        parameter: &'static str,
        /// Its value, in SI units.
        value: f64,
        /// The range.
        allowed: Range,
    },
    /// Parameters that are each within their range, but impossible together.
    #[error("{reason}")]
    Together {
        /// Names of the parameters.
        parameters: &'static [&'static str],
        /// The contradiction, in words that name the parameters.
        reason: Cow<'static, str>,
    },
    /// A constant that follows from the parameters is infinite or not a number.
    #[error("a derived constant is not finite: the parameters are too large or too small")]
    NotFinite,
    /// A request that cannot be met.
    #[error("{reason}")]
    Request {
        /// The reason in words.
        reason: String,
    },
}

impl Invalid {
    /// A request that cannot be met, for this reason.
    pub fn new(reason: impl Into<String>) -> Invalid {
        Invalid::Request { reason: reason.into() }
    }

    /// Parameters that are impossible together, for this reason.
    pub fn together(parameters: &'static [&'static str], reason: impl Into<Cow<'static, str>>) -> Invalid {
        Invalid::Together { parameters, reason: reason.into() }
    }

    /// The constants that follow from parameters, if they are all finite.
    ///
    /// # Errors
    /// [`Invalid::NotFinite`] if one of them is infinite or not a number.
    pub fn unless_finite<C: PerLane<f64, One = C>>(constants: C) -> Result<C, Invalid> {
        if C::is_finite(&constants) { Ok(constants) } else { Err(Invalid::NotFinite) }
    }

    /// Refuses a value that its range does not contain.
    ///
    /// # Errors
    /// [`Invalid::OutOfRange`] if the range does not contain the value.
    pub fn unless_within(parameter: &'static str, value: f64, allowed: Range) -> Result<(), Invalid> {
        if allowed.contains(value) { Ok(()) } else { Err(Invalid::OutOfRange { parameter, value, allowed }) }
    }
}
