//! One design point at a time.

use flap_core::num::InstructionSet;
use flap_core::simulate::{Column, Row};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::parameters;
use crate::solver::Keywords;

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

/// Run one design point until its motion repeats with the drive, then measure one drive period.
///
/// The preset's parameters hold except those given as keywords::
///
///     run("ozaki2018-large", drive_voltage_pp="80 V", hinge_stiffness=9e-5, lift_sign="printed")
///
/// The same call gives the same bits every time. Other Python threads go on meanwhile.
///
/// Parameters
/// ----------
/// preset : str
///     One of `presets()`. It names the model too.
/// rtol : float, optional
///     Relative tolerance of the integrator, per step and state: more than 0 and less than 0.1.
///     Default 1e-6.
/// atol : float, optional
///     Absolute tolerance of the integrator, in units of each state's typical size: more than 0.
///     Default rtol / 100.
/// settle_tol : float, optional
///     The point has settled when its state changes by less than this from one drive period to the
///     next, in units of each state's typical size (of the motion's own size, if that is smaller):
///     more than 0. Default 1e-6.
/// max_cycles : int, optional
///     Drive periods after which the point counts as unsettled: 1 or more. Default 1000.
/// max_steps : int, optional
///     Integration steps within one drive period after which the point is given up: 1 or more.
///     Default 20000.
/// **parameters : float or str
///     Parameters of the model by name: a number in SI units, text with a unit such as
///     ``"1.5 uN*m/rad"``, or the name of an option where there are options to choose from.
///
/// Returns
/// -------
/// dict
///     One row of results; the keys and their order are the same for every point of a model:
///
///     status : str
///         ``"periodic"``; ``"subharmonic"`` (repeats every 2 to 8 drive periods); ``"unsettled"``
///         (max_cycles reached); ``"diverged"``; ``"step_limit"`` (max_steps reached, or steps too small
///         to advance time); ``"invalid"`` (each parameter is in range, but together they are
///         impossible).
///     measures : float or None
///         Several keys, named after what is measured, how and in which unit: ``stroke_pp_deg``,
///         ``lift_mean_mn``, ``power_mean_mw``. All are None unless the point is periodic; a ratio of
///         nothing to nothing, such as efficiency without power, is nan.
///     cycles : int
///         Drive periods integrated, the measured one included.
///     residual : float or None
///         Change of the state over the last period of the motion, in the units of settle_tol. None if
///         no period was completed.
///     period : int
///         Drive periods until the motion repeats: 1 if periodic, more if subharmonic, otherwise 0.
///     floquet_max : float or None
///         Factor by which a change of the motion grows or decays per orbit in the end. None if no orbit was
///         found.
///     stable : bool or None
///         Whether floquet_max is below 1, so that motions near the orbit approach it. None if no orbit was
///         found.
///     rhs_evals : int
///         Evaluations of the equations of motion.
///     reason : str or None
///         Why the point is invalid; None if it is not.
///
/// Raises
/// ------
/// ValueError
///     Unknown preset, parameter, option or unit; a value out of range, infinite or not a number. The
///     message gives the nearest name and what is allowed.
/// TypeError
///     A value of the wrong type, such as text for a tolerance or a number for an option.
#[pyfunction]
#[pyo3(signature = (
    preset, /, *,
    rtol=None, atol=None, settle_tol=None, max_cycles=None, max_steps=None,
    **parameters
))]
#[expect(clippy::too_many_arguments, reason = "one per keyword")]
pub(crate) fn run<'py>(
    py: Python<'py>,
    preset: &Bound<'py, PyAny>,
    rtol: Option<&Bound<'py, PyAny>>,
    atol: Option<&Bound<'py, PyAny>>,
    settle_tol: Option<&Bound<'py, PyAny>>,
    max_cycles: Option<&Bound<'py, PyAny>>,
    max_steps: Option<&Bound<'py, PyAny>>,
    parameters: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyDict>> {
    let solver = Keywords { rtol, atol, settle_tol, max_cycles, max_steps }.settings()?;
    let (simulator, preset) = parameters::find_preset(preset)?;
    let values = parameters::values(simulator, preset, parameters)?;
    let row = py.detach(|| simulator.run_point(InstructionSet::best(), &solver, &values, None));
    row_to_dict(py, simulator.columns(), &row)
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
    dict.set_item("rhs_evals", row.rhs_evals)?;
    dict.set_item("reason", row.reason.as_deref())?;
    Ok(dict)
}
