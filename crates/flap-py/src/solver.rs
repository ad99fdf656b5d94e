//! Solver settings from keywords.

use flap_core::simulate::SolverSettings;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::convert;

/// The keywords, in the order of the signature.
pub(crate) const NAMES: [&str; 5] = ["rtol", "atol", "settle_tol", "max_cycles", "max_steps"];

/// Looser than this, an error estimate means nothing.
const LARGEST_RTOL: f64 = 0.1;

/// The solver settings that a call gives.
pub(crate) struct Keywords<'a, 'py> {
    pub(crate) rtol: Option<&'a Bound<'py, PyAny>>,
    pub(crate) atol: Option<&'a Bound<'py, PyAny>>,
    pub(crate) settle_tol: Option<&'a Bound<'py, PyAny>>,
    pub(crate) max_cycles: Option<&'a Bound<'py, PyAny>>,
    pub(crate) max_steps: Option<&'a Bound<'py, PyAny>>,
}

impl Keywords<'_, '_> {
    /// The settings, with the defaults of grid files for what is not given.
    pub(crate) fn settings(&self) -> PyResult<SolverSettings> {
        let mut settings = SolverSettings::default();
        if let Some(value) = self.rtol {
            settings.rtol = tolerance("rtol", LARGEST_RTOL, value)?;
            settings.atol = settings.rtol / 100.0;
        }
        if let Some(value) = self.atol {
            settings.atol = tolerance("atol", f64::INFINITY, value)?;
        }
        if let Some(value) = self.settle_tol {
            settings.settle_tol = tolerance("settle_tol", f64::INFINITY, value)?;
        }
        if let Some(value) = self.max_cycles {
            settings.max_cycles = convert::count("max_cycles", value)?;
        }
        if let Some(value) = self.max_steps {
            settings.max_steps = convert::count("max_steps", value)?;
        }
        Ok(settings)
    }
}

/// A number more than zero and less than `limit`.
fn tolerance(name: &str, limit: f64, value: &Bound<'_, PyAny>) -> PyResult<f64> {
    let number = convert::number(name, "a number", value)?;
    if number > 0.0 && number < limit {
        return Ok(number);
    }
    let below = if limit.is_finite() { format!(" and less than {limit}") } else { String::new() };
    Err(PyValueError::new_err(format!("`{name}` must be more than zero{below}, not {number:?}")))
}
