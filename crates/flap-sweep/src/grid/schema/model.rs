//! JSON schemas of one model: for each parameter as a value, as an axis and as a distribution, and for the
//! sections that contain parameters.

use std::fmt::Write as _;

use flap_core::parameter::{Kind, Parameter, Preset, Range};
use flap_core::simulate::{Column, Simulator};
use serde_json::{Map, Value, json};

use super::sections::{self, about, capitalized};
use crate::grid::sample::{FILE_KEYS, KEYS as SAMPLE_KEYS, METHODS, OF, distribution};
use crate::grid::uncertainty::{CORRELATION_KEYS, VALUE_KEYS};
use crate::grid::{gradient, output, range};
use crate::notation::text;
use crate::notation::units::prefixed;
use crate::plan::axes::Axes;
use crate::plan::sample::SamplePoints;
use crate::resonance::{AT_RESONANCE, DRIVE_FREQUENCY, measures};
use crate::table::layout::{Fixed, RUN};

/// Returns JSON schemas of keys such as `n` of a range and `sd` of a distribution. The schemas of these keys
/// are the same for all parameters.
pub(super) fn shared() -> Map<String, Value> {
    let keys = ["n", "step", "scale", "sd", "relative_sd", "source"];
    sections::properties(keys, |key| match key {
        "n" => sections::count("Number of values, both ends included.", Axes::MAX_POINTS),
        "step" => sections::quantity("Distance between values, in place of `n`.", false),
        "scale" => sections::choice("Spacing of the values. Default: linear.", &range::SCALES),
        "sd" => sections::positive("Standard deviation in the unit of the parameter.", false),
        "relative_sd" => {
            sections::positive("Standard deviation as a share of the value, such as \"5 %\".", false)
        }
        _ => sections::text("Source of the value, as free text."),
    })
}

/// Returns the JSON schema of a single value of parameter number `place`.
pub(super) fn value(model: &dyn Simulator, place: usize, defaults: Option<&Preset>) -> Value {
    let parameter = &model.parameters()[place];
    let description = description(model, place);
    let mut schema = match parameter.kind {
        Kind::Choice(options) => sections::choice(&description, options),
        Kind::Number(allowed) | Kind::Following(allowed, _) => {
            let mut schema = sections::quantity(&description, !parameter.unit.is_empty());
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

/// Adds the allowed range of a parameter to the JSON schema of its value.
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

/// Returns the default value of a parameter in the form that a grid file contains, for example as text with a
/// unit.
fn default_of(parameter: &Parameter, value: f64) -> Value {
    match parameter.kind {
        Kind::Choice(_) => json!(text::value(parameter, value)),
        _ if parameter.unit.is_empty() => json!(value),
        _ => json!(prefixed(value, parameter.unit)),
    }
}

/// Returns text about a parameter: its meaning, symbol, unit and range, and its values in the presets.
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
        let value = if value.is_nan() { "not set".to_owned() } else { text::shown(parameter, value) };
        let _ = write!(lines, "\n\n{}: {value}", preset.name);
    }
    lines
}

/// Returns the meaning of a parameter as a sentence.
fn meaning(parameter: &Parameter) -> String {
    capitalized(parameter.doc.trim_end_matches('.')) + "."
}

/// Returns text that describes the unit and the range of a parameter.
fn numbers(unit: &str, range: Range) -> String {
    let form = if unit.is_empty() {
        "A number, or text such as \"5 %\"".to_owned()
    } else {
        format!("A number in {unit}, or text with a unit")
    };
    format!("\n\n{form}; {}.", range.describe())
}

/// Returns the JSON schema of a table that contains a value and its standard error. `value` is the schema of
/// the value alone.
pub(super) fn uncertain(parameter: &Parameter, value: &Value) -> Value {
    let keys =
        sections::properties(
            VALUE_KEYS,
            |key| if key == "value" { value.clone() } else { sections::to(key) },
        );
    let mut table =
        sections::table(&format!("{}\n\nA value with its standard error.", meaning(parameter)), keys);
    table["required"] = json!(["value"]);
    table["not"] = json!({"required": ["sd", "relative_sd"]});
    table
}

/// Returns the JSON schema of an axis of a parameter: a list or a range of values. `value` is the schema of
/// one value.
pub(super) fn axis(parameter: &Parameter, value: &Value) -> Value {
    let meaning = meaning(parameter);
    if let Kind::Choice(_) = parameter.kind {
        return json!({
            "description": format!("{meaning}\n\nA list of options."),
            "type": "array", "items": value, "minItems": 1,
        });
    }
    let keys = sections::properties(range::KEYS, |key| match key {
        "from" | "to" => value.clone(),
        _ => sections::to(key),
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

/// Returns the JSON schema of a distribution of a parameter, or of a list of its values. `value` is the
/// schema of one value.
pub(super) fn distribution(parameter: &Parameter, value: &Value) -> Value {
    if let Kind::Choice(_) = parameter.kind {
        return axis(parameter, value);
    }
    let keys = sections::properties(distribution::KEYS, |key| match key {
        "scale" | "sd" | "relative_sd" => sections::to(key),
        _ => value.clone(),
    });
    let normal: Vec<Value> = ["mean", "sd", "relative_sd"].map(|key| json!({"required": [key]})).into();
    json!({
        "description": format!(
            "{}\n\nUniform distribution: {{ from, to }}. Normal distribution: {{ mean, sd }} or {{ relative_sd }}. Or a list of values.",
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

/// Adds the JSON schemas of a model to `definitions`: schemas of each parameter, and, under the model's name,
/// the schema of its sections.
pub(super) fn define(
    model: &'static dyn Simulator,
    defaults: Option<&Preset>,
    definitions: &mut Map<String, Value>,
) {
    let name = model.name();
    for (place, parameter) in model.parameters().iter().enumerate() {
        let values = reference(name, parameter, "value");
        for (role, schema) in [
            ("value", value(model, place, defaults)),
            ("uncertain", uncertain(parameter, &values)),
            ("axis", axis(parameter, &values)),
            ("distribution", distribution(parameter, &values)),
        ] {
            definitions.insert(key(name, parameter, role), schema);
        }
    }
    let columns = measures(model);
    definitions.insert(format!("{name}.{MEASURE}"), one_of(&columns, &[]));
    definitions.insert(format!("{name}.{COLUMN}"), one_of(&columns, &RUN));
    definitions.insert(name.to_owned(), sections(model));
}

/// Last part of the name of the JSON schema that lists the measures of a model.
const MEASURE: &str = "measure";
/// Last part of the name of the JSON schema that lists the columns of a model.
const COLUMN: &str = "column";

/// Returns the name of the JSON schema of a parameter. `role` is the use of the parameter, for example
/// "axis".
fn key(model: &str, parameter: &Parameter, role: &str) -> String {
    format!("{model}.{}.{role}", parameter.name)
}

fn reference(model: &str, parameter: &Parameter, role: &str) -> Value {
    sections::to(&key(model, parameter, role))
}

fn sections(model: &'static dyn Simulator) -> Value {
    let is_number = |parameter: &&Parameter| !matches!(parameter.kind, Kind::Choice(_));
    let (all, numbers) = (model.parameters(), model.parameters().iter().filter(is_number));
    let of_role = |role: &'static str| move |parameter: &Parameter| reference(model.name(), parameter, role);
    let formula = sections::text("A formula in SI units, such as \"2 * wing_length\".");
    let mut zip = keyed(about("zip"), all, of_role("axis"));
    zip["minProperties"] = json!(1);
    let [measure, column] = [MEASURE, COLUMN].map(|kind| sections::to(&format!("{}.{kind}", model.name())));
    json!({
        "properties": {
            "params": keyed(about("params"), all, |parameter| single(model, parameter)),
            "correlation": correlation(all),
            "axes": keyed(about("axes"), all, of_role("axis")),
            "zip": {"description": about("zip"), "type": "array", "items": zip},
            "sample": sample(&keyed("The sampled parameters with their distributions.", all, of_role("distribution"))),
            "derived": keyed(about("derived"), numbers, |_| formula.clone()),
            "gradient": gradient(model.parameters(), &measure),
            "output": output(&column),
        },
        // Without measures of the user, the names of columns are known.
        "if": {"required": ["measure"]},
        "else": {"properties": {
            "gradient": {"properties": {"of": {"items": measure}}},
            "output": {"properties": {"columns": {"items": column}}},
        }},
    })
}

/// Returns the JSON schema of a table that can have a key for each parameter.
fn keyed<'p>(
    description: &str,
    parameters: impl IntoIterator<Item = &'p Parameter<'p>>,
    schema: impl Fn(&Parameter) -> Value,
) -> Value {
    let keys = parameters.into_iter().map(|parameter| (parameter.name.to_owned(), schema(parameter)));
    sections::table(description, keys.collect())
}

/// Returns a JSON schema that accepts a single value of a parameter, or a table with a value and its standard
/// error. For the drive frequency, the schema also accepts the word "resonance".
fn single(model: &'static dyn Simulator, parameter: &Parameter) -> Value {
    let value = reference(model.name(), parameter, "value");
    let uncertain = reference(model.name(), parameter, "uncertain");
    let word = json!({"const": AT_RESONANCE, "description": "The drive frequency of each design is the resonance of this design."});
    let alone = if parameter.name == DRIVE_FREQUENCY { json!({"anyOf": [value, word]}) } else { value };
    // The conditions decide. The list with the empty schema shows both forms to editors.
    json!({"anyOf": [{}, alone, uncertain], "if": {"type": "object"}, "then": uncertain, "else": alone})
}

/// Returns the JSON schema of the list of correlations, each of which is between two parameters.
fn correlation(parameters: &[Parameter]) -> Value {
    let name = json!({"enum": names(parameters, |kind| !matches!(kind, Kind::Choice(_)))});
    let keys = sections::properties(CORRELATION_KEYS, |key| match key {
        "between" => {
            let mut pair = sections::list("Two parameters with standard errors.", &name);
            pair["minItems"] = json!(2);
            pair["maxItems"] = json!(2);
            pair
        }
        _ => json!({
            "description": "Correlation of the two parameters.", "type": "number", "exclusiveMinimum": -1, "exclusiveMaximum": 1,
        }),
    });
    let mut pair = sections::table(about("correlation"), keys);
    pair["required"] = json!(CORRELATION_KEYS);
    json!({"description": about("correlation"), "type": "array", "items": pair})
}

/// Returns the names of the parameters for whose kind `is_wanted` returns true.
fn names<'p>(parameters: &[Parameter<'p>], is_wanted: impl Fn(Kind<'p>) -> bool) -> Vec<&'p str> {
    parameters.iter().filter(|parameter| is_wanted(parameter.kind)).map(|parameter| parameter.name).collect()
}

fn sample(parameters: &Value) -> Value {
    let mut keys = SAMPLE_KEYS.to_vec();
    keys.extend(FILE_KEYS.iter().filter(|key| !SAMPLE_KEYS.contains(key)));
    let properties = sections::properties(keys, |key| match key {
        "method" => sections::choice("The method that spreads the points over the design space.", &METHODS),
        "n" => sections::count("Number of points.", SamplePoints::MAX_POINTS),
        "seed" => json!({
            "description": "Seed of the random points: another seed gives other points. Default: 0.",
            "type": "integer", "minimum": 0,
        }),
        "of" => sections::choice(
            "The sampled parameters are all parameters of the device that have standard errors.",
            &OF,
        ),
        "path" => sections::text("The file of points, relative to the folder of the grid file."),
        _ => parameters.clone(),
    });
    let mut table = sections::table(about("sample"), properties);
    table["required"] = json!(["method"]);
    table["if"] = json!({"properties": {"method": {"const": "file"}}});
    table["then"] = json!({"propertyNames": {"enum": FILE_KEYS}, "required": ["path"]});
    table["else"] = json!({
        "propertyNames": {"enum": SAMPLE_KEYS},
        "required": ["n"],
        "if": {"required": ["of"]},
        "then": {"not": {"required": ["parameters"]}},
        "else": {"required": ["parameters"]},
    });
    table["properties"]["parameters"]["minProperties"] = json!(1);
    table["properties"]["parameters"]["maxProperties"] = json!(SamplePoints::MAX_DIMENSIONS);
    table
}

fn gradient(parameters: &[Parameter], measure: &Value) -> Value {
    let has_shares = |kind| !matches!(kind, Kind::Choice(_) | Kind::Number(Range::Whole(..)));
    let name = json!({"enum": names(parameters, has_shares)});
    let keys = sections::properties(gradient::KEYS, |key| match key {
        "of" => sections::list("Measures of the model or of [measure].", &or_own(measure)),
        _ => sections::list("Parameters with a value, which are neither derived nor choices.", &name),
    });
    let mut table = sections::table(about("gradient"), keys);
    table["required"] = json!(gradient::KEYS);
    table
}

fn output(column: &Value) -> Value {
    let keys = sections::properties(output::KEYS, |key| match key {
        "path" => sections::text(
            "Result file, relative to the working directory: .csv, .csv.zst or .parquet; - for stdout.",
        ),
        _ => sections::list(
            "Columns to write after the status, in this order. Default: all columns.",
            &or_own(column),
        ),
    });
    sections::table(about("output"), keys)
}

/// Returns a JSON schema that accepts any name, because users can define their own measures. The schema
/// contains the `known` names so that editors offer these names.
fn or_own(known: &Value) -> Value {
    json!({"anyOf": [known, {"type": "string"}]})
}

/// Returns a JSON schema that accepts the names of the given columns: measures, and columns about the run
/// such as `cycles`.
fn one_of(measures: &[Column], run: &[Fixed]) -> Value {
    let measures = measures.iter().map(|column| (column.name.as_str(), column.doc.as_str()));
    let run = run.iter().map(|column| (column.name, column.doc));
    let (names, docs): (Vec<&str>, Vec<&str>) = measures.chain(run).unzip();
    json!({"enum": names, "x-taplo": {"docs": {"enumValues": docs}}})
}
