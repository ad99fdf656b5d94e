//! Error type for impossible parameters, requests and motions.

use super::table::Range;
use crate::num::PerLane;

/// Error for impossible parameters, for an impossible request, or for a motion that cannot be computed. The
/// error contains the reason as a text.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{0}")]
pub struct Invalid(String);

impl Invalid {
    /// Returns the error with the given reason.
    pub fn new(reason: impl Into<String>) -> Invalid {
        Invalid(reason.into())
    }

    /// Returns `constants` if all constants are finite.
    ///
    /// # Errors
    /// An error if a constant is infinite or NaN.
    pub fn unless_finite<C: PerLane<f64, One = C>>(constants: C) -> Result<C, Invalid> {
        if C::is_finite(&constants) {
            return Ok(constants);
        }
        Err(Invalid::new(
            "a constant derived from the parameters is not finite: parameters are too large or too small",
        ))
    }

    /// Checks that `allowed` contains `value`, the value of a parameter in SI units.
    ///
    /// # Errors
    /// An error if `value` is outside the range `allowed`.
    pub fn unless_within(parameter: &'static str, value: f64, allowed: Range) -> Result<(), Invalid> {
        if allowed.contains(value) {
            return Ok(());
        }
        Err(Invalid(format!("{parameter} is {value}, but must be {}", allowed.describe())))
    }
}
