//! Converts the motion of one simulated point over time to a Python dictionary of columns.

use flap_core::simulate::{Simulator, Trajectory};
use flap_sweep::table::layout::{Cell, CellKind};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::columns::{self, Columns};
use crate::error;

/// Returns a motion as a dictionary with the entries `columns` and `meta`. Each column includes its
/// description.
pub(crate) fn into_python<'py>(
    py: Python<'py>,
    motion: Trajectory,
    meaning: impl Fn(&str) -> String,
    meta: &Bound<'py, PyDict>,
) -> PyResult<Bound<'py, PyDict>> {
    let described = motion.columns.iter().map(|name| {
        let mut column = columns::named(name, CellKind::Number);
        column.doc = meaning(name);
        column
    });
    let mut columns = Columns::new(described.collect());
    for row in motion.rows {
        columns.push(&row.into_iter().map(Cell::Number).collect::<Vec<_>>());
    }
    let dict = PyDict::new(py);
    dict.set_item("columns", columns.into_python(py)?)?;
    dict.set_item("meta", meta)?;
    Ok(dict)
}

/// Returns a function that maps the name of a trajectory's column to the description of the column. The
/// description of an unknown column is empty.
pub(crate) fn meanings(
    model: &dyn Simulator,
    motion: &Trajectory,
) -> PyResult<impl Fn(&str) -> String + use<>> {
    let meanings = model.motions().map_err(|reason| error::unfinished(&reason))?.meanings();
    let pairs: Vec<(String, String)> = motion.columns.iter().cloned().zip(meanings).collect();
    Ok(move |name: &str| {
        pairs.iter().find(|(column, _)| column == name).map_or_else(String::new, |(_, doc)| doc.clone())
    })
}
