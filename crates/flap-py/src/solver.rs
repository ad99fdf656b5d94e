//! Solver settings from keywords.

use flap_core::simulate::SolverSettings;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::convert;

/// The names of the settings, in the order of the signature of `flapwing.run`.
pub(crate) const NAMES: [&str; 7] =
    ["rtol", "atol", "settle_tol", "max_cycles", "max_steps", "accuracy", "newton"];

/// The bound of rtol: above it, error estimates mean nothing.
const LARGEST_RTOL: f64 = 0.1;

/// The solver settings of a call: those of [`NAMES`] that it gives.
pub(crate) struct Keywords<'py>(Vec<Keyword<'py>>);

impl<'py> Keywords<'py> {
    /// Splits keywords into solver settings and others. A setting that is None counts as not given.
    pub(crate) fn take(
        keywords: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<(Keywords<'py>, Vec<Keyword<'py>>)> {
        let (mut settings, mut others) = (Vec::new(), Vec::new());
        for (name, value) in keywords.into_iter().flatten() {
            let name: String = name.extract()?;
            if !NAMES.contains(&name.as_str()) {
                others.push((name, value));
            } else if !value.is_none() {
                settings.push((name, value));
            }
        }
        Ok((Keywords(settings), others))
    }

    /// Replaces those of `settings` that the call gives. `TypeError` or `ValueError` for a value that a setting cannot have.
    pub(crate) fn apply(&self, settings: &mut SolverSettings) -> PyResult<()> {
        // In the order of `NAMES`: rtol decides the default of atol.
        for name in NAMES {
            let Some((_, value)) = self.0.iter().find(|(given, _)| given == name) else { continue };
            match name {
                "rtol" => *settings = settings.with_rtol(tolerance(name, LARGEST_RTOL, value)?),
                "atol" => settings.atol = tolerance(name, f64::INFINITY, value)?,
                "settle_tol" => settings.settle_tol = tolerance(name, f64::INFINITY, value)?,
                "max_cycles" => settings.max_cycles = convert::count(name, value)?,
                "max_steps" => settings.max_steps = convert::count(name, value)?,
                "accuracy" => settings.accuracy = tolerance(name, f64::INFINITY, value)?,
                _ => {
                    let flag = value.extract::<bool>();
                    settings.newton = flag.map_err(|_| convert::wrong_type(name, "True or False", value))?;
                }
            }
        }
        Ok(())
    }
}

/// A keyword that is no solver setting.
pub(crate) type Keyword<'py> = (String, Bound<'py, PyAny>);

/// A number more than zero and less than `limit`, else `ValueError`; `TypeError` if it is no number.
fn tolerance(name: &str, limit: f64, value: &Bound<'_, PyAny>) -> PyResult<f64> {
    let number = convert::number(name, "a number", value)?;
    if number > 0.0 && number < limit {
        return Ok(number);
    }
    let below = if limit.is_finite() { format!(" and less than {limit}") } else { String::new() };
    Err(PyValueError::new_err(format!("`{name}` must be more than zero{below}, not {number:?}")))
}
