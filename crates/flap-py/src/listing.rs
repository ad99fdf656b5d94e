//! Lists the parameters and measures of designs.

use std::collections::BTreeMap;
use std::path::Path;

use flap_core::parameter::{Kind, Parameter};
use flap_core::simulate;
use flap_sweep::notation::text;
use flap_sweep::plan::Robot;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::{grid, parameters};

/// A parameter, as a dictionary.
#[derive(IntoPyObject)]
pub(crate) struct Listed {
    name: String,
    value: Value,
    unit: &'static str,
    symbol: &'static str,
    doc: String,
    allowed: String,
    options: Vec<String>,
}

/// A measure, as a dictionary.
#[derive(IntoPyObject)]
pub(crate) struct Measure {
    name: String,
    unit: &'static str,
    doc: String,
}

/// The standard errors of parameters in SI units, by name, and the correlation coefficients of pairs of parameters.
type Uncertainty = (BTreeMap<String, f64>, Vec<(String, String, f64)>);

/// The value of a parameter: a number, NaN if the value is not set, or the name of an option.
#[derive(IntoPyObject)]
pub(crate) enum Value {
    Number(f64),
    Option(String),
}

/// Return the parameters of a design or a model; see `flapwing.params`.
#[pyfunction]
#[pyo3(signature = (design, /))]
pub(crate) fn params(design: &Bound<'_, PyAny>) -> PyResult<Vec<Listed>> {
    let (model, values) = find(design)?;
    let listed = model.parameters().iter().zip(values).map(|(parameter, value)| {
        let options = match parameter.kind {
            Kind::Choice(options) => options.iter().copied().map(str::to_owned).collect(),
            Kind::Number(_) | Kind::Following(..) => Vec::new(),
        };
        let option = text::option(parameter, value);
        let value = option.map_or(Value::Number(value), |option| Value::Option(option.to_owned()));
        let (name, doc) = (parameter.name.to_owned(), parameter.doc.to_owned());
        let Parameter { unit, symbol, .. } = *parameter;
        Listed { name, value, unit, symbol, doc, allowed: parameter.kind.describe(), options }
    });
    let listed = listed.collect();
    Ok(listed)
}

/// Return the measures of a design or a model; see `flapwing.measures`.
#[pyfunction]
#[pyo3(signature = (design, /))]
pub(crate) fn measures(design: &Bound<'_, PyAny>) -> PyResult<Vec<Measure>> {
    let (model, _) = find(design)?;
    let listed = model.columns().iter().map(|column| Measure {
        name: column.name.clone(),
        unit: column.unit,
        doc: column.doc.clone(),
    });
    Ok(listed.collect())
}

/// Return the standard errors of a design's parameters by name, in SI units, and the correlations of pairs of parameters.
#[pyfunction]
#[pyo3(signature = (design, /))]
pub(crate) fn uncertainty(design: &Bound<'_, PyAny>) -> PyResult<Uncertainty> {
    let plan = grid::plan(design)?;
    let name = |index: usize| plan.parameters()[index].name.to_owned();
    let known = plan.uncertainty();
    let errors = known.errors().iter().map(|(index, error)| (name(*index), *error)).collect();
    let correlations = known.correlations().iter().map(|one| {
        let [first, second] = one.between.map(name);
        (first, second, one.coefficient)
    });
    Ok((errors, correlations.collect()))
}

/// Returns the model of a design. A design can also be the name of a model.
pub(crate) fn model(design: &Bound<'_, PyAny>) -> PyResult<Robot> {
    Ok(find(design)?.0)
}

/// Returns the model and the parameter values of a design. If the design is the name of a model, all values
/// are NaN.
fn find(design: &Bound<'_, PyAny>) -> PyResult<(Robot, Vec<f64>)> {
    let model = design.extract::<String>().ok().and_then(|name| simulate::by_name(&name));
    if let Some(model) = model {
        return Ok((Robot::of_wing(model), vec![f64::NAN; model.parameters().len()]));
    }
    if let Some(name) = grid::name(design)?
        && simulate::preset(&name).is_none()
        && !Path::new(&name).exists()
    {
        let (presets, models) =
            (parameters::presets(), simulate::all().iter().map(|model| model.name()).collect::<Vec<_>>());
        let hint = parameters::did_you_mean(&name, &[&presets[..], &models[..]].concat());
        let (presets, models) = (presets.join(", "), models.join(", "));
        return Err(PyValueError::new_err(format!(
            "there is no preset or model `{name}`{hint} (presets: {presets}; models: {models})"
        )));
    }
    let plan = grid::plan(design)?;
    Ok((plan.robot().clone(), plan.point(0).values))
}
