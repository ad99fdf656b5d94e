//! Batches of points, given as columns of parameters.

use flap_core::parameter::Kind;
use flap_sweep::notation::text;
use flap_sweep::plan::gradient::NoDerivative;
use flap_sweep::plan::{ChangeError, Plan};
use numpy::{PyArray1, PyArrayMethods, PyReadonlyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::grid::Grid;
use crate::{begin, design, parameters};

/// Return a batch of points as a grid that `sweep` and `part` run; see `flapwing.evaluate`.
///
/// `columns` has a one-dimensional array of float64 or a list of text for each varied parameter, all of the same
/// length. `initial_state` has one row of state components per point. If a row contains nan, the point begins
/// at rest. A pickle of the returned grid stores only the text of the grid, which contains neither the
/// columns nor the keyword arguments.
#[pyfunction]
#[pyo3(signature = (
    design, columns, /, *, measures=None, gradient=None, initial_state=None, return_states=false, keywords=None
))]
pub(crate) fn batch<'py>(
    design: &Bound<'py, PyAny>,
    columns: &Bound<'py, PyDict>,
    measures: Option<Vec<String>>,
    gradient: Option<Vec<String>>,
    initial_state: Option<PyReadonlyArray2<'py, f64>>,
    return_states: bool,
    keywords: Option<&Bound<'py, PyDict>>,
) -> PyResult<Grid> {
    if let Some(keywords) = keywords {
        refuse_twice(columns, keywords)?;
    }
    let (mut plan, set) = match design::plan_of_model(design, keywords)? {
        Some((plan, set)) => (plan, Some(set)),
        None => (design::plan(design, keywords)?, None),
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
    if let Some(mut set) = set {
        set.extend(given.iter().map(|(index, _)| *index));
        plan = design::alone(plan, &set)?;
    }
    if let Some(measures) = measures {
        plan = with_columns(plan, &measures)?;
    }
    let mut plan = plan.crossed_with(given).map_err(|error| refused(&error))?;
    if let Some(names) = gradient {
        plan = with_slopes(plan, &names)?;
    }
    if let Some(states) = initial_state {
        plan = plan.with_initial_states(begin::rows(&states)?).map_err(|error| refused(&error))?;
    }
    if return_states {
        plan = plan.with_states().map_err(|error| refused(&error))?;
    }
    Ok(Grid { plan })
}

/// Check that a design accepts `keywords` and has the measures `measures`. A mistake raises the same
/// exception as in `batch`.
#[pyfunction]
#[pyo3(signature = (design, /, *, keywords, measures=None))]
pub(crate) fn check(
    design: &Bound<'_, PyAny>,
    keywords: &Bound<'_, PyDict>,
    measures: Option<Vec<String>>,
) -> PyResult<()> {
    let plan = design::plan(design, Some(keywords))?;
    measures.map_or(Ok(()), |measures| with_columns(plan, &measures).map(drop))
}

/// Returns an error if a parameter is given both as a column and as a keyword argument. Without the check,
/// the column would silently replace the keyword argument.
fn refuse_twice(columns: &Bound<'_, PyDict>, keywords: &Bound<'_, PyDict>) -> PyResult<()> {
    for name in keywords.keys() {
        if columns.contains(&name)? {
            let message = format!("`{name}` is a column and a keyword: keep one of them");
            return Err(PyValueError::new_err(message));
        }
    }
    Ok(())
}

/// Returns the index of the parameter with the name of the column, and the values of the column in SI units.
fn read(plan: &Plan, name: &str, column: &Bound<'_, PyAny>) -> PyResult<(usize, Vec<f64>)> {
    let index = parameters::index(plan.robot(), name)?;
    let parameter = &plan.parameters()[index];
    if let (Kind::Number(_) | Kind::Following(..), Ok(numbers)) =
        (&parameter.kind, column.cast::<PyArray1<f64>>())
    {
        return Ok((index, numbers.to_vec()?));
    }
    let values = column.try_iter()?.map(|value| parameters::value_of(parameter, &value?));
    Ok((index, values.collect::<PyResult<_>>()?))
}

/// Restricts the rows of a plan to the given measures, and returns the changed plan.
fn with_columns(plan: Plan, names: &[String]) -> PyResult<Plan> {
    let known: Vec<String> = plan.measured().map(str::to_owned).collect();
    plan.with_columns(names).map_err(|error| match error {
        ChangeError::NoColumn(name) if known.contains(&name) => {
            PyValueError::new_err(format!("`measures` has {name} twice\nkeep one of them"))
        }
        ChangeError::NoColumn(name) => {
            let names: Vec<&str> = known.iter().map(String::as_str).collect();
            let hint = parameters::did_you_mean(&name, &names);
            let listed = text::listed(names, "measure");
            PyValueError::new_err(format!("there is no measure `{name}`{hint}\nmeasures: {listed}"))
        }
        other => refused(&other),
    })
}

/// Adds derivatives with respect to the given parameters to the rows of a plan, and returns the changed plan.
fn with_slopes(plan: Plan, names: &[String]) -> PyResult<Plan> {
    let mut by = Vec::with_capacity(names.len());
    for name in names {
        let index = parameters::index(plan.robot(), name)?;
        if by.contains(&index) {
            return Err(PyValueError::new_err(format!("`gradient` has {name} twice\nkeep one of them")));
        }
        by.push(index);
    }
    plan.with_slopes(by).map_err(|error| match &error {
        ChangeError::NoDerivative(_, reason) => {
            let help = match reason {
                NoDerivative::Unset(_) => "\nset it, as a column or as a keyword".to_owned(),
                other if other.help().is_empty() => String::new(),
                other => format!("\n{}", other.help()),
            };
            PyValueError::new_err(format!("{error}{help}"))
        }
        ChangeError::NoSlope(_) => PyValueError::new_err(format!("{error}\nremove it from `measures`")),
        _ => refused(&error),
    })
}

/// Returns the exception for columns or initial states that cannot be used with a plan.
pub(crate) fn refused(error: &ChangeError) -> PyErr {
    match error {
        ChangeError::TooManyPoints(_) => PyValueError::new_err("too many points"),
        ChangeError::AtResonance => PyValueError::new_err(
            "the grid runs each design at its resonance, which excludes derivatives and initial states\n\
             set drive_frequency to a number, or follow it",
        ),
        ChangeError::OfBody => {
            PyValueError::new_err(format!("{error}\nremove trim and damping from the vehicle"))
        }
        ChangeError::States(states, points) => {
            let message = format!(
                "`initial_state` has {states} rows for {points} points\nit must have one row per point"
            );
            PyValueError::new_err(message)
        }
        other => design::refused("a column", other),
    }
}
