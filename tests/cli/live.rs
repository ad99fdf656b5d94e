//! `flap live`: its rows equal the rows of a sweep, closed connections cancel their requests, and only the page gets
//! answers.

mod foreign;
mod server;

use std::collections::BTreeMap;
use std::fs;
use std::io::Write;
use std::net::TcpStream;
use std::time::Duration;

use serde_json::{Value, json};
use server::Live;

use crate::documents::{blocks, document, examples};
use crate::support::{Folder, WINGS, send, wait};

/// A grid with all entries that the page keeps: a derived parameter, a condition, a measure, a setting.
const GRID: &str = r#"
description = "a grid for the page"
preset = "ozaki2018-large"

[params]
air_density = "1.2 kg/m^3"

[axes]
hinge_stiffness = ["90 uN*m/rad", "110 uN*m/rad"]
drive_frequency = { from = "95 Hz", to = "119 Hz", step = "6 Hz" }

[derived]
actuator_length = "200 * hinge_length_of_actuator"

[solver]
rtol = 1e-7
"#;

/// The rows of a CSV file, each with its cells by column.
fn table(text: &str) -> Vec<BTreeMap<String, String>> {
    let mut lines = text.lines();
    let columns: Vec<&str> = lines.next().unwrap().split(',').collect();
    let row = |line: &str| {
        columns.iter().map(|&name| name.to_owned()).zip(line.split(',').map(str::to_owned)).collect()
    };
    lines.map(row).collect()
}

/// Fails unless the rows of an answer equal the rows of a sweep's file, bit for bit.
#[track_caller]
fn assert_same_rows(answer: &Value, csv: &str) {
    let rows = table(csv);
    let columns: Vec<&str> =
        answer["columns"].as_array().unwrap().iter().map(|name| name.as_str().unwrap()).collect();
    assert_eq!(columns.join(","), csv.lines().next().unwrap());
    let answered = answer["rows"].as_array().unwrap();
    assert_eq!(answered.len(), rows.len());
    for (cells, row) in answered.iter().zip(&rows) {
        for (cell, name) in cells.as_array().unwrap().iter().zip(&columns) {
            let text = row[*name].as_str();
            match cell {
                Value::Null => assert_eq!(text, "", "{name}"),
                Value::Number(number) => {
                    let parsed: f64 = text.parse().unwrap();
                    assert_eq!(number.as_f64().unwrap().to_bits(), parsed.to_bits(), "{name}");
                }
                Value::Bool(flag) => assert_eq!(text, flag.to_string(), "{name}"),
                Value::String(word) => assert_eq!(text, word, "{name}"),
                other => panic!("{name}: {other}"),
            }
        }
    }
}

/// Saves the grid of a family, sweeps the grid, and compares the rows with the rows of the page.
fn check_family(arguments: &[&str], folder: &Folder, family: &Value) {
    let live = Live::start(folder, arguments);
    let mut wanted = family.clone();
    let answer = live.answer("family", &wanted);
    wanted["kind"] = json!("grid");
    let saved = live.answer("save", &wanted);
    fs::write(folder.path("family.toml"), saved["text"].as_str().unwrap()).unwrap();
    folder.ends(0, "check family.toml");
    folder.ends(0, "sweep family.toml --out family.csv --restart");
    assert_same_rows(&answer, &folder.read("family.csv"));
}

#[test]
fn rows_of_the_page_are_those_of_a_sweep() {
    for (preset, frequencies) in
        [("jafferis2016", [90, 150]), ("ozaki2018-small", [170, 240]), ("arabagi2013-75hz", [60, 90])]
    {
        let family = json!({
            "design": { "air_density": "1.1 kg/m^3" },
            "x": { "name": "drive_frequency", "from": frequencies[0], "to": frequencies[1], "n": 9 },
            "by": { "name": "drive_voltage_pp", "values": [30.0, "0.06 kV"] },
        });
        check_family(&[preset], &Folder::new(), &family);
    }
}

#[test]
fn a_grid_keeps_its_formulas_and_settings() {
    let grid = GRID.replace("200 * hinge_length_of_actuator", "0.02 + 0 * air_density")
        + "\n[where]\nslow = \"drive_frequency < 118\"\n\n[measure]\nlift_per_stroke = \"lift_mean_mn / stroke_amplitude_deg\"\n";
    let folder = Folder::with_grid(&grid);
    let family = json!({
        "x": { "name": "drive_frequency", "from": 95.0, "to": 119.0, "n": 5 },
        "by": { "name": "hinge_stiffness", "values": ["90 uN*m/rad", 110e-6] },
    });
    check_family(&["grid.toml"], &folder, &family);
    // The page shows the very rows that the grid itself gives.
    folder.ends(0, "sweep grid.toml --out grid.csv");
    assert_eq!(folder.read("family.csv"), folder.read("grid.csv"));
    let columns = folder.read("grid.csv").lines().next().unwrap().to_owned();
    for name in ["actuator_length", "lift_per_stroke"] {
        assert!(columns.split(',').any(|column| column == name), "{name}");
    }
}

#[test]
fn a_device_is_saved_whole() {
    let folder = Folder::new();
    fs::write(
        folder.path("bee.toml"),
        "preset = \"jafferis2016\"\n[params]\nhinge_stiffness = { value = \"2.2 uN*m/rad\", sd = \"0.1 uN*m/rad\" }\n",
    )
    .unwrap();
    let live = Live::start(&folder, &["bee.toml"]);
    let design = json!({ "wing_area": "50 mm^2" });
    let saved = live.answer("save", &json!({ "kind": "device", "design": design }));
    fs::write(folder.path("saved.toml"), saved["text"].as_str().unwrap()).unwrap();
    let ended = folder.ends(0, "models saved.toml --format csv");
    assert!(ended.stdout.contains("hinge_stiffness,2.2e-6,"), "{}", ended.stdout);
    assert!(ended.stdout.contains("wing_area,5e-5,"));

    let point = live.answer("point", &json!({ "design": design, "gradient": "lift_mean_mn" }));
    let place =
        |name: &str| point["columns"].as_array().unwrap().iter().position(|column| column == name).unwrap();
    let lift_of = |answer: &Value| answer["row"][place("lift_mean_mn")].as_f64().unwrap();
    let lift = lift_of(&point);
    let printed = folder.ends(0, "run saved.toml").stdout;
    let line = printed.lines().find(|line| line.starts_with("lift_mean_mn")).unwrap();
    let shown: f64 = line.split_whitespace().nth(1).unwrap().parse().unwrap();
    assert!((shown / lift - 1.0).abs() < 1e-5, "{line}");
    assert_ne!(point["row"], point["published"]);
    assert_eq!(point["modes"].as_array().unwrap().len(), 2);
    assert_eq!(point["published_modes"].as_array().unwrap().len(), 2);
    assert_ne!(point["modes"], point["published_modes"]);
    let gradient = point["gradient"].as_array().unwrap();
    let per_percent = |slope: &Value| slope["per_percent"].as_f64().unwrap();
    let slopes: Vec<f64> = gradient.iter().map(|slope| per_percent(slope).abs()).collect();
    assert!(slopes.len() > 10 && slopes.is_sorted_by(|one, next| one >= next), "{slopes:?}");
    let [less, more] = [0.995, 1.005].map(|factor| {
        let design = json!({ "wing_area": "50 mm^2", "hinge_stiffness": 2.2e-6 * factor });
        lift_of(&live.answer("point", &json!({ "design": design })))
    });
    let slope = per_percent(gradient.iter().find(|slope| slope["parameter"] == "hinge_stiffness").unwrap());
    assert!((slope / (more - less) - 1.0).abs() < 1e-3, "{slope}, not {}", more - less);
}

/// At hover, the inputs change with the design: on the page, in `flap run` and in a sweep.
#[test]
fn derivatives_at_hover_are_those_of_a_sweep() {
    let measures = ["power_mean_mw", "hover_amplitude_v"];
    let folder = Folder::with_grid(&format!(
        "preset = \"jafferis2016\"\n[params]\ndrive_voltage_pp = \"180 V\"\n\
         [gradient]\nof = {measures:?}\nwith_respect_to = [\"hinge_stiffness\", \"drive_frequency\"]\n\
         [vehicle]\ntotal_mass = \"69 mg\"\ntrim = \"hover\"\n{WINGS}"
    ));
    folder.ends(0, "sweep grid.toml --out rows.csv");
    let row = &table(&folder.read("rows.csv"))[0];
    let live = Live::start(&folder, &["grid.toml"]);
    for measure in measures {
        let point = live.answer("point", &json!({ "gradient": measure }));
        let ended = folder.ends(0, &format!("run grid.toml --gradient {measure} --format csv"));
        let printed = table(&ended.stdout);
        let of_page = |name: &str| {
            let mut slopes = point["gradient"].as_array().unwrap().iter();
            Some(slopes.find(|slope| slope["parameter"] == name)?["per_percent"].as_f64().unwrap())
        };
        let of_command = |name: &str| {
            let line = printed.iter().find(|line| line["parameter"] == name)?;
            Some(line["change_per_pct"].parse::<f64>().unwrap())
        };
        for name in ["hinge_stiffness", "drive_frequency"] {
            let wanted: f64 = row[&format!("d_{measure}_per_pct_{name}")].parse().unwrap();
            for found in [of_page(name).unwrap(), of_command(name).unwrap()] {
                assert!((found / wanted - 1.0).abs() < 1e-4, "{measure} by {name}: {found}, not {wanted}");
            }
        }
        assert_eq!((of_page("drive_voltage_pp"), of_command("drive_voltage_pp")), (None, None));
    }
}

#[test]
fn every_example_has_a_first_view() {
    let folder = Folder::new();
    for (name, grid) in examples() {
        let live = Live::start(&folder, &[grid.to_str().unwrap()]);
        let data = live.data();
        let view = &data["view"];
        let measures: Vec<&Value> =
            data["measures"].as_array().unwrap().iter().map(|measure| &measure["name"]).collect();
        assert!(measures.contains(&&view["measure"]), "{name}: {}", view["measure"]);
        let mut x = view["x"].clone();
        x["n"] = json!(2);
        let family = live.answer("family", &json!({ "x": x, "by": view["by"] }));
        let columns = family["columns"].as_array().unwrap();
        for measure in measures {
            assert!(columns.contains(measure), "{name}: {measure}");
        }
        let point = live.answer("point", &json!({}));
        assert!(point["columns"].as_array().unwrap().contains(&view["measure"]));
    }
}

#[test]
fn saved_designs_keep_standard_errors_and_correlations() {
    let folder = Folder::new();
    let device = "preset = \"jafferis2016\"\n[params]\n\
                  hinge_stiffness = { value = \"2.2 uN*m/rad\", sd = \"0.1 uN*m/rad\" }\n\
                  wing_area = { value = \"55 mm^2\", sd = \"1 mm^2\" }\n\
                  [[correlation]]\nbetween = [\"hinge_stiffness\", \"wing_area\"]\ncoefficient = 0.5\n";
    fs::write(folder.path("bee.toml"), device).unwrap();
    let live = Live::start(&folder, &["bee.toml"]);
    let saved = |design: Value| {
        let saved = live.answer("save", &json!({ "kind": "device", "design": design }));
        saved["text"].as_str().unwrap().to_owned()
    };
    let whole = saved(json!({ "wing_length": 0.016 }));
    for part in ["sd = \"0.1 uN*m/rad\"", "sd = \"1 mm^2\"", "coefficient = 0.5"] {
        assert!(whole.contains(part), "{part}: {whole}");
    }
    // A value that is given anew is as exact as it is.
    let changed = saved(json!({ "wing_area": "50 mm^2" }));
    assert!(changed.contains("sd = \"0.1 uN*m/rad\""), "{changed}");
    assert!(!changed.contains("mm^2\", sd") && !changed.contains("correlation]"), "{changed}");
    let x = json!({ "name": "hinge_stiffness", "from": 2e-6, "to": 3e-6, "n": 3 });
    let family = live.answer("save", &json!({ "kind": "grid", "x": x }));
    fs::write(folder.path("family.toml"), family["text"].as_str().unwrap()).unwrap();
    folder.ends(0, "check family.toml");
}

/// The standard error of a device belongs to the value of the device, not to the values of an axis.
#[test]
fn saved_values_of_an_axis_have_no_standard_errors() {
    let device = "preset = \"jafferis2016\"\n[params]\n\
                  hinge_stiffness = { value = \"1.5 uN*m/rad\", sd = \"0.1 uN*m/rad\" }\n\
                  wing_area = { value = \"55 mm^2\", sd = \"1 mm^2\" }\n\
                  [[correlation]]\nbetween = [\"hinge_stiffness\", \"wing_area\"]\ncoefficient = 0.5\n";
    let folder = Folder::with_grid("device = \"bee.toml\"\n[axes]\nhinge_stiffness = [1e-6, 2e-6]\n");
    fs::write(folder.path("bee.toml"), device).unwrap();
    let live = Live::start(&folder, &["grid.toml"]);
    for kind in ["device", "grid"] {
        let saved = live.answer("save", &json!({ "kind": kind }));
        let text = saved["text"].as_str().unwrap();
        let line = |name: &str| text.lines().find(|line| line.starts_with(&format!("{name} = "))).unwrap();
        assert!(line("wing_area").contains("sd = ") && !line("hinge_stiffness").contains("sd = "), "{text}");
        assert!(!text.contains("correlation]"), "{text}");
    }
}

#[test]
fn the_saved_response_is_that_of_the_page() {
    let folder = Folder::new();
    let live = Live::start(&folder, &["ozaki2018-large"]);
    let x = json!({ "name": "drive_frequency", "from": 100.0, "to": 120.0, "n": 8 });
    let curve = live.answer("hysteresis", &json!({ "x": x }));
    let saved = live.answer("save", &json!({ "kind": "grid", "updown": true, "x": x }));
    assert_eq!(saved["name"], "response.toml");
    let text = saved["text"].as_str().unwrap();
    fs::write(folder.path("response.toml"), text).unwrap();
    let command = text.lines().next().unwrap().strip_prefix("# flap ").unwrap();
    folder.ends(0, command);
    assert_same_rows(&curve, &folder.read("response.csv"));
    let (_, grid) = text.split_once('\n').unwrap();
    let python = live.answer("save", &json!({ "kind": "python", "updown": true, "x": x }));
    let call =
        format!("import flapwing\n\ncurve = flapwing.respond(\"\"\"\\\n{grid}\"\"\", \"drive_frequency\")\n");
    assert_eq!(python["text"], call);
}

#[test]
fn motion_and_hysteresis_are_those_of_the_commands() {
    let folder = Folder::new();
    let live = Live::start(&folder, &["ozaki2018-large"]);
    let motion = live.answer("motion", &json!({ "samples": 50 }));
    folder.ends(0, "run ozaki2018-large --trajectory motion.csv --cycles 1 --samples 50");
    assert_same_rows(&motion, &folder.read("motion.csv"));

    let x = json!({ "name": "drive_frequency", "from": 100.0, "to": 120.0, "n": 6 });
    let curve = live.answer("hysteresis", &json!({ "x": x }));
    folder.ends(
        0,
        "respond ozaki2018-large --along drive_frequency --from 100 --to 120 --step 4 --out curve.csv",
    );
    assert_same_rows(&curve, &folder.read("curve.csv"));
}

#[test]
fn the_motion_of_a_branch_begins_in_the_state_of_its_row() {
    let folder = Folder::new();
    let live = Live::start(&folder, &["jafferis2016"]);
    let mut design = json!({ "hinge_stiffness": 0.7486e-6, "drive_voltage_pp": 160.0 });
    let x = json!({ "name": "drive_frequency", "from": 122.0, "to": 130.0, "n": 3 });
    let curve = live.answer("hysteresis", &json!({ "design": design, "x": x }));
    let place =
        |name: &str| curve["columns"].as_array().unwrap().iter().position(|column| column == name).unwrap();
    // At 126 Hz there are two motions.
    design["drive_frequency"] = json!(126.0);
    let strokes = ["up", "down"].map(|branch| {
        let rows = curve["rows"].as_array().unwrap();
        let is_wanted =
            |row: &Value| row[place("branch")] == branch && row[place("drive_frequency")] == 126.0;
        let row = rows.iter().position(is_wanted).unwrap();
        let begin = &curve["states"][row];
        let motion = live.answer("motion", &json!({ "design": design, "samples": 400, "begin": begin }));
        let column = motion["columns"].as_array().unwrap().iter().position(|name| name == "stroke_deg");
        let samples = motion["rows"].as_array().unwrap().iter();
        let stroke = samples.map(|row| row[column.unwrap()].as_f64().unwrap());
        let (least, most) =
            stroke.fold((f64::MAX, f64::MIN), |(least, most), value| (least.min(value), most.max(value)));
        let of_row = curve["rows"][row][place("stroke_pp_deg")].as_f64().unwrap();
        assert!(((most - least) / of_row - 1.0).abs() < 1e-3, "{} {of_row}", most - least);
        of_row
    });
    assert!((strokes[0] - strokes[1]).abs() > 20.0, "{strokes:?}");
    let (status, answer) = live.ask("motion", &json!({ "design": design, "samples": 9, "begin": [1.0] }));
    assert_eq!(status, 422, "{answer}");
}

/// A vehicle of two wings, one with a device.
const VEHICLE: &str = r#"preset = "jafferis2016"
[vehicle]
total_mass = "90 mg"
[[vehicle.wings]]
name = "left"
position = ["0 mm", "4 mm", "0 mm"]
device = "bee.toml"
[[vehicle.wings]]
name = "right"
position = ["0 mm", "-4 mm", "0 mm"]
mirrored = true
"#;
const BEE: &str = "preset = \"jafferis2016\"\n[params]\nhinge_stiffness = \"2.2 uN*m/rad\"\n";

#[test]
fn devices_of_wings_are_those_that_were_opened() {
    let folder = Folder::new();
    fs::create_dir(folder.path("designs")).unwrap();
    fs::write(folder.path("designs/bee.toml"), BEE).unwrap();
    fs::write(folder.path("designs/vehicle.toml"), VEHICLE).unwrap();
    let live = Live::start(&folder, &["designs/vehicle.toml"]);
    fs::write(folder.path("designs/bee.toml"), BEE.replace("2.2", "1.8")).unwrap();
    let point = live.answer("point", &json!({ "design": { "drive_voltage_pp": "150 V" } }));
    assert_eq!(point["values"]["left_hinge_stiffness"], 2.2e-6);
    assert_eq!(point["values"]["drive_voltage_pp"], 150.0);
    assert_eq!(point["values"]["drive_shape"], "sine");
}

#[test]
fn a_formula_with_a_value_of_the_device_is_refused() {
    let folder = Folder::new();
    fs::write(folder.path("bee.toml"), BEE).unwrap();
    let measure = "[measure]\nsoft = \"hinge_stiffness / device.hinge_stiffness\"\n";
    let vehicle = VEHICLE.replace("preset = \"jafferis2016\"", "device = \"bee.toml\"");
    for grid in [format!("device = \"bee.toml\"\n{measure}"), vehicle + measure] {
        fs::write(folder.path("grid.toml"), grid).unwrap();
        folder.ends(0, "check grid.toml");
        folder.refuses("live grid.toml --no-open", "no values of the device");
    }
}

#[test]
fn a_value_of_the_preset_or_the_vehicle_cannot_be_removed() {
    let folder = Folder::new();
    fs::write(folder.path("bee.toml"), BEE).unwrap();
    fs::write(folder.path("vehicle.toml"), VEHICLE).unwrap();
    let live = Live::start(&folder, &["vehicle.toml"]);
    let (status, answer) = live.ask("point", &json!({ "design": { "total_mass": null } }));
    assert_eq!((status, answer["parameter"].as_str()), (422, Some("total_mass")), "{answer}");
    let unset = live.answer("point", &json!({ "design": { "right_hinge_stiffness": null } }));
    assert_eq!(unset["values"]["right_hinge_stiffness"], Value::Null);
}

#[test]
fn impossible_values_are_refused_with_their_parameter() {
    let folder = Folder::new();
    let live = Live::start(&folder, &["jafferis2016"]);
    let x = json!({ "name": "drive_frequency", "from": 100.0, "to": 120.0, "n": 3 });
    for (design, parameter, text) in [
        (json!({ "hinge_stiffness": -1.0 }), Some("hinge_stiffness"), "more than zero"),
        (json!({ "hinge_stiffness": "1 V" }), Some("hinge_stiffness"), "voltage"),
        (json!({ "drive_shape": "cosine" }), Some("drive_shape"), "cosine"),
        (json!({ "hinge_stifness": 1.0 }), None, "hinge_stifness"),
    ] {
        let (status, answer) = live.ask("family", &json!({ "design": design, "x": x }));
        assert_eq!(status, 422, "{answer}");
        assert_eq!(answer["parameter"].as_str(), parameter, "{answer}");
        assert!(answer["error"].as_str().unwrap().contains(text), "{answer}");
    }
    let too_many = json!({ "x": { "name": "drive_frequency", "from": 1.0, "to": 2.0, "n": 4001 } });
    assert_eq!(live.ask("family", &too_many).0, 422);
    let (status, answer) =
        live.ask("family", &json!({ "x": { "name": "drive_frequency", "from": 100, "to": 100.0, "n": 9 } }));
    assert_eq!(status, 422);
    assert!(answer["error"].as_str().unwrap().contains("two different ends"), "{answer}");
    // Parameters that are impossible together make a row, as in a sweep.
    let whole =
        live.answer("family", &json!({ "design": { "drive_rise": 0.9, "drive_shape": "square" }, "x": x }));
    let place = whole["columns"].as_array().unwrap().iter().position(|name| name == "status").unwrap();
    assert_eq!(whole["rows"][0][place], "invalid");
}

#[test]
fn a_value_far_from_the_preset_has_a_warning() {
    let folder = Folder::new();
    let live = Live::start(&folder, &["jafferis2016"]);
    let warnings = |design: Value| live.answer("point", &json!({ "design": design }))["warnings"].clone();
    assert_eq!(warnings(json!({ "drive_voltage_pp": 150.0 })), json!([]));
    let far = warnings(json!({ "drive_voltage_pp": 200_160.0 }));
    assert!(far[0].as_str().unwrap().contains("times the preset's"), "{far}");
    assert_eq!(warnings(json!({ "drive_voltage_pp": "200.16 kV" })), json!([]), "a unit was written");
}

/// The page closes the connection of a request when a newer request replaces it.
#[test]
fn a_closed_connection_cancels_its_request() {
    // Thousands of exact rows at hover take a minute.
    let grid = "preset = \"jafferis2016\"\n[solver]\nrtol = 1e-10\n[vehicle]\ntotal_mass = \"69 mg\"\ntrim = \"hover\"\n";
    let folder = Folder::with_grid(&format!("{grid}{WINGS}"));
    let live = Live::start(&folder, &["grid.toml", "--threads", "1"]);
    let slow = json!({ "x": { "name": "drive_frequency", "from": 60.0, "to": 200.0, "n": 4000 } });
    // Browsers keep connections open for further requests.
    let slow = live.request("family", &slow.to_string()).replace("Connection: close\r\n", "");
    // More requests than the server has threads.
    for _ in 0..20 {
        let mut stream = TcpStream::connect(("127.0.0.1", live.port)).unwrap();
        stream.write_all(slow.as_bytes()).unwrap();
        // The computation begins.
        std::thread::sleep(Duration::from_millis(50));
    }
    live.answer("save", &json!({ "kind": "grid" }));
}

#[test]
#[cfg(unix)]
fn ctrl_c_ends_it() {
    let folder = Folder::new();
    let mut live = Live::start(&folder, &["ozaki2018-small"]);
    send("INT", &live.child);
    assert_eq!(wait(&mut live.child), Some(0));
    assert!(TcpStream::connect(("127.0.0.1", live.port)).is_err());
}

#[test]
fn commands_and_grids_of_the_page_on_it_work() {
    let text = document("docs/how-to/live.md");
    let folder = Folder::new();
    fs::create_dir(folder.path("examples")).unwrap();
    fs::write(folder.path("examples/ozaki_large.toml"), document("examples/ozaki_large.toml")).unwrap();
    let lines: Vec<String> = blocks(&text, "sh")
        .iter()
        .flat_map(|block| block.lines().map(str::to_owned).collect::<Vec<_>>())
        .collect();
    assert!(lines.len() >= 3);
    for line in lines {
        let words = line.strip_prefix("flap live ").unwrap().split(' ');
        // The port may be taken where the test runs.
        let words: Vec<&str> = words.filter(|word| !["--no-open", "--port", "8123"].contains(word)).collect();
        let live = Live::start(&folder, &words);
        live.answer("save", &json!({ "kind": "grid" }));
    }
    let live = Live::start(&folder, &["jafferis2016"]);
    let saved = live.answer(
        "save",
        &json!({
            "kind": "grid", "design": { "hinge_stiffness": 1.6e-6 },
            "x": { "name": "drive_frequency", "from": 72, "to": 168, "n": 81 },
            "by": { "name": "drive_voltage_pp", "values": [50, 100, 150, 200, 250] },
        }),
    );
    assert_eq!(saved["text"].as_str().unwrap(), blocks(&text, "toml")[0]);
}

#[test]
fn mistakes_of_the_command_line() {
    let folder = Folder::new();
    let live = Live::start(&folder, &["ozaki2018-small"]);
    let port = live.port.to_string();
    let ended = folder.flap_with(&["live", "ozaki2018-small", "--no-open", "--port", &port]);
    assert_eq!(ended.code, 2);
    ended.says("cannot listen on port").says("choose another port");
    folder.refuses("live nosuch", "there is no preset and no file `nosuch`");
}
