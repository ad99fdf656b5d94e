//! JSON schema of grid files. The schema is generated from the same lists of keys as the checks of grid
//! files. Editors use the schema to complete keys and show mistakes.
//!
//! The schema accepts every grid file that flap accepts. The schema rejects unknown keys, unknown options and
//! values of wrong types. The schema does not check units, formulas and contradictions.

mod model;
mod sections;

use flap_core::parameter::Preset;
use flap_core::simulate::Simulator;
use serde_json::{Value, json};

use super::table::KEYS;

/// Returns the JSON schema of grid files for the `models`, in the version 2020-12 of JSON Schema.
pub fn of_models(models: &[&'static dyn Simulator]) -> Value {
    root(models, None)
}

/// Returns the JSON schema of grid files for one model. In this schema, the defaults of the parameters are
/// the values of `preset`.
pub fn of_preset(model: &'static dyn Simulator, preset: &Preset) -> Value {
    root(&[model], Some(preset))
}

fn root(models: &[&'static dyn Simulator], defaults: Option<&Preset>) -> Value {
    let mut definitions = model::shared();
    for &model in models {
        model::define(model, defaults, &mut definitions);
    }
    let properties = sections::properties(KEYS, |key| match key {
        "description" => sections::text(sections::about(key)),
        "device" => sections::designs(key, &sections::text("A device file.")),
        "preset" => sections::designs(key, &sections::preset(models)),
        "vehicle" => sections::vehicle(models),
        "resonance" => sections::resonance(),
        "where" => sections::conditions(),
        "measure" => sections::measures(),
        "refine" => sections::refine(),
        "solver" => sections::solver(),
        _ => either(key, models),
    });
    let mut schema = json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "Grid file of flap",
        "description": "A sweep of flapping-wing designs: the published design to start from, the parameters to change, \
                        and the parameters to vary.",
        "type": "object",
        "properties": properties,
        "additionalProperties": false,
        "not": {"required": ["preset", "device"]},
        "$defs": definitions,
    });
    if let (Value::Object(schema), Value::Object(rules)) =
        (&mut schema, by_preset(models, defaults.is_some()))
    {
        schema.extend(rules);
    }
    schema
}

/// Returns the JSON schema of a section whose keys depend on the model. The preset in the grid file
/// determines the model.
///
/// The schema is a list of alternatives: the section of each model, so that editors offer all keys, and an
/// empty schema, which accepts anything.
fn either(section: &str, models: &[&'static dyn Simulator]) -> Value {
    let references =
        models.iter().map(|model| sections::to(&format!("{}/properties/{section}", model.name())));
    let any: Vec<Value> = [json!({})].into_iter().chain(references).collect();
    json!({"description": sections::about(section), "anyOf": any})
}

/// Returns a JSON schema that applies the rules of a model if the grid file names a preset of this model.
///
/// If a grid file names a device, the preset is in the file of the device, and the schema cannot check the
/// preset. If `only` is true, the rules of the first model in `models` apply to a grid file that names a
/// device.
fn by_preset(models: &[&'static dyn Simulator], only: bool) -> Value {
    let begins = json!({"if": {"required": ["device"]}, "else": {"required": ["preset"]}});
    let Some((model, others)) = models.split_first() else { return begins };
    let presets: Vec<&str> = model.presets().iter().map(|preset| preset.name).collect();
    let one = json!({"enum": presets});
    let mut is_named = json!({"properties": {"preset": {"anyOf": [one, {"type": "array", "items": one}]}}});
    // Names of parameters and columns of a vehicle contain the names of its wings.
    let mut rules = json!({"if": {"not": {"required": ["vehicle"]}}, "then": sections::to(model.name())});
    if only {
        rules = json!({"allOf": [rules, begins]});
    } else {
        is_named["required"] = json!(["preset"]);
    }
    json!({"if": is_named, "then": rules, "else": by_preset(others, only)})
}
