//! Converts the design and the keyword arguments of a Python call to a plan.

use flap_core::simulate;

use flap_sweep::notation::text;
use flap_sweep::plan::{ChangeError, Plan};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::solver::{Keyword, Keywords};
use crate::{grid, parameters};

/// Returns the plan of a design (see [`grid::plan`]). Keyword arguments replace parameters and solver
/// settings of the plan.
pub(crate) fn plan(design: &Bound<'_, PyAny>, keywords: Option<&Bound<'_, PyDict>>) -> PyResult<Plan> {
    let (solver, keywords) = Keywords::take(keywords)?;
    Ok(set(with_solver(grid::plan(design)?, &solver)?, &keywords)?.0)
}

/// Returns the plan of a design, like [`plan`]. The design can also be the name of a model if the keyword
/// arguments give all parameters of the model.
pub(crate) fn whole(design: &Bound<'_, PyAny>, keywords: &Bound<'_, PyDict>) -> PyResult<Plan> {
    match plan_of_model(design, Some(keywords))? {
        Some((plan, set)) => alone(plan, &set),
        None => plan(design, Some(keywords)),
    }
}

/// Returns a plan that does not use the values of a preset. If a required parameter is not in `set`, the
/// result is a `ValueError`.
pub(crate) fn alone(plan: Plan, set: &[usize]) -> PyResult<Plan> {
    let model = plan.simulator().name();
    plan.without_preset(set).map_err(|error| match error {
        ChangeError::Missing(names) => PyValueError::new_err(format!(
            "model `{model}` has no default values: also give {}, or start from a preset",
            names.join(", ")
        )),
        other => refused("a column", &other),
    })
}

/// Returns the plan of a model with the values of keyword arguments, and the indices of the parameters that
/// keyword arguments set.
///
/// Returns `None` if `design` is not the name of a model. Parameters that are not set have the values of a
/// preset.
pub(crate) fn plan_of_model(
    design: &Bound<'_, PyAny>,
    keywords: Option<&Bound<'_, PyDict>>,
) -> PyResult<Option<(Plan, Vec<usize>)>> {
    let model = grid::name(design)?.and_then(|name| simulate::by_name(&name));
    let Some(preset) = model.and_then(|model| model.presets().first()) else {
        return Ok(None);
    };
    let (solver, keywords) = Keywords::take(keywords)?;
    let plan = grid::of_preset(design.py(), preset.name)?;
    set(with_solver(plan, &solver)?, &keywords).map(Some)
}

/// Returns an error if the plan describes a vehicle. Functions that simulate only one wing call this
/// function.
pub(crate) fn check_one_wing(plan: &Plan) -> PyResult<()> {
    let Some(vehicle) = plan.vehicle() else { return Ok(()) };
    let wings = text::count(vehicle.mounts().len() as u64, "wing");
    Err(PyValueError::new_err(format!(
        "the design is a vehicle of {wings}, but this call requires one wing\ngive the design of the wing: a preset, a device \
         or a grid without `vehicle`"
    )))
}

/// Returns the plan after the solver settings in `keywords` have replaced the settings of the plan.
fn with_solver(plan: Plan, keywords: &Keywords<'_>) -> PyResult<Plan> {
    let mut settings = *plan.solver();
    keywords.apply(&mut settings)?;
    plan.with_solver(settings).map_err(|error| PyValueError::new_err(error.to_string()))
}

/// Sets parameters of all points to the values of keyword arguments. Returns the changed plan and the indices
/// of the changed parameters.
fn set(mut plan: Plan, keywords: &[Keyword<'_>]) -> PyResult<(Plan, Vec<usize>)> {
    let mut indices = Vec::new();
    for (name, value) in keywords {
        let index = parameters::index_of_keyword(value.py(), plan.robot(), name)?;
        let value = parameters::value_of(&plan.parameters()[index], value)?;
        plan = plan.with_parameter(index, value).map_err(|error| refused("set here", &error))?;
        indices.push(index);
    }
    Ok((plan, indices))
}

/// Returns the exception for a forbidden change of a plan. In the message, the text `given` follows the name
/// of the parameter, for example "set here".
pub(crate) fn refused(given: &str, error: &ChangeError) -> PyErr {
    PyValueError::new_err(match error {
        ChangeError::Varied(name) | ChangeError::Derived(name) => {
            format!("`{name}` is {given}, but the grid varies or derives it: keep one of them")
        }
        ChangeError::Resonance(name) => {
            format!("`{name}` is {given}, but the grid runs each design at its resonance: keep one of them")
        }
        ChangeError::Input(name) => format!(
            "`{name}` is {given}, but the search for hover changes it: remove it, or remove trim from the vehicle"
        ),
        other => other.to_string(),
    })
}
