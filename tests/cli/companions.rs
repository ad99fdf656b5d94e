//! Files of the user beside an output: commands neither overwrite nor remove them.

use std::fs;

use crate::support::{Folder, quick};

/// Commands that write `out.csv` or `out.parquet`.
const COMMANDS: [&str; 7] = [
    "sweep grid.toml --out OUT",
    "results rerun rows.csv --status unsettled --max-cycles 2 --out OUT",
    "respond grid.toml --out OUT",
    "results convert rows.csv OUT",
    "results merge OUT grid.1of2.csv grid.2of2.csv",
    "run ozaki2018-large --trajectory OUT",
    "sweep grid.toml --shard 1/2 --out OUT",
];

const BESIDE: [&str; 6] = [".tmp", ".journal", ".part", ".meta.toml", ".meta.toml.tmp", ".journal.tmp"];

/// The user's text in a file beside an output.
const PRECIOUS: &str = "precious";

fn folder() -> Folder {
    let folder = Folder::with_grid(&quick(3));
    folder.ends(0, "sweep grid.toml --out rows.csv");
    folder.ends(0, "sweep grid.toml --shard 1/2");
    folder.ends(0, "sweep grid.toml --shard 2/2");
    folder
}

/// Runs each command beside each file, with and without `--force`. The command succeeds, or names the file and writes
/// nothing.
#[test]
fn they_stay_as_they_are() {
    let folder = folder();
    let before = folder.names();
    let mut refused = Vec::new();
    for command in COMMANDS {
        for ending in ["csv", "parquet"] {
            if command.starts_with("run") && ending != "csv" {
                continue;
            }
            let out = format!("out.{ending}");
            for beside in BESIDE {
                for force in ["", " --force"] {
                    let own = format!("{out}{beside}");
                    fs::write(folder.path(&own), PRECIOUS).unwrap();
                    let command = command.replace("OUT", &out) + force;
                    let ended = folder.flap(&command);
                    assert_eq!(folder.read(&own), PRECIOUS, "{command} beside {own}");
                    if ended.code == 0 {
                        assert!(folder.path(&out).exists(), "{command}");
                    } else {
                        assert_eq!(ended.code, 2, "{command}: {}", ended.stderr);
                        let message = format!(
                            "error: {own} exists already: writing {out} would overwrite it\n\
                             help: rename or remove that file, or choose another name for the results\n"
                        );
                        assert!(ended.stderr.ends_with(&message), "{command}: {}", ended.stderr);
                        assert!(!folder.path(&out).exists(), "{command}");
                        refused.push((name(&command), beside));
                    }
                    for name in folder.names() {
                        if !before.contains(&name) {
                            fs::remove_file(folder.path(&name)).unwrap();
                        }
                    }
                }
            }
        }
    }
    // Only files that a command would write are in its way.
    let runs = ["sweep", "results rerun", "respond"];
    for (command, beside) in &refused {
        let is_written = *beside == ".meta.toml"
            || (runs.contains(&command.as_str()) && [".journal", ".part"].contains(beside));
        assert!(is_written, "{command} {beside}");
    }
    // Four runs and two other commands in two formats, each with and without --force, and `run` in one.
    assert_eq!(refused.len(), 2 * (4 * (2 + 3) + 2 * 2 + 1));
}

/// The words of a command up to its first file.
fn name(command: &str) -> String {
    let words = command.split(' ').take_while(|word| !word.contains(['.', '-', '/']));
    words.collect::<Vec<_>>().join(" ")
}

/// Complete results and the user's files beside the results stay until a command replaces the results.
#[test]
fn results_are_replaced_beside_them() {
    let folder = folder();
    fs::write(folder.path("grid.toml"), quick(2)).unwrap();
    for beside in [".tmp", ".journal", ".part", ".meta.toml.tmp", ".old.csv"] {
        fs::write(folder.path(&format!("rows.csv{beside}")), PRECIOUS).unwrap();
    }
    fs::write(folder.path("rows.old.csv"), PRECIOUS).unwrap();
    let before = folder.names();
    folder.ends(0, "sweep grid.toml --out rows.csv --restart");
    assert_eq!(folder.read("rows.csv").lines().count(), 3);
    assert_eq!(folder.names(), before);
    for beside in
        ["rows.csv.tmp", "rows.csv.journal", "rows.csv.part", "rows.csv.meta.toml.tmp", "rows.old.csv"]
    {
        assert_eq!(folder.read(beside), PRECIOUS, "{beside}");
    }
}

/// The rows were moved away without their sidecar, so the sidecar contains the totals of the moved rows.
#[test]
fn a_sidecar_without_its_rows_is_kept() {
    let folder = folder();
    let sidecar = folder.read("rows.csv.meta.toml");
    fs::rename(folder.path("rows.csv"), folder.path("moved.csv")).unwrap();
    let commands = [
        "sweep grid.toml --out rows.csv",
        "results convert grid.1of2.csv rows.csv",
        "run ozaki2018-large --trajectory rows.csv",
    ];
    for command in commands {
        let told = "error: rows.csv.meta.toml exists already: writing rows.csv would overwrite it\n";
        folder.ends(2, command).says(told);
        assert_eq!(folder.read("rows.csv.meta.toml"), sidecar);
        assert!(!folder.path("rows.csv").exists(), "{command}");
    }
    folder.ends(0, "sweep grid.toml --out rows.csv --restart");
    folder.ends(0, "results verify rows.csv");
}

/// A device file of the user whose name is the name of the output's journal. The device file is an input.
#[test]
fn an_input_beside_the_output_is_kept() {
    let folder = Folder::new();
    fs::write(folder.path("y.csv.journal"), "preset = \"ozaki2018-large\"\n").unwrap();
    folder.ends(0, "run y.csv.journal --trajectory y.csv");
    assert_eq!(folder.read("y.csv.journal"), "preset = \"ozaki2018-large\"\n");
    assert!(folder.read("y.csv").starts_with("time_"), "{}", folder.read("y.csv"));
}

/// Links beside an output, to files of the user and to missing files.
#[test]
#[cfg(unix)]
fn links_beside_an_output_are_not_followed() {
    use std::os::unix::fs::symlink;

    let folder = folder();
    let before = folder.names();
    for command in COMMANDS {
        for beside in BESIDE {
            for target in ["note.txt", "nowhere.txt"] {
                fs::write(folder.path("note.txt"), PRECIOUS).unwrap();
                let own = format!("out.csv{beside}");
                symlink(target, folder.path(&own)).unwrap();
                let command = command.replace("OUT", "out.csv");
                let ended = folder.flap(&command);
                assert!(ended.code == 0 || ended.code == 2, "{command} {own}: {}", ended.stderr);
                assert_eq!(folder.read("note.txt"), PRECIOUS, "{command} {own}");
                assert!(!folder.path("nowhere.txt").exists(), "{command} {own}");
                let link = fs::read_link(folder.path(&own)).unwrap();
                assert_eq!(link.to_str(), Some(target), "{command} {own}");
                if ended.code == 0 {
                    assert!(!fs::symlink_metadata(folder.path("out.csv")).unwrap().is_symlink());
                }
                for name in folder.names() {
                    if !before.contains(&name) {
                        fs::remove_file(folder.path(&name)).unwrap();
                    }
                }
            }
        }
    }
}

/// An output that is a link stays a link. The target of the link gets the rows, also if the target does not exist.
#[test]
#[cfg(unix)]
fn outputs_are_written_through_links() {
    use std::os::unix::fs::symlink;

    let folder = folder();
    fs::create_dir(folder.path("elsewhere")).unwrap();
    for command in COMMANDS {
        let target = folder.path("elsewhere/target.csv");
        symlink("elsewhere/target.csv", folder.path("link.csv")).unwrap();
        let mut rows = String::new();
        for force in ["", " --force"] {
            let command = command.replace("OUT", "link.csv") + force;
            folder.ends(0, &command);
            assert!(fs::symlink_metadata(folder.path("link.csv")).unwrap().is_symlink(), "{command}");
            let written = fs::read_to_string(&target).unwrap();
            assert!(written.lines().count() > 1 && (rows.is_empty() || rows == written), "{command}");
            rows = written;
            let beside = fs::read_dir(folder.path("elsewhere")).unwrap().count();
            assert_eq!(beside, 1, "{command} leaves files beside the target");
            if !command.starts_with("run ") {
                folder.ends(0, "results verify link.csv");
            }
        }
        fs::remove_file(target).unwrap();
        fs::remove_file(folder.path("link.csv")).unwrap();
        let _ = fs::remove_file(folder.path("link.csv.meta.toml"));
    }
}

/// For every command, the limit on the size of files causes a write error.
#[test]
#[cfg(unix)]
fn a_file_that_grows_too_large_is_an_error() {
    let folder = Folder::with_grid(&quick(2000));
    folder.ends(0, "sweep grid.toml --out rows.csv");
    let before = folder.names();
    for command in [
        "results convert rows.csv out.csv",
        "run ozaki2018-large --samples 20000 --trajectory out.csv",
        "plot rows.csv --y cycles --html out.html",
    ] {
        let limited = format!("ulimit -f 20; exec {} {command}", env!("CARGO_BIN_EXE_flap"));
        let mut shell = std::process::Command::new("sh");
        let output = shell.args(["-c", &limited]).current_dir(folder.path("")).output().unwrap();
        let stderr = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(3), "{command}: {stderr}");
        assert!(stderr.contains("File too large"), "{command}: {stderr}");
        assert_eq!(folder.names(), before, "{command}");
    }
}
