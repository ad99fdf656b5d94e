//! Computes responses: the motions of designs while a parameter rises and falls.

use flap_core::parameter::{Kind, Parameter};
use flap_sweep::notation::UserError;
use flap_sweep::plan::{Along, Plan};
use flap_sweep::run::{Outcome, RowWriter, Summary};
use flap_sweep::study::response::{BandKind, EdgeRange, Edges, Responses, Verdict};
use flap_sweep::table::layout::Layout;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::columns::Columns;
use crate::watch::{Watch, interruptible};
use crate::{design, error, parameters, sweep};

/// The column of the stroke amplitude.
const STROKE: &str = "stroke_amplitude_deg";

/// The verdict on the response of one design, as a dictionary.
#[derive(IntoPyObject)]
struct Judged {
    curve: u64,
    text: String,
    bands: Vec<Band>,
}

/// A bistable band: the ends of the band in SI units, and the stroke difference. The stroke difference is the
/// largest difference between the peak-to-peak strokes of the rising and the falling branch (deg). The stroke
/// difference is NaN if at every value in the band at least one branch has no periodic motion.
#[derive(IntoPyObject)]
struct Band {
    start: f64,
    stop: f64,
    stroke_difference_deg: f64,
}

impl Judged {
    fn new(curve: u64, verdict: &Verdict) -> Judged {
        let bands = verdict.bands.iter().filter_map(|band| match band.kind {
            BandKind::Bistable { jump } => Some(Band {
                start: band.range[0],
                stop: band.range[1],
                stroke_difference_deg: jump.unwrap_or(f64::NAN),
            }),
            BandKind::Irregular { .. } => None,
        });
        Judged { curve, text: verdict.to_string(), bands: bands.collect() }
    }
}

/// Compute responses; see `flapwing.respond`.
///
/// `curves` contains the indices of the designs whose responses are computed, in rising order. In the result,
/// `designs` is the number of all designs.
#[pyfunction]
#[pyo3(signature = (design, parameter, /, *, start=None, stop=None, step=None, tolerance=None, unstable=false, return_states=false, threads=None, progress=None, keywords=None, curves=None))]
#[expect(clippy::too_many_arguments, reason = "one per keyword")]
pub(crate) fn respond<'py>(
    py: Python<'py>,
    design: &Bound<'py, PyAny>,
    parameter: &str,
    start: Option<&Bound<'py, PyAny>>,
    stop: Option<&Bound<'py, PyAny>>,
    step: Option<&Bound<'py, PyAny>>,
    tolerance: Option<&Bound<'py, PyAny>>,
    unstable: bool,
    return_states: bool,
    threads: Option<&Bound<'py, PyAny>>,
    progress: Option<Py<PyAny>>,
    keywords: Option<&Bound<'py, PyDict>>,
    curves: Option<Vec<u64>>,
) -> PyResult<Bound<'py, PyDict>> {
    let options = sweep::options(threads)?;
    let (plan, along) = followed(design, parameter, [start, stop, step], tolerance, unstable, keywords)?;
    let mut plan = plan.following(along);
    if return_states {
        plan = plan.with_states().map_err(|error| PyValueError::new_err(error.to_string()))?;
    }
    if let Some(curves) = curves {
        plan = plan.with_points(curves).map_err(|error| PyValueError::new_err(error.to_string()))?;
    }
    let followed = plan.followed().zip(Responses::of(&plan));
    let (along, responses) = followed.ok_or_else(|| PyValueError::new_err("no parameter is followed"))?;
    let stroke = plan.rows().columns().iter().position(|column| column.name == STROKE);
    let stroke = stroke.ok_or_else(|| PyValueError::new_err("the model does not measure the stroke"))?;
    let mut columns = Columns::new(Layout::of(&plan).columns());
    let mut verdicts = Vec::new();
    let mut watch = Watch::new(progress);
    let ran = py.detach(|| {
        let mut output = RowWriter::begin(&plan, Summary::default(), &mut columns)?;
        let mut run = responses.curves(&options, 0);
        while let Some(batch) = run.next_batch()? {
            for curve in &batch {
                if let Outcome::Ran(curve) = curve {
                    let verdict = Verdict::new(curve, along, along.parameter(&plan), stroke);
                    verdicts.push(Judged::new(curve.design.index, &verdict));
                }
                output.write_curve(curve)?;
            }
            if watch.stops(run.progress()) {
                run.stop();
            }
        }
        output.finish(Ok(()))
    });
    if ran.is_ok() {
        watch.done(plan.selected());
    }
    watch.ended()?;
    ran.map_err(|error| error::run(&error))?;
    let meta = sweep::meta(py, &plan, &options)?;
    meta.set_item("verdicts", verdicts)?;
    let dict = PyDict::new(py);
    dict.set_item("columns", columns.into_python(py)?)?;
    dict.set_item("meta", meta)?;
    dict.set_item("designs", plan.len())?;
    Ok(dict)
}

/// Returns the plan of a design, and the parameter of the response with its steps.
///
/// # Errors
/// Returns a Python exception if the design or an argument contains a mistake.
fn followed<'py>(
    design: &Bound<'py, PyAny>,
    parameter: &str,
    [start, stop, step]: [Option<&Bound<'py, PyAny>>; 3],
    tolerance: Option<&Bound<'py, PyAny>>,
    unstable: bool,
    keywords: Option<&Bound<'py, PyDict>>,
) -> PyResult<(Plan, Along)> {
    let plan = design::plan(design, keywords)?;
    design::check_one_wing(&plan)?;
    if plan.resonance().is_some() {
        let message =
            "the grid runs each design at its resonance: set drive_frequency to a number, or follow it";
        return Err(PyValueError::new_err(message));
    }
    let index = parameters::index(plan.robot(), parameter)?;
    let parameter = &plan.parameters()[index];
    let number = |argument, value| number(argument, parameter, value);
    let steps = match [number("start", start)?, number("stop", stop)?, number("step", step)?] {
        [Some(start), Some(stop), Some(step)] => Some([start, stop, step]),
        [None, None, None] => None,
        _ => {
            let message = format!(
                "the values of `{}` are incomplete: start, stop and step are required together",
                parameter.name
            );
            return Err(PyValueError::new_err(message));
        }
    };
    let tolerance = number("tolerance", tolerance)?;
    Along::new(plan, index, steps, tolerance, unstable).map_err(|error| impossible(&error))
}

/// Converts the value of an argument to a number in the unit and range of a parameter. Returns `None` for a choice,
/// because the parameter of a response must be a number.
fn number(
    argument: &str,
    parameter: &Parameter<'_>,
    value: Option<&Bound<'_, PyAny>>,
) -> PyResult<Option<f64>> {
    match parameter.kind {
        Kind::Choice(_) => Ok(None),
        Kind::Number(_) | Kind::Following(..) => {
            let named = Parameter { name: argument, ..*parameter };
            value.map(|value| parameters::value_of(&named, value)).transpose()
        }
    }
}

fn impossible(error: &UserError) -> PyErr {
    PyValueError::new_err(error.line())
}

/// Compute the edges of hysteresis; see `flapwing.edges`. Each range is a first value, a last value and a
/// step.
#[pyfunction]
#[pyo3(signature = (design, first, second, /, *, first_range, second_range, tolerance=None, threads=None, keywords=None))]
#[expect(clippy::too_many_arguments, reason = "one per keyword")]
#[expect(clippy::needless_pass_by_value, reason = "pyo3 extracts values")]
pub(crate) fn edges<'py>(
    py: Python<'py>,
    design: &Bound<'py, PyAny>,
    first: &str,
    second: &str,
    first_range: [Option<Bound<'py, PyAny>>; 3],
    second_range: [Option<Bound<'py, PyAny>>; 3],
    tolerance: Option<&Bound<'py, PyAny>>,
    threads: Option<&Bound<'py, PyAny>>,
    keywords: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyDict>> {
    let options = sweep::options(threads)?;
    let steps = first_range.each_ref().map(Option::as_ref);
    let (plan, along) = followed(design, first, steps, tolerance, false, keywords)?;
    let index = parameters::index(plan.robot(), second)?;
    let parameter = &plan.parameters()[index];
    let [from, to, step] = second_range.each_ref().map(Option::as_ref);
    let [from, to, step] = [
        number("edge_start", parameter, from)?,
        number("edge_stop", parameter, to)?,
        number("edge_step", parameter, step)?,
    ];
    let limits = [from, to].map(|limit| limit.unwrap_or(f64::NAN));
    let second = EdgeRange::new(&plan, &along, index, limits, step).map_err(|error| impossible(&error))?;
    let plan = plan.following(along);
    let followed = plan.followed().zip(Responses::of(&plan));
    let (along, responses) = followed.ok_or_else(|| PyValueError::new_err("no parameter is followed"))?;
    let mut columns = Columns::new(Edges::columns(&plan, along, &second));
    let (mut lines, mut missed) = (Vec::new(), Vec::new());
    let ran = interruptible(py, |interrupted| {
        let mut run = responses.curves(&options, 0);
        while let Some(batch) = run.next_batch()? {
            for curve in &batch {
                let Outcome::Ran(curve) = curve else { continue };
                let edges = responses.edges(curve, &second, interrupted);
                lines.extend(edges.edges.iter().map(|edge| edge.verdict(&plan, along, &second)));
                missed.extend(edges.missed.iter().map(|value| (curve.design.index, *value)));
                edges.rows(&plan, &curve.design).iter().for_each(|row| columns.push(row));
            }
            if interrupted() {
                run.stop();
            }
        }
        Ok(())
    })?;
    ran.map_err(|error| error::run(&error))?;
    for (design, value) in missed {
        let text = format!("design {design}: no edge was found at {first} = {value}, where a band ends");
        error::warn(py, text)?;
    }
    let meta = sweep::meta(py, &plan, &options)?;
    meta.set_item("second_parameter", plan.parameters()[index].name)?;
    meta.set_item("edges", lines)?;
    let dict = PyDict::new(py);
    dict.set_item("columns", columns.into_python(py)?)?;
    dict.set_item("meta", meta)?;
    Ok(dict)
}
