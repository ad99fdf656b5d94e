//! Devices: files with a preset and the user's own parameters, which can replace a preset everywhere.

use std::fs::{self, File};

use flap_sweep::files::results::{Format, Reader, Recorded};

use crate::support::Folder;

const DEVICE: &str = "\
description = \"the robot on bench 2\"
preset = \"jafferis2016\"

[params]
hinge_stiffness = { value = \"2 uN*m/rad\", relative_sd = \"5 %\", source = \"bending test\" }
wing_inertia_stroke = { value = \"50 ng*m^2\", sd = \"1 ng*m^2\" }
drive_voltage_pp = \"160 V\"

[[correlation]]
between = [\"hinge_stiffness\", \"wing_inertia_stroke\"]
coefficient = 0.6
";

const AXES: &str = "[axes]\ndrive_frequency = { from = 110, to = 130, n = 5 }\n";

/// A folder with a device, a grid that begins with the device, and a grid that sets the same values on the preset.
fn folder() -> Folder {
    let folder = Folder::with_grid(&format!("device = \"mybee.toml\"\n{AXES}"));
    fs::write(folder.path("mybee.toml"), DEVICE).unwrap();
    let params = "[params]\nhinge_stiffness = \"2 uN*m/rad\"\nwing_inertia_stroke = \"50 ng*m^2\"\n\
                  drive_voltage_pp = \"160 V\"\n";
    fs::write(folder.path("preset.toml"), format!("preset = \"jafferis2016\"\n{params}{AXES}")).unwrap();
    folder
}

#[test]
fn a_device_written_from_a_preset_has_its_rows() {
    let folder = Folder::new();
    for preset in ["jafferis2016", "jafferis2016-improved", "ozaki2018-small", "arabagi2013-30hz"] {
        let text = folder.ends(0, &format!("device new {preset}")).stdout;
        fs::write(folder.path("mybee.toml"), &text).unwrap();
        let [of_device, of_preset] =
            ["mybee.toml", preset].map(|what| folder.ends(0, &format!("run {what}")).stdout);
        assert_eq!(of_device, of_preset, "{preset}");
        // A device is written again as it is.
        assert_eq!(folder.ends(0, "device new mybee.toml").stdout, text, "{preset}");
    }
}

#[test]
fn a_grid_begins_with_a_device() {
    let folder = folder();
    folder.ends(0, "sweep grid.toml --out device.csv");
    folder.ends(0, "sweep preset.toml --out preset.csv");
    assert_eq!(folder.read("device.csv"), folder.read("preset.csv"));
    // Expressions know the device's values besides those of the preset.
    let derived = "[derived]\nhinge_stiffness = \"device.hinge_stiffness * 0 + preset.hinge_stiffness\"\n";
    fs::write(folder.path("derived.toml"), format!("device = \"mybee.toml\"\n{AXES}{derived}")).unwrap();
    folder.ends(0, "sweep derived.toml --out derived.csv");
    assert!(folder.read("derived.csv").contains("1.4972e-6"), "{}", folder.read("derived.csv"));
}

#[test]
fn results_carry_the_device_and_resume_compares_it() {
    let folder = folder();
    folder.ends(0, "sweep grid.toml --out rows.csv");
    let sidecar = folder.read("rows.csv.meta.toml");
    assert!(sidecar.contains("[[devices]]") && sidecar.contains("the robot on bench 2"), "{sidecar}");
    // Other work on the results takes the recorded device, wherever the file has gone.
    fs::rename(folder.path("mybee.toml"), folder.path("moved.toml")).unwrap();
    folder.ends(0, "results rerun rows.csv --status periodic --rtol 1e-7 --out again.csv");
    folder.ends(0, "results convert rows.csv rows.parquet");
    // So does a Parquet file whose sidecar is lost, whatever device lies there now.
    fs::write(folder.path("mybee.toml"), DEVICE.replace("160 V", "161 V")).unwrap();
    let reader = Reader::new(File::open(folder.path("rows.parquet")).unwrap(), Format::Parquet).unwrap();
    let plan = Recorded::of(reader.entries()).unwrap().plan(flap_core::simulate::all()).unwrap();
    assert_eq!(plan.devices()[0].text, DEVICE);
    let voltage =
        plan.parameters().iter().position(|parameter| parameter.name == "drive_voltage_pp").unwrap();
    assert_eq!(plan.point(0).values[voltage], 160.0);
    fs::remove_file(folder.path("mybee.toml")).unwrap();

    folder.ends(2, "sweep grid.toml --out rows.csv").says("mybee.toml: ");
    fs::write(folder.path("mybee.toml"), DEVICE.replace("160 V", "161 V")).unwrap();
    folder.ends(2, "sweep grid.toml --out rows.csv").says("the device differs").says(
        "line 7 of mybee.toml was `drive_voltage_pp = \"160 V\"`, it is `drive_voltage_pp = \"161 V\"`",
    );
    // A device is an input: results do not overwrite it.
    folder.ends(2, "sweep grid.toml --out mybee.toml --restart");
}

#[test]
fn devices_begin_with_devices_in_other_folders() {
    let folder = folder();
    fs::create_dir(folder.path("lab")).unwrap();
    fs::rename(folder.path("mybee.toml"), folder.path("lab/mybee.toml")).unwrap();
    fs::write(folder.path("lab/stiff.toml"), "device = \"mybee.toml\"\n[params]\nhinge_stiffness = 3e-6\n")
        .unwrap();
    fs::write(folder.path("grid.toml"), format!("device = \"lab/stiff.toml\"\n{AXES}")).unwrap();
    folder.ends(0, "sweep grid.toml --out stiff.csv");
    let preset = folder.read("preset.toml").replace("2 uN*m/rad", "3 uN*m/rad");
    fs::write(folder.path("preset.toml"), preset).unwrap();
    folder.ends(0, "sweep preset.toml --out preset.csv");
    assert_eq!(folder.read("stiff.csv"), folder.read("preset.csv"));
    // A value that is set anew has no standard error, and its correlation has ended.
    let text = folder.ends(0, "device new lab/stiff.toml").stdout;
    assert!(
        text.contains("hinge_stiffness = \"3 uN*m/rad\"\n") && !text.contains("[[correlation]]"),
        "{text}"
    );
    assert!(text.contains("wing_inertia_stroke = { value = \"50 ng*m^2\", sd = \"1 ng*m^2\" }"), "{text}");
}

#[test]
fn builds_are_drawn_from_errors_and_correlations() {
    let folder = folder();
    let sample =
        "[sample]\nmethod = \"sobol\"\nn = 512\nof = \"device\"\n[output]\ncolumns = [\"stroke_pp_deg\"]\n";
    fs::write(folder.path("builds.toml"), format!("device = \"mybee.toml\"\n{sample}")).unwrap();
    folder.ends(0, "check builds.toml").prints("sd 1e-7, of the device");
    folder.ends(0, "sweep builds.toml --out builds.csv");
    let text = folder.read("builds.csv");
    let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split(',').collect()).collect();
    let column = |name: &str| {
        let place = rows[0].iter().position(|known| *known == name).unwrap();
        rows[1..].iter().map(|row| row[place].parse::<f64>().unwrap()).collect::<Vec<f64>>()
    };
    let (stiffness, inertia) = (column("hinge_stiffness"), column("wing_inertia_stroke"));
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let covariance = |a: &[f64], b: &[f64]| {
        let (mean_a, mean_b) = (mean(a), mean(b));
        mean(&a.iter().zip(b).map(|(a, b)| (a - mean_a) * (b - mean_b)).collect::<Vec<f64>>())
    };
    let sd = |values: &[f64]| covariance(values, values).sqrt();
    assert!((mean(&stiffness) / 2e-6 - 1.0).abs() < 1e-3 && (sd(&stiffness) / 1e-7 - 1.0).abs() < 0.02);
    assert!((mean(&inertia) / 50e-12 - 1.0).abs() < 1e-3 && (sd(&inertia) / 1e-12 - 1.0).abs() < 0.02);
    let correlation = covariance(&stiffness, &inertia) / (sd(&stiffness) * sd(&inertia));
    assert!((correlation - 0.6).abs() < 0.02, "{correlation}");
}

#[test]
fn commands_take_a_device_for_a_preset() {
    let folder = folder();
    folder.ends(0, "run mybee.toml").prints("lift_mean_mn");
    folder.ends(0, "test resonance mybee.toml");
    folder.ends(0, "respond mybee.toml --from 110 --to 130 --step 5 --out curves.csv");
    folder.ends(0, "check mybee.toml").prints("hinge_stiffness");
    let listed = folder.ends(0, "models mybee.toml");
    listed.prints("mybee.toml: based on jafferis2016\n");
    listed.prints("hinge_stiffness           2 uN*m/rad ± 100 nN*m/rad");
    listed.prints("drive_voltage_pp          160 V");
    // Numbers as they are for other programs.
    folder.ends(0, "models mybee.toml --format csv").prints(",hinge_stiffness,2e-6,N*m/rad,");
    folder.ends(2, "models none.toml").says("none.toml: there is no such file");
}

/// Fails the test unless flap rejects a grid that begins with this device, with `message` and `place`.
#[track_caller]
fn refused(folder: &Folder, device: &str, message: &str, place: &str) {
    fs::write(folder.path("mybee.toml"), device).unwrap();
    folder.ends(2, "check grid.toml").says(message).says(place);
}

/// A device with lines below `[params]`.
fn params(lines: &str) -> String {
    format!("preset = \"jafferis2016\"\n[params]\n{lines}\n")
}

#[test]
fn mistakes_in_devices_are_told_with_their_place() {
    let folder = folder();
    let told = |text: &str, message: &str, place: &str| refused(&folder, text, message, place);
    told("device = \"grid2.toml\"\n", "grid2.toml: ", "mybee.toml:1:10");
    told(
        "device = \"mybee.toml\"\n",
        "the device refers to itself: mybee.toml → mybee.toml",
        "mybee.toml:1:10",
    );
    told(
        "preset = \"jafferis2016\"\n[axes]\nwing_area = [1]\n",
        "unknown key `axes` in a device",
        "mybee.toml:2:2",
    );
    told("preset = \"jafferis2016\"\ndevice = \"a.toml\"\n", "not from both", "mybee.toml:1:1");
    told("[params]\nwing_area = 1\n", "`preset` is missing", "mybee.toml");
    told(&params("wing_area = \"-1 mm^2\""), "`wing_area` must be more than zero", "mybee.toml:3:13");
    fs::write(folder.path("other.toml"), "device = \"mybee.toml\"\n").unwrap();
    told(
        "device = \"other.toml\"\n",
        "the device refers to itself: mybee.toml → other.toml → mybee.toml",
        "other.toml:1:10",
    );
    told(
        &params("vehicle_mass = \"-80 mg\""),
        "`vehicle_mass` must be zero or more, not -8e-5 kg",
        "mybee.toml:3:16",
    );
    told(&params("wing_area = nan"), "`wing_area` cannot be `nan`: values must be finite", "mybee.toml:3:13");
    told(
        &params("wing_area = \"50 mm\""),
        "`mm` is a length, but `wing_area` is in m^2",
        "help: use m^2, mm^2, um^2",
    );
    told(
        "preset = \"jafferis2016\"\nauthor = \"me\"\n",
        "unknown key `author` in a device",
        "mybee.toml:2:1",
    );
    told("preset = \"jafferis2016\"\n[parms]\n", "unknown key `parms` in a device", "did you mean `params`?");
    told(&params("wing_aera = 1"), "has no parameter `wing_aera`", "did you mean `wing_area`?");
}

#[test]
fn mistakes_in_standard_errors_are_told_with_their_place() {
    let folder = folder();
    let told = |text: &str, message: &str, place: &str| refused(&folder, text, message, place);
    told(&params("wing_area = { sd = \"1 mm^2\" }"), "`wing_area` has no `value`", "mybee.toml:3:13");
    told(&params("wing_area = { value = 5e-5, sd = \"2 %\" }"), "not a share of its value", "relative_sd");
    told(
        &params("wing_area = { value = 5e-5, sd = 0 }"),
        "`sd` must give a standard error of more than zero",
        "mybee.toml:3:34",
    );
    told(
        &params("wing_area = { value = 5e-5, sd = -1e-6 }"),
        "`sd` must give a standard error of more than zero, not -1e-6",
        "mybee.toml:3:34",
    );
    told(&params("wing_area = { value = 5e-5, sd = nan }"), "`sd` cannot be `nan`", "mybee.toml:3:34");
    told(
        &params("wing_area = { value = 5e-5, sd = 1e-6, relative_sd = 0.1 }"),
        "not both",
        "mybee.toml:3:40",
    );
    told(
        &params("drive_shape = { value = \"sine\", sd = 1 }"),
        "a choice and has no standard error",
        "mybee.toml:3",
    );
    told(&params("wing_area = { value = 5e-5, note = \"x\" }"), "unknown key `note` of a value", "source");
    // A sample of a device without errors.
    let sample = "preset = \"jafferis2016\"\n[sample]\nmethod = \"random\"\nn = 5\nof = \"device\"\n";
    fs::write(folder.path("grid.toml"), sample).unwrap();
    folder
        .ends(2, "check grid.toml")
        .says("no parameter of the device has a standard error")
        .says("grid.toml:5:6");
}

#[test]
fn mistakes_in_correlations_are_told_with_their_place() {
    let folder = folder();
    let told = |text: &str, message: &str, place: &str| refused(&folder, text, message, place);
    let pair = |pair: &str, coefficient: &str| {
        let values =
            "wing_area = { value = 5e-5, sd = 1e-6 }\nhinge_stiffness = { value = 2e-6, sd = 1e-7 }\n";
        params(&format!("{values}[[correlation]]\nbetween = {pair}\ncoefficient = {coefficient}"))
    };
    told(&pair("[\"wing_area\"]", "0.1"), "a list of two parameters", "mybee.toml:6:11");
    told(
        &pair("[\"wing_area\", \"wing_length\"]", "0.1"),
        "`wing_length` has no standard error",
        "mybee.toml:6:25",
    );
    told(&pair("[\"wing_area\", \"wing_area\"]", "0.1"), "names one parameter twice", "mybee.toml:6:11");
    told(&pair("[\"wing_area\", \"hinge_stiffness\"]", "1"), "must be between -1 and 1", "mybee.toml:7:15");
    told(
        &pair("[\"wing_area\", \"hinge_stiffness\"]", "1.5"),
        "must be between -1 and 1, not 1.5",
        "mybee.toml:7:15",
    );
    told(
        &pair("[\"wing_area\", \"hinge_stiffness\"]", "nan"),
        "`coefficient` cannot be `nan`",
        "mybee.toml:7:15",
    );
    let twice = pair("[\"wing_area\", \"hinge_stiffness\"]", "0.5")
        + "[[correlation]]\nbetween = [\"hinge_stiffness\", \"wing_area\"]\ncoefficient = 0.4\n";
    told(&twice, "the correlation of these two parameters is given twice", "mybee.toml:9:11");
    let three = "piezo_thickness = { value = 1e-4, sd = 1e-6 }\n[[correlation]]\nbetween = [\"wing_area\", \"piezo_thickness\"]\n\
                 coefficient = 0.9\n[[correlation]]\nbetween = [\"hinge_stiffness\", \"piezo_thickness\"]\ncoefficient = -0.9\n";
    let text = pair("[\"wing_area\", \"hinge_stiffness\"]", "0.9")
        .replace("[[correlation]]", &format!("{three}[[correlation]]"));
    told(&text, "the correlations contradict each other", "mybee.toml");
}

/// The rows of a CSV file as cells, without the header, and the positions of its columns.
fn cells(text: &str) -> (Vec<Vec<&str>>, impl Fn(&str) -> usize) {
    let mut lines = text.lines().map(|line| line.split(',').collect::<Vec<&str>>());
    let header = lines.next().unwrap();
    (lines.collect(), move |name: &str| header.iter().position(|known| *known == name).unwrap())
}

/// A folder with three devices, and the grid `grid.toml` that begins with all of them.
fn three() -> Folder {
    let folder = folder();
    fs::write(folder.path("short.toml"), params("wing_length = \"15 mm\"\nwing_area = \"50 mm^2\"")).unwrap();
    fs::write(folder.path("long.toml"), params("wing_length = \"19 mm\"\ndrive_voltage_pp = \"180 V\""))
        .unwrap();
    let derived = "[derived]\ntransmission_stiffness = \"device.transmission_stiffness * (device.wing_length / preset.wing_length)^2\"\n";
    fs::write(folder.path("rest.toml"), format!("{AXES}{derived}")).unwrap();
    let rest = folder.read("rest.toml");
    fs::write(
        folder.path("grid.toml"),
        format!("device = [\"mybee.toml\", \"short.toml\", \"long.toml\"]\n{rest}"),
    )
    .unwrap();
    folder
}

const THREE: [&str; 3] = ["mybee", "short", "long"];

#[test]
fn rows_of_a_device_axis_are_the_rows_of_each_device() {
    let folder = three();
    folder.ends(0, "check grid.toml").prints("15 points of bimorph from jafferis2016");
    folder.ends(0, "sweep grid.toml --threads 1 --out all.csv");
    let text = folder.read("all.csv");
    let (rows, place) = cells(&text);
    assert_eq!([place("point"), place("device"), place("drive_frequency")], [0, 1, 2]);
    for (number, device) in THREE.into_iter().enumerate() {
        let rest = folder.read("rest.toml");
        fs::write(folder.path("one.toml"), format!("device = \"{device}.toml\"\n{rest}")).unwrap();
        folder.ends(0, &format!("sweep one.toml --out {device}.csv"));
        let one = folder.read(&format!("{device}.csv"));
        let (one, _) = cells(&one);
        for (row, same) in rows[5 * number..].iter().zip(&one) {
            assert_eq!(row[1], device);
            assert_eq!(row[2..], same[1..], "{device}");
        }
        assert_eq!(one.len(), 5);
    }
    // The bytes do not depend on threads, and merged shards have the same bytes.
    folder.ends(0, "sweep grid.toml --threads 3 --out threads.csv");
    folder.ends(0, "sweep grid.toml --shard 1/2 --out part.csv");
    folder.ends(0, "sweep grid.toml --shard 2/2 --out rest.csv");
    folder.ends(0, "results merge merged.csv part.csv rest.csv");
    assert_eq!(folder.read("threads.csv"), text);
    assert_eq!(folder.read("merged.csv"), text);
}

#[test]
fn every_command_on_results_takes_a_device_axis() {
    let folder = three();
    folder.ends(0, "sweep grid.toml --out all.csv");
    folder.ends(0, "top all.csv --by lift_mean_mn -n 1 --where device=short").prints("short");
    let compared = ["top", "all.csv", "--by", "lift_mean_mn", "--format", "csv", "--where"];
    let rows =
        |condition| folder.ends_with(0, &[&compared[..], &[condition]].concat()).stdout.lines().count() - 1;
    assert_eq!(["device == 'short'", "device != 'short'"].map(rows), [5, 10]);
    folder.ends(0, "describe all.csv --by lift_mean_mn").prints("device ");
    folder.ends(0, "plot all.csv --kind scatter --out scatter.svg");
    assert!(THREE.iter().all(|device| folder.read("scatter.svg").contains(&format!(">{device}<"))));
    folder.ends(0, "plot all.csv --x drive_frequency --y lift_mean_mn --by device --out all.svg");
    assert!(THREE.iter().all(|device| folder.read("all.svg").contains(&format!(">{device}<"))));
    // Points are run again with the recorded devices.
    let tight = folder.read("grid.toml") + "[solver]\nrtol = 1e-7\n";
    fs::write(folder.path("tight.toml"), tight).unwrap();
    folder.ends(0, "sweep tight.toml --out tight.csv");
    fs::rename(folder.path("short.toml"), folder.path("moved.toml")).unwrap();
    folder.ends(0, "results rerun all.csv --status periodic --rtol 1e-7 --out again.csv");
    assert_eq!(folder.read("again.csv"), folder.read("tight.csv"));
    fs::rename(folder.path("moved.toml"), folder.path("short.toml")).unwrap();
    let text = folder.read("all.csv");
    folder.ends(0, "results convert all.csv all.parquet");
    folder.ends(0, "results convert all.parquet back.csv");
    assert_eq!(folder.read("back.csv"), text);
    // A response has the curves of each device. A value of the command line is not the value of the first device.
    folder.ends(0, "respond grid.toml --from 110 --to 120 --step 5 --out curves.csv");
    let curves = folder.read("curves.csv");
    let (rows, place) = cells(&curves);
    assert_eq!([rows[0][place("device")], rows[rows.len() - 1][place("device")]], ["mybee", "long"]);
    folder
        .ends(2, "respond grid.toml --from 110 --to 120 --step 5 --out curves.csv --set wing_length=0.017")
        .says("the parameters of the designs differ");
}

/// The label of a design on the command line chooses the values of this design.
#[test]
fn a_point_takes_the_design_of_the_command_line() {
    let folder = three();
    let lift = |arguments: &str| {
        let printed = folder.ends(0, &format!("run grid.toml {arguments} --format csv")).stdout;
        let (_, value) = printed.split_once("lift_mean_mn,").unwrap_or_else(|| panic!("{printed}"));
        value.split(',').next().unwrap().to_owned()
    };
    assert_ne!(lift("--point 0"), lift("--point 10"));
    assert_eq!(lift("--set device=long"), lift("--point 10"));
    assert_eq!(lift("--each device=long"), lift("--point 10"));
    let unit = ["run", "grid.toml", "--each", "drive_voltage_pp=100 V, 15 x"];
    folder
        .ends_with(2, &unit)
        .says("error: --each drive_voltage_pp=15 x: unknown unit `x`\nhelp: use V, mV, kV\n");
    folder
        .ends(2, "run grid.toml --each drive_voltage_pp=100,abc")
        .says("error: --each drive_voltage_pp=abc: `drive_voltage_pp` must start with a number\n");
    // Other parameters of the command line keep their values.
    let volts = "--set drive_voltage_pp=150";
    assert_eq!(lift(&format!("--set device=long {volts}")), lift(&format!("--point 10 {volts}")));
}

#[test]
fn a_changed_device_of_an_axis_is_told() {
    let folder = three();
    folder.ends(0, "sweep grid.toml --out all.csv");
    folder.ends(0, "sweep grid.toml --out all.csv").says("complete");
    fs::write(folder.path("long.toml"), params("wing_length = \"18 mm\"\ndrive_voltage_pp = \"180 V\""))
        .unwrap();
    let told = folder.ends(2, "sweep grid.toml --out all.csv");
    told.says("the device differs");
    told.says("line 3 of long.toml was `wing_length = \"19 mm\"`, it is `wing_length = \"18 mm\"`");
    // Every device is an input.
    folder.ends(2, "sweep grid.toml --out short.toml --restart");
}

#[test]
fn mistakes_in_a_list_of_devices_are_told_with_their_place() {
    let folder = three();
    let told = |list: &str, message: &str, place: &str| {
        fs::write(folder.path("grid.toml"), format!("device = {list}\n{AXES}")).unwrap();
        folder.ends(2, "check grid.toml").says(message).says(place);
    };
    told("[]", "the list of `device` has no values", "grid.toml:1:10");
    told("[\"mybee.toml\", 3]", "`device` must be text in quotes, not a number", "grid.toml:1:25");
    told("[\"mybee.toml\", \"none.toml\"]", "none.toml: there is no such file", "grid.toml:1:25");
    fs::create_dir(folder.path("lab")).unwrap();
    fs::write(folder.path("lab/mybee.toml"), DEVICE).unwrap();
    told(
        "[\"mybee.toml\", \"lab/mybee.toml\"]",
        "two values of `device` have the label `mybee`",
        "rename one of the files",
    );
    fs::write(folder.path("12.toml"), DEVICE).unwrap();
    told("[\"mybee.toml\", \"12.toml\"]", "`12` cannot be the label of a device", "grid.toml:1:25");
    fs::write(folder.path("other.toml"), "preset = \"ozaki2018-small\"\n").unwrap();
    told(
        "[\"mybee.toml\", \"other.toml\"]",
        "this device has the model direct-drive, but the first has the model bimorph",
        "grid.toml:1:25",
    );
    fs::write(folder.path("other.toml"), params("wing_aera = 1")).unwrap();
    told("[\"mybee.toml\", \"other.toml\"]", "has no parameter `wing_aera`", "other.toml:3:1");
    // Formulas name the devices without a value.
    fs::write(folder.path("other.toml"), params("hinge_length = \"80 um\"")).unwrap();
    for (list, formula, unset) in [
        ("[\"other.toml\", \"long.toml\"]", "device.hinge_length", "for the device `long`"),
        (
            "[\"long.toml\", \"other.toml\", \"short.toml\"]",
            "hinge_length",
            "for the devices `long`, `short`",
        ),
    ] {
        let derived = format!("[derived]\nhinge_stiffness = \"0.019 * {formula}\"\n");
        fs::write(folder.path("grid.toml"), format!("device = {list}\n{derived}")).unwrap();
        folder.ends(2, "check grid.toml").says(&format!("error: `{formula}` is not set {unset}\n"));
    }
    fs::write(
        folder.path("grid.toml"),
        "device = [\"short.toml\", \"long.toml\"]\n[derived]\nhinge_stiffness = \"hinge_length\"\n",
    )
    .unwrap();
    folder.ends(2, "check grid.toml").says("error: `hinge_length` is not set\n");
    // Devices differ in the mean, so that a share of it has no meaning.
    let sample = "[sample]\nmethod = \"random\"\nn = 2\nparameters.wing_length = { relative_sd = \"5 %\" }\n";
    fs::write(folder.path("grid.toml"), format!("device = [\"short.toml\", \"long.toml\"]\n{sample}"))
        .unwrap();
    folder.ends(2, "check grid.toml").says("`wing_length` differs between the designs");
}

/// A device has the values of the formulas, and no values of axes.
#[test]
fn a_device_of_a_grid_has_its_derived_values() {
    let folder = folder();
    let write = |rest: &str| fs::write(folder.path("grid.toml"), format!("device = \"mybee.toml\"\n{rest}"));
    let derived = "[derived]\ntransmission_stiffness = \"device.transmission_stiffness * 4\"\n";
    write(&format!("{derived}{AXES}")).unwrap();
    let written = folder.ends(0, "device new grid.toml");
    let stiffness = written.stdout.lines().find(|line| line.starts_with("transmission_stiffness = "));
    fs::write(folder.path("copy.toml"), &written.stdout).unwrap();
    let of_grid = folder.ends(0, "run grid.toml --set drive_frequency=120 --format csv").stdout;
    let of_copy = folder.ends(0, "run copy.toml --set drive_frequency=120 --format csv").stdout;
    assert_eq!(of_grid, of_copy, "{stiffness:?}");
    assert_ne!(of_copy, folder.ends(0, "run mybee.toml --set drive_frequency=120 --format csv").stdout);
    written.says("a device has no axes: it has the values before the axes are applied, drive_frequency = ");

    write(&format!("[derived]\ntransmission_stiffness = \"drive_frequency\"\n{AXES}")).unwrap();
    folder
        .ends(2, "device new grid.toml")
        .says("`transmission_stiffness` is derived from `drive_frequency`, which has an axis")
        .says("help: set drive_frequency under [params]");
    write("[derived]\ntransmission_stiffness = \"-1\"\n").unwrap();
    folder.ends(2, "device new grid.toml").says("`transmission_stiffness` is computed as -1");
    write("[params]\ndrive_frequency = \"resonance\"\n").unwrap();
    folder.ends(2, "device new grid.toml").says("`drive_frequency` is the resonance of each design");
    // A parameter that only other designs set is not set in the device of the first design.
    fs::write(folder.path("other.toml"), params("wing_radius_1 = 0.5")).unwrap();
    fs::write(folder.path("grid.toml"), "device = [\"mybee.toml\", \"other.toml\"]\n").unwrap();
    let written = folder.ends(0, "device new grid.toml");
    written.says("device = mybee");
    assert!(!written.stdout.contains("NaN"), "{}", written.stdout);
}

/// Values of axes and formulas have no standard errors.
#[test]
fn standard_errors_belong_to_the_values_of_the_device() {
    let folder = folder();
    let rest = "[axes]\nhinge_stiffness = [1e-6, 2e-6]\n";
    fs::write(folder.path("grid.toml"), format!("device = \"mybee.toml\"\n{rest}")).unwrap();
    let listed = folder.ends(0, "models grid.toml").stdout;
    let line = |name: &str| listed.lines().find(|line| line.trim().starts_with(name)).unwrap().to_owned();
    assert!(!line("hinge_stiffness ").contains('±'), "{listed}");
    assert!(line("wing_inertia_stroke ").contains("± 1 ng*m^2"), "{listed}");
}
