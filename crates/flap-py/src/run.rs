//! One design point at a time.

use flap_core::num::InstructionSet;
use flap_core::simulate::{Column, PointRun, Row, TrajectoryRequest};
use flap_sweep::table::layout::{Cell, Kind};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::columns::{self, Columns};
use crate::watch::interruptible;
use crate::{convert, design, error, parameters};

/// The most samples of one trajectory: they are held in memory.
const SAMPLES_MAX: u64 = 5_000_000;

/// The names of the published parameter sets, each with its model.
///
/// Returns
/// -------
/// list of str
///     Names that `run` takes, such as ``"ozaki2018-large"``.
#[pyfunction]
pub(crate) fn presets() -> Vec<&'static str> {
    parameters::preset_names()
}

/// Runs one point; see `flapwing.run`.
#[pyfunction]
#[pyo3(signature = (preset, keywords, /))]
pub(crate) fn run<'py>(
    py: Python<'py>,
    preset: &Bound<'py, PyAny>,
    keywords: &Bound<'py, PyDict>,
) -> PyResult<Bound<'py, PyDict>> {
    let plan = design::point(preset, keywords)?;
    let (simulator, solver, values) = (plan.simulator(), plan.solver(), plan.point(0).values);
    let set = InstructionSet::best();
    let row = interruptible(py, |interrupted| {
        simulator.row(&PointRun::new(set, solver, &values).until(interrupted))
    })?;
    let row = row.map_err(|reason| error::unfinished(&reason))?;
    row_to_dict(py, simulator.columns(), &row)
}

/// Samples the motion of one point; see `flapwing.trajectory`.
#[pyfunction]
#[pyo3(signature = (preset, keywords, /, *, cycles, samples, from_rest))]
pub(crate) fn trajectory<'py>(
    py: Python<'py>,
    preset: &Bound<'py, PyAny>,
    keywords: &Bound<'py, PyDict>,
    cycles: &Bound<'py, PyAny>,
    samples: &Bound<'py, PyAny>,
    from_rest: bool,
) -> PyResult<Bound<'py, PyDict>> {
    let plan = design::point(preset, keywords)?;
    let (simulator, solver, values) = (plan.simulator(), plan.solver(), plan.point(0).values);
    let (cycles, samples) = (convert::count("cycles", cycles)?, convert::count("samples", samples)?);
    let all = u64::from(cycles) * u64::from(samples);
    if all > SAMPLES_MAX {
        let message = format!("{all} samples are too many: cycles times samples may be {SAMPLES_MAX}");
        return Err(PyValueError::new_err(message));
    }
    let request = TrajectoryRequest { cycles, samples_per_cycle: samples, settled: !from_rest };
    let set = InstructionSet::best();
    let motion = interruptible(py, |interrupted| {
        simulator.motions()?.trajectory(&PointRun::new(set, solver, &values).until(interrupted), &request)
    })?;
    let motion = motion.map_err(|reason| error::unfinished(&reason))?;
    let described = motion.columns.iter().map(|name| columns::named(name, Kind::Number));
    let mut columns = Columns::new(described.collect());
    for row in motion.rows {
        columns.push(&row.into_iter().map(Cell::Number).collect::<Vec<_>>());
    }
    let dict = PyDict::new(py);
    dict.set_item("columns", columns.into_python(py)?)?;
    Ok(dict)
}

/// A row as a dictionary, in the order of result files.
fn row_to_dict<'py>(py: Python<'py>, columns: &[Column], row: &Row) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    dict.set_item("status", row.status.name())?;
    for (i, column) in columns.iter().enumerate() {
        dict.set_item(&column.name, row.measures.get(i))?;
    }
    dict.set_item("cycles", row.cycles)?;
    dict.set_item("residual", (!row.residual.is_nan()).then_some(row.residual))?;
    dict.set_item("period", row.period)?;
    dict.set_item("floquet_max", (!row.floquet_max.is_nan()).then_some(row.floquet_max))?;
    dict.set_item("stable", row.stable())?;
    dict.set_item("error_estimate", (!row.error_estimate.is_nan()).then_some(row.error_estimate))?;
    dict.set_item("rhs_evals", row.rhs_evals)?;
    dict.set_item("reason", row.reason.as_deref())?;
    Ok(dict)
}
