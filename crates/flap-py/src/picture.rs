//! Colours, default measures and computations that pictures share with `flap plot`.

use flap_sweep::picture::branches::{BRANCHES, Comparison, Way, compared};
use flap_sweep::picture::measures::{Role, usual};
use flap_sweep::picture::{colours as table, sample, scale};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Return the colours of pictures.
///
/// `series` is a list, and `branches` has one colour for each branch. `dark`, `plain` and `bistable` are single
/// colours.
#[pyfunction]
pub(crate) fn colours(py: Python<'_>) -> PyResult<Bound<'_, PyDict>> {
    let branches = PyDict::new(py);
    for branch in BRANCHES {
        branches.set_item(branch.name, branch.colour)?;
    }
    let found = PyDict::new(py);
    found.set_item("series", table::SERIES)?;
    found.set_item("branches", branches)?;
    found.set_item("dark", table::DARK)?;
    found.set_item("plain", table::PLAIN)?;
    found.set_item("bistable", table::BISTABLE)?;
    Ok(found)
}

/// Return the colours of `count` ordered lines, as positions in the sequential colour map. Return None for a
/// single line.
#[pyfunction]
#[pyo3(signature = (count, /))]
pub(crate) fn line_shades(count: usize) -> Option<Vec<f64>> {
    (0..count).map(|index| table::shade(index, count)).collect()
}

/// Return True if the range from `low` to `high` contains negative and positive numbers. A picture of
/// negative and positive numbers requires a diverging colour map with zero in the middle.
#[pyfunction]
#[pyo3(signature = (low, high, /))]
pub(crate) fn is_signed(low: f64, high: f64) -> bool {
    table::is_signed(low, high)
}

/// Return True if an axis or a colour bar with the rising values `values` is logarithmic.
#[pyfunction]
#[pyo3(signature = (values, /))]
#[expect(clippy::needless_pass_by_value, reason = "arrays are handed over so")]
pub(crate) fn is_log(values: PyReadonlyArray1<'_, f64>) -> PyResult<bool> {
    Ok(scale::is_log(values.as_slice()?))
}

/// Return the default measure for a purpose in pictures: a name in `columns` that is not in `taken`. Return
/// None if `columns` contains no default measure.
///
/// `role` is the purpose: "response", "benefit", "cost" or "motion".
#[pyfunction]
#[pyo3(signature = (role, columns, taken, /))]
#[expect(clippy::needless_pass_by_value, reason = "a list of Python's becomes a vector")]
pub(crate) fn usual_measure(
    role: &str,
    columns: Vec<String>,
    taken: Vec<String>,
) -> PyResult<Option<String>> {
    let role = Role::of(role).ok_or_else(|| PyValueError::new_err(format!("there is no role `{role}`")))?;
    let [columns, taken] =
        [&columns, &taken].map(|names| names.iter().map(String::as_str).collect::<Vec<_>>());
    Ok(usual(role, &columns, &taken).map(|place| columns[place].to_owned()))
}

type PyWay<'py> = (PyReadonlyArray1<'py, f64>, PyReadonlyArray1<'py, f64>, PyReadonlyArray1<'py, bool>);

/// The bands in which two branches differ, and the rows after which each branch jumps.
type Ways = (Vec<(f64, f64)>, [Vec<usize>; 2]);

/// Return the bands in which the branches up and down differ, and the rows after which each branch jumps.
///
/// `up` and `down` are the branches: arrays of the parameter, of the measure, and of the column `bistable`.
#[pyfunction]
#[pyo3(signature = (up, down, /))]
#[expect(clippy::needless_pass_by_value, reason = "arrays are handed over so")]
pub(crate) fn ways(up: PyWay<'_>, down: PyWay<'_>) -> PyResult<Ways> {
    let way = Way { x: up.0.as_slice()?, y: up.1.as_slice()?, bistable: up.2.as_slice()? };
    let back = Way { x: down.0.as_slice()?, y: down.1.as_slice()?, bistable: down.2.as_slice()? };
    let Comparison { bands, jumps } = compared(way, back);
    Ok((bands, jumps))
}

/// Edges and heights of the bars of a histogram.
type Bars<'py> = (Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>);

/// Return a histogram: edges and heights of the bars. Return None if no value is finite.
#[pyfunction]
#[pyo3(signature = (values, /))]
#[expect(clippy::needless_pass_by_value, reason = "arrays are handed over so")]
pub(crate) fn bars<'py>(py: Python<'py>, values: PyReadonlyArray1<'py, f64>) -> PyResult<Option<Bars<'py>>> {
    let found = sample::histogram(values.as_slice()?);
    Ok(found.map(|found| {
        let counts = found.counts.iter().map(|&count| count as f64);
        (PyArray1::from_vec(py, found.edges), PyArray1::from_iter(py, counts))
    }))
}

/// Return the index of each parameter and its rank correlation with a measure, in falling order of absolute value.
///
/// The result leaves out parameters without a correlation. If two parameters rank the rows in the same order,
/// the result leaves out the second parameter.
#[pyfunction]
#[pyo3(signature = (parameters, measure, /))]
#[expect(clippy::needless_pass_by_value, reason = "arrays are handed over so")]
pub(crate) fn correlations(
    parameters: Vec<PyReadonlyArray1<'_, f64>>,
    measure: PyReadonlyArray1<'_, f64>,
) -> PyResult<Vec<(usize, f64)>> {
    let columns = parameters.iter().map(|column| column.as_slice()).collect::<Result<Vec<_>, _>>()?;
    Ok(sample::correlations(&columns, measure.as_slice()?))
}
