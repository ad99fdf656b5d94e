//! The schema of grid files that `flap generate schema` prints, as validators of JSON schemas understand it.

use std::fs;

use flap_core::simulate;
use jsonschema::Validator;
use serde_json::Value;

use crate::documents::{blocks, document, examples, pages};
use crate::support::Folder;

fn schema(arguments: &str) -> Value {
    let printed = Folder::new().ends(0, arguments).stdout;
    serde_json::from_str(&printed).unwrap()
}

/// The schema with a validator for it.
fn validator(arguments: &str) -> Validator {
    let schema = schema(arguments);
    jsonschema::meta::validate(&schema).unwrap();
    jsonschema::draft202012::new(&schema).unwrap()
}

/// The mistakes in a grid file: where each is, and its message.
fn mistakes(validator: &Validator, grid: &str) -> Vec<String> {
    let table: toml::Table = grid.parse().unwrap();
    let grid = serde_json::to_value(table).unwrap();
    validator.iter_errors(&grid).map(|error| format!("{}: {error}", error.instance_path())).collect()
}

/// The grids of the examples and of the documents, with their names.
fn grids() -> Vec<(String, String)> {
    let files = examples().into_iter().map(|(name, path)| (name, fs::read_to_string(path).unwrap()));
    let blocks = pages().into_iter().flat_map(|page| {
        let blocks = blocks(&document(&page), "toml").into_iter();
        let begins =
            |block: &String| ["preset", "device", "# mybee"].iter().any(|word| block.starts_with(word));
        blocks.filter(begins).map(move |block| (page.clone(), block))
    });
    files.chain(blocks).collect()
}

#[test]
fn grids_of_the_examples_and_documents_satisfy_the_schema() {
    let all = validator("generate schema");
    let grids = grids();
    assert!(grids.len() > 20, "{} grids found", grids.len());
    for (name, grid) in grids {
        assert_eq!(mistakes(&all, &grid), [""; 0], "{name}\n{grid}");
        let table: toml::Table = grid.parse().unwrap();
        let preset = table.get("preset").and_then(toml::Value::as_str).unwrap_or("jafferis2016");
        let own = validator(&format!("generate schema --preset {preset}"));
        assert_eq!(mistakes(&own, &grid), [""; 0], "{name} with --preset {preset}\n{grid}");
    }
}

#[test]
fn every_form_of_a_value_satisfies_the_schema() {
    let all = validator("generate schema");
    for section in [
        "[params]\nwing_area = 54e-6",
        "[params]\nwing_area = \"54 mm^2\"",
        "[params]\nwing_area = \" 5.4e1mm²\"",
        "[params]\nactuator_extension_ratio = \"5 %\"",
        "[params]\nactuator_extension_ratio = \".05\"",
        "[params]\ndrive_frequency = \"resonance\"\n[resonance]\nof = \"lift\"\nfrom = \"90 Hz\"\ntolerance = 0.1",
        "[params]\ndrag_coefficient_max = 3.0",
        "[params]\nwing_area = { value = \"54 mm^2\", sd = 1e-6, source = \"a photograph\" }\n\
         actuator_extension_ratio = { value = 0.3, relative_sd = \"5 %\" }\n\
         [[correlation]]\nbetween = [\"wing_area\", \"actuator_extension_ratio\"]\ncoefficient = -0.5\n\
         [sample]\nmethod = \"sobol\"\nn = 8\nof = \"device\"",
        "[axes]\ndrag_coefficient_max = [3.0, 4]",
        "[axes]\nwing_area = { from = \"50 mm^2\", to = 6e-5, n = 3, scale = \"log\" }",
        "[axes]\nwing_area = { from = \"50 mm^2\", to = \"60 mm^2\", step = \"1 mm^2\" }",
        "[sample]\nmethod = \"file\"\npath = \"designs.csv\"",
        "[sample]\nmethod = \"random\"\nn = 3\nseed = 0\n[sample.parameters]\nwing_area = [5e-5, 6e-5]\n\
         wing_length = { relative_sd = 0.05, from = \"10 mm\" }",
        "[measure]\nown = \"2 * lift_mean_mn\"\n[output]\ncolumns = [\"own\", \"lift_mean_mn\", \"cycles\"]",
        "[gradient]\nof = [\"lift_mean_mn\"]\nwith_respect_to = [\"wing_area\", \"drag_coefficient_max\"]",
        "[solver]\nrtol = 1e-5\nmax_cycles = 10\nnewton = false",
    ] {
        let grid = format!("preset = \"jafferis2016\"\n{section}\n");
        assert_eq!(mistakes(&all, &grid), [""; 0], "{grid}");
    }
}

#[test]
fn mistakes_do_not_satisfy_the_schema() {
    let all = validator("generate schema");
    for (section, place, message) in [
        ("[parms]\n", "", "'parms' was unexpected"),
        ("[params]\nwing_lenght = 1\n", "/params", "'wing_lenght' was unexpected"),
        ("[params]\ntransmission_ratio = 1\n", "/params", "'transmission_ratio' was unexpected"),
        ("[params]\ncentre_of_pressure = \"fold\"\n", "/params/centre_of_pressure", "\"fold\" is not one of"),
        ("[params]\nwing_length = 0\n", "/params/wing_length", "0 is less than or equal to the minimum of 0"),
        ("[params]\nwing_length = \"54\"\n", "/params/wing_length", "\"54\" does not match"),
        ("[params]\nwing_length = \"mm\"\n", "/params/wing_length", "\"mm\" does not match"),
        ("[params]\nwing_length = [1, 2]\n", "/params/wing_length", "[1,2] is not of types"),
        (
            "[params]\nwing_length = { value = 0 }\n",
            "/params/wing_length/value",
            "0 is less than or equal to",
        ),
        ("[params]\nwing_length = { sd = 1 }\n", "/params/wing_length", "\"value\" is a required property"),
        ("[params]\nwing_length = { value = 1, rms = 1 }\n", "/params/wing_length", "'rms' was unexpected"),
        ("[correlation]\ncoefficient = 0.5\n", "/correlation", "is not of type \"array\""),
        (
            "[[correlation]]\nbetween = [\"wing_length\"]\ncoefficient = 0\n",
            "/correlation/0/between",
            "less than 2",
        ),
        ("[axes]\nwing_length = \"54 mm\"\n", "/axes/wing_length", "is not of types \"array\", \"object\""),
        ("[axes]\nwing_length = []\n", "/axes/wing_length", "less than 1 item"),
        (
            "[axes]\nwing_length = { from = 1, to = 2 }\n",
            "/axes/wing_length",
            "\"step\" is a required property",
        ),
        (
            "[axes]\nwing_length = { from = 1, to = 2, m = 3, n = 3 }\n",
            "/axes/wing_length",
            "'m' was unexpected",
        ),
        ("[axes]\ncentre_of_pressure = \"folded\"\n", "/axes/centre_of_pressure", "is not of type \"array\""),
        ("[zip]\nwing_length = [1, 2]\n", "/zip", "is not of type \"array\""),
        ("[sample]\nmethod = \"sobol\"\n", "/sample", "\"n\" is a required property"),
        (
            "[sample]\nmethod = \"sobbol\"\nn = 1\nparameters.wing_length = [1]\n",
            "/sample/method",
            "\"sobbol\" is not one of",
        ),
        ("[sample]\nmethod = \"file\"\npath = \"a.csv\"\nn = 3\n", "/sample", "\"n\" is not one of"),
        ("[derived]\ncentre_of_pressure = \"1\"\n", "/derived", "'centre_of_pressure' was unexpected"),
        ("[derived]\nwing_length = 3\n", "/derived/wing_length", "3 is not of type \"string\""),
        ("[where]\nsmall = true\n", "/where/small", "true is not of type \"string\""),
        ("[resonance]\nof = \"drag\"\n", "/resonance/of", "\"drag\" is not one of"),
        ("[gradient]\nof = [\"lift_mean_mn\"]\n", "/gradient", "\"with_respect_to\" is a required property"),
        ("[solver]\nrtol = 0.5\n", "/solver/rtol", "0.5 is greater than or equal to the maximum"),
        ("[solver]\nnewton = 1\n", "/solver/newton", "1 is not of type \"boolean\""),
        ("[output]\ncolumns = \"lift_mean_mn\"\n", "/output/columns", "is not of type \"array\""),
        ("[output]\ncolumns = [\"lift_meen_mn\"]\n", "/output/columns/0", "\"lift_meen_mn\" is not one of"),
    ] {
        let grid = format!("preset = \"ozaki2018-large\"\n{section}");
        let found = mistakes(&all, &grid);
        let is_told =
            found.iter().any(|line| line.starts_with(&format!("{place}: ")) && line.contains(message));
        assert!(is_told && found.len() <= 2, "{section}{found:#?}");
        // The check of grid files agrees.
        Folder::with_grid(&grid).ends(2, "check grid.toml");
    }
    let found = mistakes(&all, "preset = \"ozaki\"\n");
    assert!(found.len() == 1 && found[0].starts_with("/preset: \"ozaki\" is not one of"), "{found:?}");
    let own = validator("generate schema --preset ozaki2018-large");
    for validator in [&all, &own] {
        assert_eq!(mistakes(validator, ""), [": \"preset\" is a required property"]);
        let both = mistakes(validator, "preset = \"ozaki2018-large\"\ndevice = \"mine.toml\"\n");
        assert!(both.len() == 1 && both[0].contains("is not allowed for"), "{both:?}");
    }
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

/// Fails unless the schema and those of its keys have descriptions, or refer to others.
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

    // The schema of all models does not know the model of a device; that of one model does.
    let grid = "device = \"mybee.toml\"\n[params]\nwing_lenght = 1\n";
    assert_eq!(mistakes(&validator("generate schema"), grid), [""; 0]);
    let own = mistakes(&validator("generate schema --preset jafferis2016"), grid);
    assert!(own.len() == 1 && own[0].starts_with("/params: "), "{own:?}");
    Folder::new().ends(2, "generate schema --preset jafferis2017").says("did you mean `jafferis2016`?");
}
