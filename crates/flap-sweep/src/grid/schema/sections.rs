//! The sections of a grid file that are the same for every model, and the meanings of all.

use flap_core::simulate::{SettingKind, Simulator, SolverSettings};
use serde_json::{Value, json};

use super::super::resonance;
use super::part;
use crate::resonance::{Objective, Range};

/// The meaning of a section.
pub(super) fn about(section: &str) -> &'static str {
    match section {
        "description" => "Text of your own.",
        "preset" => "The published design to start from. It chooses the model.",
        "device" => "The file of your own design to start from, in place of a preset.",
        "params" => "Single values that replace those of the preset or device.",
        "correlation" => "Correlations between parameters that have standard errors.",
        "vehicle" => "Wings that make a vehicle, with their places and what differs between them.",
        "resonance" => {
            "The search for the resonance of each design. It needs drive_frequency = \"resonance\" under [params]."
        }
        "axes" => {
            "Parameters that vary: the points are all combinations of all axes. The last axis varies fastest."
        }
        "zip" => "Parameters that vary together along one axis.",
        "sample" => "Points that are spread over the design space, or listed in a file.",
        "derived" => "Parameters that follow from others by a formula in SI units.",
        "where" => "Conditions: points that do not satisfy all of them are not run.",
        "measure" => "Columns of your own, computed from measures and parameters.",
        "gradient" => "Columns with derivatives of measures by parameters.",
        "solver" => "Settings of the integrator and of the search for settled motions.",
        "output" => "The file for the rows, and its columns.",
        _ => "",
    }
}

/// The presets, each with its meaning.
pub(super) fn preset(models: &[&'static dyn Simulator]) -> Value {
    let presets = models.iter().flat_map(|model| model.presets());
    let (names, docs): (Vec<&str>, Vec<&str>) = presets.map(|preset| (preset.name, preset.doc)).unzip();
    let mut schema = part::choice(about("preset"), &names);
    schema["x-taplo"] = json!({"docs": {"enumValues": docs}});
    schema
}

pub(super) fn resonance() -> Value {
    let tolerance = format!("Largest error of the frequency. Default: {} Hz.", Range::default().tolerance);
    let of = format!("The measure that is largest at the resonance. Default: {}.", Objective::NAMES[0]);
    let keys = part::properties(resonance::KEYS, |key| match key {
        "of" => part::choice(&of, &Objective::NAMES),
        "from" => part::positive("Lowest drive frequency, in Hz or as text with a unit.", true),
        "to" => part::positive("Highest drive frequency, in Hz or as text with a unit.", true),
        _ => part::positive(&tolerance, true),
    });
    part::table(about("resonance"), keys)
}

pub(super) fn conditions() -> Value {
    json!({
        "description": about("where"),
        "type": "object",
        "additionalProperties": part::text("A condition, such as \"wing_length < 0.03 and arms == 'axis'\"."),
    })
}

pub(super) fn measures() -> Value {
    let about_one = "A number or a condition, such as \"lift_mean_mn / power_mean_mw\".";
    json!({
        "description": about("measure"),
        "type": "object",
        "propertyNames": {"pattern": "^[A-Za-z_][A-Za-z0-9_]*$"},
        "additionalProperties": part::text(about_one),
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
    part::table(about("solver"), settings.collect())
}

/// The text with a capital first letter.
pub(super) fn capitalized(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map(|first| first.to_uppercase().chain(letters).collect()).unwrap_or_default()
}
