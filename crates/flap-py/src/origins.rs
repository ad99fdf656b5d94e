//! Sources of a design's parameter values, as written in the design's grid file and devices.

use std::collections::BTreeMap;

use flap_core::parameter::Parameter;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use toml::{Table, Value};

use crate::grid;

/// Return the description of a design, which may be empty, and the sources of its parameters by name.
#[pyfunction]
#[pyo3(signature = (design, /))]
pub(crate) fn origins(design: &Bound<'_, PyAny>) -> PyResult<(String, BTreeMap<String, String>)> {
    let plan = grid::plan(design)?;
    let parameters = plan.parameters();
    let mut description = String::new();
    let mut sources = vec![None; parameters.len()];
    for file in plan.devices().iter().rev().chain([plan.source()]) {
        let entries: Table =
            toml::from_str(&file.text).map_err(|error| PyValueError::new_err(error.to_string()))?;
        if let Some(text) = entries.get("description").and_then(Value::as_str) {
            text.clone_into(&mut description);
        }
        for (name, value) in entries.get("params").and_then(Value::as_table).into_iter().flatten() {
            if let Some(index) = Parameter::index(parameters, name) {
                sources[index] = value.get("source").and_then(Value::as_str).map(str::to_owned);
            }
        }
    }
    let named = parameters.iter().zip(sources);
    let sources =
        named.filter_map(|(parameter, source)| Some((parameter.name.to_owned(), source?))).collect();
    Ok((description, sources))
}
