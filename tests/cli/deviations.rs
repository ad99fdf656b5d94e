//! Values that differ from the preset, and warnings of probable mistakes.

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
    has(&["OTHER THAN THE PRESET", "HERE", "PRESET", "RATIO"]);
    has(&["added_mass", "lagrangian", "paper"]);
    ended.prints("2 uN*m/rad");
    ended.prints("60 Hz to 200 Hz");

    let ended = Folder::with_grid("preset = \"ozaki2018-large\"\n").flap("check grid.toml");
    assert!(!ended.stdout.contains("OTHER THAN"), "{}", ended.stdout);
}

/// Millimetres that became metres.
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
        for command in ["check grid.toml", "sweep --grid grid.toml --out rows.csv --force", "run grid.toml"] {
            let ended = folder.ends(0, command);
            let told = &ended.stderr;
            assert!(
                told.starts_with("warning: wing_length = 17") && told.contains(" times the preset's "),
                "{told}"
            );
            if !grid.contains("sobol") || !command.starts_with("run") {
                assert!(told.contains("; if 17 mm was meant, write \"17 mm\"\n"), "{told}");
            }
        }
    }
    let ended = Folder::new().flap("run ozaki2018-large --set wing_length=17 --max-cycles 1");
    ended.says("if 17 mm was meant");
    let ended = Folder::new().flap("run ozaki2018-large");
    assert_eq!(ended.stderr, "");
    let ended = Folder::new().flap("run ozaki2018-large --max-cycles 1");
    assert!(ended.stderr.starts_with("the point did not settle"), "{}", ended.stderr);
}

#[test]
fn check_says_when_every_point_is_invalid() {
    let grid = "preset = \"ozaki2018-large\"\n[derived]\nwing_length = \"-0.01\"\n[axes]\ndrive_frequency = [60, 70]\n";
    let ended = Folder::with_grid(grid).ends(0, "check grid.toml");
    let told = "all points that were tried are invalid, such as point 0: ";
    assert!(
        ended.stdout.contains(told) && ended.stdout.contains("`wing_length` is computed as -0.01"),
        "{}",
        ended.stdout
    );
    let ended = Folder::with_grid("preset = \"ozaki2018-large\"\n").flap("check grid.toml");
    assert!(!ended.stdout.contains(told), "{}", ended.stdout);
}
