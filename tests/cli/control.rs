//! `flap vehicle`: the matrix of control effectiveness, its inputs and trims.

use std::fs;

use crate::support::{Folder, VEHICLE, WINGS, near};

/// The lines of the matrix: the name of each input, its value, and the change of force and torque.
fn matrix(folder: &Folder, arguments: &str) -> Vec<(String, f64, [f64; 6])> {
    let text = folder.ends(0, &format!("vehicle {arguments} --format csv")).stdout;
    let line = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        let numbers: Vec<f64> = cells[2..].iter().map(|cell| cell.parse().unwrap_or(f64::NAN)).collect();
        (cells[0].to_owned(), numbers[0], core::array::from_fn(|i| numbers[i + 1]))
    };
    text.lines().skip(1).map(line).collect()
}

/// If an input is almost zero, the change is a share of its typical size. A share of the input itself would be lost in
/// rounding.
#[test]
fn inputs_of_almost_nothing_have_the_slopes_of_zero() {
    let folder = Folder::with_grid(VEHICLE);
    let pitch = |offset: &str| {
        let found = matrix(&folder, &format!("grid.toml --inputs bias --set drive_offset={offset}"));
        found[1].2[4]
    };
    let at_zero = pitch("0");
    assert!(at_zero < -0.01, "{at_zero}");
    for offset in ["1e-15", "1e-9", "-1e-6", "1e-3"] {
        near(pitch(offset), at_zero, 1e-5);
    }
    let of_one = |own: &str| matrix(&folder, &format!("grid.toml --inputs left_bias {own}"))[1].2[4];
    near(of_one("--set left_drive_offset=1e-9"), of_one(""), 1e-5);
    let difference =
        |own: &str| matrix(&folder, &format!("grid.toml --inputs bias_difference {own}"))[1].2[5];
    near(difference("--set difference_drive_offset=1e-9 --set drive_offset=1e-9"), difference(""), 1e-4);
}

/// After a trim to zero torque, the differences of the wings' inputs are almost zero.
#[test]
fn the_matrix_after_a_trim_is_that_without_the_rest() {
    let folder = Folder::with_grid(&format!(
        "{VEHICLE}[params]\ndrive_shape = \"harmonics\"\ndrive_second_phase = \"90 deg\"\n"
    ));
    let targets = "--trim force_up=2 --trim torque_roll=0 --trim torque_pitch=0 --trim torque_yaw=0";
    let trimmed = matrix(&folder, &format!("grid.toml {targets}"));
    assert_eq!(trimmed.len(), 7);
    let exact = matrix(&folder, &format!("grid.toml --set drive_voltage_pp={}", trimmed[1].1));
    for (one, other) in trimmed[1..].iter().zip(&exact[1..]) {
        assert_eq!(one.0, other.0);
        let largest = other.2.iter().fold(0.0, |largest: f64, slope| largest.max(slope.abs()));
        for (slope, wanted) in one.2.iter().zip(&other.2) {
            assert!((slope - wanted).abs() < 2e-3 * largest, "{one:?}, not {other:?}");
        }
    }
}

/// The derivative per one per cent is the value times the slope, for any small value.
#[test]
fn per_cents_of_almost_nothing_are_exact() {
    let folder = Folder::with_grid(VEHICLE);
    let slope = matrix(&folder, "grid.toml --inputs bias")[1].2[4];
    for offset in [1e-9, 1e-3] {
        let gradient = "[gradient]\nof = [\"torque_pitch_unm\"]\nwith_respect_to = [\"drive_offset\"]\n";
        let grid = format!(
            "{VEHICLE}[params]\ndrive_offset = {offset}\n{gradient}[output]\ncolumns = [\"torque_pitch_unm\"]\n"
        );
        fs::write(folder.path("tiny.toml"), grid).unwrap();
        folder.ends(0, "sweep tiny.toml --restart");
        let rows = folder.read("tiny.csv");
        let place =
            rows.lines().next().unwrap().split(',').position(|name| name.starts_with("d_torque")).unwrap();
        let found: f64 = rows.lines().nth(1).unwrap().split(',').nth(place).unwrap().parse().unwrap();
        near(found, 0.01 * offset * slope, 1e-5);
    }
}

/// A wing's parameter that is not set has the value of all wings, wherever an expression names the parameter.
#[test]
fn parameters_of_a_wing_that_are_not_set_have_the_common_value() {
    let folder = Folder::with_grid(&format!(
        "{VEHICLE}[sample]\nmethod = \"random\"\nn = 3\n[sample.parameters]\nleft_drive_voltage_pp = {{ relative_sd = \"5 %\" }}\n\
         [where]\nwide = \"left_wing_area <= wing_area and left_wing_area >= preset.left_wing_area\"\n\
         [gradient]\nof = [\"torque_roll_unm\"]\nwith_respect_to = [\"left_hinge_stiffness\"]\n"
    ));
    folder.ends(0, "sweep grid.toml --out rows.csv");
    let rows = folder.read("rows.csv");
    let names: Vec<&str> = rows.lines().next().unwrap().split(',').collect();
    let place = |name: &str| names.iter().position(|known| *known == name).unwrap();
    let volts = place("left_drive_voltage_pp");
    let slope = place("d_torque_roll_unm_per_pct_left_hinge_stiffness");
    for row in rows.lines().skip(1) {
        let number = |place: usize| row.split(',').nth(place).unwrap().parse::<f64>().unwrap();
        assert!((150.0..250.0).contains(&number(volts)) && number(slope).abs() > 1e-5, "{row}");
        let own =
            format!("grid.toml --inputs left_hinge_stiffness --set left_drive_voltage_pp={}", number(volts));
        let matrix = matrix(&folder, &own);
        near(number(slope), 0.01 * matrix[1].1 * matrix[1].2[3], 1e-4);
    }
    assert_eq!(rows.lines().count(), 4);
    // Not so where an axis varies the common value: a mean would be of another point.
    let varied = format!(
        "{VEHICLE}[axes]\ndrive_voltage_pp = [150, 200]\n[sample]\nmethod = \"random\"\nn = 3\n\
         [sample.parameters]\nleft_drive_voltage_pp = {{ relative_sd = \"5 %\" }}\n"
    );
    fs::write(folder.path("varied.toml"), varied).unwrap();
    folder.refuses("check varied.toml", "is not set, so it has no value for the mean");
}

#[test]
fn trims_reach_small_targets_too() {
    let folder = Folder::with_grid(VEHICLE);
    let found =
        matrix(&folder, "grid.toml --inputs amplitude,bias --trim force_up=1 --trim torque_pitch=0.01");
    near(found[0].2[2], 1.0, 1e-6);
    near(found[0].2[4], 0.01, 1e-6);
}

/// The default inputs do not include inputs without effect.
#[test]
fn usual_inputs_do_something() {
    let folder = Folder::new();
    for preset in ["arabagi2013-75hz", "ozaki2018-large"] {
        let head = VEHICLE.replace("jafferis2016", preset);
        fs::write(folder.path("grid.toml"), head).unwrap();
        let found = matrix(&folder, "grid.toml");
        assert!(found[1].0 == "amplitude" && found[2].0 == "amplitude_difference", "{found:?}");
        for (name, _, slopes) in &found[1..] {
            assert!(slopes.iter().any(|slope| slope.abs() > 1e-9), "{name} of {preset}: {slopes:?}");
        }
    }
    // The bias of this model follows the voltage until it has a value.
    folder.refuses("vehicle grid.toml --inputs bias", "`drive_bias`, which is not set");
    let bias = &matrix(&folder, "grid.toml --set drive_bias=100V --inputs bias")[1];
    assert!(bias.2[4].abs() > 1e-3, "{bias:?}");
}

/// If damping is zero, it can only grow, and its change affects force and torque.
#[test]
fn an_input_that_is_zero_has_its_one_sided_derivative() {
    let folder = Folder::with_grid(VEHICLE);
    // Line 0 has the mean force and torque; components are forward, left, up.
    let lift = |arguments: &str| matrix(&folder, &format!("grid.toml {arguments}"))[1].2[2];
    let slope = lift("--inputs stroke_damping");
    let near_zero = lift("--set stroke_damping=1e-12 --inputs stroke_damping");
    assert!(slope < 0.0, "{slope}");
    near(slope, near_zero, 1e-2);
    let growth = lift("--inputs transmission_growth");
    assert!(growth != 0.0);
}

/// A wing without voltage rests, even if the wind makes the rest unstable. The forces at a rest are proportional to the
/// square of the voltage, so they have no one-sided derivative.
#[test]
fn an_unstable_rest_has_no_one_sided_derivative() {
    let folder = Folder::with_grid(&format!(
        "preset = \"ozaki2018-large\"\n[params]\nflow_direction = \"blade\"\ndrive_voltage_pp = 0\n\
         drive_bias = 0\n[vehicle]\n{WINGS}"
    ));
    for speed in ["-3.5", "-4.2"] {
        let ended =
            folder.ends(2, &format!("vehicle grid.toml --inputs amplitude --set body_velocity_up={speed}"));
        ended.says("is missing: edge");
    }
}

#[test]
fn inputs_that_cannot_be_have_help() {
    let folder = Folder::with_grid(VEHICLE);
    for name in ["phase", "left_phase", "left_drive_phase", "phase_difference"] {
        folder
            .ends(2, &format!("vehicle grid.toml --inputs {name}"))
            .says("the vehicle has no input")
            .says("it would not change any mean force or torque");
    }
    folder.refuses("vehicle grid.toml --inputs left_frequency", "the vehicle has no input");
    folder
        .ends(2, "vehicle grid.toml --set drive_voltage_pp=0 --inputs amplitude")
        .says("is missing: edge")
        .says("help: the input is at an end of its range");
    folder
        .ends(2, "vehicle grid.toml --set charge_recovery=1 --inputs charge_recovery")
        .says("is missing: edge")
        .says("help: the input is at an end of its range");
    folder.refuses("run grid.toml --set left_position_x=nan", "--set left_position_x=nan: ");
    folder
        .ends(2, "run grid.toml --set left_drive_frequency=100")
        .says("there is no parameter `left_drive_frequency`")
        .says("`drive_frequency` is common to all wings: write `drive_frequency`");
    folder
        .ends(2, "run grid.toml --set left_body_velocity_forward=1")
        .says("`body_velocity_forward` is common to all wings: write `body_velocity_forward`");
    for (arguments, message) in [
        ("run grid.toml --set total_mass=1 --set total_mass=2", "--set: `total_mass` is given twice"),
        ("vehicle grid.toml --trim force_up=1 --trim force_up=2", "--trim: `force_up` is given twice"),
        ("vehicle grid.toml --trim hover=1", "write hover without a value"),
        (
            "vehicle grid.toml --trim hover --set total_mass=1e308",
            "total_mass is 1e308 kg: the weight is not finite",
        ),
        (
            "vehicle grid.toml --inputs second_phase --set drive_shape=sine",
            "the input `second_phase` has an effect only with drive_shape = \"harmonics\"",
        ),
        (
            "vehicle grid.toml --fly 1s --disturb rate_yaw=1 --disturb rate_yaw=2",
            "--disturb: `rate_yaw` is given twice",
        ),
        (
            "vehicle grid.toml --fly -1s --set body_inertia_roll=1.5e-9 --set body_inertia_pitch=1.5e-9 --set body_inertia_yaw=5e-10",
            "a flight of -1 s is impossible",
        ),
        ("run grid.toml --point -1", "expected a whole number of 0 or more"),
    ] {
        folder.refuses(arguments, message);
    }
}
