//! Computes the rows and the motions of single design points.

use flap_core::simulate::{Row, TrajectoryRequest};
use flap_sweep::notation::expression::Kind;
use flap_sweep::plan::Plan;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::evaluate::refused;
use crate::point::Chosen;
use crate::records::Wave;
use crate::watch::interruptible;
use crate::{begin, convert, error, motion};

/// Largest number of samples in a trajectory. All samples of a trajectory are in memory at the same time.
const SAMPLES_MAX: u64 = 5_000_000;

/// Run one point; see `flapwing.run`.
#[pyfunction]
#[pyo3(signature = (design, keywords, /, *, point=None, initial_state=None, waveform=None, stroke=None))]
pub(crate) fn run<'py>(
    py: Python<'py>,
    design: &Bound<'py, PyAny>,
    keywords: &Bound<'py, PyDict>,
    point: Option<&Bound<'py, PyAny>>,
    initial_state: Option<&Bound<'py, PyAny>>,
    waveform: Option<&Bound<'py, PyAny>>,
    stroke: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let wave = Wave::of(waveform, stroke, false)?;
    let chosen = Chosen::new(design, keywords, point, wave.as_ref())?;
    if initial_state.is_some() && wave.is_none() {
        chosen.plan.check_motions().map_err(|error| refused(&error))?;
    }
    let begin = initial_state.map(|state| begin::state(chosen.plan.simulator(), state)).transpose()?;
    let mut row = match &chosen.invalid {
        Some(reason) => Row::invalid(reason),
        None => interruptible(py, |interrupted| {
            chosen.rows().run_point(&chosen.run().until(interrupted), begin.as_deref())
        })?,
    };
    chosen.plan.add_own_measures(&chosen.values, &mut row.measures);
    let names: Vec<&str> = chosen.rows().columns().iter().map(|column| column.name.as_str()).collect();
    row_to_dict(py, &names, &chosen.plan, &row)
}

/// Sample the motion of one point; see `flapwing.trajectory`.
#[pyfunction]
#[pyo3(signature = (
    design, keywords, /, *, point, cycles, samples, from_rest, initial_state=None, waveform=None, stroke=None,
    once=false
))]
#[expect(clippy::too_many_arguments, reason = "one per keyword")]
pub(crate) fn trajectory<'py>(
    py: Python<'py>,
    design: &Bound<'py, PyAny>,
    keywords: &Bound<'py, PyDict>,
    point: Option<&Bound<'py, PyAny>>,
    cycles: &Bound<'py, PyAny>,
    samples: &Bound<'py, PyAny>,
    from_rest: bool,
    initial_state: Option<&Bound<'py, PyAny>>,
    waveform: Option<&Bound<'py, PyAny>>,
    stroke: Option<&Bound<'py, PyAny>>,
    once: bool,
) -> PyResult<Bound<'py, PyDict>> {
    let wave = Wave::of(waveform, stroke, once)?;
    let chosen = Chosen::new(design, keywords, point, wave.as_ref())?.for_motion(py)?;
    let (cycles, samples) = (convert::count("cycles", cycles)?, convert::count("samples", samples)?);
    // A record that is followed once has only one period.
    let cycles = if once { 1 } else { cycles };
    let all = u64::from(cycles) * u64::from(samples);
    if all > SAMPLES_MAX {
        let message =
            format!("{all} samples are too many: cycles times samples must be at most {SAMPLES_MAX}");
        return Err(PyValueError::new_err(message));
    }
    if from_rest && initial_state.is_some() {
        return Err(PyValueError::new_err(
            "from_rest and initial_state both set the beginning of the motion\nkeep one of them",
        ));
    }
    let begin = initial_state.map(|state| begin::state(chosen.plan.simulator(), state)).transpose()?;
    let settled = !from_rest && !once && begin.is_none();
    let request = TrajectoryRequest { cycles, samples_per_cycle: samples, settled };
    let sampled = interruptible(py, |interrupted| {
        let run = chosen.run().until(interrupted);
        chosen.simulator().motions()?.trajectory_from(&run, begin.as_deref(), &request)
    })?;
    let sampled = sampled.map_err(|reason| error::unfinished(&reason))?;
    let meanings = motion::meanings(chosen.simulator(), &sampled)?;
    motion::into_python(py, sampled, meanings, &chosen.meta(py)?)
}

/// Returns a row as a dictionary. The entry `measures` contains the measures of the model, with the names
/// `names`, and then the measures that the grid defines under `[measure]`. Unknown numbers and flags are NaN.
pub(crate) fn row_to_dict<'py>(
    py: Python<'py>,
    names: &[&str],
    plan: &Plan,
    row: &Row,
) -> PyResult<Bound<'py, PyDict>> {
    let measure = |index: usize| row.measures.get(index).copied().unwrap_or(f64::NAN);
    let measures = PyDict::new(py);
    for (i, name) in names.iter().enumerate() {
        measures.set_item(name, measure(i))?;
    }
    for (i, own) in plan.measures().iter().enumerate() {
        let value = measure(names.len() + i);
        match own.kind() {
            Kind::Condition if !value.is_nan() => measures.set_item(&own.name, value != 0.0)?,
            Kind::Condition | Kind::Number => measures.set_item(&own.name, value)?,
        }
    }
    let dict = PyDict::new(py);
    dict.set_item("status", row.status.name())?;
    dict.set_item("measures", measures)?;
    dict.set_item("cycles", row.cycles)?;
    dict.set_item("residual", row.residual)?;
    dict.set_item("period", row.period)?;
    dict.set_item("floquet_max", row.floquet_max)?;
    match row.stable() {
        Some(stable) => dict.set_item("stable", stable)?,
        None => dict.set_item("stable", f64::NAN)?,
    }
    dict.set_item("error_estimate", row.error_estimate)?;
    dict.set_item("rhs_evals", row.rhs_evals)?;
    dict.set_item("reason", row.reason.as_deref().unwrap_or_default())?;
    Ok(dict)
}
