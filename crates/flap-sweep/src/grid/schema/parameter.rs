//! The schemas of one parameter: of a value, of values along an axis, and of a distribution.

use std::fmt::Write as _;

use flap_core::parameter::{Kind, Parameter, Preset, Range};
use flap_core::simulate::Simulator;
use serde_json::{Map, Value, json};

use super::super::range;
use super::super::sample::distribution;
use super::super::uncertainty::VALUE_KEYS;
use super::part;
use super::sections::capitalized;
use crate::notation::text;
use crate::notation::units::prefixed;
use crate::plan::axes::Axes;

/// The definitions that all parameters share: of numbers that describe values along axes and their distributions.
pub(super) fn shared() -> Map<String, Value> {
    let keys = ["n", "step", "scale", "sd", "relative_sd", "source"];
    part::properties(keys, |key| match key {
        "n" => part::count("Number of values, both ends included.", Axes::MAX_POINTS),
        "step" => part::quantity("Distance between values, in place of `n`.", false),
        "scale" => part::choice("Spacing of the values. Default: linear.", &range::SCALES),
        "sd" => part::positive("Standard deviation in the unit of the parameter.", false),
        "relative_sd" => {
            part::positive("Standard deviation as a share of the value, such as \"5 %\".", false)
        }
        _ => part::text("The place that the value comes from, in your words."),
    })
}

/// A single value of the parameter with this place in the model's table.
pub(super) fn value(model: &dyn Simulator, place: usize, defaults: Option<&Preset>) -> Value {
    let parameter = &model.parameters()[place];
    let description = description(model, place);
    let mut schema = match parameter.kind {
        Kind::Choice(options) => part::choice(&description, options),
        Kind::Number(allowed) | Kind::Following(allowed, _) => {
            let mut schema = part::quantity(&description, !parameter.unit.is_empty());
            limit(&mut schema, allowed);
            schema
        }
    };
    let default = defaults.map(|preset| (preset.values)()[place]).filter(|value| !value.is_nan());
    if let Some(default) = default {
        schema["default"] = default_of(parameter, default);
    }
    schema
}

/// Puts the range of numbers into the schema.
fn limit(schema: &mut Value, allowed: Range) {
    let limits = match allowed {
        Range::Any => vec![],
        Range::NonNegative => vec![("minimum", json!(0))],
        Range::Positive => vec![("exclusiveMinimum", json!(0))],
        Range::Between(low, high) => {
            vec![("exclusiveMinimum", json!(low)), ("exclusiveMaximum", json!(high))]
        }
        Range::Share => vec![("minimum", json!(0)), ("maximum", json!(1))],
        Range::Whole(first, last) => {
            vec![("minimum", json!(first)), ("maximum", json!(last)), ("multipleOf", json!(1))]
        }
    };
    for (key, limit) in limits {
        schema[key] = limit;
    }
}

/// A default as a user writes it.
fn default_of(parameter: &Parameter, value: f64) -> Value {
    match parameter.kind {
        Kind::Choice(_) => json!(text::value(parameter, value)),
        _ if parameter.unit.is_empty() => json!(value),
        _ => json!(prefixed(value, parameter.unit)),
    }
}

/// Meaning, symbol, unit, range, and the values of the presets.
fn description(model: &dyn Simulator, place: usize) -> String {
    let parameter = &model.parameters()[place];
    let Parameter { unit, symbol, kind, .. } = parameter;
    let mut lines = meaning(parameter);
    if !symbol.is_empty() {
        let _ = write!(lines, " Symbol: {symbol}.");
    }
    match kind {
        Kind::Number(range) => lines += &numbers(unit, *range),
        Kind::Following(range, follows) => {
            lines += &numbers(unit, *range);
            let _ = write!(lines, "\n\nIf not set: {follows}.");
        }
        Kind::Choice(_) => {}
    }
    for preset in model.presets() {
        let value = (preset.values)()[place];
        let value = match kind {
            _ if value.is_nan() => "not set".to_owned(),
            Kind::Choice(_) => text::value(parameter, value),
            _ => prefixed(value, unit),
        };
        let _ = write!(lines, "\n\n{}: {value}", preset.name);
    }
    lines
}

/// The meaning as a sentence.
fn meaning(parameter: &Parameter) -> String {
    capitalized(parameter.doc.trim_end_matches('.')) + "."
}

/// Unit and range in words.
fn numbers(unit: &str, range: Range) -> String {
    let form = if unit.is_empty() {
        "A number, or text such as \"5 %\"".to_owned()
    } else {
        format!("A number in {unit}, or text with a unit")
    };
    format!("\n\n{form}; {}.", range.describe())
}

/// A value with its standard error. `value` is the schema of the value.
pub(super) fn uncertain(parameter: &Parameter, value: &Value) -> Value {
    let keys = part::properties(VALUE_KEYS, |key| if key == "value" { value.clone() } else { part::to(key) });
    let mut table = part::table(&format!("{}\n\nA value with its standard error.", meaning(parameter)), keys);
    table["required"] = json!(["value"]);
    table["not"] = json!({"required": ["sd", "relative_sd"]});
    table
}

/// The values of a parameter along an axis: a list, or a range. `value` is the schema of one of them.
pub(super) fn axis(parameter: &Parameter, value: &Value) -> Value {
    let meaning = meaning(parameter);
    if let Kind::Choice(_) = parameter.kind {
        return json!({
            "description": format!("{meaning}\n\nA list of options."),
            "type": "array", "items": value, "minItems": 1,
        });
    }
    let keys = part::properties(range::KEYS, |key| match key {
        "from" | "to" => value.clone(),
        _ => part::to(key),
    });
    json!({
        "description": format!(
            "{meaning}\n\nA list such as [1, 2, 5], or a range such as {{ from = 1, to = 5, n = 9 }} or \
             {{ from = 1, to = 5, step = 0.5 }}."
        ),
        "type": ["array", "object"],
        "items": value,
        "minItems": 1,
        "properties": keys,
        "additionalProperties": false,
        "required": ["from", "to"],
        "if": {"required": ["n"]},
        "then": {"not": {"type": "object", "required": ["step"]}},
        "else": {"required": ["step"]},
    })
}

/// The distribution of a parameter, or a list of values. `value` is the schema of a value.
pub(super) fn distribution(parameter: &Parameter, value: &Value) -> Value {
    if let Kind::Choice(_) = parameter.kind {
        return axis(parameter, value);
    }
    let keys = part::properties(distribution::KEYS, |key| match key {
        "scale" | "sd" | "relative_sd" => part::to(key),
        _ => value.clone(),
    });
    let normal: Vec<Value> = ["mean", "sd", "relative_sd"].map(|key| json!({"required": [key]})).into();
    json!({
        "description": format!(
            "{}\n\nEqually likely values: {{ from, to }}. Normal ones: {{ mean, sd }} or {{ relative_sd }}. Or a list.",
            meaning(parameter)
        ),
        "type": ["array", "object"],
        "items": value,
        "minItems": 1,
        "properties": keys,
        "additionalProperties": false,
        "if": {"anyOf": normal},
        "then": {"not": {"type": "object", "required": ["sd", "relative_sd"]}},
        "else": {"required": ["from", "to"]},
    })
}
