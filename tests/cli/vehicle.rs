//! Vehicles: grid files with `[vehicle]`, and `flap vehicle`.

use std::fmt::Write as _;
use std::fs;

use crate::support::{Folder, VEHICLE, numbers};
#[cfg(unix)]
use crate::support::{send, sweep_until, wait};

const AXES: &str = "\
[params]
drive_frequency = \"100 Hz\"
[axes]
left_drive_voltage_pp = { from = \"150 V\", to = \"200 V\", n = 6 }
difference_drive_offset = { from = \"-20 V\", to = \"20 V\", n = 5 }
";

fn folder() -> Folder {
    Folder::with_grid(&format!("{VEHICLE}{AXES}"))
}

#[test]
fn rows_have_force_torque_and_the_wings() {
    let folder = folder();
    folder.ends(0, "sweep grid.toml --out all.csv");
    let rows = folder.read("all.csv");
    let [roll, lift] = ["torque_roll_unm", "force_up_mn"].map(|name| numbers(&rows, name));
    assert_eq!(roll.len(), 30);
    // Less drive on the left lowers the left side.
    assert!(roll[2] < -1.0 && roll[27].abs() < 1e-3, "{roll:?}");
    let ratio = numbers(&rows, "lift_to_weight");
    assert!((ratio[0] - lift[0] * 1e-3 / (85e-6 * 9.80665)).abs() < 1e-12);
    let [efficiency, power] = ["efficiency_gf_per_w", "power_mean_mw"].map(|name| numbers(&rows, name));
    assert!((efficiency[0] / (lift[0] / 9.80665 / (power[0] * 1e-3)) - 1.0).abs() < 1e-12);
    let strokes = ["left_stroke_pp_deg", "right_stroke_pp_deg"].map(|name| numbers(&rows, name));
    assert!(strokes[0][0] < strokes[1][0]);
}

/// Threads, shards, formats and an interruption do not change a byte.
#[test]
fn rows_have_the_same_bytes_however_they_are_made() {
    let folder = folder();
    folder.ends(0, "sweep grid.toml --out all.csv --threads 2");
    folder.ends(0, "sweep grid.toml --out one.csv --threads 1");
    assert_eq!(folder.read("all.csv"), folder.read("one.csv"));
    folder.ends(0, "sweep grid.toml --out part1.csv --shard 1/2");
    folder.ends(0, "sweep grid.toml --out part2.csv --shard 2/2");
    folder.ends(0, "results merge merged.csv part1.csv part2.csv");
    assert_eq!(folder.read("all.csv"), folder.read("merged.csv"));
    folder.ends(0, "sweep grid.toml --out rows.parquet");
    folder.ends(0, "results convert rows.parquet converted.csv");
    assert_eq!(folder.read("all.csv"), folder.read("converted.csv"));
    folder.ends(0, "results verify all.csv merged.csv rows.parquet");
}

/// A resumed sweep has the same bytes as an uninterrupted sweep.
#[test]
#[cfg(unix)]
fn an_interrupted_sweep_goes_on() {
    let axes = "[axes]\nleft_drive_voltage_pp = { from = 100, to = 200, n = 3000 }\n";
    let folder = Folder::with_grid(&format!("{VEHICLE}{axes}"));
    let mut child = sweep_until(&folder, 1);
    send("INT", &child);
    assert_eq!(wait(&mut child), Some(130));
    assert!(folder.read("grid.csv").lines().count() < 3000);
    folder.ends(0, "results resume grid.csv");
    folder.ends(0, "sweep grid.toml --out whole.csv");
    assert!(folder.read("grid.csv") == folder.read("whole.csv"));
}

/// A wing with its own design equals a wing whose parameters are set to the values of this design.
#[test]
fn a_wing_has_a_design_of_its_own() {
    let folder = Folder::new();
    fs::write(
        folder.path("worn.toml"),
        "preset = \"jafferis2016\"\n[params]\nhinge_stiffness = \"1.3 uN*m/rad\"\n",
    )
    .unwrap();
    let with = |key: &str| VEHICLE.replacen("name = \"left\"", &format!("name = \"left\"\n{key}"), 1);
    for (file, text) in [
        ("device.toml", with("device = \"worn.toml\"")),
        ("params.toml", with("params = { hinge_stiffness = \"1.3 uN*m/rad\" }")),
        ("flat.toml", format!("{VEHICLE}[params]\nleft_hinge_stiffness = \"1.3 uN*m/rad\"\n")),
    ] {
        fs::write(folder.path(file), text).unwrap();
        folder.ends(0, &format!("sweep {file} --out {file}.csv"));
    }
    let row = |file: &str| folder.read(&format!("{file}.toml.csv"));
    assert_eq!(row("device"), row("params"));
    assert_eq!(
        numbers(&folder.read("flat.toml.csv"), "torque_roll_unm"),
        numbers(&folder.read("device.toml.csv"), "torque_roll_unm")
    );
    assert!(numbers(&folder.read("flat.toml.csv"), "torque_roll_unm")[0].abs() > 1e-3);
    // Results know the device, wherever the file is.
    fs::remove_file(folder.path("worn.toml")).unwrap();
    folder.ends(0, "results rerun device.toml.csv --status periodic --rtol 1e-7 --out again.csv");
}

/// The control matrix equals the derivatives in the columns of `[gradient]`.
#[test]
fn the_matrix_of_inputs_is_that_of_derivatives() {
    let gradient = "[params]\ndrive_offset = \"5 V\"\n[gradient]\nof = [\"torque_pitch_unm\"]\nwith_respect_to = [\"drive_offset\"]\n";
    let folder = Folder::with_grid(&format!("{VEHICLE}{gradient}"));
    folder.ends(0, "sweep grid.toml --out rows.csv");
    let slope = numbers(&folder.read("rows.csv"), "d_torque_pitch_unm_per_pct_drive_offset")[0] / 0.05;
    let inputs = "--inputs bias,about_z,about_x,left_plane_pitch";
    let text = folder.ends(0, &format!("vehicle grid.toml {inputs} --format csv")).stdout;
    let lines: Vec<Vec<&str>> = text.lines().map(|line| line.split(',').collect()).collect();
    let number = |line: usize, place: usize| lines[line][place].parse::<f64>().unwrap();
    let [forward, up] = [number(1, 3), number(1, 5)];
    // Torques refer to a point, and the pitch of a stroke plane turns the lift of one of two wings forward.
    for (line, input, place, slope, share) in [
        (2, ["bias", "V", "5.0"], 7, slope, 1e-6),
        (3, ["about_z", "mm", "-3.0"], 7, -forward, 1e-5),
        (4, ["about_x", "mm", "0.0"], 7, up, 1e-5),
        (5, ["left_plane_pitch", "deg", "0.0"], 3, 0.5 * up * 1.0_f64.to_radians(), 1e-5),
    ] {
        let found = number(line, place);
        assert_eq!(&lines[line][..3], input, "{text}");
        assert!((found / slope - 1.0).abs() < share, "{input:?}: {found}, not {slope}");
    }
    let pitch = [-2.9, -3.1].map(|mm| {
        let ended = folder.ends(0, &format!("run grid.toml --set about_z={mm}mm --format csv"));
        let line = ended.stdout.lines().find_map(|line| line.strip_prefix("torque_pitch_unm,")).unwrap();
        line.split(',').next().unwrap().parse::<f64>().unwrap()
    });
    let [found, difference] = [number(3, 7), (pitch[0] - pitch[1]) / 0.2];
    assert!((found / difference - 1.0).abs() < 1e-4, "{found}, not {difference}");
    folder.ends(0, "vehicle grid.toml").prints("amplitude_difference").prints("roll").prints("+1.00 bias");
    folder.ends(0, "vehicle grid.toml --format json").prints("\"torque_yaw_unm\"");
}

#[test]
fn trims_reach_their_targets() {
    let folder = Folder::with_grid(VEHICLE);
    let inputs = "--inputs amplitude,amplitude_difference,bias";
    let targets = "--trim force_up=2.1 --trim torque_roll_unm=0.3 --trim torque_pitch=-0.2";
    let text = folder.ends(0, &format!("vehicle grid.toml {inputs} {targets} --format csv")).stdout;
    let mean: Vec<f64> =
        text.lines().nth(1).unwrap().split(',').skip(3).map(|cell| cell.parse().unwrap()).collect();
    for (place, target) in [(2, 2.1), (3, 0.3), (4, -0.2)] {
        assert!((mean[place] - target).abs() < 1e-5, "{mean:?}");
    }
    // The inputs that it prints give that wrench.
    let value = |line: usize| text.lines().nth(line).unwrap().split(',').nth(2).unwrap().to_owned();
    let set = format!(
        "--set drive_voltage_pp={} --set difference_drive_voltage_pp={} --set drive_offset={}",
        value(2),
        value(3),
        value(4)
    );
    let run = folder.ends(0, &format!("run grid.toml {set}")).stdout;
    let lift = run.lines().find(|line| line.starts_with("force_up_mn")).unwrap();
    assert!(lift.contains("2.1 ") || lift.contains("2.09999") || lift.contains("2.10000"), "{lift}");
    let text =
        folder.ends(0, "vehicle grid.toml --inputs about_x --trim torque_pitch=0.5 --format csv").stdout;
    let cell = |line: usize, place: usize| {
        text.lines().nth(line).unwrap().split(',').nth(place).unwrap().parse::<f64>().unwrap()
    };
    // A lever of the lift in mm.
    assert!((cell(2, 2) * cell(1, 5) / 0.5 - 1.0).abs() < 1e-5, "{text}");
    folder.refuses(
        &format!("vehicle grid.toml {inputs} --trim force_up=50"),
        "the targets are not reached: force_up_mn",
    );
    // Only the missed target is named.
    let missed =
        folder.ends(2, &format!("vehicle grid.toml {inputs} --trim force_up=50 --trim torque_roll=0"));
    missed.says("instead of 50.0000000, but a trim allows a difference of 1.9e-3");
    assert!(!missed.stderr.contains("torque_roll"), "{}", missed.stderr);
    folder.refuses(
        "vehicle grid.toml --inputs bias --trim force_up=2 --trim torque_roll=0",
        "2 targets need at least 2 inputs with an effect, not only [bias]",
    );
}

/// Grid files with mistakes, each with its message.
#[test]
fn mistakes_in_vehicles_are_told_with_their_place() {
    let wing = "[[vehicle.wings]]\nname = \"left\"\n";
    for (text, told) in [
        ("[vehicle]\nabout = [0, 0, 0]\n", "grid.toml:3:2: a vehicle needs at least one wing"),
        ("[vehicle]\nwings = []\n", "grid.toml:4:9: `wings` must be a list of tables"),
        ("[vehicle]\nwings = [{}]\n", "grid.toml:4:10: the wing has no `name`"),
        ("[vehicle]\nwing = 1\n", "unknown key `wing` in [vehicle]"),
        (&format!("{wing}mirrored = \"y\"\n"), "grid.toml:5:12: `mirrored` must be true or false"),
        (&format!("{wing}{wing}"), "grid.toml:6:8: two wings are called `left`"),
        (
            "[[vehicle.wings]]\nname = \"Left\"\n",
            "grid.toml:4:8: `Left` is not allowed as the name of a wing",
        ),
        (&format!("{wing}position = [1, 2]\n"), "`position` must be a list of three lengths"),
        (&format!("{wing}position = [\"1 V\", 0, 0]\n"), "`V` is a voltage"),
        (
            &format!("{wing}plane = {{ dihedral = \"5 deg\" }}\n"),
            "unknown key `dihedral` in the plane of a wing",
        ),
        (
            &format!("{wing}params = {{ wing_mass = \"1 mg\" }}\n"),
            "it is a parameter of the models direct-drive and four-bar",
        ),
        (
            &format!("{wing}params = {{ drive_frequency = 120 }}\n"),
            "`drive_frequency` cannot differ between wings",
        ),
        (
            &format!("{wing}params = {{ drive_shape = \"square\" }}\n"),
            "`drive_shape` cannot differ between wings",
        ),
        (&format!("{wing}params = {{ wing_area = -1 }}\n"), "`left_wing_area` must be more than zero"),
        (&format!("{wing}preset = \"ozaki2018-large\"\n"), "the wing `left` has the model direct-drive"),
        (&format!("{wing}device = \"nothing.toml\"\n"), "grid.toml:5:10: nothing.toml: "),
        (
            &format!("{wing}[params]\ndrive_frequency = \"resonance\"\n"),
            "vehicles are not run at their resonance",
        ),
        (
            &format!("{wing}[axes]\ndifference_drive_offset = [1, 2]\n"),
            "has no parameter `difference_drive_offset`",
        ),
        (
            &format!("{wing}[axes]\ndifference_drive_offset = [1, 2]\n"),
            "a left-right difference requires wings on both sides",
        ),
        (
            &format!("{wing}[axes]\nleft_drive_frequency = [100, 110]\n"),
            "help: `drive_frequency` is common to all wings: write `drive_frequency`",
        ),
        (
            &format!("{wing}[axes]\nleft_drive_shape = [\"square\"]\n"),
            "help: `drive_shape` is common to all wings: write `drive_shape`",
        ),
        (
            &format!("{wing}[params]\nleft_drive_phase = \"30 deg\"\n"),
            "help: you cannot set a phase between wings",
        ),
        (&format!("{wing}plane = [0, 0, 0]\n"), "help: write plane = { roll = \"5 deg\""),
        (&format!("{wing}plane = {{ dihedral = \"5 deg\" }}\n"), "help: write plane = { roll = \"5 deg\""),
        (&format!("{wing}position = [nan, 0, 0]\n"), "help: write a finite number in m, or text with a unit"),
        ("[[vehicle.wings]]\nname = \"Left\"\n", "help: write a name such as \"left\""),
        (&format!("{wing}{wing}"), "help: give each wing a name of its own"),
        ("[vehicle]\nwings = []\n", "help: write [[vehicle.wings]]"),
        (
            &format!("[vehicle]\ntotal_mass = 0\n{wing}"),
            "help: write total_mass = \"85 mg\", or leave it out",
        ),
        (
            &format!("[vehicle]\ntotal_mass = nan\n{wing}"),
            "help: write total_mass = \"85 mg\", or leave it out",
        ),
        (
            &format!("{wing}position = [0, \"1 mm\", 0]\n[derived]\nleft_position_y = \"0.001\"\n"),
            "`left_position_y` is derived and set in [vehicle]",
        ),
        (&format!("{wing}[axes]\nright_drive_offset = [1, 2]\n"), "did you mean `left_drive_offset`?"),
    ] {
        let folder = Folder::with_grid(&format!("preset = \"jafferis2016\"\n\n{text}"));
        let ended = folder.ends(2, "check grid.toml");
        // Some have a place in front.
        let (place, message) =
            told.split_once(": ").filter(|_| told.starts_with("grid.toml")).unwrap_or(("", told));
        ended.says(place).says(message);
    }
    let other = format!("preset = \"ozaki2018-large\"\n\n{wing}preset = \"ozaki2018-small\"\n");
    let folder = Folder::with_grid(&other);
    folder.ends(2, "check grid.toml").says("the wing `left` flaps at 209 Hz, but the vehicle at 109 Hz");
    for set in [
        "[params]\ndrive_frequency = 150\n",
        "[[zip]]\ndrive_frequency = [150, 160]\ndrive_voltage_pp = [60, 70]\n",
        "[sample]\nmethod = \"random\"\nn = 2\n[sample.parameters]\ndrive_frequency = { from = 140, to = 160 }\n",
    ] {
        let folder = Folder::with_grid(&format!("{other}{set}"));
        folder.ends(0, "run grid.toml").prints("force_up_mn");
    }
}

/// The message points at the first wing that is too many.
#[test]
fn seventeen_wings_are_too_many() {
    let mut text = "preset = \"jafferis2016\"\n".to_owned();
    for wing in 0..17 {
        let _ = writeln!(text, "[[vehicle.wings]]\nname = \"w{wing}\"");
    }
    let folder = Folder::with_grid(&text);
    folder
        .ends(2, "check grid.toml")
        .says("--> grid.toml:34:1")
        .says("17 wings are too many: a vehicle has at most 16")
        .says("help: remove this wing");
}

/// A wing with its own preset or device takes all values except the drive from this design. The grid's `[params]` do
/// not change these values.
#[test]
fn a_wing_keeps_its_design_when_the_grid_changes() {
    let with = |key: &str| VEHICLE.replacen("mirrored = true", &format!("mirrored = true\n{key}"), 1);
    let set = "[params]\nhinge_stiffness = \"1.2 uN*m/rad\"\ndrive_voltage_pp = 180\n";
    let folder = Folder::with_grid(&format!("{}{set}", with("preset = \"jafferis2016\"")));
    folder.ends(0, "sweep grid.toml --out preset.csv");
    let own = "params = { hinge_stiffness = \"1.4972 uN*m/rad\" }";
    fs::write(folder.path("own.toml"), format!("{}{set}", with(own))).unwrap();
    folder.ends(0, "sweep own.toml --out own.csv");
    let roll = |file: &str| numbers(&folder.read(file), "torque_roll_unm")[0];
    assert!((roll("preset.csv") / roll("own.csv") - 1.0).abs() < 1e-6);
    assert!(roll("own.csv").abs() > 1e-2);
    // What reaches no wing is told.
    let both = with("preset = \"jafferis2016\"").replacen(
        "name = \"left\"",
        "name = \"left\"\npreset = \"jafferis2016\"",
        1,
    );
    fs::write(folder.path("both.toml"), format!("{both}{set}")).unwrap();
    for command in ["check both.toml", "sweep both.toml"] {
        let ended = folder.ends(0, command);
        ended.says("both.toml: `hinge_stiffness` has no effect: every wing sets its own `hinge_stiffness`");
        assert!(!ended.stderr.contains("drive_voltage_pp"), "{}", ended.stderr);
    }
}

#[test]
fn a_check_lists_the_wings() {
    folder().ends(0, "check grid.toml").prints("a vehicle of 2 wings: left, right (mirrored)");
}

#[test]
fn what_a_vehicle_cannot_do_is_told() {
    let folder = Folder::with_grid(VEHICLE);
    folder.refuses("vehicle jafferis2016", "jafferis2016 describes one wing, not a vehicle");
    folder.refuses("vehicle grid.toml --inputs bais", "the vehicle has no input `bais`");
    folder.refuses("vehicle grid.toml --inputs bias,drive_offset", "`drive_offset` is named twice");
    folder.refuses("vehicle grid.toml --inputs drive_shape", "`drive_shape` is a choice, not an input");
    folder.refuses(
        "run grid.toml --set difference_hinge_thickness=1e-6",
        "difference_hinge_thickness requires a value of hinge_thickness, which is not set",
    );
    folder.refuses("vehicle grid.toml --trim torque_up=1", "there is no component `torque_up`");
    folder.refuses("vehicle grid.toml --trim torque_yaw=far", "`far` is not a number");
    for (command, taker) in [
        ("run grid.toml --trajectory motion.csv", "`flap run` with --trajectory"),
        ("test chirp grid.toml", "`flap test chirp`"),
        ("test impulse grid.toml", "`flap test impulse`"),
        ("respond grid.toml --from 90 --to 100 --step 5", "`flap respond`"),
        ("test resonance grid.toml", "`flap test resonance`"),
        ("test lift grid.toml motion.csv", "`flap test lift`"),
        ("device new grid.toml", "`flap device new`"),
    ] {
        let ended = folder.ends(2, command);
        ended.says(&format!("grid.toml is a vehicle of 2 wings, but {taker} requires one wing"));
        ended.says("help: remove [vehicle] from the file");
        assert_eq!(ended.stdout, "");
    }
}
