//! The sections of a grid file that differ between models.

use flap_core::parameter::{Kind, Parameter, Preset, Range};
use flap_core::simulate::{Column, Simulator};
use serde_json::{Map, Value, json};

use super::super::sample::{FILE_KEYS, KEYS as SAMPLE_KEYS, METHODS, OF};
use super::super::uncertainty::CORRELATION_KEYS;
use super::super::{gradient, output, resonance};
use super::sections::about;
use super::{parameter, part};
use crate::plan::sample::Design;
use crate::resonance::{DRIVE_FREQUENCY, measures};
use crate::table::fixed::{Fixed, RUN};

/// Puts the rules of a model into the definitions of a schema, under the model's name, and those of its parameters.
pub(super) fn define(
    model: &'static dyn Simulator,
    defaults: Option<&Preset>,
    definitions: &mut Map<String, Value>,
) {
    let name = model.name();
    for (place, parameter) in model.parameters().iter().enumerate() {
        let value = reference(name, parameter, "value");
        for (role, schema) in [
            ("value", parameter::value(model, place, defaults)),
            ("uncertain", parameter::uncertain(parameter, &value)),
            ("axis", parameter::axis(parameter, &value)),
            ("distribution", parameter::distribution(parameter, &value)),
        ] {
            definitions.insert(key(name, parameter, role), schema);
        }
    }
    let columns = measures(model);
    definitions.insert(format!("{name}.{MEASURE}"), one_of(&columns, &[]));
    definitions.insert(format!("{name}.{COLUMN}"), one_of(&columns, &RUN));
    definitions.insert(name.to_owned(), sections(model));
}

/// The definition of the names of measures.
const MEASURE: &str = "measure";
/// The definition of the names of columns.
const COLUMN: &str = "column";

/// The name of a definition.
fn key(model: &str, parameter: &Parameter, role: &str) -> String {
    format!("{model}.{}.{role}", parameter.name)
}

fn reference(model: &str, parameter: &Parameter, role: &str) -> Value {
    part::to(&key(model, parameter, role))
}

fn sections(model: &'static dyn Simulator) -> Value {
    let is_number = |parameter: &&Parameter| !matches!(parameter.kind, Kind::Choice(_));
    let (all, numbers) = (model.parameters(), model.parameters().iter().filter(is_number));
    let of_role = |role: &'static str| move |parameter: &Parameter| reference(model.name(), parameter, role);
    let formula = part::text("A formula in SI units, such as \"2 * wing_length\".");
    let mut zip = keyed(about("zip"), all, of_role("axis"));
    zip["minProperties"] = json!(1);
    let [measure, column] = [MEASURE, COLUMN].map(|kind| part::to(&format!("{}.{kind}", model.name())));
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

/// A table with a key for each parameter. Former names are accepted, but editors do not offer them.
fn keyed<'p>(
    description: &str,
    parameters: impl IntoIterator<Item = &'p Parameter<'p>>,
    schema: impl Fn(&Parameter) -> Value,
) -> Value {
    let (mut now, mut former) = (Map::new(), Map::new());
    for parameter in parameters {
        now.insert(parameter.name.to_owned(), schema(parameter));
        if !parameter.former.is_empty() {
            let rule = json!({
                "description": parameter.renamed(), "deprecated": true, "allOf": [schema(parameter)]
            });
            former.insert(format!("^{}$", parameter.former), rule);
        }
    }
    let mut table = part::table(description, now);
    if !former.is_empty() {
        table["patternProperties"] = Value::Object(former);
    }
    table
}

/// A single value, or a table with its standard error. The drive frequency may be the resonance.
fn single(model: &'static dyn Simulator, parameter: &Parameter) -> Value {
    let value = reference(model.name(), parameter, "value");
    let uncertain = reference(model.name(), parameter, "uncertain");
    let word = json!({"const": resonance::WORD, "description": "Each design is run at its own resonance."});
    let alone = if parameter.name == DRIVE_FREQUENCY { json!({"anyOf": [value, word]}) } else { value };
    // The conditions decide; the list with the empty schema names both forms for editors.
    json!({"anyOf": [{}, alone, uncertain], "if": {"type": "object"}, "then": uncertain, "else": alone})
}

/// Correlations between two parameters each.
fn correlation(parameters: &[Parameter]) -> Value {
    let name = json!({"enum": names(parameters, |kind| !matches!(kind, Kind::Choice(_)))});
    let keys = part::properties(CORRELATION_KEYS, |key| match key {
        "between" => {
            let mut pair = part::list("Two parameters with standard errors.", &name);
            pair["minItems"] = json!(2);
            pair["maxItems"] = json!(2);
            pair
        }
        _ => json!({
            "description": "Their correlation.", "type": "number", "exclusiveMinimum": -1, "exclusiveMaximum": 1,
        }),
    });
    let mut pair = part::table(about("correlation"), keys);
    pair["required"] = json!(CORRELATION_KEYS);
    json!({"description": about("correlation"), "type": "array", "items": pair})
}

/// The names of parameters of some kinds, former ones included.
fn names<'p>(parameters: &[Parameter<'p>], is_wanted: impl Fn(Kind) -> bool) -> Vec<&'p str> {
    let wanted = parameters.iter().filter(|parameter| is_wanted(parameter.kind));
    let names = wanted.flat_map(|parameter| [parameter.name, parameter.former]);
    names.filter(|name| !name.is_empty()).collect()
}

fn sample(parameters: &Value) -> Value {
    let mut keys = SAMPLE_KEYS.to_vec();
    keys.extend(FILE_KEYS.iter().filter(|key| !SAMPLE_KEYS.contains(key)));
    let properties = part::properties(keys, |key| match key {
        "method" => part::choice("The method by which points are spread.", &METHODS),
        "n" => part::count("Number of points.", Design::MAX_POINTS),
        "seed" => json!({
            "description": "Number of the sample: another seed gives another sample. Default: 0.",
            "type": "integer", "minimum": 0,
        }),
        "of" => part::choice("Builds of the device: all parameters with standard errors.", &OF),
        "path" => part::text("The file of points, relative to the folder of the grid file."),
        _ => parameters.clone(),
    });
    let mut table = part::table(about("sample"), properties);
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
    table["properties"]["parameters"]["maxProperties"] = json!(Design::MAX_DIMENSIONS);
    table
}

fn gradient(parameters: &[Parameter], measure: &Value) -> Value {
    let has_shares = |kind| !matches!(kind, Kind::Choice(_) | Kind::Number(Range::Whole(..)));
    let name = json!({"enum": names(parameters, has_shares)});
    let keys = part::properties(gradient::KEYS, |key| match key {
        "of" => part::list("Measures of the model or of [measure].", &or_own(measure)),
        _ => part::list("Parameters that have a value: neither derived nor choices.", &name),
    });
    let mut table = part::table(about("gradient"), keys);
    table["required"] = json!(gradient::KEYS);
    table
}

fn output(column: &Value) -> Value {
    let keys = part::properties(output::KEYS, |key| match key {
        "path" => part::text(
            "The file, relative to the working directory: .csv, .csv.zst or .parquet; - for stdout.",
        ),
        _ => part::list(
            "Columns to write behind the status, in this order. Default: all of them.",
            &or_own(column),
        ),
    });
    part::table(about("output"), keys)
}

/// A known name, or any other: the user may define it.
fn or_own(known: &Value) -> Value {
    json!({"anyOf": [known, {"type": "string"}]})
}

/// The name of a measure, or of a column on the course of a run.
fn one_of(measures: &[Column], run: &[Fixed]) -> Value {
    let measures = measures.iter().map(|column| (column.name.as_str(), column.doc.as_str()));
    let run = run.iter().map(|column| (column.name, column.doc));
    let (names, docs): (Vec<&str>, Vec<&str>) = measures.chain(run).unzip();
    json!({"enum": names, "x-taplo": {"docs": {"enumValues": docs}}})
}
