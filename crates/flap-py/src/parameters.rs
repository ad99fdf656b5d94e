//! Parameters from Python: their names, and values out of keywords.

use flap_core::parameter::{Kind, Parameter, Preset, Range};
use flap_core::simulate::{self, Simulator};
use flap_sweep::notation::nearest;
use flap_sweep::notation::units;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyString;

use crate::convert;
use crate::solver::{self, Keyword};

/// The names of all presets, in the order of the models.
pub(crate) fn preset_names() -> Vec<&'static str> {
    simulate::all().iter().flat_map(|model| model.presets()).map(|preset| preset.name).collect()
}

/// The preset called `name`, with its model.
pub(crate) fn find_preset(name: &Bound<'_, PyAny>) -> PyResult<(&'static dyn Simulator, &'static Preset)> {
    let Ok(name) = name.cast::<PyString>() else {
        return Err(convert::wrong_type("preset", "the name of a preset", name));
    };
    let name = name.to_cow()?;
    simulate::preset(&name).ok_or_else(|| {
        let names = preset_names();
        let hint = did_you_mean(&name, &names);
        PyValueError::new_err(format!("there is no preset `{name}`{hint} (presets: {})", names.join(", ")))
    })
}

/// The index of the parameter called `name`.
pub(crate) fn index(simulator: &dyn Simulator, name: &str) -> PyResult<usize> {
    let index = simulator.parameters().iter().position(|parameter| parameter.name == name);
    index.ok_or_else(|| unknown_parameter(simulator, name))
}

/// Puts the parameters given as keywords over `values`.
pub(crate) fn apply(simulator: &dyn Simulator, values: &mut [f64], keywords: &[Keyword<'_>]) -> PyResult<()> {
    for (name, value) in keywords {
        let index = index(simulator, name)?;
        values[index] = value_of(&simulator.parameters()[index], value)?;
    }
    Ok(())
}

/// The value of `parameter` in a design point: a number in SI units, or the index of an option.
pub(crate) fn value_of(parameter: &Parameter, value: &Bound<'_, PyAny>) -> PyResult<f64> {
    match &parameter.kind {
        Kind::Number(range) | Kind::Following(range, _) => quantity(parameter, *range, value),
        Kind::Choice(options) => option(parameter.name, options, value),
    }
}

/// A number in SI units, or text with a unit.
fn quantity(parameter: &Parameter, range: Range, value: &Bound<'_, PyAny>) -> PyResult<f64> {
    let Parameter { name, unit, .. } = *parameter;
    let number = match value.cast::<PyString>() {
        Ok(text) => units::parse_as(&text.to_cow()?, unit).map_err(|error| {
            let help = error.help().map_or_else(String::new, |help| format!("; {help}"));
            PyValueError::new_err(format!("{}{help}", error.message(&format!("`{name}`"))))
        })?,
        Err(_) if unit.is_empty() => convert::number(name, "a number", value)?,
        Err(_) => convert::number(name, &format!("a number in {unit} or text with a unit"), value)?,
    };
    if range.contains(number) {
        return Ok(number);
    }
    let allowed = range.describe();
    let message = format!("`{name}` must be {allowed}, not {number:?} {unit}");
    Err(PyValueError::new_err(message.trim_end().to_owned()))
}

/// The index of an option.
fn option(name: &str, options: &[&str], value: &Bound<'_, PyAny>) -> PyResult<f64> {
    let listed = options.iter().map(|option| format!("\"{option}\"")).collect::<Vec<_>>().join(", ");
    let Ok(text) = value.cast::<PyString>() else {
        return Err(convert::wrong_type(name, &format!("one of {listed}"), value));
    };
    let text = text.to_cow()?;
    let index = options.iter().position(|option| *option == text);
    index.map(|index| index as f64).ok_or_else(|| {
        let hint = did_you_mean(&text, options);
        PyValueError::new_err(format!("`{name}` has no option `{text}`{hint} (options: {listed})"))
    })
}

fn unknown_parameter(simulator: &dyn Simulator, name: &str) -> PyErr {
    let parameters: Vec<&str> = simulator.parameters().iter().map(|parameter| parameter.name).collect();
    // A misspelt solver setting arrives here too.
    let hint = did_you_mean(name, &[&parameters[..], &solver::NAMES].concat());
    PyValueError::new_err(format!(
        "model `{}` has no parameter `{name}`{hint} (parameters: {}; solver settings: {})",
        simulator.name(),
        parameters.join(", "),
        solver::NAMES.join(", "),
    ))
}

/// The name among `names` that is nearest to `name`, as part of a message; empty if none is near.
fn did_you_mean(name: &str, names: &[&str]) -> String {
    let nearest = nearest(name, names.iter().copied());
    nearest.map_or_else(String::new, |nearest| format!(", did you mean `{nearest}`?"))
}
