//! The schema of grid files that `flap generate schema` prints. tests/python/test_schema.py validates grids with it.

use flap_core::simulate;
use serde_json::Value;

use crate::support::Folder;

fn schema(arguments: &str) -> Value {
    let printed = Folder::new().ends(0, arguments).stdout;
    serde_json::from_str(&printed).unwrap()
}

#[test]
fn every_key_has_a_description() {
    let schema = schema("generate schema");
    for section in schema["properties"].as_object().unwrap() {
        assert_described(section.0, section.1);
    }
    for model in simulate::all() {
        let sections = &schema["$defs"][model.name()]["properties"];
        for (name, section) in sections.as_object().unwrap() {
            assert_described(name, section);
        }
        for parameter in model.parameters() {
            let about = schema["$defs"][format!("{}.{}.value", model.name(), parameter.name)]["description"]
                .as_str()
                .unwrap();
            assert!(about[1..].starts_with(&parameter.doc[1..parameter.doc.len() - 1]), "{about}");
            assert!(
                parameter.unit.is_empty() || about.contains(&format!("in {}, or", parameter.unit)),
                "{about}"
            );
        }
    }
}

/// Fails unless the schema and the schemas of its keys have descriptions or references.
fn assert_described(name: &str, schema: &Value) {
    let is_described = schema["description"].as_str().is_some_and(|about| about.len() > 5);
    let [alone, uncertain] = [&schema["anyOf"][1], &schema["anyOf"][2]];
    let refers = |schema: &Value| schema["$ref"].is_string() || schema["anyOf"][0]["$ref"].is_string();
    let refers = refers(schema) || (refers(alone) && refers(uncertain));
    assert!(is_described || refers, "{name}: {schema}");
    for (key, schema) in schema["properties"].as_object().into_iter().flatten() {
        assert_described(&format!("{name}.{key}"), schema);
    }
}

#[test]
fn a_preset_chooses_its_model_and_the_defaults() {
    let own = schema("generate schema --preset jafferis2016");
    assert_eq!(own["$defs"]["bimorph.wing_length.value"]["default"], "17 mm");
    assert!(own["$defs"]["direct-drive"].is_null());
    let all = schema("generate schema");
    assert!(all["$defs"]["bimorph.wing_length.value"]["default"].is_null());
    Folder::new().ends(2, "generate schema --preset jafferis2017").says("did you mean `jafferis2016`?");
}
