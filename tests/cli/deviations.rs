//! Values that differ from the preset, and warnings of probable mistakes.

use std::fs;

use crate::support::Folder;

#[test]
fn check_lists_what_differs_from_the_preset() {
    let grid = r#"preset = "ozaki2018-large"
[params]
hinge_stiffness = "2 uN*m/rad"
added_mass = "lagrangian"
[axes]
drive_frequency = { from = 60, to = 200, n = 15 }
"#;
    let ended = Folder::with_grid(grid).flap("check grid.toml");
    assert_eq!((ended.code, ended.stderr.as_str()), (0, ""));
    let lines =
        ended.stdout.lines().map(|line| line.split("  ").map(str::trim).filter(|cell| !cell.is_empty()));
    let lines: Vec<Vec<&str>> = lines.map(Iterator::collect).collect();
    let has =
        |line: &[&str]| assert!(lines.iter().any(|found| found == line), "{line:?} in\n{}", ended.stdout);
    has(&["DIFFERS FROM THE PRESET", "HERE", "PRESET", "RATIO"]);
    has(&["added_mass", "lagrangian", "paper"]);
    ended.prints("2 uN*m/rad");
    ended.prints("60 Hz to 200 Hz");

    let ended = Folder::with_grid("preset = \"ozaki2018-large\"\n").flap("check grid.toml");
    assert!(!ended.stdout.contains("DIFFERS FROM"), "{}", ended.stdout);
}

/// A length in millimetres that is written as metres.
#[test]
fn values_far_from_the_preset_are_warned_of() {
    for grid in [
        "[params]\nwing_length = 17\n",
        "[axes]\nwing_length = [17]\n",
        "[axes]\nwing_length = { from = 17, to = 18, n = 2 }\n",
        "[sample]\nmethod = \"sobol\"\nn = 2\n[sample.parameters]\nwing_length = { from = 17, to = 18 }\n",
    ] {
        let grid = "preset = \"ozaki2018-large\"\n".to_owned() + grid + "[solver]\nmax_cycles = 1\n";
        let folder = Folder::with_grid(&grid);
        for command in ["check grid.toml", "sweep --grid grid.toml --out rows.csv --restart", "run grid.toml"]
        {
            let ended = folder.ends(0, command);
            let told = &ended.stderr;
            assert!(
                told.starts_with("warning: wing_length = 17") && told.contains(" times the preset's "),
                "{told}"
            );
            if !grid.contains("sobol") || !command.starts_with("run") {
                assert!(told.contains("; if you mean 17 mm, write \"17 mm\"\n"), "{told}");
            }
        }
    }
    let ended = Folder::new().flap("run ozaki2018-large --set wing_length=17 --max-cycles 1");
    ended.says("if you mean 17 mm");
    let ended = Folder::new().flap("run ozaki2018-large");
    assert_eq!(ended.stderr, "");
    let ended = Folder::new().flap("run ozaki2018-large --max-cycles 1");
    assert!(ended.stderr.starts_with("the point did not settle"), "{}", ended.stderr);
}

/// If a value has a unit, flap prints no warning, even if the value is far from the preset's value.
#[test]
fn values_with_their_units_are_not_doubted() {
    let folder = Folder::new();
    fs::write(folder.path("points.csv"), "wing_length [m]\n17\n").unwrap();
    for grid in [
        "[params]\nwing_length = \"17 m\"\n",
        "[params]\nwing_length = { value = \"17 m\", sd = 1 }\n",
        "[axes]\nwing_length = [\"17 m\"]\n",
        "[axes]\nwing_length = { from = \"17 m\", to = \"18 m\", n = 2 }\n",
        "[[zip]]\nwing_length = [\"17 m\", \"18 m\"]\nhinge_stiffness = [8e-5, 9e-5]\n",
        "[sample]\nmethod = \"sobol\"\nn = 2\n[sample.parameters]\nwing_length = { mean = \"17 m\", relative_sd = \"1 %\" }\n",
        "[sample]\nmethod = \"file\"\npath = \"points.csv\"\n",
    ] {
        let grid = "preset = \"ozaki2018-large\"\n".to_owned() + grid + "[solver]\nmax_cycles = 1\n";
        fs::write(folder.path("grid.toml"), &grid).unwrap();
        for command in ["check grid.toml", "sweep --grid grid.toml --out rows.csv --restart", "run grid.toml"]
        {
            let ended = folder.ends(0, command);
            assert!(!ended.stderr.contains("warning"), "{grid}{command}: {}", ended.stderr);
        }
        folder.ends(0, "run grid.toml --set wing_length=17").says("if you mean 17 mm");
        folder.ends(0, "check grid.toml").prints("525");
    }
    let set =
        folder.ends_with(0, &["run", "ozaki2018-large", "--set", "wing_length=17 m", "--max-cycles", "1"]);
    assert!(!set.stderr.contains("warning"), "{}", set.stderr);
}

/// A number without a unit that overrides a device with units causes a warning. An unchanged value of the device causes
/// no warning.
#[test]
fn values_of_devices_are_doubted_like_those_of_grids() {
    let folder = Folder::new();
    let device = "preset = \"ozaki2018-large\"\n[params]\nwing_length = \"17 m\"\nhinge_stiffness = 86.4\n";
    fs::write(folder.path("device.toml"), device).unwrap();
    for (params, doubted) in [
        ("", "hinge_stiffness"),
        ("hinge_stiffness = \"86.4 N*m/rad\"\n", ""),
        ("wing_length = 17\nhinge_stiffness = \"86.4 N*m/rad\"\n", "wing_length"),
    ] {
        fs::write(folder.path("grid.toml"), format!("device = \"device.toml\"\n[params]\n{params}")).unwrap();
        let told = folder.ends(0, "check grid.toml").stderr;
        let named = told.strip_prefix("warning: ").map_or("", |told| told.split(' ').next().unwrap());
        assert_eq!((named, told.lines().count()), (doubted, usize::from(!doubted.is_empty())), "{told}");
    }
}

#[test]
fn check_says_when_every_point_is_invalid() {
    let grid = "preset = \"ozaki2018-large\"\n[derived]\nwing_length = \"-0.01\"\n[axes]\ndrive_frequency = [60, 70]\n";
    let ended = Folder::with_grid(grid).ends(0, "check grid.toml");
    let told = "every point that was tried is invalid, for example point 0: ";
    assert!(
        ended.stdout.contains(told) && ended.stdout.contains("`wing_length` is computed as -0.01"),
        "{}",
        ended.stdout
    );
    let ended = Folder::with_grid("preset = \"ozaki2018-large\"\n").flap("check grid.toml");
    assert!(!ended.stdout.contains(told), "{}", ended.stdout);
}

/// The formulas for linked parameters contain the geometry: K_t = T² κ_t, and the stiffness E w t³ / (12 l) of a
/// bending flexure.
#[test]
fn check_names_linked_parameters_that_stay_the_same() {
    let linked = |folder: &Folder| {
        let ended = folder.ends(0, "check grid.toml --format csv");
        let mut rows = csv::Reader::from_reader(ended.stdout.as_bytes());
        let rows: Vec<csv::StringRecord> = rows.records().map(Result::unwrap).collect();
        let formulas = rows.iter().filter(|row| &row[0] == "linked" && &row[2] == "derived");
        formulas.map(|row| format!("{} = \"{}\"", &row[1], &row[3])).collect::<Vec<_>>()
    };
    let of_grid = |grid: &str| linked(&Folder::with_grid(grid));
    let ratio = "preset = \"jafferis2016\"\n[axes]\ntransmission_ratio = [3000, 3333]\n";
    let formula = "transmission_stiffness = \"preset.transmission_stiffness * \
                   (transmission_ratio / preset.transmission_ratio)^2\"";
    assert_eq!(of_grid(ratio), [formula]);
    // The formula is valid in [derived], and nothing is left to name.
    assert!(of_grid(&format!("{ratio}[derived]\n{formula}\n")).is_empty());
    assert!(of_grid("preset = \"jafferis2016\"\n[axes]\ndrive_frequency = [100, 120]\n").is_empty());

    // The values of a device are numbers; a value that is not set does not scale.
    let device = "preset = \"arabagi2013-75hz\"\n[params]\nhinge_stiffness = 4e-5\nhinge_length = 1e-4\n";
    let of_device = |axis: &str| {
        let folder = Folder::with_grid(&format!("device = \"mine.toml\"\n[axes]\n{axis}\n"));
        fs::write(folder.path("mine.toml"), device).unwrap();
        linked(&folder)
    };
    assert!(of_device("hinge_thickness = [8e-6, 1e-5]").is_empty());
    assert_eq!(
        of_device("hinge_length = [1e-4, 2e-4]"),
        ["hinge_stiffness = \"4e-5 * (hinge_length / 0.0001)^-1\""]
    );

    let wing = "preset = \"jafferis2016\"\n[axes]\nwing_length = [0.015, 0.017]\nair_density = [1.0, 1.2]\n";
    let found = of_grid(wing);
    assert_eq!(found.len(), 8, "{found:?}");
    assert!(
        found.contains(
            &"added_inertia_stroke = \"preset.added_inertia_stroke * (wing_length / preset.wing_length)^5 * \
              (air_density / preset.air_density)\""
                .to_owned()
        ),
        "{found:?}"
    );
}
