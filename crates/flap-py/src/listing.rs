//! Lists of parameters and measures.

use flap_core::parameter::Kind;
use flap_core::simulate;
use flap_sweep::notation::text;
use flap_sweep::plan::Robot;
use pyo3::prelude::*;

use crate::grid;

/// Name, value, unit, symbol, meaning, allowed, options.
type Listed = (String, Option<Value>, &'static str, &'static str, String, String, Vec<&'static str>);

/// A parameter and its standard error in SI units.
type StandardError = (String, f64);

/// Two parameters and the coefficient of their correlation.
type Correlated = (String, String, f64);

/// A number, or the name of an option.
#[derive(IntoPyObject)]
pub(crate) enum Value {
    Number(f64),
    Option(&'static str),
}

/// The parameters of a design or a model; see `flapwing.params`.
#[pyfunction]
#[pyo3(signature = (design, /))]
pub(crate) fn params(design: &Bound<'_, PyAny>) -> PyResult<Vec<Listed>> {
    let (model, values) = find(design)?;
    let listed = model.parameters().iter().zip(values).map(|(parameter, value)| {
        let (allowed, options) = match parameter.kind {
            Kind::Number(range) => (range.describe(), Vec::new()),
            Kind::Following(range, follows) => {
                (format!("{}; if not set, {follows}", range.describe()), Vec::new())
            }
            Kind::Choice(options) => (options.join(" | "), options.to_vec()),
        };
        let value = if value.is_nan() {
            None
        } else {
            Some(text::option(parameter, value).map_or(Value::Number(value), Value::Option))
        };
        let (name, doc) = (parameter.name.to_owned(), parameter.doc.to_owned());
        (name, value, parameter.unit, parameter.symbol, doc, allowed, options)
    });
    let listed = listed.collect();
    Ok(listed)
}

/// The measures of a design or a model: names, each with unit and meaning; see `flapwing.measures`.
#[pyfunction]
#[pyo3(signature = (design, /))]
pub(crate) fn measures(design: &Bound<'_, PyAny>) -> PyResult<Vec<(String, &'static str, String)>> {
    let (model, _) = find(design)?;
    Ok(model.columns().iter().map(|column| (column.name.clone(), column.unit, column.doc.clone())).collect())
}

/// The standard errors of the parameters of a design in SI units, by name, and the correlations: two names and a coefficient.
#[pyfunction]
#[pyo3(signature = (design, /))]
pub(crate) fn uncertainty(design: &Bound<'_, PyAny>) -> PyResult<(Vec<StandardError>, Vec<Correlated>)> {
    let plan = grid::plan(design)?;
    let name = |index: usize| plan.parameters()[index].name.to_owned();
    let known = plan.uncertainty();
    let errors = known.errors().iter().map(|(index, error)| (name(*index), *error)).collect();
    let correlations =
        known.correlations().iter().map(|one| (name(one.between[0]), name(one.between[1]), one.coefficient));
    let correlations = correlations.collect();
    Ok((errors, correlations))
}

/// The model of a design, or the model itself.
pub(crate) fn model(design: &Bound<'_, PyAny>) -> PyResult<Robot> {
    Ok(find(design)?.0)
}

/// The model of a preset or another design with its values, or a model with none.
fn find(design: &Bound<'_, PyAny>) -> PyResult<(Robot, Vec<f64>)> {
    let model = design.extract::<String>().ok().and_then(|name| simulate::by_name(&name));
    if let Some(model) = model {
        return Ok((Robot::Wing(model), vec![f64::NAN; model.parameters().len()]));
    }
    let plan = grid::plan(design)?;
    Ok((plan.robot().clone(), plan.point(0).values))
}
