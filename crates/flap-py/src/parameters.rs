//! Names of parameters in calls from Python, and values of parameters from keywords.

use flap_core::parameter::{Kind, Parameter, Preset};
use flap_core::simulate::{self, Simulator};
use flap_sweep::notation::nearest;
use flap_sweep::notation::value::{self, UnitOf, ValueError};
use flap_sweep::plan::Robot;
use flap_sweep::resonance::{AT_RESONANCE, DRIVE_FREQUENCY};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyString;

use crate::{convert, error, solver};

/// Return the names of the published parameter sets.
///
/// Returns
/// -------
/// list of str
///     Names for `run`, such as ``"ozaki2018-large"``.
#[pyfunction]
pub(crate) fn presets() -> Vec<&'static str> {
    simulate::all().iter().flat_map(|model| model.presets()).map(|preset| preset.name).collect()
}

/// Returns the preset `name` with its model.
pub(crate) fn find_preset(name: &Bound<'_, PyAny>) -> PyResult<(&'static dyn Simulator, &'static Preset)> {
    let Ok(name) = name.cast::<PyString>() else {
        return Err(convert::wrong_type("preset", "the name of a preset", name));
    };
    let name = name.to_cow()?;
    simulate::preset(&name).ok_or_else(|| {
        let names = presets();
        let hint = did_you_mean(&name, &names);
        PyValueError::new_err(format!("there is no preset `{name}`{hint} (presets: {})", names.join(", ")))
    })
}

/// Returns the index of the parameter `name`.
pub(crate) fn index(robot: &Robot, name: &str) -> PyResult<usize> {
    Parameter::index(robot.parameters(), name).ok_or_else(|| unknown_parameter(robot, name, None))
}

/// Returns the index of the parameter that a keyword argument of the user's call names.
pub(crate) fn index_of_keyword(py: Python<'_>, robot: &Robot, name: &str) -> PyResult<usize> {
    let Some(index) = Parameter::index(robot.parameters(), name) else {
        let near = py.import("flapwing._mistakes")?.call_method1("near_argument", (name,))?;
        return Err(unknown_parameter(robot, name, near.extract()?));
    };
    Ok(index)
}

/// Warns that a parameter of all wings of a vehicle has no effect, because each wing sets its own value.
pub(crate) fn warn_unreached(py: Python<'_>, parameter: &Parameter) -> PyResult<()> {
    error::warn(py, format!("`{0}` has no effect: every wing sets its own `{0}`", parameter.name))
}

/// Returns the value of `parameter` in a design point: a number in SI units, or the index of an option.
pub(crate) fn value_of(parameter: &Parameter, value: &Bound<'_, PyAny>) -> PyResult<f64> {
    let found = match value.cast::<PyString>() {
        Ok(text) if parameter.name == DRIVE_FREQUENCY && text.to_cow()? == AT_RESONANCE => {
            return Err(PyValueError::new_err(format!(
                "`{DRIVE_FREQUENCY}` must be a number in Hz or text with a unit here\n\
                 only a grid runs designs at resonance: {{\"preset\": ..., \"params\": {{\"{DRIVE_FREQUENCY}\": \"{AT_RESONANCE}\"}}}}"
            )));
        }
        Ok(text) => value::of_text(parameter, &text.to_cow()?, UnitOf::Text),
        Err(_) => value::of_number(parameter, number(parameter, value)?),
    };
    found.map_err(|error| refused(parameter, &error))
}

/// Converts a Python object that is not text to a number in SI units.
fn number(parameter: &Parameter, value: &Bound<'_, PyAny>) -> PyResult<f64> {
    let Parameter { name, unit, .. } = *parameter;
    match parameter.kind {
        Kind::Choice(options) => {
            Err(convert::wrong_type(name, &format!("one of {}", listed(options)), value))
        }
        Kind::Number(_) | Kind::Following(..) if unit.is_empty() => convert::number(name, "a number", value),
        Kind::Number(_) | Kind::Following(..) => {
            convert::number(name, &format!("a number in {unit} or text with a unit"), value)
        }
    }
}

/// Returns the exception for a value that `parameter` cannot have.
fn refused(parameter: &Parameter, error: &ValueError) -> PyErr {
    let Parameter { name, unit, .. } = *parameter;
    PyValueError::new_err(match error {
        ValueError::OutOfRange { value, .. } => error.message(name, &format!("{value:?} {unit}")),
        ValueError::NoQuantity(cause) => {
            let help = cause.help().map_or_else(String::new, |help| format!("; {help}"));
            error.message(name, "") + &help
        }
        ValueError::NoOption { text, options } => {
            let options: Vec<&str> = options.iter().map(String::as_str).collect();
            let hint = did_you_mean(text, &options);
            format!("{}{hint} (options: {})", error.message(name, text), listed(&options))
        }
    })
}

/// Returns the list of options as text, with each option in quotes.
fn listed(options: &[&str]) -> String {
    options.iter().map(|option| format!("\"{option}\"")).collect::<Vec<_>>().join(", ")
}

/// Returns the exception for an unknown parameter. `argument` is the argument of the user's call that is similar to
/// `name`.
fn unknown_parameter(robot: &Robot, name: &str, argument: Option<String>) -> PyErr {
    let parameters: Vec<&str> = robot.parameters().iter().map(|parameter| parameter.name).collect();
    let settings = solver::settings();
    if settings.contains(&name) {
        return PyValueError::new_err(format!(
            "`{name}` is a solver setting, not a parameter, and applies to all points\n\
             give it as a keyword argument, as in {name}=..."
        ));
    }
    // Misspelt solver settings are also reported here.
    let hint = match argument {
        Some(argument) => format!(", did you mean `{argument}`?"),
        None => did_you_mean(name, &[&parameters[..], &settings[..]].concat()),
    };
    PyValueError::new_err(format!(
        "model `{}` has no parameter `{name}`{hint} (parameters: {}; solver settings: {})",
        robot.name(),
        parameters.join(", "),
        settings.join(", "),
    ))
}

/// Returns the part of an error message that suggests the most similar of the names `names`. The text is
/// empty if no name is similar to `name`.
pub(crate) fn did_you_mean(name: &str, names: &[&str]) -> String {
    let nearest = nearest(name, names.iter().copied());
    nearest.map_or_else(String::new, |nearest| format!(", did you mean `{nearest}`?"))
}
