//! The best design within the axes of a grid.

use std::cell::{Cell, RefCell};
use std::num::NonZeroUsize;

use flap_sweep::grid;
use flap_sweep::notation::text;
use flap_sweep::run::Progress;
use flap_sweep::study::optimum::{self, Aim, Optimum, Problem, ProblemError, ProblemPart, Settings};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::run::row_to_dict;
use crate::watch::Watch;
use crate::{convert, design, error, sweep};

/// Find the best design; see `flapwing.optimise`.
#[pyfunction]
#[pyo3(signature = (design, keywords, /, *, goal, is_largest, conditions, starts, sample, threads=None, progress=None))]
#[expect(clippy::too_many_arguments, reason = "one per keyword")]
#[expect(clippy::needless_pass_by_value, reason = "what pyo3 extracts is owned")]
pub(crate) fn optimise<'py>(
    py: Python<'py>,
    design: &Bound<'py, PyAny>,
    keywords: &Bound<'py, PyDict>,
    goal: &str,
    is_largest: bool,
    conditions: Vec<String>,
    starts: &Bound<'py, PyAny>,
    sample: &Bound<'py, PyAny>,
    threads: Option<&Bound<'py, PyAny>>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let run = sweep::options(threads)?;
    let starts = usize::try_from(convert::count("starts", starts)?).unwrap_or(usize::MAX);
    let settings = Settings {
        run,
        starts: NonZeroUsize::new(starts).unwrap_or(NonZeroUsize::MIN),
        points: convert::count("sample", sample)?.into(),
    };
    let plan = design::plan(design, Some(keywords))?;
    let aim = if is_largest { Aim::Largest } else { Aim::Smallest };
    let problem = Problem::new(plan, goal, aim, &conditions)
        .map_err(|error| refused(&error, goal, is_largest, &conditions))?;
    let (found, watch) = py.detach(|| {
        let (watch, all) = (RefCell::new(Watch::new(progress)), Cell::new(0));
        let found = optimum::optimise(&problem, &settings, &|finished, points| {
            all.set(points);
            watch.borrow_mut().stops(Progress { finished, points })
        });
        let mut watch = watch.into_inner();
        if found.is_ok() {
            watch.done(all.get());
        }
        (found, watch)
    });
    watch.ended()?;
    let best = found.map_err(|error| error::run(&error))?;
    let best = best.ok_or_else(|| {
        PyValueError::new_err(
            "no point of the grid has a periodic motion with finite values of the goal and the conditions\n\
             `sweep` returns the status and the measures of each point",
        )
    })?;
    into_python(py, &problem, &best)
}

/// Returns the `ValueError` for an optimisation whose goal, conditions or plan contain a mistake.
fn refused(error: &ProblemError, goal: &str, is_largest: bool, conditions: &[String]) -> PyErr {
    let place = match error.part {
        ProblemPart::Plan => String::new(),
        ProblemPart::Goal if is_largest => format!("maximise {goal:?}: "),
        ProblemPart::Goal => format!("minimise {goal:?}: "),
        ProblemPart::Condition(number) => format!("where {:?}: ", conditions[number]),
    };
    error::with_help(format!("{place}{error}"), error.help.as_ref())
}

/// Returns the result of an optimisation as a dictionary (see `flapwing.Optimum`).
fn into_python<'py>(py: Python<'py>, problem: &Problem, best: &Optimum) -> PyResult<Bound<'py, PyDict>> {
    let plan = problem.plan();
    let values = |varied: &mut dyn Iterator<Item = (usize, f64)>| -> PyResult<Bound<'py, PyDict>> {
        let dict = PyDict::new(py);
        for (index, value) in varied {
            let parameter = &plan.parameters()[index];
            match text::option(parameter, value) {
                Some(option) => dict.set_item(parameter.name, option)?,
                None => dict.set_item(parameter.name, value)?,
            }
        }
        Ok(dict)
    };
    let names: Vec<&str> = plan.rows().columns().iter().map(|column| column.name.as_str()).collect();
    let dict = PyDict::new(py);
    dict.set_item("status", best.status.name())?;
    dict.set_item("value", best.goal)?;
    dict.set_item("values", values(&mut plan.differing().map(|index| (index, best.values[index])))?)?;
    dict.set_item("row", row_to_dict(py, &names, plan, &best.row)?)?;
    let mut active = Vec::new();
    for bound in &best.active {
        let entry = PyDict::new(py);
        entry.set_item("kind", bound.edge.name())?;
        entry.set_item("name", &bound.name)?;
        entry.set_item("limit", bound.limit)?;
        entry.set_item("multiplier", bound.per_unit)?;
        entry.set_item("percent", bound.percent)?;
        entry.set_item("text", bound.sentence(problem.goal()))?;
        active.push(entry);
    }
    dict.set_item("active", active)?;
    let mut conditions = Vec::new();
    for limit in &best.limits {
        let entry = PyDict::new(py);
        entry.set_item("text", &limit.text)?;
        entry.set_item("smaller", limit.sides[0])?;
        entry.set_item("larger", limit.sides[1])?;
        entry.set_item("excess", limit.excess)?;
        conditions.push(entry);
    }
    dict.set_item("conditions", conditions)?;
    let mut optima = Vec::new();
    for other in &best.optima {
        let entry = PyDict::new(py);
        entry.set_item("value", other.goal)?;
        entry.set_item("values", values(&mut other.varied.iter().copied())?)?;
        entry.set_item("is_feasible", other.is_feasible)?;
        entry.set_item("starts", other.starts)?;
        optima.push(entry);
    }
    dict.set_item("optima", optima)?;
    let at_end = PyDict::new(py);
    for (index, [from, to]) in &best.at_end {
        at_end.set_item(plan.parameters()[*index].name, (*from, *to))?;
    }
    dict.set_item("at_end", at_end)?;
    dict.set_item("starts", best.starts)?;
    dict.set_item("points", best.points)?;
    dict.set_item("points_computed", best.computed)?;
    dict.set_item("rows", best.rows)?;
    dict.set_item("rows_with_derivatives", best.sloped)?;
    dict.set_item("is_polished", best.is_polished)?;
    let device = match plan.vehicle() {
        Some(_) => String::new(),
        None => {
            grid::device(&plan.clone().of_point(&best.values)).map_err(|error| error::experiment(&error))?
        }
    };
    dict.set_item("device", device)?;
    Ok(dict)
}
