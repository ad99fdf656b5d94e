//! Solver settings from keywords.

use flap_core::simulate::{Setting, SettingKind, SolverSettings};
use flap_sweep::plan::with_rtol;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::convert;

/// Return the names of the solver settings, in the order of the signature of `flapwing.run`.
#[pyfunction]
pub(crate) fn settings() -> Vec<&'static str> {
    SolverSettings::TABLE.iter().map(|setting| setting.name).collect()
}

/// The solver settings that a call gives.
pub(crate) struct Keywords<'py>(Vec<Keyword<'py>>);

impl<'py> Keywords<'py> {
    /// Separates the solver settings of a call from all other keyword arguments. A setting that is None
    /// counts as not given.
    pub(crate) fn take(
        keywords: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<(Keywords<'py>, Vec<Keyword<'py>>)> {
        let (mut settings, mut others) = (Vec::new(), Vec::new());
        for (name, value) in keywords.into_iter().flatten() {
            let name: String = name.extract()?;
            if SolverSettings::TABLE.iter().all(|setting| setting.name != name) {
                others.push((name, value));
            } else if !value.is_none() {
                settings.push((name, value));
            }
        }
        Ok((Keywords(settings), others))
    }

    /// Returns the names and values of the settings that the call gives.
    pub(crate) fn entries(&self) -> &[Keyword<'py>] {
        &self.0
    }

    /// Copies the settings that the call gives into `settings`. If a setting cannot have the given value,
    /// returns a `TypeError` or a `ValueError`.
    pub(crate) fn apply(&self, settings: &mut SolverSettings) -> PyResult<()> {
        // The order of the table matters, because rtol determines the defaults of atol and accuracy.
        for Setting { name, kind, .. } in SolverSettings::TABLE {
            let Some((_, value)) = self.0.iter().find(|(given, _)| given == name) else { continue };
            match kind {
                SettingKind::Number { below, .. } if *name == "rtol" => {
                    *settings = with_rtol(*settings, tolerance(name, *below, value)?);
                }
                SettingKind::Number { below, set, .. } => set(settings, tolerance(name, *below, value)?),
                SettingKind::Count { set, .. } => set(settings, convert::count(name, value)?),
                SettingKind::Flag { set, .. } => {
                    let flag = convert::flag(value);
                    set(settings, flag.ok_or_else(|| convert::wrong_type(name, "True or False", value))?);
                }
            }
        }
        Ok(())
    }
}

/// A keyword that is not a solver setting.
pub(crate) type Keyword<'py> = (String, Bound<'py, PyAny>);

/// Converts `value` to a number that is more than zero and less than `limit`. A number outside of this range
/// is a `ValueError`, and an object that is not a number is a `TypeError`.
fn tolerance(name: &str, limit: f64, value: &Bound<'_, PyAny>) -> PyResult<f64> {
    let number = convert::number(name, "a number", value)?;
    if number > 0.0 && number < limit {
        return Ok(number);
    }
    let below = if limit.is_finite() { format!(" and less than {limit}") } else { String::new() };
    Err(PyValueError::new_err(format!("`{name}` must be more than zero{below}, not {number:?}")))
}
