//! Converts the initial states that a Python user gives. An initial state is the state at the start of a
//! drive period.

use flap_core::simulate::Simulator;
use flap_sweep::table::labels::split_unit;
use numpy::PyReadonlyArray2;
use numpy::ndarray::ArrayView1;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::parameters::did_you_mean;
use crate::{convert, error};

/// Returns the state vector for a dictionary of components. A component is a number in the unit of its name,
/// or text with a unit. Components that are not given are zero.
///
/// The name of a component ends with its unit, as in `pitch_rad` and `pitch_deg`. A component without a unit
/// in its name, such as `pitch`, is in the unit of the state (rad).
pub(crate) fn state(model: &dyn Simulator, begin: &Bound<'_, PyAny>) -> PyResult<Vec<f64>> {
    let Ok(begin) = begin.cast::<PyDict>() else {
        let found = begin.get_type().name()?;
        let message = format!(
            "`initial_state` is {found}\nit must be a dictionary of components such as {{\"pitch\": \"10 deg\"}}, or a table of one row"
        );
        return Err(PyTypeError::new_err(message));
    };
    let states = model.gradients().map_err(|reason| error::unfinished(&reason))?.states();
    let mut values = vec![0.0; states.len()];
    let mut given = vec![false; states.len()];
    for (name, value) in begin {
        let name: String = name.extract().map_err(|_| {
            PyTypeError::new_err("names in `initial_state` must be text\nsuch as {\"pitch\": \"10 deg\"}")
        })?;
        let (index, factor) = component(&states, &name)?;
        if std::mem::replace(&mut given[index], true) {
            let message = format!("`initial_state` gives {} twice\nkeep one of them", states[index]);
            return Err(PyValueError::new_err(message));
        }
        let (_, unit) = split_unit(&states[index]);
        values[index] =
            factor * convert::quantity(&format!("initial_state[{name:?}]"), unit, factor == 1.0, &value)?;
    }
    Ok(values)
}

/// Returns one initial state for each row of an array. The initial state is `None` if a component in the row
/// is NaN. An infinite component is a `ValueError`.
pub(crate) fn rows(begin: &PyReadonlyArray2<'_, f64>) -> PyResult<Vec<Option<Vec<f64>>>> {
    let state = |(number, row): (usize, ArrayView1<'_, f64>)| {
        if row.iter().any(|y| y.is_infinite()) {
            let message = format!("row {number} of `initial_state` has an infinite component");
            return Err(PyValueError::new_err(message + "\ngive finite numbers, or nan for a start at rest"));
        }
        Ok(row.iter().all(|y| !y.is_nan()).then(|| row.iter().copied().collect()))
    };
    begin.as_array().rows().into_iter().enumerate().map(state).collect()
}

/// Returns the index of the component `name` in the state vector. Also returns the factor from the unit of
/// `name` to the unit of the state.
fn component(states: &[String], name: &str) -> PyResult<(usize, f64)> {
    for (index, state) in states.iter().enumerate() {
        let (words, unit) = split_unit(state);
        if name == state || name == words {
            return Ok((index, 1.0));
        }
        // Names in degrees, as in trajectories: stroke_deg, stroke_rate_deg_s.
        let in_degrees = state.replace("rad", "deg");
        if unit.contains("rad") && name == in_degrees {
            return Ok((index, 1.0_f64.to_radians()));
        }
    }
    let known: Vec<&str> = states.iter().map(|state| split_unit(state).0).collect();
    let hint = did_you_mean(name, &known);
    let message =
        format!("`initial_state` has no component `{name}`{hint}\nthe states are {}", states.join(", "));
    Err(PyValueError::new_err(message))
}

/// Return the names of the states in the equations of motion of a design or a model. Each name ends with the unit.
#[pyfunction]
#[pyo3(signature = (design, /))]
pub(crate) fn states(design: &Bound<'_, PyAny>) -> PyResult<Vec<String>> {
    let model = crate::listing::model(design)?;
    Ok(model.gradients().map_err(|reason| error::unfinished(&reason))?.states())
}
