//! The functions that workers of a cluster call, and the identity of a process.

use flap_sweep::run::identity::build;
use flap_sweep::run::{self, RunOptions};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};

use crate::grid::Grid;
use crate::watch::Watch;
use crate::{error, sweep};

/// Run the points from `begin` up to, but not including, `end`. Return the rows as bytes. The argument
/// `chunks` of `sweep` is a function that must return such bytes: the bytes of the rows after the finished
/// rows. If `first` is given, the points are a part of a larger grid, and `first` is the index of the first
/// point in the larger grid.
#[pyfunction]
#[pyo3(signature = (grid, begin, end, /, *, first=None, threads=None))]
pub(crate) fn part<'py>(
    py: Python<'py>,
    grid: &Bound<'py, Grid>,
    begin: u64,
    end: u64,
    first: Option<u64>,
    threads: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyBytes>> {
    let plan = &grid.get().plan;
    let options = sweep::options(threads)?;
    if begin >= end || end > plan.selected() {
        let message = format!("there are no points {begin} to {end}: the grid has {}", plan.selected());
        return Err(PyValueError::new_err(message));
    }
    let mut watch = Watch::new(None);
    let ran = py.detach(|| {
        let chunk = run::chunk(plan, &options, begin..end, |run| watch.stops(run.progress()))?;
        chunk.beginning_at(first.unwrap_or(begin)).to_bytes()
    });
    watch.ended()?;
    Ok(PyBytes::new(py, &ran.map_err(|error| error::run(&error))?))
}

/// Return the identity of this process, a dictionary with `build` (a hash of the sources) and `arithmetic`.
/// Processes with the same identity compute rows that are equal to the last bit.
#[pyfunction]
pub(crate) fn identity(py: Python<'_>) -> PyResult<Bound<'_, PyDict>> {
    let dict = PyDict::new(py);
    dict.set_item("build", build())?;
    dict.set_item("arithmetic", RunOptions::default().instructions.arithmetic().name())?;
    Ok(dict)
}
