//! Refined grids: check, sweep, shards, rerun and maps.

use std::fs;

use flap_sweep::files::sidecar::Sidecar;

use crate::support::Folder;

/// A map with a steep flank.
const GRID: &str = r#"preset = "jafferis2016"

[axes]
drive_voltage_pp = { from = "40 V", to = "240 V", n = 4 }
drive_frequency = { from = "60 Hz", to = "180 Hz", n = 7 }

[refine]
measure = "stroke_pp_deg"
error = "4 %"
max_points = 120

[solver]
max_cycles = 2000
settle_tol = 1e-4

[output]
columns = ["stroke_pp_deg", "power_mean_mw"]
"#;

#[test]
fn a_check_tells_what_a_refinement_adds() {
    let folder = Folder::with_grid(GRID);
    folder.ends(0, "check grid.toml").prints(
        "[refine] adds points to these 28 uniform points along drive_voltage_pp and drive_frequency, up to 120 in \
         total, until linear interpolation of stroke_pp_deg errs by at most 4 % of its range",
    );
    let rows = folder.ends(0, "check grid.toml --format csv").stdout;
    for row in ["refine,stroke_pp_deg,error,4 %", "refine,drive_frequency,along,2", "refine,,max_points,120"]
    {
        assert!(rows.contains(row), "{row} is not in\n{rows}");
    }
}

/// Shards contain only the points of the axes. In every format, a refinement of the merged file has the same bytes as
/// one run.
#[test]
fn merged_shards_of_a_refined_grid_are_continued() {
    let folder = Folder::with_grid(GRID);
    for shard in 1..=3 {
        let told = "after `flap results merge`, `flap results resume` adds the points of [refine]";
        folder.ends(0, &format!("sweep grid.toml --shard {shard}/3")).says(told);
    }
    let bytes = |name: &str| fs::read(folder.path(name)).unwrap();
    let shards = "grid.1of3.csv grid.2of3.csv grid.3of3.csv";
    for (ending, command) in [
        ("csv", "results resume merged.csv"),
        ("csv.zst", "sweep grid.toml --out merged.csv.zst"),
        ("parquet", "results resume merged.parquet"),
    ] {
        folder.ends(0, &format!("sweep grid.toml --out whole.{ending} --threads 1"));
        let merged = format!("merged.{ending}");
        folder.ends(0, &format!("results merge {merged} {shards}"));
        folder.ends(0, &format!("results verify {merged}")).prints("sound: 28 rows");
        folder.ends(0, command).says("28 of 28 points").says("added in");
        assert!(bytes(&merged) == bytes(&format!("whole.{ending}")), "{merged}");
        let summary = |name: &str| Sidecar::read(&folder.path(&format!("{name}.meta.toml"))).unwrap().summary;
        assert_eq!(summary(&merged), summary(&format!("whole.{ending}")));
        folder.ends(0, command).says("is complete");
        let names = folder.names();
        assert!(!names.iter().any(|name| name.contains(".new.") || name.ends_with(".journal")), "{names:?}");
    }
}

/// `flap results rerun` can run points of a refinement again, and its results can be repeated from their sidecar.
#[test]
fn points_of_a_refinement_are_run_again() {
    let folder = Folder::with_grid(GRID);
    folder.ends(0, "sweep grid.toml --out rows.csv");
    folder.ends(0, "results rerun rows.csv --status periodic --out again.csv");
    assert!(folder.read("again.csv") == folder.read("rows.csv"));
    folder.ends(0, "sweep again.csv.meta.toml --out third.csv");
    assert!(folder.read("third.csv") == folder.read("rows.csv"));
    folder.ends(0, "results convert rows.csv rows.parquet");
    folder.refuses("run grid.toml --point 28", "a point of [refine] is in the rows only");
}

#[test]
fn a_map_of_refined_rows_has_no_gaps() {
    let folder = Folder::with_grid(GRID);
    folder.ends(0, "sweep grid.toml --out rows.csv");
    folder.ends(0, "plot rows.csv --kind map --color stroke_pp_deg --out map.svg");
    let picture = folder.read("map.svg");
    assert!(!picture.contains("without a value") && !picture.contains("no value"));
}
