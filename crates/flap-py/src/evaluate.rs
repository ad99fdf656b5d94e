//! A batch of points, given as columns of parameters.

use flap_core::parameter::Kind;
use flap_sweep::plan::Plan;
use numpy::{PyArray1, PyArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::{design, parameters, sweep};

/// Runs a batch of points; see `flapwing.evaluate`. `columns` has a one-dimensional array of float64, or a list of text,
/// for each parameter that varies, all as long.
#[pyfunction]
#[pyo3(signature = (design, columns, /, *, threads=None, progress=None, keywords=None))]
pub(crate) fn evaluate<'py>(
    py: Python<'py>,
    design: &Bound<'py, PyAny>,
    columns: &Bound<'py, PyDict>,
    threads: Option<&Bound<'py, PyAny>>,
    progress: Option<Py<PyAny>>,
    keywords: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyDict>> {
    let options = sweep::options(threads)?;
    if let Some(keywords) = keywords {
        refuse_twice(columns, keywords)?;
    }
    let of_model = design::plan_of_model(design, keywords)?;
    let is_model = of_model.is_some();
    let mut plan = match of_model {
        Some(plan) => plan,
        None => design::plan(design, keywords)?,
    };
    let given = columns.iter().map(|(name, column)| read(&plan, &name.extract::<String>()?, &column));
    let given = given.collect::<PyResult<Vec<_>>>()?;
    let Some(length) = given.first().map(|(_, values)| values.len()) else {
        return Err(PyValueError::new_err("there are no columns: give a parameter with its values"));
    };
    if let Some((index, values)) = given.iter().find(|(_, values)| values.len() != length) {
        let (name, first) = (plan.parameters()[*index].name, plan.parameters()[given[0].0].name);
        let message =
            format!("columns differ in length: `{first}` has {length} values, `{name}` has {}", values.len());
        return Err(PyValueError::new_err(message));
    }
    if is_model {
        refuse_missing(&plan, &given)?;
    }
    if let Some(index) = plan.varied().chain(plan.derived.parameters()).find(|index| is_given(*index, &given))
    {
        let message = format!(
            "`{}` is a column, and the grid varies or derives it: keep one of them",
            plan.parameters()[index].name
        );
        return Err(PyValueError::new_err(message));
    }
    if !plan.cross(given) {
        return Err(PyValueError::new_err("too many points"));
    }
    sweep::into_columns(py, &plan, &options, progress, None)
}

/// A parameter has one place: a keyword would be lost behind a column.
fn refuse_twice(columns: &Bound<'_, PyDict>, keywords: &Bound<'_, PyDict>) -> PyResult<()> {
    for name in keywords.keys() {
        if columns.contains(&name)? {
            let message = format!("`{name}` is a column and a keyword: keep one of them");
            return Err(PyValueError::new_err(message));
        }
    }
    Ok(())
}

fn is_given(index: usize, given: &[(usize, Vec<f64>)]) -> bool {
    given.iter().any(|(given, _)| *given == index)
}

/// The values of a column.
fn read(plan: &Plan, name: &str, column: &Bound<'_, PyAny>) -> PyResult<(usize, Vec<f64>)> {
    let index = parameters::index(plan.simulator, name)?;
    let parameter = &plan.parameters()[index];
    if let (Kind::Number(_) | Kind::Following(..), Ok(numbers)) =
        (&parameter.kind, column.cast::<PyArray1<f64>>())
    {
        return Ok((index, numbers.to_vec()?));
    }
    let values = column.try_iter()?.map(|value| parameters::value_of(parameter, &value?));
    Ok((index, values.collect::<PyResult<_>>()?))
}

/// A model has no values of its own: those that nothing follows from must be given.
fn refuse_missing(plan: &Plan, given: &[(usize, Vec<f64>)]) -> PyResult<()> {
    let missing = plan.parameters().iter().enumerate().filter(|(index, parameter)| {
        !matches!(parameter.kind, Kind::Following(..))
            && plan.base[*index].is_nan()
            && !is_given(*index, given)
    });
    let missing: Vec<&str> = missing.map(|(_, parameter)| parameter.name).collect();
    if missing.is_empty() {
        return Ok(());
    }
    let message = format!(
        "model `{}` has no values of its own: give {} too, or start from a preset",
        plan.simulator.name(),
        missing.join(", ")
    );
    Err(PyValueError::new_err(message))
}
