//! Lists of parameters and measures.

use flap_core::parameter::Kind;
use flap_core::simulate::{self, Simulator};
use flap_sweep::notation::text;
use pyo3::prelude::*;

use crate::parameters;

/// Name, value, unit, symbol, meaning, allowed, options.
type Listed =
    (&'static str, Option<Value>, &'static str, &'static str, &'static str, String, Vec<&'static str>);

/// A number, or the name of an option.
#[derive(IntoPyObject)]
pub(crate) enum Value {
    Number(f64),
    Option(&'static str),
}

/// The parameters of a preset or a model; see `flapwing.params`.
#[pyfunction]
#[pyo3(signature = (name, /))]
pub(crate) fn params(name: &Bound<'_, PyAny>) -> PyResult<Vec<Listed>> {
    let (model, values) = find(name)?;
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
        (parameter.name, value, parameter.unit, parameter.symbol, parameter.doc, allowed, options)
    });
    Ok(listed.collect())
}

/// The measures of a preset or a model: names, each with unit and meaning; see `flapwing.measures`.
#[pyfunction]
#[pyo3(signature = (name, /))]
pub(crate) fn measures(name: &Bound<'_, PyAny>) -> PyResult<Vec<(String, &'static str, String)>> {
    let (model, _) = find(name)?;
    Ok(model.columns().iter().map(|column| (column.name.clone(), column.unit, column.doc.clone())).collect())
}

/// The model of a preset, or the model itself.
pub(crate) fn model(name: &Bound<'_, PyAny>) -> PyResult<&'static dyn Simulator> {
    Ok(find(name)?.0)
}

/// The model of a preset with its values, or a model with none.
fn find(name: &Bound<'_, PyAny>) -> PyResult<(&'static dyn Simulator, Vec<f64>)> {
    let model = name.extract::<String>().ok().and_then(|name| simulate::by_name(&name));
    if let Some(model) = model {
        return Ok((model, vec![f64::NAN; model.parameters().len()]));
    }
    let (model, preset) = parameters::find_preset(name)?;
    Ok((model, (preset.values)()))
}
