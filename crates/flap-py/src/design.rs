//! Designs: the first argument of `evaluate` and `respond`.

use flap_core::simulate;
use flap_sweep::plan::Plan;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString};

use crate::solver::{Keyword, Keywords};
use crate::{error, grid, parameters};

/// The plan of a preset by its name, or of anything that is a grid, with keywords on top.
pub(crate) fn plan(design: &Bound<'_, PyAny>, keywords: Option<&Bound<'_, PyDict>>) -> PyResult<Plan> {
    let (solver, keywords) = Keywords::take(keywords)?;
    let mut plan = match name(design)? {
        Some(name) => {
            let preset = parameters::find_preset(design)?.1;
            debug_assert_eq!(preset.name, name);
            of_preset(design.py(), preset.name)?
        }
        None => grid::plan(design)?,
    };
    solver.apply(&mut plan.solver)?;
    apply(&mut plan, &keywords)?;
    Ok(plan)
}

/// The plan of a model by its name, with no parameter set but those of `keywords`; `None` if there is no such model.
pub(crate) fn plan_of_model(
    design: &Bound<'_, PyAny>,
    keywords: Option<&Bound<'_, PyDict>>,
) -> PyResult<Option<Plan>> {
    let model = name(design)?.and_then(|name| simulate::by_name(&name));
    let Some((model, preset)) = model.and_then(|model| Some((model, model.presets().first()?))) else {
        return Ok(None);
    };
    let (solver, keywords) = Keywords::take(keywords)?;
    let mut plan = of_preset(design.py(), preset.name)?;
    debug_assert_eq!(plan.simulator.name(), model.name());
    plan.base.fill(f64::NAN);
    plan.preset = "";
    solver.apply(&mut plan.solver)?;
    apply(&mut plan, &keywords)?;
    Ok(Some(plan))
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

/// Sets parameters of all points.
fn apply(plan: &mut Plan, keywords: &[Keyword<'_>]) -> PyResult<()> {
    for (name, _) in keywords {
        let index = parameters::index(plan.simulator, name)?;
        if plan.varied().chain(plan.derived.parameters()).any(|varied| varied == index) {
            let message =
                format!("`{name}` is set here, and the grid varies or derives it: keep one of them");
            return Err(PyValueError::new_err(message));
        }
    }
    parameters::apply(plan.simulator, &mut plan.base, keywords)
}
