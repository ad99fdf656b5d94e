//! Error of impossible parameters.

use std::borrow::Cow;

use super::table::Range;
use crate::num::PerLane;

/// Impossible parameters, or an impossible request.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Invalid {
    /// A value outside the parameter's range.
    #[error("{parameter} is {value}, but must be {}", allowed.describe())]
    OutOfRange {
        /// Name of the parameter.
        parameter: &'static str,
        /// Its value, in SI units.
        value: f64,
        /// Allowed range.
        allowed: Range,
    },
    /// Parameters that are each within range, but an impossible combination.
    #[error("{reason}")]
    Together {
        /// Names of the parameters.
        parameters: &'static [&'static str],
        /// Contradiction, in words that name the parameters.
        reason: Cow<'static, str>,
    },
    /// A constant derived from the parameters is infinite or NaN.
    #[error("a constant derived from the parameters is not finite: parameters are too large or too small")]
    NotFinite,
    /// An impossible request.
    #[error("{reason}")]
    Request {
        /// Reason in words.
        reason: String,
    },
}

impl Invalid {
    /// Returns the error of an impossible request, with this reason.
    pub fn new(reason: impl Into<String>) -> Invalid {
        Invalid::Request { reason: reason.into() }
    }

    /// Returns the error of parameters that are impossible together, with this reason.
    pub fn together(parameters: &'static [&'static str], reason: impl Into<Cow<'static, str>>) -> Invalid {
        Invalid::Together { parameters, reason: reason.into() }
    }

    /// Returns `constants` if they are all finite.
    ///
    /// # Errors
    /// [`Invalid::NotFinite`] if one of them is infinite or NaN.
    pub fn unless_finite<C: PerLane<f64, One = C>>(constants: C) -> Result<C, Invalid> {
        if C::is_finite(&constants) { Ok(constants) } else { Err(Invalid::NotFinite) }
    }

    /// Checks that `allowed` contains `value`.
    ///
    /// # Errors
    /// [`Invalid::OutOfRange`] if it does not.
    pub fn unless_within(parameter: &'static str, value: f64, allowed: Range) -> Result<(), Invalid> {
        if allowed.contains(value) { Ok(()) } else { Err(Invalid::OutOfRange { parameter, value, allowed }) }
    }
}
