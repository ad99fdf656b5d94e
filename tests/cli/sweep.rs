//! `flap sweep` without errors.

use crate::support::{Folder, frequencies};

#[test]
fn rows_go_to_a_file_named_after_the_grid() {
    let folder = Folder::with_grid(&frequencies(30));
    let ended = folder.ends(0, "sweep --grid grid.toml");
    assert_eq!(ended.stdout, "");
    ended.says("30 periodic in ");
    assert!(ended.stderr.ends_with("30 rows in grid.csv\n"), "{}", ended.stderr);
    assert_eq!(folder.names(), ["grid.csv", "grid.csv.meta.toml", "grid.toml"]);

    let rows = folder.read("grid.csv");
    assert!(rows.starts_with("point,drive_frequency,status,"), "{rows}");
    assert_eq!(rows.lines().count(), 31);
    assert!(rows.lines().last().unwrap().starts_with("29,62.9,periodic,"), "{rows}");
    assert!(!rows.contains("NaN"));

    let sidecar: toml::Table = folder.read("grid.csv.meta.toml").parse().unwrap();
    assert_eq!(sidecar["state"].as_str(), Some("complete"));
    assert_eq!(sidecar["summary"]["rows"].as_integer(), Some(30));
    assert_eq!(sidecar["preset"].as_str(), Some("ozaki2018-large"));
    assert_eq!(sidecar["grid"]["text"].as_str(), Some(folder.read("grid.toml").as_str()));
    assert_eq!(sidecar["started"].as_str().map(str::len), Some("2026-01-02T03:04:05Z".len()));
}

#[test]
fn the_grid_file_may_say_where_rows_go_and_the_command_line_wins() {
    let folder = Folder::with_grid(&(frequencies(3) + "[output]\npath = \"chosen.csv\"\n"));
    assert_eq!(folder.flap("sweep --grid grid.toml").code, 0);
    assert_eq!(folder.flap("sweep --grid grid.toml --out given.csv").code, 0);
    assert_eq!(folder.read("chosen.csv"), folder.read("given.csv"));
    assert!(!folder.path("grid.csv").exists());
}

#[test]
fn the_rows_do_not_depend_on_the_threads() {
    let folder = Folder::with_grid(&frequencies(200));
    for threads in ["1", "2", "3"] {
        folder.ends(0, &format!("sweep --grid grid.toml --threads {threads} --out {threads}.csv"));
    }
    assert!(folder.read("1.csv") == folder.read("2.csv"));
    assert!(folder.read("1.csv") == folder.read("3.csv"));
}

#[test]
fn selected_columns_only() {
    let folder = Folder::with_grid(&(frequencies(1) + "[output]\ncolumns = [\"lift_mean_mn\"]\n"));
    let ended = folder.flap("sweep --grid grid.toml --out -");
    let header = ended.stdout.lines().next();
    assert_eq!(header, Some("point,drive_frequency,status,lift_mean_mn"));
    let all = Folder::with_grid(&frequencies(1)).flap("sweep grid.toml --out -");
    let header = all.stdout.lines().next().unwrap();
    assert!(
        header.ends_with(",cycles,residual,period,floquet_max,stable,error_estimate,rhs_evals"),
        "{header}"
    );
    let chosen = "[output]\ncolumns = [\"residual\", \"lift_mean_mn\", \"rhs_evals\"]\n";
    let folder = Folder::with_grid(&(frequencies(1) + chosen));
    let ended = folder.flap("sweep grid.toml --out -");
    assert!(ended.stdout.starts_with("point,drive_frequency,status,residual,lift_mean_mn,rhs_evals\n"));
}

#[test]
fn strict_counts_points_that_are_not_periodic() {
    let folder = Folder::with_grid(&(frequencies(2) + "[solver]\nmax_cycles = 2\n"));
    folder.ends(0, "sweep --grid grid.toml").says("2 unsettled in ");
    assert!(folder.read("grid.csv").contains("unsettled,,"));
    assert_eq!(folder.flap("sweep --grid grid.toml --strict --restart").code, 1);
}

#[test]
fn a_grid_without_axes_is_one_point() {
    let folder = Folder::with_grid("preset = \"ozaki2018-small\"\n");
    let ended = folder.ends(0, "sweep -g grid.toml -o -");
    assert_eq!(ended.stdout.lines().count(), 2);
    ended.prints("\n0,periodic,");
}

/// `--force` overwrites results only after the new results are written.
#[test]
fn old_rows_stay_if_new_ones_cannot_be_written() {
    let folder = Folder::with_grid("preset = \"ozaki2018-large\"\n");
    std::fs::write(folder.path("old.csv"), "precious").unwrap();
    // The sidecar cannot be written where a folder has its name.
    std::fs::create_dir(folder.path("old.csv.meta.toml")).unwrap();
    folder.ends(2, "sweep --grid grid.toml --out old.csv --restart").says("old.csv.meta.toml exists already");
    assert_eq!(folder.read("old.csv"), "precious");
}
