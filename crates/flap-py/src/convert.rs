//! Converts Python objects to numbers, with errors for objects that are not numbers.

use flap_sweep::notation::text::shortened;
use flap_sweep::notation::units;
use flap_sweep::resonance;
use pyo3::exceptions::{PyException, PyIndexError, PyOverflowError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyString;

use crate::error;

/// Returns a finite number from any type that Python's `float` accepts, except text and `bool`.
///
/// Returns a `TypeError` if the type of `value` does not allow the conversion, or if reading `value` raises
/// an exception. The message contains the name `name` and the required type `wanted`. Returns a `ValueError`
/// if the number is infinite, not a number, or too large.
pub(crate) fn number(name: &str, wanted: &str, value: &Bound<'_, PyAny>) -> PyResult<f64> {
    if flag(value).is_some() {
        return Err(wrong_type(name, wanted, value));
    }
    let number = value.extract::<f64>().map_err(|error| {
        if error.is_instance_of::<PyTypeError>(value.py()) {
            wrong_type(name, wanted, value)
        } else if error.is_instance_of::<PyOverflowError>(value.py()) {
            too_large(name)
        } else {
            failed(name, wanted, value, error)
        }
    })?;
    if number.is_finite() {
        Ok(number)
    } else {
        let told = number.to_string().to_lowercase();
        Err(PyValueError::new_err(format!("`{name}` cannot be {told}: values must be finite")))
    }
}

/// Returns a duration in seconds from a number in seconds or text with a unit. A duration that is not more than zero
/// is a `ValueError`. If `value` cannot be converted to a number, returns the error of [`quantity`].
pub(crate) fn duration(name: &str, value: &Bound<'_, PyAny>) -> PyResult<f64> {
    let duration = quantity(name, "s", true, value)?;
    if duration > 0.0 {
        return Ok(duration);
    }
    Err(PyValueError::new_err(format!("`{name}` must be more than zero, not {duration:?} s")))
}

/// Returns the size of an impulse (rad) from a number in rad or text with a unit. An impulse of zero or of more
/// than half a turn is a `ValueError`. If `value` cannot be converted to a number, returns the error of
/// [`quantity`].
pub(crate) fn impulse(name: &str, value: &Bound<'_, PyAny>) -> PyResult<f64> {
    let amplitude = quantity(name, "rad", true, value)?;
    if amplitude == 0.0 {
        return Err(PyValueError::new_err(format!(
            "`{name}` must not be zero: give a size such as \"20 deg\""
        )));
    }
    resonance::impulse(amplitude)
        .map_err(|error| error::with_help(format!("`{name}` is too large: {error}"), error.help))
}

/// Converts a number, or text with a unit, to a number in `unit`. If `takes_text` is false, text is an error,
/// because the unit is already a part of `name`.
///
/// Returns the errors of [`number`], and a `ValueError` for text that cannot be converted to `unit`.
pub(crate) fn quantity(name: &str, unit: &str, takes_text: bool, value: &Bound<'_, PyAny>) -> PyResult<f64> {
    match value.cast::<PyString>() {
        Ok(text) if takes_text => {
            units::parse_as(&text.to_cow()?, unit).map_err(|error| error::quantity(name, &error))
        }
        _ if takes_text => number(name, &format!("a number in {unit} or text with a unit"), value),
        _ => number(name, "a number, in the unit of its name", value),
    }
}

/// Returns a whole number from 1 to the largest `u32`. A value that is not a whole number is a `TypeError`,
/// and a whole number below 1 or above the largest `u32` is a `ValueError`.
pub(crate) fn count(name: &str, value: &Bound<'_, PyAny>) -> PyResult<u32> {
    let wanted = "a whole number";
    if flag(value).is_some() {
        return Err(wrong_type(name, wanted, value));
    }
    let count = match value.extract::<u32>() {
        Ok(count) => count,
        Err(error) if error.is_instance_of::<PyTypeError>(value.py()) => {
            return Err(wrong_type(name, wanted, value));
        }
        // The number is negative or too large.
        Err(error) if error.is_instance_of::<PyOverflowError>(value.py()) => 0,
        Err(error) => return Err(failed(name, wanted, value, error)),
    };
    if count == 0 {
        let found = value.str().map_or_else(|_| "this".to_owned(), |found| found.to_string());
        return Err(PyValueError::new_err(format!("`{name}` must be from 1 to {}, not {found}", u32::MAX)));
    }
    Ok(count)
}

/// Returns the value of a `bool` or of NumPy's `bool`. Returns `None` for an object of any other type.
pub(crate) fn flag(value: &Bound<'_, PyAny>) -> Option<bool> {
    value.extract().ok()
}

/// Returns the `TypeError` for a value of the wrong type.
pub(crate) fn wrong_type(name: &str, wanted: &str, value: &Bound<'_, PyAny>) -> PyErr {
    PyTypeError::new_err(format!("`{name}` must be {wanted}, not {}", type_name(value)))
}

/// Returns the `ValueError` for a whole number beyond the largest float.
pub(crate) fn too_large(name: &str) -> PyErr {
    PyValueError::new_err(format!("`{name}` is too large for a 64-bit float\nthe largest is {:e}", f64::MAX))
}

/// Returns the `TypeError` for an object that raised the exception `error` when flap read the object. The
/// cause of the `TypeError` is `error`. Exceptions such as `KeyboardInterrupt`, which are not subclasses of
/// Python's `Exception`, are returned unchanged.
pub(crate) fn failed(name: &str, wanted: &str, value: &Bound<'_, PyAny>, error: PyErr) -> PyErr {
    let py = value.py();
    if !error.is_instance_of::<PyException>(py) {
        return error;
    }
    let told = error.to_string();
    let told = shortened(told.lines().next().unwrap_or_default());
    let message = format!("`{name}` is {}, which raised {told}\nit must be {wanted}", type_name(value));
    let refused = PyTypeError::new_err(message);
    refused.set_cause(py, Some(error));
    refused
}

/// Returns the name of an object's type.
pub(crate) fn type_name(value: &Bound<'_, PyAny>) -> String {
    value.get_type().name().map_or_else(|_| "an object".to_owned(), |name| name.to_string())
}

/// Returns the index of a point among `length` points. A negative index counts from the end.
pub(crate) fn point_index(length: u64, name: &str, given: &Bound<'_, PyAny>) -> PyResult<u64> {
    let missing =
        |wanted: &str| PyIndexError::new_err(format!("there is no point {wanted}: the grid has {length}"));
    let wanted = given.extract::<i64>().map_err(|error| {
        let allowed = "a whole number, the index of a point in the grid";
        if error.is_instance_of::<PyOverflowError>(given.py()) {
            missing("so large")
        } else if error.is_instance_of::<PyTypeError>(given.py()) {
            PyTypeError::new_err(format!("`{name}` is {}\nit must be {allowed}", type_name(given)))
        } else {
            failed(name, allowed, given, error)
        }
    })?;
    let index =
        if wanted < 0 { length.checked_sub(wanted.unsigned_abs()) } else { Some(wanted.unsigned_abs()) };
    index.filter(|index| *index < length).ok_or_else(|| missing(&wanted.to_string()))
}
