//! Rows of vehicles at hover, and rows with the damping matrix.

use std::fs;

use crate::support::{Folder, WINGS, column, near, numbers};

/// The robot of the manual, up to the table `[vehicle]`, to which each test adds keys.
const HEAD: &str = "\
preset = \"jafferis2016\"
[params]
drive_voltage_pp = \"140 V\"
drive_frequency = \"120 Hz\"
[axes]
about_z = [\"-1 mm\", \"-3 mm\"]
hinge_stiffness = [1.3e-6, 1.7e-6]
";

const BODY: &str = "\
[vehicle]
total_mass = \"69 mg\"
body_inertia_roll = 1.5e-9
body_inertia_pitch = 1.5e-9
body_inertia_yaw = 0.5e-9
";

/// The columns of hover contain the numbers that `flap vehicle` prints. Threads, shards and formats do not change the
/// bytes.
#[test]
fn rows_at_hover_are_the_numbers_of_the_command() {
    let folder = Folder::with_grid(&format!("{HEAD}{BODY}trim = \"hover\"\ndamping = true\n{WINGS}"));
    folder.ends(0, "sweep grid.toml --out all.csv --threads 2");
    folder.ends(0, "sweep grid.toml --out one.csv --threads 1");
    folder.ends(0, "sweep grid.toml --out part1.csv --shard 1/2");
    folder.ends(0, "sweep grid.toml --out part2.csv --shard 2/2");
    folder.ends(0, "results merge merged.csv part1.csv part2.csv");
    let rows = folder.read("all.csv");
    assert_eq!(rows, folder.read("one.csv"));
    assert_eq!(rows, folder.read("merged.csv"));

    let given = Folder::with_grid(&format!("{HEAD}{BODY}{WINGS}"));
    let growth = numbers(&rows, "hover_growth_1_s");
    let slowest = growth.iter().copied().fold(f64::INFINITY, f64::min);
    let best = folder.ends(0, "top all.csv --by hover_growth_1_s -n 1 --format csv").stdout;
    assert_eq!(numbers(&best, "hover_growth_1_s"), [slowest]);
    let weight = 69e-6 * 9.80665 * 1e3;
    for point in 0..4 {
        near(numbers(&rows, "force_up_mn")[point], weight, 2e-6);
        let command = |options: &str| {
            let line = format!("vehicle grid.toml --point {point} --trim hover --format csv {options}");
            given.ends(0, &line).stdout
        };
        let modes = command("--hover");
        near(growth[point], numbers(&modes, "eigenvalue_real")[0], 1e-9);
        let period = numbers(&modes, "period_s")[0];
        let found = numbers(&rows, "hover_period_s")[point];
        assert!(found.is_nan() == period.is_nan() && (found.is_nan() || (found / period - 1.0).abs() < 1e-9));
        let inputs = command("");
        for (name, value) in column(&inputs, "input").iter().zip(numbers(&inputs, "value")).skip(1) {
            near(numbers(&rows, &format!("hover_{name}_v"))[point], value, 1e-9);
        }
        let damping = command("--damping");
        let yaw = numbers(&rows, "d_torque_yaw_unm_per_si_body_rate_yaw")[point];
        near(yaw * 1e-6, numbers(&damping, "rate_yaw")[5], 1e-9);
        let coupling = numbers(&rows, "d_torque_pitch_unm_per_si_body_velocity_forward")[point];
        near(coupling * 1e-6, numbers(&damping, "velocity_forward")[4], 1e-9);
    }
    // The robot of 1 mm tips over without oscillation, and the robot of 3 mm oscillates.
    assert!(growth[0] > 4.0 * growth[2], "{growth:?}");
    assert!(numbers(&rows, "hover_period_s")[0].is_nan() && numbers(&rows, "hover_period_s")[2] > 0.5);

    // A single point has all columns of its row.
    let single = folder.ends(0, "run grid.toml --point 2 --format csv").stdout;
    let header = rows.lines().next().unwrap().split(',').skip_while(|name| *name != "hover_growth_1_s");
    let names: Vec<&str> = header.take_while(|name| *name != "cycles").collect();
    assert_eq!(names.len(), 3 + 4 + 36, "{names:?}");
    for name in names {
        let line = single.lines().find(|line| line.starts_with(&format!("{name},")));
        let found: f64 = line
            .unwrap_or_else(|| panic!("no {name} in\n{single}"))
            .split(',')
            .nth(1)
            .unwrap()
            .parse()
            .unwrap();
        let wanted = numbers(&rows, name)[2];
        assert!((found - wanted).abs() <= 1e-4 * wanted.abs() + 1e-3, "{name}: {found}, not {wanted}");
    }

    // The trim of the grid file applies to single points, too.
    let modes = folder.ends(0, "vehicle grid.toml --point 2 --hover --format csv");
    near(growth[2], numbers(&modes.stdout, "eigenvalue_real")[0], 1e-4);
    assert!(modes.stderr.contains("amplitude = ") && modes.stderr.contains("hovers"), "{}", modes.stderr);
}

/// A design that cannot hover has a row without measures, and the summary contains the reason.
#[test]
fn designs_that_cannot_hover_are_invalid() {
    let axes = HEAD.replace("about_z = [\"-1 mm\", \"-3 mm\"]", "total_mass = [\"69 mg\", \"2 g\"]");
    let body = BODY.replace("total_mass = \"69 mg\"\n", "");
    let folder = Folder::with_grid(&format!("{axes}{body}trim = \"hover\"\n{WINGS}"));
    let ended = folder.ends(0, "sweep grid.toml --out rows.csv");
    let rows = folder.read("rows.csv");
    assert_eq!(column(&rows, "status"), ["periodic", "periodic", "invalid", "invalid"]);
    assert_eq!(column(&rows, "hover_growth_1_s")[2], "");
    assert!(ended.stderr.contains("does not reach hover"), "{}", ended.stderr);
    let one = folder.ends(2, "run grid.toml --point 2");
    assert!(one.stderr.contains("does not reach hover"), "{}", one.stderr);
}

/// Without moments of inertia, rows at hover contain inputs and power, but no modes.
#[test]
fn a_mass_is_enough_for_the_power_of_hover() {
    let folder =
        Folder::with_grid(&format!("{HEAD}[vehicle]\ntotal_mass = \"69 mg\"\ntrim = \"hover\"\n{WINGS}"));
    folder.ends(0, "sweep grid.toml --out rows.csv");
    let rows = folder.read("rows.csv");
    assert!(column(&rows, "hover_growth_1_s").iter().all(String::is_empty), "{rows}");
    assert!(numbers(&rows, "hover_amplitude_v").iter().all(|volts| (100.0..200.0).contains(volts)), "{rows}");
    assert!(numbers(&rows, "power_mean_mw").iter().all(|power| *power > 1.0), "{rows}");
}

/// Derivatives at hover agree with differences of rows, whose inputs also change with the design.
#[test]
fn derivatives_at_hover_contain_the_change_of_the_inputs() {
    let measures = ["power_mean_mw", "hover_amplitude_v", "left_stroke_pp_deg", "power_per_volt"];
    let grid = |parameter: &str, values: [f64; 3], more: &str, vehicle: &str| {
        format!(
            "preset = \"jafferis2016\"\n[axes]\n{parameter} = {values:?}\n[solver]\nrtol = 1e-9\n\
             [measure]\npower_per_volt = \"power_mean_mw / drive_voltage_pp\"\n\
             [gradient]\nof = {:?}\nwith_respect_to = [{parameter:?}]\n{vehicle}trim = \"hover\"\n{WINGS}",
            [&measures[..], &[more]].concat(),
        )
    };
    let light = "[vehicle]\ntotal_mass = \"69 mg\"\n";
    let derived = "[derived]\ntotal_mass = \"46 * hinge_stiffness\"\n[vehicle]\n";
    let (growth, difference) = ("hover_growth_1_s", "hover_amplitude_difference_v");
    for (parameter, value, more, vehicle) in [
        ("hinge_stiffness", 1.5e-6, growth, light),
        ("hinge_stiffness", 1.5e-6, "force_up_mn", derived),
        ("left_hinge_stiffness", 1.5e-6, difference, light),
        ("total_mass", 69e-6, growth, "[vehicle]\n"),
    ] {
        let folder =
            Folder::with_grid(&grid(parameter, [value, 0.999 * value, 1.001 * value], more, vehicle));
        folder.ends(0, "sweep grid.toml --out rows.csv");
        let rows = folder.read("rows.csv");
        let slope = |measure: &str| format!("d_{measure}_per_pct_{parameter}");
        for measure in measures.into_iter().chain((more != growth).then_some(more)) {
            let values = numbers(&rows, measure);
            near(numbers(&rows, &slope(measure))[0], (values[2] - values[1]) / 0.2, 1e-4);
        }
        if more == growth {
            assert_eq!(column(&rows, &slope(growth))[0], "");
            assert_eq!(column(&rows, "gradient_gap")[0], "missing");
        } else {
            assert_eq!(column(&rows, "gradient_gap")[0], "");
        }
    }
    let amplitude = grid("drive_frequency", [120.0, 121.0, 122.0], growth, light)
        .replace("with_respect_to = [\"drive_frequency\"]", "with_respect_to = [\"drive_voltage_pp\"]");
    Folder::with_grid(&amplitude).refuses(
        "sweep grid.toml --out rows.csv",
        "`drive_voltage_pp` is an input that the search for hover changes",
    );
}

/// The search for hover changes its inputs, so neither formulas nor conditions can depend on these inputs.
#[test]
fn formulas_and_conditions_do_not_depend_on_the_inputs_of_hover() {
    for section in [
        "[derived]\nleft_drive_voltage_pp = \"0.95 * drive_voltage_pp\"",
        "[where]\nlimit = \"drive_voltage_pp < 150\"",
    ] {
        let grid = format!("{HEAD}{section}\n[vehicle]\ntotal_mass = \"69 mg\"\ntrim = \"hover\"\n{WINGS}");
        let folder = Folder::with_grid(&grid);
        folder.refuses(
            "sweep grid.toml --out rows.csv",
            "depends on drive_voltage_pp, which the search for hover changes",
        );
        fs::write(folder.path("free.toml"), grid.replace("trim = \"hover\"\n", "")).unwrap();
        folder.ends(0, "check free.toml");
    }
}

/// The lift of the four-bar jumps strip by strip, so differences replace its derivatives.
#[test]
fn rows_of_the_four_bar_have_a_damping_matrix() {
    let grid = format!("preset = \"arabagi2013-75hz\"\n[vehicle]\ndamping = true\n{WINGS}");
    let folder = Folder::with_grid(&grid);
    folder.ends(0, "sweep grid.toml --out rows.csv");
    let rows = folder.read("rows.csv");
    let damping = folder.ends(0, "vehicle grid.toml --damping --format csv").stdout;
    let vertical = numbers(&rows, "d_force_up_mn_per_si_body_velocity_up")[0];
    near(vertical * 1e-3, numbers(&damping, "velocity_up")[2], 1e-9);
    assert!(vertical < 0.0, "{vertical}");
}

/// Differences of rows are as exact as the rows, so a smaller tolerance hardly changes the damping matrix.
#[test]
fn the_damping_of_the_four_bar_has_small_errors() {
    let folder = Folder::with_grid(&format!("preset = \"arabagi2013-75hz\"\n[vehicle]\n{WINGS}"));
    let set = "--set drive_voltage_pp=120 --set drive_frequency=70 --damping --format csv";
    let [damping, exact] = ["", "--rtol 1e-10 --settle-tol 1e-9"]
        .map(|solver| folder.ends(0, &format!("vehicle grid.toml {set} {solver}")).stdout);
    for (place, name) in ["velocity_forward", "velocity_left", "velocity_up"].into_iter().enumerate() {
        let [one, other] = [&damping, &exact].map(|text| numbers(text, name)[place]);
        near(one / other, 1.0, 1e-4);
    }
}

/// The search for hover changes the inputs, so a formula of `[measure]` uses the inputs at hover.
#[test]
fn measures_have_the_inputs_at_hover() {
    let own = "[measure]\nvolts = \"drive_voltage_pp\"\n";
    let folder = Folder::with_grid(&format!("{HEAD}{BODY}trim = \"hover\"\n{WINGS}{own}"));
    folder.ends(0, "sweep grid.toml --out rows.csv");
    let rows = folder.read("rows.csv");
    for (volts, at_hover) in numbers(&rows, "volts").into_iter().zip(numbers(&rows, "hover_amplitude_v")) {
        near(volts, at_hover, 1e-12);
    }
    let single = folder.ends(0, "run grid.toml --format csv").stdout;
    let volts = single.lines().find_map(|line| line.strip_prefix("volts,")).unwrap();
    near(volts.split(',').next().unwrap().parse().unwrap(), numbers(&rows, "volts")[0], 1e-5);
}

#[test]
fn inputs_of_hover_do_not_vary() {
    let varied = HEAD.replace("about_z = [\"-1 mm\", \"-3 mm\"]", "drive_voltage_pp = [100, 140]");
    let folder = Folder::with_grid(&format!("{varied}{BODY}trim = \"hover\"\n{WINGS}"));
    let refused = folder.ends(2, "check grid.toml").stderr;
    assert!(refused.contains("the search for hover changes drive_voltage_pp, which varies"), "{refused}");
    // A bias hardly changes the forces of the four-bar, so only two inputs have an effect.
    let folder =
        Folder::with_grid(&format!("preset = \"arabagi2013-75hz\"\n{BODY}trim = \"hover\"\n{WINGS}"));
    let refused = folder.ends(2, "run grid.toml").stderr;
    let few = "4 targets need at least 4 inputs with an effect, not only [amplitude, amplitude_difference]";
    assert!(refused.contains(few), "{refused}");
}

/// The search for hover balances lift and torques, but not forward and sideways forces.
#[test]
fn unbalanced_rows_are_counted() {
    let axes = HEAD.replace("hinge_stiffness = [1.3e-6, 1.7e-6]", "about_x = [\"0 mm\", \"-2.5 mm\"]");
    let folder = Folder::with_grid(&format!("{axes}{BODY}trim = \"hover\"\n{WINGS}"));
    let ended = folder.ends(0, "sweep grid.toml --out rows.csv");
    let rows = folder.read("rows.csv");
    let residual = numbers(&rows, "hover_residual");
    let weight = 69e-6 * 9.80665 * 1e3;
    for (point, residual) in residual.iter().enumerate() {
        let forward = numbers(&rows, "force_forward_mn")[point] / weight;
        near(*residual, forward.abs(), 1e-3);
    }
    let above = residual.iter().filter(|share| **share > 0.01).count();
    assert!(above > 0 && ended.stderr.contains(&format!("{above} rows do not hover")), "{}", ended.stderr);
    assert!(folder.read("rows.csv.meta.toml").contains(&format!("unbalanced = {above}")));
}

/// Returns the rows at hover of `n` masses in a range (mg).
fn rows_of_masses([from, to]: [f64; 2], n: usize, solver: &str) -> String {
    let axes = HEAD.replace(
        "about_z = [\"-1 mm\", \"-3 mm\"]\nhinge_stiffness = [1.3e-6, 1.7e-6]",
        &format!("total_mass = {{ from = \"{from} mg\", to = \"{to} mg\", n = {n} }}"),
    );
    let axes = axes.replace("drive_voltage_pp = \"140 V\"\n", "");
    let body = BODY.replace("total_mass = \"69 mg\"\n", "");
    let folder = Folder::with_grid(&format!("{axes}{body}trim = \"hover\"\n{WINGS}{solver}"));
    folder.ends(0, "sweep grid.toml --out rows.csv");
    let rows = folder.read("rows.csv");
    assert!(column(&rows, "status").iter().all(|status| status == "periodic"), "{rows}");
    rows
}

/// Masses for which the limited accuracy of the rows ends the search for hover before its tolerance.
#[test]
fn hover_is_reached_within_the_accuracy_of_rows() {
    let rows = rows_of_masses([160.0, 180.0], 41, "");
    for (mass, lift) in numbers(&rows, "total_mass").iter().zip(numbers(&rows, "force_up_mn")) {
        near(lift, mass * 9.80665 * 1e3, 1e-5);
    }
}

/// At a coarse tolerance, the error of the rows exceeds the tolerance of the search for hover (1e-6). The accepted
/// residual is at most half of the residual of the warning, which is 1 % of the weight.
#[test]
fn rows_of_a_coarse_tolerance_are_near_hover() {
    let residual = numbers(&rows_of_masses([150.0, 170.0], 5, "[solver]\nrtol = 1e-3\n"), "hover_residual");
    assert!(residual.iter().all(|share| (1e-4..5e-3).contains(share)), "{residual:?}");
}

/// A grid with `damping` or with `trim` must have only one design.
#[test]
fn several_designs_have_no_rows_at_hover() {
    let presets = "preset = [\"jafferis2016\", \"jafferis2016-improved\"]";
    for key in ["damping = true", "trim = \"hover\""] {
        let folder = Folder::with_grid(&format!("{presets}\n{BODY}{key}\n{WINGS}"));
        let refused = folder.ends(2, "check grid.toml").stderr;
        assert!(refused.contains("are for one design"), "{refused}");
        assert!(refused.contains("write a grid file for each device"), "{refused}");
    }
}
