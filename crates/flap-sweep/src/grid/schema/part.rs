//! Small schemas of which larger ones consist.

use serde_json::{Map, Value, json};

/// A reference to a definition.
pub(super) fn to(definition: &str) -> Value {
    json!({"$ref": format!("#/$defs/{definition}")})
}

/// A schema for each of the keys.
pub(super) fn properties<'k>(
    keys: impl IntoIterator<Item = &'k str>,
    schema: impl Fn(&str) -> Value,
) -> Map<String, Value> {
    keys.into_iter().map(|key| (key.to_owned(), schema(key))).collect()
}

/// A table with these keys and no others.
pub(super) fn table(description: &str, properties: Map<String, Value>) -> Value {
    json!({
        "description": description,
        "type": "object",
        "properties": Value::Object(properties),
        "additionalProperties": false,
    })
}

/// One of some options.
pub(super) fn choice(description: &str, options: &[&str]) -> Value {
    json!({"description": description, "enum": options})
}

/// Text that is not empty.
pub(super) fn text(description: &str) -> Value {
    json!({"description": description, "type": "string", "minLength": 1})
}

/// A whole number from 1 on.
pub(super) fn count(description: &str, most: u64) -> Value {
    json!({"description": description, "type": "integer", "minimum": 1, "maximum": most})
}

/// A list without repetitions.
pub(super) fn list(description: &str, items: &Value) -> Value {
    json!({"description": description, "type": "array", "items": items, "minItems": 1, "uniqueItems": true})
}

/// A number, bare or as text: with a unit if it `has_unit`.
pub(super) fn quantity(description: &str, has_unit: bool) -> Value {
    // A number; then a unit, where there must be one. Units other than `1/m` begin with neither a digit nor a point.
    let pattern = if has_unit {
        r"^\s*[+-]?[0-9.]+([eE][+-]?[0-9]+)?(\s*[^0-9.\s]|\s+1)"
    } else {
        r"^\s*[+-]?\.?[0-9]"
    };
    json!({"description": description, "type": ["number", "string"], "pattern": pattern})
}

/// A number of more than zero, bare or as text: with a unit if it `has_unit`.
pub(super) fn positive(description: &str, has_unit: bool) -> Value {
    let mut schema = quantity(description, has_unit);
    schema["exclusiveMinimum"] = json!(0);
    schema
}
