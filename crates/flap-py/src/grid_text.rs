//! A dictionary as the text of a grid file, so that messages can show the lines of its mistakes.
//!
//! Tables keep the order of the dictionary: the last axis varies fastest.

use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyList, PyString, PyTuple};
use toml::Value;

/// The text of a grid file with the entries of `grid`. `TypeError` for a key or a value that no grid file has.
pub(crate) fn write(grid: &Bound<'_, PyDict>) -> PyResult<String> {
    let (mut head, mut tables) = (Vec::new(), Vec::new());
    for (key, value) in grid {
        let name = name(&key)?;
        if let Ok(table) = value.cast::<PyDict>() {
            tables.push(format!("\n[{name}]\n{}", lines(table, &name)?));
        } else if let Some(blocks) = dictionaries(&value) {
            for block in blocks {
                tables.push(format!("\n[[{name}]]\n{}", lines(&block, &name)?));
            }
        } else {
            head.push(format!("{name} = {}\n", inline(&value, &name)?));
        }
    }
    head.append(&mut tables);
    Ok(head.concat())
}

/// The dictionaries of a list, if it is a list of nothing else.
fn dictionaries<'py>(value: &Bound<'py, PyAny>) -> Option<Vec<Bound<'py, PyDict>>> {
    let items: Vec<Bound<'py, PyAny>> = value.cast::<PyList>().ok()?.iter().collect();
    if items.is_empty() {
        return None;
    }
    items.into_iter().map(|item| item.cast_into::<PyDict>().ok()).collect()
}

fn lines(table: &Bound<'_, PyDict>, place: &str) -> PyResult<String> {
    let lines = table.iter().map(|(key, value)| {
        let name = name(&key)?;
        Ok(format!("{name} = {}\n", inline(&value, &format!("{place}.{name}"))?))
    });
    lines.collect()
}

fn name(key: &Bound<'_, PyAny>) -> PyResult<String> {
    let Ok(key) = key.cast::<PyString>() else {
        return Err(PyTypeError::new_err(format!("keys of a grid are text, not {}", key.get_type().name()?)));
    };
    let key = key.to_cow()?;
    let bare = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    if !key.is_empty() && key.chars().all(bare) {
        return Ok(key.into_owned());
    }
    Ok(Value::String(key.into_owned()).to_string())
}

/// A value on one line.
fn inline(value: &Bound<'_, PyAny>, place: &str) -> PyResult<String> {
    if let Ok(dict) = value.cast::<PyDict>() {
        let items = dict.iter().map(|(key, value)| {
            let name = name(&key)?;
            Ok(format!("{name} = {}", inline(&value, &format!("{place}.{name}"))?))
        });
        return Ok(format!("{{ {} }}", items.collect::<PyResult<Vec<_>>>()?.join(", ")));
    }
    if value.is_instance_of::<PyList>() || value.is_instance_of::<PyTuple>() {
        let items = value.try_iter()?.map(|item| inline(&item?, place));
        return Ok(format!("[{}]", items.collect::<PyResult<Vec<_>>>()?.join(", ")));
    }
    Ok(scalar(value, place)?.to_string())
}

fn scalar(value: &Bound<'_, PyAny>, place: &str) -> PyResult<Value> {
    if let Ok(flag) = value.cast::<PyBool>() {
        return Ok(Value::Boolean(flag.is_true()));
    }
    if let Ok(text) = value.cast::<PyString>() {
        return Ok(Value::String(text.to_cow()?.into_owned()));
    }
    // A whole number first: 3 stays 3.
    if let Ok(whole) = value.extract::<i64>() {
        return Ok(Value::Integer(whole));
    }
    if let Ok(number) = value.extract::<f64>() {
        return Ok(Value::Float(number));
    }
    let found = value.get_type().name()?;
    let message = format!(
        "`{place}` of a grid must be a number, text, true or false, a list or a dictionary, not {found}"
    );
    Err(PyTypeError::new_err(message))
}
