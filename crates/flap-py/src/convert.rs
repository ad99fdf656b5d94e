//! Numbers out of Python objects, and the errors for objects that are no numbers.

use flap_sweep::notation::units;
use pyo3::exceptions::{PyOverflowError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyString};

/// A finite number, of any type that Python's `float` takes except text and truth values.
///
/// `TypeError` if `value` is of another type: the message says that `name` must be `wanted`. `ValueError` if the number is
/// infinite, not a number, or too large.
pub(crate) fn number(name: &str, wanted: &str, value: &Bound<'_, PyAny>) -> PyResult<f64> {
    if value.is_instance_of::<PyBool>() {
        return Err(wrong_type(name, wanted, value));
    }
    let number = value.extract::<f64>().map_err(|error| {
        if error.is_instance_of::<PyTypeError>(value.py()) {
            wrong_type(name, wanted, value)
        } else if error.is_instance_of::<PyOverflowError>(value.py()) {
            PyValueError::new_err(format!("`{name}` is too large for a 64-bit float"))
        } else {
            error
        }
    })?;
    if number.is_finite() {
        Ok(number)
    } else {
        Err(PyValueError::new_err(format!("`{name}` cannot be {}: values are finite", value.str()?)))
    }
}

/// A number in `unit`, or text with a unit, in `unit`. Text is refused if `takes_text` is false: the name has another unit.
///
/// `TypeError` or `ValueError` as [`number`]; `ValueError` for a text that is no such quantity.
pub(crate) fn quantity(name: &str, unit: &str, takes_text: bool, value: &Bound<'_, PyAny>) -> PyResult<f64> {
    match value.cast::<PyString>() {
        Ok(text) if takes_text => units::parse_as(&text.to_cow()?, unit).map_err(|error| {
            let help = error.help().map_or_else(String::new, |help| format!("\n{help}"));
            PyValueError::new_err(format!("{}{help}", error.message(&format!("`{name}`"))))
        }),
        _ if takes_text => number(name, &format!("a number in {unit} or text with a unit"), value),
        _ => number(name, "a number, in the unit of its name", value),
    }
}

/// A whole number from 1 to the largest `u32`. `TypeError` for another type, `ValueError` for another number.
pub(crate) fn count(name: &str, value: &Bound<'_, PyAny>) -> PyResult<u32> {
    let wanted = "a whole number";
    if value.is_instance_of::<PyBool>() {
        return Err(wrong_type(name, wanted, value));
    }
    let count = match value.extract::<u32>() {
        Ok(count) => count,
        Err(error) if error.is_instance_of::<PyTypeError>(value.py()) => {
            return Err(wrong_type(name, wanted, value));
        }
        // Negative, or too large.
        Err(error) if error.is_instance_of::<PyOverflowError>(value.py()) => 0,
        Err(error) => return Err(error),
    };
    if count == 0 {
        let message = format!("`{name}` must be from 1 to {}, not {}", u32::MAX, value.str()?);
        return Err(PyValueError::new_err(message));
    }
    Ok(count)
}

/// The `TypeError` for a value that is not of the type wanted.
pub(crate) fn wrong_type(name: &str, wanted: &str, value: &Bound<'_, PyAny>) -> PyErr {
    match value.get_type().name() {
        Ok(found) => PyTypeError::new_err(format!("`{name}` must be {wanted}, not {found}")),
        Err(error) => error,
    }
}
