//! Responses up and down.

use std::sync::Arc;
use std::thread;
use std::time::Duration;

use flap_core::parameter::Kind;
use flap_sweep::run::RunError;
use flap_sweep::study::response::{self, Along, AlongError, Motions, Verdict};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::columns::Columns;
use crate::watch::Watch;
use crate::{design, error, parameters, sweep};

/// The interval between looks at Ctrl-C and at the end of the work.
const LOOK: Duration = Duration::from_millis(2);

/// The column of the stroke amplitude.
const STROKE: &str = "stroke_amplitude_deg";

/// Follows responses; see `flapwing.respond`.
#[pyfunction]
#[pyo3(signature = (design, along, /, *, start=None, stop=None, step=None, tolerance=None, unstable=false, threads=None, keywords=None))]
#[expect(clippy::too_many_arguments, reason = "one per keyword")]
pub(crate) fn respond<'py>(
    py: Python<'py>,
    design: &Bound<'py, PyAny>,
    along: &str,
    start: Option<&Bound<'py, PyAny>>,
    stop: Option<&Bound<'py, PyAny>>,
    step: Option<&Bound<'py, PyAny>>,
    tolerance: Option<&Bound<'py, PyAny>>,
    unstable: bool,
    threads: Option<&Bound<'py, PyAny>>,
    keywords: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyDict>> {
    let options = sweep::options(threads)?;
    let plan = design::plan(design, keywords)?;
    if plan.resonance().is_some() {
        let message =
            "the grid runs each design at its own resonance: give drive_frequency a number, or follow it";
        return Err(PyValueError::new_err(message));
    }
    let index = parameters::index(plan.simulator(), along)?;
    let parameter = &plan.parameters()[index];
    let number = |value: Option<&Bound<'py, PyAny>>| match parameter.kind {
        // It is refused below.
        Kind::Choice(_) => Ok(None),
        Kind::Number(_) | Kind::Following(..) => {
            value.map(|value| parameters::value_of(parameter, value)).transpose()
        }
    };
    let steps = match [number(start)?, number(stop)?, number(step)?] {
        [Some(start), Some(stop), Some(step)] => Some([start, stop, step]),
        [None, None, None] => None,
        _ => {
            let message = format!("how `{along}` rises is not known: start, stop and step go together");
            return Err(PyValueError::new_err(message));
        }
    };
    let along = Along::new(plan, index, steps, number(tolerance)?, unstable);
    let (plan, along) = along.map_err(|AlongError { message, help }| {
        PyValueError::new_err(if help.is_empty() { message } else { format!("{message}: {help}") })
    })?;

    let motions = Motions::of(&plan, &along);
    let stroke = plan.rows().columns().iter().position(|column| column.name == STROKE);
    let stroke = stroke.ok_or_else(|| PyValueError::new_err("the model measures no stroke"))?;
    let mut columns = Columns::new(motions.columns());
    let mut verdicts = Vec::new();
    let mut watch = Watch::new(None);
    let raised = Arc::clone(&watch.stop);
    let ran: Result<(), RunError> = py.detach(|| {
        thread::scope(|scope| {
            let follow = scope.spawn(|| {
                response::run(&plan, &along, options.threads, &raised, |curve| {
                    let verdict = Verdict::new(&curve, parameter, stroke);
                    verdicts.push(verdict.to_string());
                    for cells in motions.rows(&curve) {
                        columns.push(cells);
                    }
                    Ok(())
                })
            });
            while !follow.is_finished() {
                watch.look(0, 0);
                thread::park_timeout(LOOK);
            }
            follow.join().unwrap_or_else(|_| Err(RunError::Panic("while following a response".to_owned())))
        })
    });
    watch.ended()?;
    ran.map_err(|error| error::run(&error))?;
    let meta = sweep::meta(py, &plan, &options)?;
    meta.set_item("along", parameter.name)?;
    meta.set_item("verdicts", verdicts)?;
    let dict = PyDict::new(py);
    dict.set_item("columns", columns.into_python(py)?)?;
    dict.set_item("meta", meta)?;
    Ok(dict)
}
