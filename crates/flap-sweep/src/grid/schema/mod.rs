//! The JSON schema of grid files, from the tables that their check uses: editors complete keys and show mistakes with it.
//!
//! The schema accepts every grid that the check accepts. It refuses unknown keys, options and types; units, formulas and
//! contradictions are left to the check.

mod model;
mod sections;

use flap_core::parameter::Preset;
use flap_core::simulate::Simulator;
use serde_json::{Value, json};

use super::table::KEYS;

/// The schema of grid files with the presets of these models (draft 2020-12).
pub fn of_models(models: &[&'static dyn Simulator]) -> Value {
    root(models, None)
}

/// The schema of grid files with the presets of one model, whose parameters default to the values of `preset`.
pub fn of_preset(model: &'static dyn Simulator, preset: &Preset) -> Value {
    root(&[model], Some(preset))
}

fn root(models: &[&'static dyn Simulator], defaults: Option<&Preset>) -> Value {
    let mut definitions = model::shared();
    for &model in models {
        model::define(model, defaults, &mut definitions);
    }
    let properties = sections::properties(KEYS, |key| match key {
        "description" | "device" => sections::text(sections::about(key)),
        "preset" => sections::preset(models),
        "vehicle" => sections::vehicle(models),
        "resonance" => sections::resonance(),
        "where" => sections::conditions(),
        "measure" => sections::measures(),
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

/// A section that differs between models. The preset decides which model's applies; here each is named, so that editors know
/// all keys, beside the empty schema, which accepts anything.
fn either(section: &str, models: &[&'static dyn Simulator]) -> Value {
    let references =
        models.iter().map(|model| sections::to(&format!("{}/properties/{section}", model.name())));
    let any: Vec<Value> = [json!({})].into_iter().chain(references).collect();
    json!({"description": sections::about(section), "anyOf": any})
}

/// The rules of the model whose preset the grid names. The preset of a device is not known: a grid that begins with one has the
/// rules of the `only` model, if there is one.
fn by_preset(models: &[&'static dyn Simulator], only: bool) -> Value {
    let begins = json!({"if": {"required": ["device"]}, "else": {"required": ["preset"]}});
    let Some((model, others)) = models.split_first() else { return begins };
    let presets: Vec<&str> = model.presets().iter().map(|preset| preset.name).collect();
    let mut is_named = json!({"properties": {"preset": {"enum": presets}}});
    // The parameters and columns of a vehicle have the names of its wings in them.
    let mut rules = json!({"if": {"not": {"required": ["vehicle"]}}, "then": sections::to(model.name())});
    if only {
        rules = json!({"allOf": [rules, begins]});
    } else {
        is_named["required"] = json!(["preset"]);
    }
    json!({"if": is_named, "then": rules, "else": by_preset(others, only)})
}
