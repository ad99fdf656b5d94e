//! JSON schemas that are the same for all models: sections of a grid file, and small schemas for use in
//! larger schemas.

use flap_core::simulate::{SettingKind, Simulator, SolverSettings};
use flap_core::vehicle::MOST_WINGS;
use serde_json::{Map, Value, json};

use crate::grid::uncertainty::VALUE_KEYS;
use crate::grid::vehicle::{HOVER, KEYS, PLANE_KEYS, WING_KEYS};
use crate::grid::{refine, resonance};
use crate::plan::refine::Refine;
use crate::resonance::{Objective, Range};

/// Returns a JSON reference to the schema with the name `definition`.
pub(super) fn to(definition: &str) -> Value {
    json!({"$ref": format!("#/$defs/{definition}")})
}

/// Returns an object that contains, for each key, the result of the function `schema`.
pub(super) fn properties<'k>(
    keys: impl IntoIterator<Item = &'k str>,
    schema: impl Fn(&str) -> Value,
) -> Map<String, Value> {
    keys.into_iter().map(|key| (key.to_owned(), schema(key))).collect()
}

/// Returns the JSON schema of a table with the given keys and no other keys.
pub(super) fn table(description: &str, properties: Map<String, Value>) -> Value {
    json!({
        "description": description,
        "type": "object",
        "properties": Value::Object(properties),
        "additionalProperties": false,
    })
}

/// Returns the JSON schema of a text that must be one of the given options.
pub(super) fn choice(description: &str, options: &[&str]) -> Value {
    json!({"description": description, "enum": options})
}

/// Returns the JSON schema of text that is not empty.
pub(super) fn text(description: &str) -> Value {
    json!({"description": description, "type": "string", "minLength": 1})
}

/// Returns the JSON schema of a whole number from 1 to `most`.
pub(super) fn count(description: &str, most: u64) -> Value {
    json!({"description": description, "type": "integer", "minimum": 1, "maximum": most})
}

/// Returns the JSON schema of a list that contains no item twice.
pub(super) fn list(description: &str, items: &Value) -> Value {
    json!({"description": description, "type": "array", "items": items, "minItems": 1, "uniqueItems": true})
}

/// Returns a JSON schema that accepts one value or a list of values. `one` is the schema of one value, and
/// `list` is the schema of the list.
fn one_or_more(description: &str, one: &Value, list: &Value) -> Value {
    json!({"description": description, "anyOf": [one, list]})
}

/// Returns the JSON schema of the key `preset` or `device`, whose value is one design or a list of designs.
pub(super) fn designs(key: &str, one: &Value) -> Value {
    one_or_more(about(key), one, &list("Designs along an axis of the grid, all of one model.", one))
}

/// Returns the JSON schema of a number with or without quotes. If `has_unit` is true, a number in quotes has
/// a unit.
pub(super) fn quantity(description: &str, has_unit: bool) -> Value {
    // A number, then a unit if required. Units other than `1/m` begin with neither a digit nor a point.
    let pattern = if has_unit {
        r"^\s*[+-]?[0-9.]+([eE][+-]?[0-9]+)?(\s*[^0-9.\s]|\s+1)"
    } else {
        r"^\s*[+-]?\.?[0-9]"
    };
    json!({"description": description, "type": ["number", "string"], "pattern": pattern})
}

/// Returns the JSON schema of a number of more than zero, with or without quotes. If `has_unit` is true, a
/// number in quotes has a unit.
pub(super) fn positive(description: &str, has_unit: bool) -> Value {
    let mut schema = quantity(description, has_unit);
    schema["exclusiveMinimum"] = json!(0);
    schema
}

/// Returns the text that describes a section of grid files in the JSON schema.
pub(super) fn about(section: &str) -> &'static str {
    match section {
        "description" => "Free text.",
        "preset" => {
            "The published design to start from, or a list of designs to compare. The preset determines the model."
        }
        "device" => {
            "The device file of a design to start from, in place of a preset, or a list of device files to compare."
        }
        "params" => "Single values that replace values of the preset or device.",
        "correlation" => "Correlations between parameters that have standard errors.",
        "vehicle" => {
            "Wings of a vehicle, with the positions of the wings and the parameters in which wings differ."
        }
        "resonance" => {
            "The search for the resonance of each design. It requires drive_frequency = \"resonance\" under [params]."
        }
        "axes" => {
            "Parameters that vary: the points are all combinations of all axes. The last axis varies fastest."
        }
        "zip" => "Parameters that vary together along one axis.",
        "sample" => "Points that are spread over the design space, or listed in a file.",
        "refine" => "Points that are added where interpolation between the rows of the axes errs.",
        "derived" => "Parameters that follow from others by a formula in SI units.",
        "where" => "Conditions on the points: flap runs only points that satisfy all conditions.",
        "measure" => "Additional columns, computed from measures and parameters.",
        "gradient" => "Columns with derivatives of measures with respect to parameters.",
        "solver" => "Settings of the integrator and of the search for settled motions.",
        "output" => "The file for the rows, and the columns of this file.",
        _ => "",
    }
}

/// Returns the JSON schema of the names of presets, each with a description.
pub(super) fn preset(models: &[&'static dyn Simulator]) -> Value {
    let presets = models.iter().flat_map(|model| model.presets());
    let (names, docs): (Vec<&str>, Vec<&str>) = presets.map(|preset| (preset.name, preset.doc)).unzip();
    let mut schema = choice(about("preset"), &names);
    schema["x-taplo"] = json!({"docs": {"enumValues": docs}});
    schema
}

pub(super) fn resonance() -> Value {
    let tolerance =
        format!("Largest error of the resonance frequency. Default: {} Hz.", Range::default().tolerance);
    let of = format!("The measure that is largest at the resonance. Default: {}.", Objective::NAMES[0]);
    let keys = properties(resonance::KEYS, |key| match key {
        "of" => choice(&of, &Objective::NAMES),
        "from" => positive("Lowest drive frequency, in Hz or as text with a unit.", true),
        "to" => positive("Highest drive frequency, in Hz or as text with a unit.", true),
        _ => positive(&tolerance, true),
    });
    table(about("resonance"), keys)
}

pub(super) fn refine() -> Value {
    let name = text("The name of a measure.");
    let error =
        positive("A share of the range of the measure, such as \"1 %\", or a number in its unit.", false);
    let halvings = format!(
        "Largest number of halvings of a cell of the axes along each axis. Default: {}.",
        Refine::HALVINGS
    );
    let keys = properties(refine::KEYS, |key| match key {
        "measure" => one_or_more(
            "The measure whose interpolation error is limited, or several.",
            &name,
            &list("Names of measures.", &name),
        ),
        "error" => {
            let errors = json!({"type": "array", "items": error, "minItems": 1});
            one_or_more("The largest error of interpolation, for all measures or for each.", &error, &errors)
        }
        "max_points" => {
            count("The largest number of points, including the points of the axes.", Refine::MOST_POINTS)
        }
        "along" => list(
            "Parameters along whose axes points are added. Default: all axes of numbers.",
            &text("A parameter."),
        ),
        _ => count(&halvings, u64::from(Refine::MOST_HALVINGS)),
    });
    let mut table = table(about("refine"), keys);
    table["required"] = json!(["measure", "error", "max_points"]);
    table
}

pub(super) fn conditions() -> Value {
    json!({
        "description": about("where"),
        "type": "object",
        "additionalProperties": text("A condition, such as \"wing_length < 0.03 and arms == 'axis'\"."),
    })
}

pub(super) fn measures() -> Value {
    let about_one = "A number or a condition, such as \"lift_mean_mn / power_mean_mw\".";
    json!({
        "description": about("measure"),
        "type": "object",
        "propertyNames": {"pattern": "^[A-Za-z_][A-Za-z0-9_]*$"},
        "additionalProperties": text(about_one),
    })
}

pub(super) fn solver() -> Value {
    let settings = SolverSettings::TABLE.iter().map(|setting| {
        let default = SolverSettings::DEFAULT;
        let (rule, value) = match setting.kind {
            SettingKind::Number { below, get, .. } => {
                let mut rule = json!({"type": "number", "exclusiveMinimum": 0});
                if below.is_finite() {
                    rule["exclusiveMaximum"] = json!(below);
                }
                (rule, json!(get(&default)))
            }
            SettingKind::Count { get, .. } => {
                (json!({"type": "integer", "minimum": 1, "maximum": u32::MAX}), json!(get(&default)))
            }
            SettingKind::Flag { get, .. } => (json!({"type": "boolean"}), json!(get(&default))),
        };
        let mut rule = rule;
        let follows = setting.follows.map(|follows| format!(" Default: {follows}.")).unwrap_or_default();
        rule["description"] = json!(format!("{}.{follows}", capitalized(setting.doc)));
        rule["default"] = value;
        (setting.name.to_owned(), rule)
    });
    table(about("solver"), settings.collect())
}

/// Returns the text with its first letter in upper case.
pub(super) fn capitalized(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map(|first| first.to_uppercase().chain(letters).collect()).unwrap_or_default()
}

pub(super) fn vehicle(models: &[&'static dyn Simulator]) -> Value {
    let keys = properties(KEYS, |key| match key {
        "about" => lengths("Position of the reference point of the torques: forward, to the left, upwards."),
        "damping" => json!({
            "description": "True for rows with the damping matrix: derivatives of force and torque with respect to velocity and rates of the body.",
            "type": "boolean", "default": false,
        }),
        "trim" => json!({
            "description": "\"hover\" for rows at hover: flap searches the inputs with which the lift is the weight and all torques are zero.",
            "enum": [HOVER],
        }),
        "wings" => json!({
            "description": "The wings of the vehicle, each in its own table [[vehicle.wings]].",
            "type": "array", "minItems": 1, "maxItems": MOST_WINGS, "items": wing(models),
        }),
        "total_mass" => measured("Mass of the whole vehicle, in kg or as text with a unit.", true),
        "body_inertia_product" => {
            measured("Product of inertia of the whole vehicle about its centre of mass, in kg m^2.", false)
        }
        "gravity" => measured("Gravitational acceleration, in m/s^2.", true),
        axis => {
            let axis = axis.trim_start_matches("body_inertia_");
            measured(
                &format!("Moment of inertia of the whole vehicle about its {axis} axis, in kg m^2."),
                true,
            )
        }
    });
    let mut table = table(about("vehicle"), keys);
    table["required"] = json!(["wings"]);
    table
}

/// Returns the JSON schema of a number that describes the whole vehicle, such as its mass. The number can
/// have a standard error.
fn measured(about: &str, is_positive: bool) -> Value {
    let number = if is_positive { positive(about, true) } else { quantity(about, true) };
    let keys = properties(VALUE_KEYS, |key| if key == "value" { number.clone() } else { to(key) });
    let mut uncertain = table("A number with its standard error.", keys);
    uncertain["required"] = json!(["value"]);
    uncertain["not"] = json!({"required": ["sd", "relative_sd"]});
    json!({"description": about, "anyOf": [number, uncertain]})
}

/// Returns the JSON schema of a table `[[vehicle.wings]]`, which describes one wing.
fn wing(models: &[&'static dyn Simulator]) -> Value {
    let keys = properties(WING_KEYS, |key| match key {
        "name" => json!({
            "description": "Name of the wing: the first part of the names of its parameters and columns.",
            "type": "string", "pattern": "^[a-z][a-z0-9_]*$",
        }),
        "mirrored" => json!({
            "description": "True for the mirror image of a wing at its position, which is a wing on the right.", "type": "boolean",
        }),
        "position" => lengths(
            "Position of the shoulder: forward, to the left (for a mirrored wing to the right), upwards.",
        ),
        "plane" => {
            let angles = properties(PLANE_KEYS, |_| number("An angle, in rad or as text with a unit."));
            table("The orientation of the stroke plane.", angles)
        }
        "preset" => preset(models),
        "device" => text("A device file with the parameters of this wing."),
        _ => json!({"description": "Parameters of this wing alone.", "type": "object"}),
    });
    let mut table = table("A wing of the vehicle.", keys);
    table["required"] = json!(["name"]);
    table["not"] = json!({"required": ["preset", "device"]});
    table
}

/// Returns the JSON schema of a list of three lengths.
fn lengths(description: &str) -> Value {
    json!({
        "description": description, "type": "array", "minItems": 3, "maxItems": 3,
        "items": number("A length, in m or as text with a unit."),
    })
}

/// Returns a JSON schema that accepts a number, text with a unit, or a table with a number and its standard
/// error.
fn number(description: &str) -> Value {
    json!({"description": description, "type": ["number", "string", "object"]})
}
