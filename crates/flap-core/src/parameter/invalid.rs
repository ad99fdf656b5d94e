//! Error type for impossible parameters.

use std::borrow::Cow;

use super::table::Range;
use crate::num::PerLane;

/// Impossible parameters, or an impossible request.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Invalid {
    /// A value outside the allowed range of the parameter.
    #[error("{parameter} is {value}, but must be {}", allowed.describe())]
    OutOfRange {
        /// Name of the parameter.
        parameter: &'static str,
        /// Value of the parameter in SI units.
        value: f64,
        /// Allowed range.
        allowed: Range,
    },
    /// An impossible combination of parameters, each of which is within its range.
    #[error("{reason}")]
    Together {
        /// Names of the parameters.
        parameters: &'static [&'static str],
        /// Description of the contradiction, with the names of the parameters.
        reason: Cow<'static, str>,
    },
    /// A constant derived from the parameters is infinite or NaN.
    #[error("a constant derived from the parameters is not finite: parameters are too large or too small")]
    NotFinite,
    /// An impossible request.
    #[error("{reason}")]
    Request {
        /// Reason why the request is impossible.
        reason: String,
    },
}

impl Invalid {
    /// Returns the error for an impossible request, with the given reason.
    pub fn new(reason: impl Into<String>) -> Invalid {
        Invalid::Request { reason: reason.into() }
    }

    /// Returns the error for an impossible combination of parameters, with the given reason.
    pub fn together(parameters: &'static [&'static str], reason: impl Into<Cow<'static, str>>) -> Invalid {
        Invalid::Together { parameters, reason: reason.into() }
    }

    /// Returns `constants` if all constants are finite.
    ///
    /// # Errors
    /// [`Invalid::NotFinite`] if a constant is infinite or NaN.
    pub fn unless_finite<C: PerLane<f64, One = C>>(constants: C) -> Result<C, Invalid> {
        if C::is_finite(&constants) { Ok(constants) } else { Err(Invalid::NotFinite) }
    }

    /// Checks that `allowed` contains `value`.
    ///
    /// # Errors
    /// [`Invalid::OutOfRange`] if `value` is outside the range `allowed`.
    pub fn unless_within(parameter: &'static str, value: f64, allowed: Range) -> Result<(), Invalid> {
        if allowed.contains(value) { Ok(()) } else { Err(Invalid::OutOfRange { parameter, value, allowed }) }
    }
}
