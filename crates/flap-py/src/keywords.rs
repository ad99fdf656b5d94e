//! Writes the keyword arguments of a call into the text of a grid.

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use toml_edit::{DocumentMut, Item, TomlError, Value};

use crate::evaluate::check;
use crate::grid::{self, Grid};
use crate::grid_text;
use crate::solver::Keywords;

/// Return the grid with keywords as entries of its `[params]` and `[solver]`, and with `measures` as its columns.
#[pyfunction]
#[pyo3(signature = (grid, keywords, /, *, measures=None))]
pub(crate) fn with_keywords(
    py: Python<'_>,
    grid: &Bound<'_, Grid>,
    keywords: &Bound<'_, PyDict>,
    measures: Option<Vec<String>>,
) -> PyResult<Grid> {
    // Mistakes have the same messages as in other calls.
    check(grid, keywords, measures.clone())?;
    let source = grid.get().plan.source();
    let mut document: DocumentMut = source.text.parse().map_err(|error| refused(&error))?;
    let (settings, parameters) = Keywords::take(Some(keywords))?;
    for (name, value) in parameters {
        set(&mut document, "params", &name, &value)?;
    }
    for (name, value) in settings.entries() {
        set(&mut document, "solver", name, value)?;
    }
    if let Some(measures) = measures {
        let columns = PyList::new(py, measures)?;
        set(&mut document, "output", "columns", &columns)?;
    }
    Ok(Grid { plan: grid::parse(py, &source.name, &document.to_string())? })
}

/// Sets an entry of a table. All other entries, the comments and the order of tables do not change.
fn set(document: &mut DocumentMut, table: &str, name: &str, value: &Bound<'_, PyAny>) -> PyResult<()> {
    let value: Value = grid_text::inline(value, name, 1)?.parse().map_err(|error| refused(&error))?;
    if let Some(table) = document.entry(table).or_insert_with(toml_edit::table).as_table_like_mut() {
        table.insert(name, Item::Value(value));
    }
    Ok(())
}

fn refused(error: &TomlError) -> PyErr {
    PyValueError::new_err(error.to_string())
}
