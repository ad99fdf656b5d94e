//! `--force`: earlier results are kept until the new results are complete.

use std::fs;
use std::path::Path;

use crate::support::{Folder, frequencies, quick, send, start, wait};

/// Results of three points in `rows.ENDING`, and a grid with many more points.
fn folder(ending: &str) -> (Folder, Vec<u8>, String) {
    let folder = Folder::with_grid(&quick(3));
    assert_eq!(folder.flap(&format!("sweep --grid grid.toml --out rows.{ending}")).code, 0);
    fs::write(folder.path("grid.toml"), frequencies(100_000)).unwrap();
    let rows = fs::read(folder.path(&format!("rows.{ending}"))).unwrap();
    let sidecar = folder.read(&format!("rows.{ending}.meta.toml"));
    (folder, rows, sidecar)
}

fn assert_kept(folder: &Folder, ending: &str, rows: &[u8], sidecar: &str) {
    assert!(fs::read(folder.path(&format!("rows.{ending}"))).unwrap() == rows);
    assert_eq!(folder.read(&format!("rows.{ending}.meta.toml")), sidecar);
    folder.ends(0, &format!("results verify rows.{ending}"));
}

/// Waits until the journal contains checkpoints that are not in the journal `before`.
fn wait_until_begun(folder: &Folder, journal: &Path, before: &str) {
    let is_another = |text: &str| before.is_empty() || !text.starts_with(before);
    let begun =
        || fs::read_to_string(journal).is_ok_and(|text| text.lines().count() > 2 && is_another(&text));
    for _ in 0..6000 {
        if begun() {
            return;
        }
        std::thread::sleep(std::time::Duration::from_millis(10));
    }
    panic!("no rows are written: {:?}", folder.names());
}

#[test]
fn a_killed_force_keeps_the_earlier_results_and_goes_on() {
    for ending in ["csv", "csv.zst", "parquet"] {
        let (folder, rows, sidecar) = folder(ending);
        let out = format!("rows.{ending}");
        let arguments = ["sweep", "--grid", "grid.toml", "--out", &out, "--force", "--checkpoint", "10 ms"];
        let mut child = start(&folder, &arguments);
        let journal = format!("rows.new.{ending}.journal");
        wait_until_begun(&folder, &folder.path(&journal), "");
        child.kill().unwrap();
        wait(&mut child);
        assert_kept(&folder, ending, &rows, &sidecar);

        // Forced once more: those that were not complete go, the complete ones stay.
        let before = folder.read(&journal);
        let mut child = start(&folder, &arguments);
        wait_until_begun(&folder, &folder.path(&journal), &before);
        send("INT", &child);
        assert_eq!(wait(&mut child), Some(130));
        let mut told = String::new();
        std::io::Read::read_to_string(&mut child.stderr.take().unwrap(), &mut told).unwrap();
        let expected = format!("until the new results are complete, {out} keeps the earlier results\n");
        assert!(told.ends_with(&expected), "{told}");
        assert_kept(&folder, ending, &rows, &sidecar);
    }
}

#[test]
fn an_interrupted_force_is_resumed_and_then_the_earlier_results_go() {
    let folder = Folder::with_grid(&quick(3));
    assert_eq!(folder.flap("sweep --grid grid.toml --out grid.csv").code, 0);
    fs::write(folder.path("grid.toml"), frequencies(8_000)).unwrap();
    let arguments = ["sweep", "--grid", "grid.toml", "--force", "--checkpoint", "10 ms", "--threads", "1"];
    let mut child = start(&folder, &arguments);
    wait_until_begun(&folder, &folder.path("grid.new.csv.journal"), "");
    send("INT", &child);
    assert_eq!(wait(&mut child), Some(130));
    assert_eq!(folder.read("grid.csv").lines().count(), 4);
    folder.ends(0, "sweep --grid grid.toml").says(" of 8000 points of grid.csv are done\n");
    assert_eq!(folder.names(), ["grid.csv", "grid.csv.meta.toml", "grid.toml"]);
    assert_eq!(folder.read("grid.csv").lines().count(), 8_001);
}

#[test]
fn a_completed_force_leaves_nothing_of_the_earlier_results() {
    let (folder, ..) = folder("csv");
    fs::write(folder.path("grid.toml"), quick(5)).unwrap();
    assert_eq!(folder.flap("sweep --grid grid.toml --out rows.csv --restart").code, 0);
    assert_eq!(folder.names(), ["grid.toml", "rows.csv", "rows.csv.meta.toml"]);
    assert_eq!(folder.read("rows.csv").lines().count(), 6);
}

/// flap neither overwrites nor removes another file with the name of the new results.
#[test]
fn a_file_in_the_way_stays() {
    let (folder, rows, sidecar) = folder("csv");
    fs::write(folder.path("grid.toml"), quick(5)).unwrap();
    fs::write(folder.path("rows.new.csv"), "precious").unwrap();
    folder
        .ends(2, "sweep --grid grid.toml --out rows.csv --restart")
        .says("rows.new.csv exists already: writing rows.csv would overwrite it");
    assert_eq!(folder.read("rows.new.csv"), "precious");
    assert!(fs::read(folder.path("rows.csv")).unwrap() == rows);
    assert_eq!(folder.read("rows.csv.meta.toml"), sidecar);
    // Nor when results are made anew.
    assert_eq!(folder.flap("sweep --grid grid.toml --out new.csv").code, 0);
    assert_eq!(folder.read("rows.new.csv"), "precious");
    fs::remove_file(folder.path("rows.new.csv")).unwrap();

    // A sweep of that name that was interrupted is not taken for a replacement.
    fs::write(folder.path("more.toml"), frequencies(100_000)).unwrap();
    let arguments = ["sweep", "more.toml", "--out", "rows.new.csv", "--checkpoint", "10 ms"];
    let mut child = start(&folder, &arguments);
    wait_until_begun(&folder, &folder.path("rows.new.csv.journal"), "");
    child.kill().unwrap();
    wait(&mut child);
    let before = folder.read("rows.new.csv");
    folder.ends(2, "sweep grid.toml --out rows.csv --restart").says("rows.new.csv exists already");
    folder.ends(0, "results resume rows.csv").says("rows.csv is complete: nothing is left to run");
    assert_eq!(folder.read("rows.new.csv"), before);
}

/// A conversion into results whose replacement is unfinished.
#[test]
fn a_conversion_ends_an_unfinished_replacement() {
    let (folder, ..) = folder("csv");
    folder.ends(0, "results convert rows.csv other.parquet");
    let arguments = ["sweep", "grid.toml", "--out", "rows.csv", "--force", "--checkpoint", "10 ms"];
    let mut child = start(&folder, &arguments);
    wait_until_begun(&folder, &folder.path("rows.new.csv.journal"), "");
    folder
        .ends(3, "results convert other.parquet rows.csv --force")
        .says("another run is writing to rows.csv");
    child.kill().unwrap();
    wait(&mut child);
    folder
        .ends(2, "results convert other.parquet rows.csv")
        .says("is the unfinished result of an interrupted sweep");
    folder.ends(0, "results convert other.parquet rows.csv --force");
    let left = ["grid.toml", "other.parquet", "other.parquet.meta.toml", "rows.csv", "rows.csv.meta.toml"];
    assert_eq!(folder.names(), left);
    folder.ends(0, "results verify rows.csv");
}

/// A link stays a link, and flap writes the rows to the target of the link.
#[test]
#[cfg(unix)]
fn a_link_to_results_stays_one() {
    let (folder, ..) = folder("csv");
    fs::write(folder.path("grid.toml"), quick(5)).unwrap();
    std::os::unix::fs::symlink("rows.csv", folder.path("link.csv")).unwrap();
    assert_eq!(folder.flap("sweep --grid grid.toml --out link.csv --restart").code, 0);
    assert!(fs::symlink_metadata(folder.path("link.csv")).unwrap().is_symlink());
    assert_eq!(folder.read("rows.csv").lines().count(), 6);
    assert!(!folder.path("rows.new.csv").exists());
}

/// If the disk is full, the earlier file stays.
#[test]
#[cfg(target_os = "linux")]
fn what_is_computed_at_once_replaces_an_earlier_file_at_once() {
    let folder = Folder::new();
    let motion = "run ozaki2018-large --samples 20000 --trajectory motion.csv";
    fs::write(folder.path("motion.csv"), "precious").unwrap();
    let limited = format!("ulimit -f 100; exec {} {motion} --force", env!("CARGO_BIN_EXE_flap"));
    let mut command = std::process::Command::new("sh");
    let status = command.args(["-c", &limited]).current_dir(folder.path("")).output().unwrap().status;
    assert!(!status.success());
    assert_eq!(folder.read("motion.csv"), "precious");
    assert_eq!(folder.flap(&format!("{motion} --force")).code, 0);
    assert!(folder.read("motion.csv").lines().count() > 40_000);
}
