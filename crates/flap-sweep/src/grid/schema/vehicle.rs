//! The section `[vehicle]`.

use flap_core::simulate::Simulator;
use flap_core::vehicle::MOST_WINGS;
use serde_json::{Value, json};

use super::super::uncertainty::VALUE_KEYS;
use super::super::vehicle::{KEYS, PLANE_KEYS, WING_KEYS};
use super::part;
use super::sections::{about, preset};

pub(super) fn section(models: &[&'static dyn Simulator]) -> Value {
    let keys = part::properties(KEYS, |key| match key {
        "about" => lengths("The point about which torques are taken: forward, to the left, upwards."),
        "total_mass" => mass(),
        _ => json!({
            "description": "The wings, each under [[vehicle.wings]].",
            "type": "array", "minItems": 1, "maxItems": MOST_WINGS, "items": wing(models),
        }),
    });
    let mut table = part::table(about("vehicle"), keys);
    table["required"] = json!(["wings"]);
    table
}

/// A mass, with or without its standard error.
fn mass() -> Value {
    let about = "Mass of the whole vehicle, in kg or as text with a unit.";
    let mass = part::positive(about, true);
    let keys = part::properties(VALUE_KEYS, |key| if key == "value" { mass.clone() } else { part::to(key) });
    let mut uncertain = part::table("A mass with its standard error.", keys);
    uncertain["required"] = json!(["value"]);
    uncertain["not"] = json!({"required": ["sd", "relative_sd"]});
    json!({"description": about, "anyOf": [mass, uncertain]})
}

/// A wing.
fn wing(models: &[&'static dyn Simulator]) -> Value {
    let keys = part::properties(WING_KEYS, |key| match key {
        "name" => json!({
            "description": "First part of the names of its parameters and columns.",
            "type": "string", "pattern": "^[a-z][a-z0-9_]*$",
        }),
        "mirrored" => json!({
            "description": "The wing is the mirror image of one at its position: a wing on the right.", "type": "boolean",
        }),
        "position" => {
            lengths("The shoulder: forward, to the left, upwards; of a mirrored wing to the right.")
        }
        "plane" => {
            let angles = part::properties(PLANE_KEYS, |_| number("An angle, in rad or as text with a unit."));
            part::table("The orientation of its stroke plane.", angles)
        }
        "preset" => preset(models),
        "device" => part::text("A device whose numbers the wing has."),
        _ => json!({"description": "Parameters that the wing has of its own.", "type": "object"}),
    });
    let mut table = part::table("A wing of the vehicle.", keys);
    table["required"] = json!(["name"]);
    table["not"] = json!({"required": ["preset", "device"]});
    table
}

/// Three lengths.
fn lengths(description: &str) -> Value {
    json!({
        "description": description, "type": "array", "minItems": 3, "maxItems": 3,
        "items": number("A length, in m or as text with a unit."),
    })
}

/// A number, or text with a unit.
fn number(description: &str) -> Value {
    json!({"description": description, "type": ["number", "string", "object"]})
}
