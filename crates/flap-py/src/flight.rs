//! Flight of a vehicle over time.

use flap_core::simulate::Trajectory;
use flap_sweep::study::inputs;
use flap_sweep::vehicle::control::VehicleRun;
use flap_sweep::vehicle::flight::{self, FED_BACK, FlightError, FlightRequest};
use flap_sweep::vehicle::hover::STATES;
use nalgebra::DMatrix;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{IntoPyDict, PyDict};

use crate::point::Chosen;
use crate::watch::interruptible;
use crate::{convert, error, linear, motion, parameters};

/// Simulate the flight of a vehicle; see `flapwing.fly`.
#[pyfunction]
#[pyo3(signature = (design, keywords, /, *, point, seconds, disturbance, gains, inputs, averaged, samples))]
#[expect(clippy::too_many_arguments, reason = "one per keyword")]
#[expect(clippy::needless_pass_by_value, reason = "pyo3 extracts values")]
pub(crate) fn fly<'py>(
    py: Python<'py>,
    design: &Bound<'py, PyAny>,
    keywords: &Bound<'py, PyDict>,
    point: Option<&Bound<'py, PyAny>>,
    seconds: &Bound<'py, PyAny>,
    disturbance: Vec<(String, Bound<'py, PyAny>)>,
    gains: Option<Vec<Vec<f64>>>,
    inputs: Vec<String>,
    averaged: bool,
    samples: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let chosen = Chosen::new(design, keywords, point, None)?.at_hover(py)?;
    let vehicle = inputs::vehicle(&chosen.plan, "the design").map_err(|error| error::experiment(&error))?;
    let mut start = [0.0; FED_BACK];
    for (name, value) in &disturbance {
        let Some(state) = STATES[..FED_BACK].iter().position(|(state, _)| state == name) else {
            let known: Vec<&str> = STATES[..FED_BACK].iter().map(|(state, _)| *state).collect();
            let near = parameters::did_you_mean(name, &known);
            let help = if near.is_empty() { format!("\nthe states are {}", known.join(", ")) } else { near };
            return Err(PyValueError::new_err(format!("disturbance: no state is called `{name}`{help}")));
        };
        start[state] = convert::quantity(&format!("disturbance[{name:?}]"), STATES[state].1, true, value)?;
    }
    let inputs = linear::named(&chosen.plan, &inputs)?;
    let gains =
        gains.map(|rows| DMatrix::from_fn(rows.len(), rows.first().map_or(0, Vec::len), |i, j| rows[i][j]));
    let request = FlightRequest {
        seconds: convert::quantity("seconds", "s", true, seconds)?,
        disturbance: start,
        inputs,
        gains,
        is_averaged: averaged,
        samples: samples.map(|samples| convert::count("samples", samples)).transpose()?,
    };
    let record = interruptible(py, |interrupted| {
        let vehicle_run = VehicleRun { vehicle, solver: chosen.plan.solver(), interrupted };
        flight::fly(&vehicle_run, &chosen.values, &request)
    })?;
    let record = record.map_err(|error: FlightError| PyValueError::new_err(error.to_string()))?;
    let columns = vehicle_columns(&chosen);
    let table = chosen.plan.parameters();
    let inputs = request.inputs.iter().map(|input| (&input.name, &table[input.parameter]));
    let units = inputs.clone().map(|(name, parameter)| (name, parameter.unit)).into_py_dict(py)?;
    let inputs = inputs.map(|(name, parameter)| (name.clone(), parameter.name.to_owned()));
    let inputs: Vec<(String, String)> = inputs.collect();
    let meaning = |name: &str| {
        let mut known = inputs.iter().chain(&columns);
        known.find(|(known, _)| known == name).map_or_else(|| state_meaning(name), |(_, doc)| doc.clone())
    };
    let made = Trajectory { columns: record.columns, rows: record.rows };
    let dict = motion::into_python(py, made, meaning, &chosen.meta(py)?)?;
    dict.set_item("units", units)?;
    let held_constant = inputs::held_constant(&chosen.plan).filter(|_| !inputs.is_empty());
    dict.set_item(
        "warnings",
        held_constant.map(str::to_owned).into_iter().chain(record.end).collect::<Vec<_>>(),
    )?;
    Ok(dict)
}

/// Returns the names and the descriptions of the columns of force and torque.
fn vehicle_columns(chosen: &Chosen) -> Vec<(String, String)> {
    let columns = chosen.simulator().columns().iter();
    columns.map(|column| (column.name.clone(), column.doc.clone())).collect()
}

/// Returns the description of a column of the body's motion.
fn state_meaning(name: &str) -> String {
    let meaning = match name {
        "time_s" => "time since the beginning of the flight",
        name if name.starts_with("velocity") => "velocity in body axes",
        name if name.starts_with("rate") => "angular velocity in body axes",
        name if name.starts_with("angle") => {
            "angle of the body: yaw, then pitch, then roll lead to its attitude"
        }
        name if name.starts_with("position") => "position in fixed axes",
        _ => "",
    };
    meaning.to_owned()
}
