//! Shards of a sweep, and their merging.

use std::fs;
use std::path::Path;

use flap_sweep::files::results::{Format, Reader, Recorded};
use flap_sweep::files::sidecar::{Sidecar, State};

use crate::support::{Folder, quick};

/// A folder with all points of a grid in `whole.csv`, and its shards in `grid.1of3.csv` and so on.
fn folder(points: u64) -> Folder {
    folder_of(&quick(points))
}

fn folder_of(grid: &str) -> Folder {
    let folder = Folder::with_grid(grid);
    for arguments in ["--out whole.csv", "--shard 1/3", "--shard 2/3", "--shard 3/3"] {
        folder.ends(0, &format!("sweep --grid grid.toml {arguments}"));
    }
    folder
}

#[test]
fn merged_shards_are_the_file_of_one_machine() {
    for points in [1000, 2] {
        let folder = folder(points);
        for ending in ["csv", "csv.zst", "parquet"] {
            let merged = format!("merged.{ending}");
            let ended =
                folder.ends(0, &format!("results merge {merged} grid.3of3.csv grid.1of3.csv grid.2of3.csv"));
            assert_eq!(ended.stderr, format!("{points} rows of 3 shards in {merged}\n"));
            assert_eq!(folder.flap(&format!("results convert whole.csv one.{ending}")).code, 0);
            let bytes = |name: &str| fs::read(folder.path(name)).unwrap();
            assert!(bytes(&merged) == bytes(&format!("one.{ending}")), "{merged}");
            let sidecar =
                |name: &str| folder.read(&format!("{name}.meta.toml")).parse::<toml::Table>().unwrap();
            for key in ["state", "points", "rows", "cycles", "rhs_evals", "statuses", "invalid", "grid"] {
                assert_eq!(sidecar(&merged).get(key), sidecar("whole.csv").get(key), "{key}");
            }
            assert!(!sidecar(&merged).contains_key("shard"));
        }
    }
}

/// Shards of a grid with conditions have different numbers of rows. Together, the shards count all excluded points.
#[test]
fn merged_shards_of_a_grid_with_conditions_are_the_file_of_one_machine() {
    let grid = quick(1000)
        + r#"
[derived]
hinge_stiffness = "preset.hinge_stiffness * (drive_frequency / preset.drive_frequency)^2"
[where]
not_around_70 = "abs(drive_frequency - 70) > 4"
not_every_third = "drive_frequency > 100 or abs(sin(pi * (drive_frequency - 60) / 0.3)) > 1e-3"
[measure]
strong = "lift_mean_mn > 1"
"#;
    let folder = folder_of(&grid);
    let rows = |name: &str| folder.read(name).lines().count() - 1;
    assert_eq!(rows("grid.1of3.csv") + rows("grid.2of3.csv") + rows("grid.3of3.csv"), rows("whole.csv"));
    assert!(rows("grid.1of3.csv") + 100 < rows("grid.2of3.csv"));
    for ending in ["csv", "csv.zst", "parquet"] {
        let merged = format!("merged.{ending}");
        folder.ends(0, &format!("results merge {merged} grid.2of3.csv grid.1of3.csv grid.3of3.csv"));
        assert_eq!(folder.flap(&format!("sweep --grid grid.toml --out one.{ending}")).code, 0);
        let bytes = |name: &str| fs::read(folder.path(name)).unwrap();
        assert!(bytes(&merged) == bytes(&format!("one.{ending}")), "{merged}");
        let sidecar = |name: &str| folder.read(&format!("{name}.meta.toml")).parse::<toml::Table>().unwrap();
        for key in ["points", "ran", "rows", "excluded", "unsatisfied", "statuses", "warnings"] {
            assert_eq!(sidecar(&merged)["summary"][key], sidecar("whole.csv")["summary"][key], "{key}");
        }
        assert_eq!(sidecar(&merged)["points"], sidecar("whole.csv")["points"]);
    }
}

#[test]
fn a_shard_keeps_the_indices_of_the_grid() {
    let folder = folder(10);
    let rows = folder.read("grid.2of3.csv");
    let points: Vec<&str> = rows.lines().skip(1).map(|row| row.split(',').next().unwrap()).collect();
    assert_eq!(points, ["1", "4", "7"]);
    let sidecar: toml::Table = folder.read("grid.2of3.csv.meta.toml").parse().unwrap();
    assert_eq!(sidecar["shard"].as_str(), Some("2/3"));
    assert_eq!(
        (sidecar["points"].as_integer(), sidecar["summary"]["rows"].as_integer()),
        (Some(10), Some(3))
    );
}

#[test]
fn shards_that_do_not_belong_together_are_refused() {
    let folder = folder(100);
    fs::write(folder.path("other.toml"), quick(101)).unwrap();
    assert_eq!(folder.flap("sweep --grid other.toml --shard 3/3").code, 0);
    assert_eq!(folder.flap("sweep --grid grid.toml --shard 3/4").code, 0);
    for (shards, message) in [
        ("grid.1of3.csv grid.2of3.csv", "error: shard 3/3 is missing\n"),
        ("grid.3of3.csv", "error: 2 shards are missing, the first is 1/3\n"),
        (
            "grid.1of3.csv grid.2of3.csv grid.3of3.csv grid.2of3.csv",
            "error: grid.2of3.csv and grid.2of3.csv are both shard 2/3\n",
        ),
        (
            "grid.1of3.csv grid.2of3.csv other.3of3.csv",
            "error: other.3of3.csv does not belong to grid.1of3.csv: the grid file differs\n\
             shard 3/3 is missing\n",
        ),
        (
            "grid.1of3.csv grid.2of3.csv grid.3of4.csv",
            "error: grid.3of4.csv is shard 3/4, but grid.1of3.csv is shard 1/3\nshard 3/3 is missing\n",
        ),
        ("whole.csv", "error: whole.csv is not a shard\n"),
    ] {
        let ended = folder.ends(2, &format!("results merge merged.csv {shards}"));
        assert_eq!(ended.stderr, message, "{shards}");
    }
    folder.ends(2, "results merge merged.csv missing.csv").says("missing.csv: there is no such file");
    assert!(!folder.path("merged.csv").exists());
}

#[test]
fn shards_that_do_not_hold_what_they_should_are_refused() {
    let whole = folder(100).read("grid.2of3.csv");
    let mut lines: Vec<&str> = whole.lines().collect();
    let last = lines.pop().unwrap();
    let short = lines.join("\n") + "\n";
    let foreign = short.clone() + "3," + last.split_once(',').unwrap().1 + "\n";
    for (rows, message) in [
        (short.as_str(), "it contains 32 rows, but 33 were written"),
        (foreign.as_str(), "row 33 belongs to point `3`, which was not run"),
        (&short.replacen("unsettled", "peridoic", 1), "row 1: `peridoic` is not a status"),
        ("a,b\n1,2\n", "its columns differ from the columns of the grid in its sidecar"),
        ("", "its columns differ from the columns of the grid in its sidecar"),
    ] {
        let folder = folder(100);
        fs::write(folder.path("grid.2of3.csv"), rows).unwrap();
        // Checksums would have told before.
        folder.rewrite_sidecar("grid.2of3.csv", |sidecar| sidecar.checksums = None);
        let ended = folder.ends(3, "results merge merged.csv grid.1of3.csv grid.2of3.csv grid.3of3.csv");
        assert!(
            ended.stderr.ends_with(&format!("error: cannot read grid.2of3.csv: {message}\n")),
            "{}",
            ended.stderr
        );
        assert!(!folder.path("merged.csv").exists());
    }
}

/// flap rejects a shard whose sweep was interrupted, and the error names the interruption.
#[test]
fn unfinished_shards_are_refused() {
    let folder = folder(100);
    folder.rewrite_sidecar("grid.2of3.csv", |sidecar| sidecar.state = State::Interrupted);
    let ended = folder.ends(2, "results merge merged.csv grid.1of3.csv grid.2of3.csv grid.3of3.csv");
    assert_eq!(ended.stderr, "error: grid.2of3.csv is not complete\n");
}

#[test]
fn wrong_shards_are_explained() {
    let folder = Folder::with_grid(&quick(10));
    for shard in ["0/3", "4/3", "3"] {
        folder
            .ends(2, &format!("sweep --grid grid.toml --shard {shard}"))
            .says("expected I/N with I from 1 to N");
    }
}

/// Merging runs no model, so the shards need the same build, but not the build that merges them.
#[test]
fn shards_of_several_builds_are_merged_if_asked() {
    let folder = folder(100);
    let merge = "results merge merged.parquet grid.1of3.csv grid.2of3.csv grid.3of3.csv";
    let (flap, build) = (env!("CARGO_PKG_VERSION"), flap_sweep::run::identity::build());
    let build_of = |name: &str| {
        let sidecar = Sidecar::read(&folder.path(&format!("{name}.meta.toml"))).unwrap();
        let file = fs::File::open(folder.path(name)).unwrap();
        let reader = Reader::new(file, Format::of(Path::new(name)).unwrap()).unwrap();
        let recorded = Recorded::of(reader.entries()).unwrap().text("flap.build").to_owned();
        assert_eq!(recorded, sidecar.identity.build);
        recorded
    };
    folder.rewrite_sidecar("grid.2of3.csv", |sidecar| sidecar.identity.build = "zfed".to_owned());
    let ended = folder.ends(2, merge);
    assert_eq!(
        ended.stderr,
        format!(
            "error: the shards were computed by several builds of flap, whose rows may differ: grid.1of3.csv by build {build} of \
             flap {flap}, grid.2of3.csv by build zfed of flap {flap}\n\
             help: sweep all shards with the same build, or use --mixed-builds to merge these shards\n"
        )
    );
    assert!(!folder.path("merged.parquet").exists());
    folder
        .ends(0, &format!("{merge} --mixed-builds"))
        .says(&format!("the sidecar records build {build}, zfed of flap {flap} for these rows\n"));
    assert_eq!(build_of("merged.parquet"), format!("{build}, zfed"));
    folder.ends(0, "results verify merged.parquet");
    folder.ends(0, "results convert merged.parquet merged.csv");
    assert_eq!(folder.read("merged.csv"), folder.read("whole.csv"));
    // No build calls rows of several ones its own.
    folder
        .ends(2, "sweep grid.toml --out merged.csv")
        .says(&format!("computed by build {build}, zfed of flap"));

    for shard in ["grid.1of3.csv", "grid.3of3.csv"] {
        folder.rewrite_sidecar(shard, |sidecar| sidecar.identity.build = "zfed".to_owned());
    }
    let ended = folder.ends(0, &format!("{merge} --force"));
    ended.says(&format!("the sidecar records build zfed of flap {flap} for these rows\n"));
    assert_eq!(build_of("merged.parquet"), "zfed");
}
