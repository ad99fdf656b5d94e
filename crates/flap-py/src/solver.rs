//! Solver settings from keywords.

use flap_core::simulate::SolverSettings;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::convert;

/// The keywords, in the order of the signature.
pub(crate) const NAMES: [&str; 7] =
    ["rtol", "atol", "settle_tol", "max_cycles", "max_steps", "accuracy", "newton"];

/// Looser than this, an error estimate means nothing.
const LARGEST_RTOL: f64 = 0.1;

/// The solver settings that a call gives.
#[derive(Default)]
pub(crate) struct Keywords<'py> {
    rtol: Option<Bound<'py, PyAny>>,
    atol: Option<Bound<'py, PyAny>>,
    settle_tol: Option<Bound<'py, PyAny>>,
    max_cycles: Option<Bound<'py, PyAny>>,
    max_steps: Option<Bound<'py, PyAny>>,
    accuracy: Option<Bound<'py, PyAny>>,
    newton: Option<Bound<'py, PyAny>>,
}

impl<'py> Keywords<'py> {
    /// Takes the solver settings out of `keywords`, and gives those that are left.
    pub(crate) fn take(
        keywords: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<(Keywords<'py>, Vec<Keyword<'py>>)> {
        let mut solver = Keywords::default();
        let mut others = Vec::new();
        for (name, value) in keywords.into_iter().flatten() {
            let name: String = name.extract()?;
            let setting = match name.as_str() {
                "rtol" => &mut solver.rtol,
                "atol" => &mut solver.atol,
                "settle_tol" => &mut solver.settle_tol,
                "max_cycles" => &mut solver.max_cycles,
                "max_steps" => &mut solver.max_steps,
                "accuracy" => &mut solver.accuracy,
                "newton" => &mut solver.newton,
                _ => {
                    others.push((name, value));
                    continue;
                }
            };
            *setting = Some(value).filter(|value| !value.is_none());
        }
        Ok((solver, others))
    }

    /// Puts the settings that are given over those of `settings`.
    pub(crate) fn apply(&self, settings: &mut SolverSettings) -> PyResult<()> {
        if let Some(value) = &self.rtol {
            *settings = settings.with_rtol(tolerance("rtol", LARGEST_RTOL, value)?);
        }
        if let Some(value) = &self.atol {
            settings.atol = tolerance("atol", f64::INFINITY, value)?;
        }
        if let Some(value) = &self.settle_tol {
            settings.settle_tol = tolerance("settle_tol", f64::INFINITY, value)?;
        }
        if let Some(value) = &self.max_cycles {
            settings.max_cycles = convert::count("max_cycles", value)?;
        }
        if let Some(value) = &self.max_steps {
            settings.max_steps = convert::count("max_steps", value)?;
        }
        if let Some(value) = &self.accuracy {
            settings.accuracy = tolerance("accuracy", f64::INFINITY, value)?;
        }
        if let Some(value) = &self.newton {
            let flag = value.extract::<bool>();
            settings.newton = flag.map_err(|_| convert::wrong_type("newton", "True or False", value))?;
        }
        Ok(())
    }
}

/// A keyword that is no solver setting.
pub(crate) type Keyword<'py> = (String, Bound<'py, PyAny>);

/// A number more than zero and less than `limit`.
fn tolerance(name: &str, limit: f64, value: &Bound<'_, PyAny>) -> PyResult<f64> {
    let number = convert::number(name, "a number", value)?;
    if number > 0.0 && number < limit {
        return Ok(number);
    }
    let below = if limit.is_finite() { format!(" and less than {limit}") } else { String::new() };
    Err(PyValueError::new_err(format!("`{name}` must be more than zero{below}, not {number:?}")))
}
