//! The linear model of a vehicle about hover.

use flap_sweep::files::linear_model::LinearModel;
use flap_sweep::plan::Plan;
use flap_sweep::study::inputs;
use flap_sweep::vehicle::control::{Input, VehicleRun};
use flap_sweep::vehicle::hover::{self, component};
use flap_sweep::vehicle::trim;
use nalgebra::DMatrix;
use numpy::{PyArray1, PyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::error;
use crate::point::Chosen;
use crate::watch::interruptible;

/// Compute the linear model of a vehicle about hover; see `flapwing.Vehicle.linear`.
#[pyfunction]
#[pyo3(signature = (design, keywords, /, *, point=None, inputs=None, trim_to_hover=false, positions=false))]
pub(crate) fn linear<'py>(
    py: Python<'py>,
    design: &Bound<'py, PyAny>,
    keywords: &Bound<'py, PyDict>,
    point: Option<&Bound<'py, PyAny>>,
    inputs: Option<Vec<String>>,
    trim_to_hover: bool,
    positions: bool,
) -> PyResult<Bound<'py, PyDict>> {
    let chosen = Chosen::new(design, keywords, point, None)?.at_hover(py)?;
    let vehicle = inputs::vehicle(&chosen.plan, "the design").map_err(|error| error::experiment(&error))?;
    let is_usual = inputs.is_none();
    let inputs = match inputs {
        None => inputs::usual(&chosen.plan, &chosen.values).map_err(|error| error::experiment(&error))?,
        Some(names) => named(&chosen.plan, &names)?,
    };
    let targets = match trim_to_hover.then(|| hover::targets(&vehicle.mass_properties(&chosen.values))) {
        Some(None) => {
            return Err(PyValueError::new_err("trim: total_mass is not set\nset the mass of the vehicle"));
        }
        targets => targets.flatten(),
    };
    let design = format!("{} from {}", chosen.plan.simulator().name(), chosen.plan.preset());
    let model = interruptible(py, |interrupted| {
        let vehicle_run = VehicleRun { vehicle, solver: chosen.plan.solver(), interrupted };
        let mut at =
            vehicle_run.effectiveness(&chosen.values, &inputs, None).map_err(|error| error.to_string())?;
        if is_usual {
            at = at.without_idle(&vehicle_run, &chosen.values);
        }
        if let Some(targets) = &targets {
            at = trim::to_targets(&vehicle_run, &chosen.values, &at.inputs, targets)
                .map_err(|error| error.to_string())?
                .at;
        }
        let values = at.applied(&chosen.values);
        LinearModel::at(&vehicle_run, &values, &at, positions, design).map_err(|error| error.to_string())
    })?;
    let model = model.map_err(PyValueError::new_err)?;
    let held_constant = inputs::held_constant(&chosen.plan).map(str::to_owned);
    let warnings = held_constant.into_iter().chain(model.warnings()).collect();
    into_python(py, &model, warnings)
}

/// Returns the inputs with the names in the argument `inputs` of the Python function.
pub(crate) fn named(plan: &Plan, names: &[String]) -> PyResult<Vec<Input>> {
    inputs::named(plan, names).map_err(|error| error::argument("inputs", &error))
}

/// Returns the model as a dictionary; see `flapwing.LinearModel`.
fn into_python<'py>(
    py: Python<'py>,
    model: &LinearModel,
    warnings: Vec<String>,
) -> PyResult<Bound<'py, PyDict>> {
    let matrix = |matrix: &DMatrix<f64>| {
        PyArray2::from_owned_array(py, numpy::ndarray::Array2::from_shape_fn(matrix.shape(), |at| matrix[at]))
    };
    let hover = &model.hover;
    let size = hover.a.nrows();
    let damping = DMatrix::from_fn(6, 6, |i, j| hover.damping[(i, j)]);
    let (states, state_units): (Vec<&str>, Vec<&str>) = hover.states().iter().copied().unzip();
    let (real, imaginary): (Vec<f64>, Vec<f64>) =
        hover.eigenvalues().iter().map(|one| (one.re, one.im)).unzip();
    let modes = hover.modes.iter().flat_map(|mode| {
        let copies = if mode.eigenvalue.im > 0.0 { 2 } else { 1 };
        core::iter::repeat_n(mode.name(), copies)
    });
    let values = model.inputs.iter().map(|input| input.value);
    let dict = PyDict::new(py);
    dict.set_item("A", matrix(&hover.a))?;
    dict.set_item("B", matrix(&hover.b))?;
    dict.set_item("C", matrix(&DMatrix::identity(size, size)))?;
    dict.set_item("D", matrix(&DMatrix::zeros(size, model.inputs.len())))?;
    dict.set_item("damping", matrix(&damping))?;
    dict.set_item("control_matrix", matrix(&hover.control))?;
    dict.set_item("W0", PyArray1::from_slice(py, &hover.wrench))?;
    dict.set_item("residual", PyArray1::from_slice(py, &hover.residual()))?;
    dict.set_item("eigenvalues_real", PyArray1::from_vec(py, real))?;
    dict.set_item("eigenvalues_imag", PyArray1::from_vec(py, imaginary))?;
    dict.set_item("modes", modes.collect::<Vec<_>>())?;
    dict.set_item("states", states)?;
    dict.set_item("state_units", state_units)?;
    dict.set_item("inputs", model.inputs.iter().map(|input| input.name.as_str()).collect::<Vec<_>>())?;
    dict.set_item("input_units", model.inputs.iter().map(|input| input.unit.as_str()).collect::<Vec<_>>())?;
    dict.set_item("input_values", PyArray1::from_iter(py, values))?;
    dict.set_item("wrench", (0..6).map(component).collect::<Vec<_>>())?;
    dict.set_item("drive_frequency", model.frequency)?;
    dict.set_item("floquet_max", model.floquet_max)?;
    dict.set_item("warnings", warnings)?;
    Ok(dict)
}
