//! Designs: the first argument of `evaluate` and `respond`.

use flap_core::simulate;

use flap_sweep::plan::{ChangeError, Plan};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString};

use crate::solver::{Keyword, Keywords};
use crate::{error, grid, parameters};

/// The plan of a preset by its name, or of anything that is a grid, with keywords on top.
pub(crate) fn plan(design: &Bound<'_, PyAny>, keywords: Option<&Bound<'_, PyDict>>) -> PyResult<Plan> {
    let (solver, keywords) = Keywords::take(keywords)?;
    let plan = match name(design)? {
        Some(_) => of_preset(design.py(), parameters::find_preset(design)?.1.name)?,
        None => grid::plan(design)?,
    };
    Ok(set(with_solver(plan, &solver)?, &keywords)?.0)
}

/// The plan of a model by its name, with keywords on top, and the parameters that these set; `None` if there is no such
/// model. Other parameters have the values of a preset.
pub(crate) fn plan_of_model(
    design: &Bound<'_, PyAny>,
    keywords: Option<&Bound<'_, PyDict>>,
) -> PyResult<Option<(Plan, Vec<usize>)>> {
    let model = name(design)?.and_then(|name| simulate::by_name(&name));
    let Some(preset) = model.and_then(|model| model.presets().first()) else {
        return Ok(None);
    };
    let (solver, keywords) = Keywords::take(keywords)?;
    let plan = of_preset(design.py(), preset.name)?;
    set(with_solver(plan, &solver)?, &keywords).map(Some)
}

/// The plan of a preset's one point with keywords on top.
pub(crate) fn point(preset: &Bound<'_, PyAny>, keywords: &Bound<'_, PyDict>) -> PyResult<Plan> {
    let (solver, keywords) = Keywords::take(Some(keywords))?;
    let plan = of_preset(preset.py(), parameters::find_preset(preset)?.1.name)?;
    Ok(set(with_solver(plan, &solver)?, &keywords)?.0)
}

fn of_preset(py: Python<'_>, preset: &str) -> PyResult<Plan> {
    let text = format!("preset = \"{preset}\"\n");
    flap_sweep::grid::parse(preset, &text, simulate::all())
        .map_err(|diagnostics| error::grid(py, &diagnostics))
}

/// The name of a preset or a model; `None` if `design` is a path, the text of a grid, or no text.
fn name(design: &Bound<'_, PyAny>) -> PyResult<Option<String>> {
    let Ok(text) = design.cast::<PyString>() else { return Ok(None) };
    let text = text.to_cow()?;
    let is_grid = text.contains(['\n', '=', '/', '\\']) || text.ends_with(".toml");
    Ok((!is_grid).then(|| text.into_owned()))
}

/// The plan with the solver settings of keywords over its own.
fn with_solver(plan: Plan, keywords: &Keywords<'_>) -> PyResult<Plan> {
    let mut settings = *plan.solver();
    keywords.apply(&mut settings)?;
    plan.with_solver(settings).map_err(|error| PyValueError::new_err(error.to_string()))
}

/// The plan with parameters of all points set to the values of keywords, and the indices of these parameters.
fn set(mut plan: Plan, keywords: &[Keyword<'_>]) -> PyResult<(Plan, Vec<usize>)> {
    let mut indices = Vec::new();
    for (name, value) in keywords {
        let index = parameters::index(plan.simulator(), name)?;
        let value = parameters::value_of(&plan.parameters()[index], value)?;
        plan = plan.with_parameter(index, value).map_err(|error| refused("set here", &error))?;
        indices.push(index);
    }
    Ok((plan, indices))
}

/// The exception for a change that a plan does not take, of a parameter that is `given` so, such as "set here".
pub(crate) fn refused(given: &str, error: &ChangeError) -> PyErr {
    PyValueError::new_err(match error {
        ChangeError::Varied(name) | ChangeError::Derived(name) => {
            format!("`{name}` is {given}, and the grid varies or derives it: keep one of them")
        }
        ChangeError::Resonance(name) => {
            format!(
                "`{name}` is {given}, and the grid runs each design at its own resonance: keep one of them"
            )
        }
        other => other.to_string(),
    })
}
