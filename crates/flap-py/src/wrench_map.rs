//! Quadratic maps of a vehicle's force and torque.

use std::cell::RefCell;

use flap_sweep::study::inputs;
use flap_sweep::study::wrench_map::{MapInput, WrenchMap, WrenchMapError};
use flap_sweep::vehicle::control::COMPONENTS;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::point::Chosen;
use crate::watch::Watch;
use crate::{convert, error, parameters, sweep};

/// Fit a quadratic map of force and torque; see `flapwing.wrench_map`. Each entry of `ranges` contains the
/// name, the smallest value and the largest value of an input.
#[pyfunction]
#[pyo3(signature = (design, keywords, /, *, point, ranges, samples, threads=None, progress=None))]
#[expect(clippy::too_many_arguments, reason = "one per keyword")]
#[expect(clippy::needless_pass_by_value, reason = "pyo3 extracts values")]
pub(crate) fn wrench_map<'py>(
    py: Python<'py>,
    design: &Bound<'py, PyAny>,
    keywords: &Bound<'py, PyDict>,
    point: Option<&Bound<'py, PyAny>>,
    ranges: Vec<(String, Bound<'py, PyAny>, Bound<'py, PyAny>)>,
    samples: &Bound<'py, PyAny>,
    threads: Option<&Bound<'py, PyAny>>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let options = sweep::options(threads)?;
    let samples = convert::count("samples", samples)?;
    let chosen = Chosen::new(design, keywords, point, None)?.at_hover(py)?;
    inputs::vehicle(&chosen.plan, "the design").map_err(|error| error::experiment(&error))?;
    let mut inputs = Vec::new();
    for (name, from, to) in &ranges {
        inputs.push(input(&chosen, name, from, to)?);
    }
    let (found, watch) = py.detach(|| {
        let watch = RefCell::new(Watch::new(progress));
        let found = WrenchMap::of(&chosen.plan, &chosen.values, inputs, samples, &options, |progress| {
            watch.borrow_mut().stops(progress)
        });
        if found.is_ok() {
            watch.borrow_mut().done(samples.into());
        }
        (found, watch.into_inner())
    });
    watch.ended()?;
    let found = found.map_err(|error| match error {
        WrenchMapError::Mistake(error) => error::experiment(&error),
        WrenchMapError::Run(error) => error::run(&error),
    });
    let map = found?.ok_or_else(|| PyValueError::new_err("interrupted"))?;
    into_python(py, &chosen, &map)
}

/// Returns the input `name` of the map, with the range from `from` to `to`.
fn input(chosen: &Chosen, name: &str, from: &Bound<'_, PyAny>, to: &Bound<'_, PyAny>) -> PyResult<MapInput> {
    let input = inputs::input(&chosen.plan, name).map_err(|error| error::argument("ranges", &error))?;
    let parameter = &chosen.plan.parameters()[input.parameter];
    let [from, to] = [from, to].map(|value| parameters::value_of(parameter, value));
    MapInput::new(&input, from?, to?).map_err(|error| error::experiment(&error))
}

/// Returns the map as a dictionary; see `flapwing.WrenchMap`.
fn into_python<'py>(py: Python<'py>, chosen: &Chosen, map: &WrenchMap) -> PyResult<Bound<'py, PyDict>> {
    let of_inputs = |get: fn(&MapInput) -> f64| map.inputs.iter().map(get).collect::<Vec<f64>>();
    let parameters: Vec<_> =
        map.inputs.iter().map(|input| &chosen.plan.parameters()[input.parameter]).collect();
    let [scaled, physical] = [&map.scaled, &map.physical()].map(|coefficients| {
        coefficients.row_iter().map(|row| row.iter().copied().collect()).collect::<Vec<Vec<f64>>>()
    });
    let rows = PyDict::new(py);
    for (name, count) in map.rows() {
        rows.set_item(name, count)?;
    }
    let dict = PyDict::new(py);
    dict.set_item("inputs", map.inputs.iter().map(|input| input.name.as_str()).collect::<Vec<_>>())?;
    dict.set_item("parameters", parameters.iter().map(|parameter| parameter.name).collect::<Vec<_>>())?;
    dict.set_item("units", parameters.iter().map(|parameter| parameter.unit).collect::<Vec<_>>())?;
    dict.set_item("start", of_inputs(|input| input.from))?;
    dict.set_item("stop", of_inputs(|input| input.to))?;
    dict.set_item("components", COMPONENTS.to_vec())?;
    dict.set_item("powers", map.powers())?;
    dict.set_item("scaled", scaled)?;
    dict.set_item("physical", physical)?;
    dict.set_item("r_squared", map.r_squared.to_vec())?;
    dict.set_item("largest_error", map.largest_error.to_vec())?;
    dict.set_item("rows", rows)?;
    dict.set_item("floquet_max", map.floquet_max)?;
    dict.set_item("warnings", map.warnings())?;
    Ok(dict)
}
