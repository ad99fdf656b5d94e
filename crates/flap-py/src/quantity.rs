//! Converts text with units in the user's data to numbers.

use flap_sweep::notation::units;
use pyo3::prelude::*;

use crate::{error, listing, parameters};

/// Return the value of a parameter in SI units, from a number or a text with a unit. `model` is a preset or a model.
#[pyfunction]
#[pyo3(signature = (model, parameter, value, /))]
pub(crate) fn value(model: &Bound<'_, PyAny>, parameter: &str, value: &Bound<'_, PyAny>) -> PyResult<f64> {
    let model = listing::model(model)?;
    let index = parameters::index(&model, parameter)?;
    parameters::value_of(&model.parameters()[index], value)
}

/// Return the name of a parameter of a preset or a model. Raise ValueError for an unknown name.
#[pyfunction]
#[pyo3(signature = (model, parameter, /))]
pub(crate) fn parameter(model: &Bound<'_, PyAny>, parameter: &str) -> PyResult<String> {
    let model = listing::model(model)?;
    Ok(model.parameters()[parameters::index(&model, parameter)?].name.to_owned())
}

/// Parse a text such as `"3 mm"`, and return the number in `unit`. The unit in the text and `unit` must
/// measure the same kind of quantity.
#[pyfunction]
#[pyo3(signature = (name, text, unit, /))]
pub(crate) fn quantity(name: &str, text: &str, unit: &str) -> PyResult<f64> {
    let refused = |error| error::quantity(name, &error);
    let value = units::parse_as(text, unit).map_err(refused)?;
    let one =
        if unit.is_empty() { 1.0 } else { units::parse_as(&format!("1 {unit}"), unit).map_err(refused)? };
    Ok(value / one)
}
