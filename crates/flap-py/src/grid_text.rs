//! Converts a dictionary to the text of a grid file, so that messages can show the lines of mistakes.
//!
//! Tables keep the order of the dictionary, because the order of the axes determines the order of the points.
//! When flap reads a user's object, the object may raise an exception. [`convert::failed`] converts the
//! exception of a user's object to a `TypeError`.

use pyo3::exceptions::{PyOverflowError, PyTypeError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyMapping, PyRange, PyString, PyTuple};
use toml::Value;

use crate::{convert, error};

/// Largest number of nested levels of dictionaries and lists. A usual grid file has about six levels.
const MOST_LEVELS: usize = 64;

/// The types that an entry of a grid can have, as text for messages.
const WANTED: &str = "a number, text, True or False, a list, an array, or a dictionary";

/// Returns the text of a grid file with the entries `entries`.
pub(crate) fn text_of(entries: &Bound<'_, PyDict>) -> PyResult<String> {
    let (mut head, mut tables) = (Vec::new(), Vec::new());
    for (key, value) in entries {
        let name = name(&key)?;
        if let Some(table) = dictionary(&value)? {
            // [zip] is a table of columns that vary together.
            let brackets = if name == "zip" { ["[[", "]]"] } else { ["[", "]"] };
            let [open, close] = brackets;
            let (plain, blocks) = split(&table)?;
            tables.push(format!("\n{open}{name}{close}\n{}", lines(&plain, &name)?));
            for (key, block) in blocks {
                let place = format!("{name}.{key}");
                tables.push(format!("\n[[{place}]]\n{}", lines(&block, &place)?));
            }
        } else if let Some(blocks) = dictionaries(&value)? {
            for block in blocks {
                tables.push(format!("\n[[{name}]]\n{}", lines(&block, &name)?));
            }
        } else {
            head.push(format!("{name} = {}\n", inline(&value, &name, 1)?));
        }
    }
    head.append(&mut tables);
    Ok(head.concat())
}

/// The dictionaries in the lists of a table, for example one dictionary for each wing of a vehicle. Each
/// dictionary is paired with the key of its list.
type Blocks<'py> = Vec<(String, Bound<'py, PyDict>)>;

/// Separates the lists of dictionaries in a table, such as the wings of a vehicle, from all other entries of
/// the table.
fn split<'py>(table: &Bound<'py, PyDict>) -> PyResult<(Bound<'py, PyDict>, Blocks<'py>)> {
    let (plain, mut blocks) = (PyDict::new(table.py()), Vec::new());
    for (key, value) in table {
        match dictionaries(&value)? {
            Some(found) => {
                let name = name(&key)?;
                blocks.extend(found.into_iter().map(|block| (name.clone(), block)));
            }
            None => plain.set_item(key, value)?,
        }
    }
    Ok((plain, blocks))
}

/// Returns the items of a list if all items are dictionaries, and `None` otherwise.
fn dictionaries<'py>(value: &Bound<'py, PyAny>) -> PyResult<Option<Vec<Bound<'py, PyDict>>>> {
    let Ok(list) = value.cast::<PyList>() else { return Ok(None) };
    let items = list.iter().map(|item| dictionary(&item)).collect::<PyResult<Option<Vec<_>>>>()?;
    Ok(items.filter(|items| !items.is_empty()))
}

/// Converts a mapping, or a table with columns (a DataFrame, an Arrow table, a `Table`), to a dictionary.
/// Returns `None` if the object is neither a mapping nor a table.
pub(crate) fn dictionary<'py>(value: &Bound<'py, PyAny>) -> PyResult<Option<Bound<'py, PyDict>>> {
    if let Ok(dict) = value.cast::<PyDict>() {
        return Ok(Some(dict.clone()));
    }
    if value.is_instance_of::<PyString>() {
        return Ok(None);
    }
    let failed = |error| convert::failed("grid", WANTED, value, error);
    if !value.is_instance_of::<PyMapping>() && value.hasattr("collect").map_err(failed)? {
        let found = convert::type_name(value);
        return Err(PyTypeError::new_err(format!(
            "{found} has no columns yet\ncall its method collect() first"
        )));
    }
    columns(value).map_err(failed)
}

/// Returns a dictionary of the entries of a mapping or the columns of a table. Returns `None` if the object
/// is neither a mapping nor a table.
fn columns<'py>(value: &Bound<'py, PyAny>) -> PyResult<Option<Bound<'py, PyDict>>> {
    let dict = PyDict::new(value.py());
    if let Ok(mapping) = value.cast::<PyMapping>() {
        dict.update(mapping)?;
        return Ok(Some(dict));
    }
    for names in ["column_names", "columns"] {
        if let Some(names) = value.getattr_opt(names)? {
            for name in names.try_iter()? {
                let name = name?;
                dict.set_item(&name, value.get_item(&name)?)?;
            }
            return Ok(Some(dict));
        }
    }
    Ok(None)
}

/// Converts a range, an array, a Series or an Arrow column to a list. Returns `None` for all
/// other types of objects.
fn listed<'py>(value: &Bound<'py, PyAny>) -> PyResult<Option<Bound<'py, PyAny>>> {
    if value.is_instance_of::<PyRange>() {
        return Ok(Some(
            PyList::new(value.py(), value.try_iter()?.collect::<PyResult<Vec<_>>>()?)?.into_any(),
        ));
    }
    for method in ["tolist", "to_list", "to_pylist"] {
        if let Some(method) = value.getattr_opt(method)? {
            let list = method.call0()?;
            return Ok(list.is_instance_of::<PyList>().then_some(list));
        }
    }
    Ok(None)
}

fn lines(table: &Bound<'_, PyDict>, place: &str) -> PyResult<String> {
    let lines = table.iter().map(|(key, value)| {
        let name = name(&key)?;
        Ok(format!("{name} = {}\n", inline(&value, &format!("{place}.{name}"), 2)?))
    });
    lines.collect()
}

fn name(key: &Bound<'_, PyAny>) -> PyResult<String> {
    let Ok(key) = key.cast::<PyString>() else {
        return Err(PyTypeError::new_err(format!(
            "keys of a grid must be text, not {}",
            key.get_type().name()?
        )));
    };
    let key = key.to_cow()?;
    let bare = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    if !key.is_empty() && key.chars().all(bare) {
        return Ok(key.into_owned());
    }
    Ok(Value::String(key.into_owned()).to_string())
}

/// Returns a value as one line of a grid file. `level` is the number of dictionaries and lists that contain
/// the value.
pub(crate) fn inline(value: &Bound<'_, PyAny>, place: &str, level: usize) -> PyResult<String> {
    if level > MOST_LEVELS {
        return Err(error::no_grid(value.py(), &too_deep(place)));
    }
    let failed = |error| convert::failed(place, WANTED, value, error);
    if let Some(list) = listed(value).map_err(failed)? {
        return inline(&list, place, level + 1);
    }
    if let Some(dict) = dictionary(value)? {
        let items = dict.iter().map(|(key, value)| {
            let name = name(&key)?;
            Ok(format!("{name} = {}", inline(&value, &format!("{place}.{name}"), level + 1)?))
        });
        return Ok(format!("{{ {} }}", items.collect::<PyResult<Vec<_>>>()?.join(", ")));
    }
    if value.is_instance_of::<PyList>() || value.is_instance_of::<PyTuple>() {
        let items = value.try_iter().map_err(failed)?;
        let items = items.map(|item| inline(&item.map_err(failed)?, place, level + 1));
        return Ok(format!("[{}]", items.collect::<PyResult<Vec<_>>>()?.join(", ")));
    }
    Ok(scalar(value, place)?.to_string())
}

fn scalar(value: &Bound<'_, PyAny>, place: &str) -> PyResult<Value> {
    if let Some(flag) = convert::flag(value) {
        return Ok(Value::Boolean(flag));
    }
    if let Ok(text) = value.cast::<PyString>() {
        return Ok(Value::String(text.to_cow()?.into_owned()));
    }
    // Whole numbers are tried first, so that 3 stays 3.
    if let Ok(whole) = value.extract::<i64>() {
        return Ok(Value::Integer(whole));
    }
    value.extract::<f64>().map(Value::Float).map_err(|error| {
        let py = value.py();
        if error.is_instance_of::<PyOverflowError>(py) {
            convert::too_large(place)
        } else if error.is_instance_of::<PyTypeError>(py) {
            let found = convert::type_name(value);
            PyTypeError::new_err(format!("`{place}` of a grid is {found}\nit must be {WANTED}"))
        } else {
            convert::failed(place, WANTED, value, error)
        }
    })
}

/// Returns the error message for too many nested dictionaries or lists in the entry `place`.
fn too_deep(place: &str) -> String {
    let first: Vec<&str> = place.split('.').take(4).collect();
    let dots = if first.len() < 4 { "" } else { "…" };
    format!(
        "`{}{dots}` has more than {MOST_LEVELS} levels of dictionaries or lists\ngive fewer levels; none may contain itself",
        first.join(".")
    )
}
