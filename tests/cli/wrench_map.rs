//! `flap vehicle --wrench-map`: formats, threads and mistakes.

use serde_json::Value;

use crate::support::{Folder, VEHICLE};

const MAP: &str = "vehicle grid.toml --wrench-map amplitude=180V:220V,bias=-10V:10V --samples 50";

fn folder() -> Folder {
    Folder::with_grid(&format!("{VEHICLE}[params]\ndrive_frequency = \"100 Hz\"\n"))
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
}

/// The JSON contains all numbers that are necessary to evaluate the map. The CSV contains the same coefficients.
#[test]
fn formats_contain_the_same_map() {
    let folder = folder();
    let json = folder.ends(0, &format!("{MAP} --format json"));
    assert_eq!(json.stderr, "");
    let map: Value = serde_json::from_str(&json.stdout).unwrap();
    assert_eq!(map["inputs"][0]["parameter"], "drive_voltage_pp");
    assert_eq!(map["inputs"][1]["unit"], "V");
    let range = ["from", "to", "centre", "half_range"].map(|key| map["inputs"][0][key].as_f64().unwrap());
    assert_eq!(range, [180.0, 220.0, 200.0, 20.0]);
    assert_eq!(
        map["terms"].to_string(),
        r#"["1","amplitude","bias","amplitude^2","amplitude*bias","bias^2"]"#
    );
    assert_eq!(map["powers"].to_string(), "[[0,0],[1,0],[0,1],[2,0],[1,1],[0,2]]");
    assert_eq!(map["rows"].to_string(), r#"{"fitted":40,"left_out":10}"#);
    assert_eq!(map["outputs"][2]["name"], "force_up_mn");
    assert_eq!(map["outputs"][3]["unit"], "uN*m");
    // With equal wings, no input makes a roll torque: there is no coefficient of determination.
    assert!(map["outputs"][3]["r_squared"].is_null());
    assert!(map["outputs"][2]["r_squared"].as_f64().unwrap() > 0.999);

    let csv = folder.ends(0, &format!("{MAP} --format csv")).stdout;
    let lines: Vec<Vec<&str>> = csv.lines().map(|line| line.split(',').collect()).collect();
    for section in ["scaled", "physical"] {
        let rows: Vec<&Vec<&str>> = lines.iter().filter(|line| line[0] == section).collect();
        assert_eq!(rows.len(), 6);
        for (component, row) in map[section].as_array().unwrap().iter().enumerate() {
            let of_csv: Vec<f64> = rows.iter().map(|line| line[6 + component].parse().unwrap()).collect();
            assert_eq!(numbers(row), of_csv, "{section} {component}");
        }
    }
    assert!(csv.contains("\nrows,left_out,,,,10,,,,,,\n"), "{csv}");
    // Both kinds of coefficients give the same lift at 190 V and 5 V.
    let value = |section: &str, [x, y]: [f64; 2]| {
        let terms = [1.0, x, y, x * x, x * y, y * y];
        numbers(&map[section][2]).iter().zip(terms).map(|(c, term)| c * term).sum::<f64>()
    };
    let [scaled, physical] = [value("scaled", [-0.5, 0.5]), value("physical", [190.0, 5.0])];
    assert!((scaled - physical).abs() < 1e-12 && scaled > 0.5, "{scaled} {physical}");

    let table = folder.ends(0, MAP).stdout;
    for text in ["amplitude  180 V  220 V", "over 40 rows", "on 10 rows", "constant", "amplitude*bias"] {
        assert!(table.contains(text), "{text}: {table}");
    }
}

#[test]
fn threads_do_not_change_a_byte() {
    let folder = folder();
    let [one, two] = ["1", "2"].map(|threads| folder.ends(0, &format!("{MAP} --format json -j {threads}")));
    assert_eq!(one.stdout, two.stdout);
}

#[test]
fn mistakes_have_a_place_and_help() {
    let folder = folder();
    let refuses = |arguments: &str, texts: &[&str]| {
        let ended = folder.ends(2, &format!("vehicle grid.toml --wrench-map {arguments}"));
        for text in texts {
            assert!(ended.stderr.contains(text), "{arguments}: {}", ended.stderr);
        }
    };
    refuses(
        "bias=20V:-20V",
        &["--wrench-map bias=20V:-20V: the range of `bias` ends below", "smaller end first"],
    );
    refuses("bias=2V:2V", &["the range of `bias` is empty"]);
    refuses("bias=2V", &["write INPUT=FROM:TO"]);
    refuses("biass=1V:2V", &["--wrench-map: the vehicle has no input `biass`", "did you mean `bias`?"]);
    refuses("bias=1V:2mm", &["--wrench-map bias=2mm: `mm` is a length", "use V"]);
    refuses("amplitude=-1V:2V", &["`drive_voltage_pp` must be zero or more, not -1V"]);
    refuses("drive_shape=0:1", &["`drive_shape` is a choice"]);
    refuses("bias=1V:2V,drive_offset=1V:2V", &["--wrench-map: `drive_offset` is named twice"]);
    refuses(
        "bias=1V:2V,amplitude=1V:2V --samples 9",
        &["--wrench-map: 9 samples are too few for 6 coefficients", "at least 10", "leave out inputs"],
    );
    refuses(
        "bias=-10V:10V --max-cycles 1",
        &["none of the 400 rows are periodic", "400 unsettled", "choose narrower ranges"],
    );
    refuses("bias=1V:2V --inputs bias", &["cannot be used with"]);
    let one = folder.ends(2, "vehicle jafferis2016 --wrench-map bias=1V:2V");
    assert!(one.stderr.contains("describes one wing"), "{}", one.stderr);
    let alone = folder.ends(2, "vehicle grid.toml --samples 50");
    assert!(alone.stderr.contains("--wrench-map"), "{}", alone.stderr);
}

/// A derived parameter cannot be an input, because its formula would be ignored.
#[test]
fn derived_parameters_are_no_inputs() {
    let folder =
        Folder::with_grid(&format!("{VEHICLE}[derived]\ndrive_offset = \"drive_voltage_pp / 20\"\n"));
    let ended = folder.ends(2, "vehicle grid.toml --wrench-map bias=1V:2V");
    assert!(ended.stderr.contains("`bias` is derived from other parameters"), "{}", ended.stderr);
    assert!(ended.stderr.contains("remove it from [derived]"), "{}", ended.stderr);
}

/// flap prints warnings about poor maps, steep responses and inputs without effect.
#[test]
fn warnings_name_poor_maps() {
    let folder = folder();
    let steep = "vehicle grid.toml --wrench-map drive_frequency=60Hz:160Hz,amplitude=150V:250V";
    let ended = folder.ends(0, steep);
    assert!(ended.stderr.contains("R^2 below 0.99, for force_up_mn: choose narrower"), "{}", ended.stderr);
    assert!(ended.stderr.contains("the largest Floquet multiplier of the rows is 0.8"), "{}", ended.stderr);
    let idle = folder.ends(0, "vehicle grid.toml --wrench-map bias=-1V:1V,total_mass=80mg:90mg");
    assert!(idle.stderr.contains("the input `total_mass` changes neither"), "{}", idle.stderr);
}
