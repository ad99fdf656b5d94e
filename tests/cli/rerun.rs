//! Sweeps that are repeated from the sidecar of their results.

use std::fs;

use crate::support::{Folder, quick};

/// A grid with few drive periods per point, so that some points do not settle.
const GRID: &str = r#"
preset = "ozaki2018-large"

[axes]
drive_voltage_pp = [1, 10, 60, 200]
drive_frequency = { from = 60, to = 170, step = 10 }

[solver]
settle_tol = 1e-4
max_cycles = 6

[output]
columns = ["lift_mean_mn"]
"#;

fn unsettled() -> Folder {
    let folder = Folder::with_grid(GRID);
    folder.ends(0, "sweep --grid grid.toml --out rows.csv");
    folder
}

fn points(folder: &Folder, name: &str) -> Vec<(String, String)> {
    let text = folder.read(name);
    let rows = text.lines().skip(1).map(|row| {
        let cells: Vec<&str> = row.split(',').collect();
        (cells[0].to_owned(), cells[3].to_owned())
    });
    rows.collect()
}

#[test]
fn a_sidecar_is_enough_to_repeat_a_sweep() {
    let folder = unsettled();
    fs::remove_file(folder.path("grid.toml")).unwrap();
    folder.ends(0, "sweep rows.csv.meta.toml --out again.csv");
    assert_eq!(folder.read("rows.csv"), folder.read("again.csv"));

    folder.ends(2, "sweep rows.csv --out other.csv").says("rows.csv contains results and is not a grid file");
    folder.ends(2, "sweep rows.csv.meta.toml").says("--out");
}

#[test]
fn failed_points_are_run_again_with_other_settings() {
    let folder = unsettled();
    let failed: Vec<(String, String)> =
        points(&folder, "rows.csv").into_iter().filter(|(_, status)| status == "unsettled").collect();
    assert!(!failed.is_empty() && failed.len() < 48, "{}", folder.read("rows.csv"));
    folder.ends(0, "results rerun rows.csv --status unsettled --max-cycles 500 --out again.csv");
    let again = points(&folder, "again.csv");
    assert!(again.iter().map(|(point, _)| point).eq(failed.iter().map(|(point, _)| point)));
    assert!(again.iter().all(|(_, status)| status == "periodic"), "{again:?}");

    let sidecar: toml::Table = folder.read("again.csv.meta.toml").parse().unwrap();
    assert_eq!(sidecar["identity"]["solver"]["max_cycles"].as_integer(), Some(500));
    assert_eq!(sidecar["identity"]["solver"]["settle_tol"].as_float(), Some(1e-4));
    assert_eq!(sidecar["rerun"]["of"].as_str(), Some("rows.csv"));
    assert_eq!(sidecar["rerun"]["statuses"].as_array().unwrap().len(), 1);

    // The sidecar of a rerun repeats the rerun.
    folder.ends(0, "sweep again.csv.meta.toml --out third.csv");
    assert_eq!(folder.read("again.csv"), folder.read("third.csv"));
}

#[test]
fn what_cannot_be_run_again() {
    let folder = unsettled();
    let ended = folder.ends(0, "results rerun rows.csv --status diverged --out again.csv");
    assert_eq!(
        ended.stderr,
        "no point in rows.csv is diverged: nothing is left to run, and no file is written\n"
    );
    assert!(!folder.path("again.csv").exists());

    fs::copy(folder.path("rows.csv.meta.toml"), folder.path("edited.meta.toml")).unwrap();
    folder.rewrite_sidecar("edited", |sidecar| sidecar.identity.solver.max_cycles = 0);
    folder
        .ends(2, "sweep edited.meta.toml --out again.csv")
        .says("the recorded solver settings are outside the limits");

    folder
        .ends(2, "results rerun rows.csv --status unsetled --out again.csv")
        .says("did you mean `unsettled`?");

    folder
        .ends(2, "results rerun rows.csv --status unsettled --out rows.csv --restart")
        .says("writing rows.csv would overwrite the results rows.csv");
}

/// flap reads the file of points in the folder of the grid file. The file must not have changed.
#[test]
fn a_sweep_of_a_file_of_points_is_repeated_from_its_sidecar() {
    let folder = Folder::new();
    fs::create_dir(folder.path("designs")).unwrap();
    let grid = quick(3).replace("[solver]", "[sample]\nmethod = \"file\"\npath = \"points.csv\"\n[solver]");
    fs::write(folder.path("designs/grid.toml"), grid).unwrap();
    let points = "drive_voltage_pp\n20\n30\n";
    fs::write(folder.path("designs/points.csv"), points).unwrap();
    folder.ends(0, "sweep --grid designs/grid.toml --out rows.csv");
    assert_eq!(folder.read("rows.csv").lines().count(), 7);
    fs::remove_file(folder.path("designs/grid.toml")).unwrap();
    folder.ends(0, "sweep rows.csv.meta.toml --out again.csv");
    assert_eq!(folder.read("rows.csv"), folder.read("again.csv"));
    folder.ends(0, "results rerun rows.csv --status unsettled --max-cycles 2 --out rerun.csv");
    assert_eq!(
        folder.flap("results resume rerun.csv").stderr,
        "rerun.csv is complete: nothing is left to run; use --restart to run its points again\n"
    );

    fs::write(folder.path("designs/points.csv"), points.replace("30", "31")).unwrap();
    for arguments in [
        "sweep rows.csv.meta.toml --out third.csv",
        "results resume rows.csv",
        "results rerun rows.csv --status unsettled --out third.csv",
        "results convert rows.csv third.parquet",
    ] {
        let ended = folder.ends(2, arguments);
        assert_eq!(
            ended.stderr,
            "error: rows.csv.meta.toml: designs/points.csv has changed since the points were run\n\
             help: restore the file of points, or sweep the grid file again\n",
            "{arguments}"
        );
    }
    fs::remove_file(folder.path("designs/points.csv")).unwrap();
    folder.ends(2, "results resume rows.csv").says("designs/points.csv: ");
}
