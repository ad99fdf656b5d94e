//! Wrong command lines, wrong grid files, and files that cannot be read or written.

use std::fs;

use crate::support::{Folder, frequencies};

#[test]
fn mistakes_in_a_grid_file_are_shown_in_their_lines() {
    let grid = r#"preset = "ozaki2018-large"

[params]
hinge_stifness = "1.5 uN*m/rad"

[axes]
drive_frequency = { from = "60 Hz", to = "200 mm", n = 15 }
"#;
    let folder = Folder::with_grid(grid);
    let ended = folder.ends(2, "check grid.toml");
    assert_eq!(ended.stdout, "");
    assert_eq!(
        ended.stderr,
        r#"error: model `direct-drive` has no parameter `hinge_stifness`
 --> grid.toml:4:1
  |
4 | hinge_stifness = "1.5 uN*m/rad"
  | ^^^^^^^^^^^^^^ unknown parameter
  |
  = help: did you mean `hinge_stiffness`?

error: `mm` is a length, but `drive_frequency` is in Hz
 --> grid.toml:7:47
  |
7 | drive_frequency = { from = "60 Hz", to = "200 mm", n = 15 }
  |                                               ^^
  |
  = help: use Hz, kHz

grid.toml: 2 mistakes, nothing was run
"#
    );
}

/// flap checks bounds and whole numbers of a table before it runs a point.
#[test]
fn values_outside_their_bounds_are_found_by_check() {
    for (preset, line, message) in [
        ("jafferis2016", "actuator_width_ratio = 2", "`actuator_width_ratio` must be between 0 and 2, not 2"),
        ("arabagi2013-75hz", "strips = 7.5", "`strips` must be a whole number from 1 to 64, not 7.5"),
    ] {
        let folder = Folder::with_grid(&format!("preset = \"{preset}\"\n[params]\n{line}\n"));
        let ended = folder.flap("check grid.toml");
        assert_eq!(ended.code, 2);
        assert!(
            ended.stderr.starts_with(&format!("error: {message}\n --> grid.toml:3:")),
            "{}",
            ended.stderr
        );
    }
}

#[test]
fn results_are_not_overwritten_unasked() {
    let folder = Folder::with_grid(&frequencies(2));
    fs::write(folder.path("grid.csv"), "precious\n").unwrap();
    let ended = folder.ends(2, "sweep --grid grid.toml");
    assert_eq!(
        ended.stderr,
        "error: grid.csv exists already\nhelp: use --out FILE to write to another file, or --restart to replace the file\n"
    );
    assert_eq!(folder.read("grid.csv"), "precious\n");
    assert_eq!(folder.flap("sweep --grid grid.toml --restart").code, 0);
    assert_eq!(folder.read("grid.csv").lines().count(), 3);
}

#[test]
fn the_grid_file_is_not_overwritten_at_all() {
    let folder = Folder::with_grid(&frequencies(2));
    folder.ends(2, "sweep --grid grid.toml --out ./grid.toml --restart").says("overwrite the grid file");
    assert_eq!(folder.read("grid.toml"), frequencies(2));
}

#[test]
fn places_that_cannot_be_written() {
    let folder = Folder::with_grid(&frequencies(2));
    for out in ["missing/rows.csv", "."] {
        let ended = folder.ends(3, &format!("sweep --grid grid.toml --restart --out {out}"));
        assert!(ended.stderr.starts_with(&format!("error: cannot write {out}: ")), "{}", ended.stderr);
        assert_eq!(ended.stdout, "");
    }
}

#[test]
#[cfg(target_os = "linux")]
fn a_full_disk_is_reported() {
    let folder = Folder::with_grid(&frequencies(2));
    let ended = folder.ends(3, "sweep --grid grid.toml --restart --out /dev/full");
    assert!(ended.stderr.starts_with("error: cannot write rows: "), "{}", ended.stderr);
}

#[test]
fn files_that_are_not_grid_files() {
    let folder = Folder::new();
    fs::write(folder.path("bytes.toml"), b"preset = \"\xff\"").unwrap();
    fs::write(folder.path("empty.toml"), "").unwrap();
    for command in ["check ", "sweep --grid ", "run "] {
        for (file, message) in [
            ("missing.toml", "error: missing.toml: there is no such file"),
            ("./", "error: ./: this is a folder"),
            ("bytes.toml", "error: bytes.toml:1:11: not UTF-8"),
            ("empty.toml", "error: "),
        ] {
            let ended = folder.ends(2, &format!("{command}{file}"));
            assert!(ended.stderr.starts_with(message), "{command}{file}: {}", ended.stderr);
            assert_eq!(ended.stdout, "");
        }
    }
}

#[test]
fn results_that_do_not_exist() {
    let folder = Folder::new();
    for command in [
        "describe no.csv",
        "top no.csv --by cycles",
        "plot no.csv",
        "results resume no.csv",
        "results rerun no.csv --inaccurate --out again.csv",
        "results convert no.csv no.parquet",
        "results merge all.csv no.csv",
        "test track no.csv",
    ] {
        let ended = folder.ends(2, command);
        assert!(
            ended.stderr.starts_with("error: no.csv: there is no such file\n"),
            "{command}: {}",
            ended.stderr
        );
    }
    folder
        .ends(2, "sweep no.csv.meta.toml --out again.csv")
        .says("error: no.csv.meta.toml: there is no such file\n");
}

#[test]
fn a_command_without_its_group_gets_a_hint() {
    let folder = Folder::new();
    for (command, hint) in [
        ("merge all.csv one.csv", "use `flap results merge`"),
        ("chirp ozaki2018-small", "use `flap test chirp`"),
        ("wing outline.csv", "use `flap device wing`"),
        ("schema", "use `flap generate schema`"),
    ] {
        folder.ends(2, command).says("unrecognized subcommand").says(hint);
    }
}

#[test]
fn wrong_command_lines() {
    let folder = Folder::with_grid(&frequencies(2));
    for arguments in [
        "",
        "fly",
        "sweep",
        "sweep --grid grid.toml --threads 0",
        "sweep --grid grid.toml --threads many",
        "sweep --grid grid.toml --out rows.json",
        "sweep --grid grid.toml --shard 4/3",
        "sweep --grid grid.toml --resume",
        "sweep --grid grid.toml --checkpoint=-1s",
        "sweep missing.meta.toml --out rows.csv",
        "results resume grid.csv",
        "results merge rows.csv",
        "results convert missing.csv rows.csv",
        "run ozaki2018-large --rtol 0",
        "run ozaki2018-large --rtol nan",
        "run ozaki2018-large --settle-tol 1",
        "run ozaki2018-large --max-cycles 0",
        "run ozaki2018-large --cycles 3",
        "run ozaki2018-large --set drive_frequency",
        "run ozaki2018-large --point 1",
        "run grid.toml --point 2",
    ] {
        let ended = folder.ends(2, arguments);
        assert_eq!(ended.stdout, "", "{arguments}");
        assert_ne!(ended.stderr, "", "{arguments}");
    }
    assert_eq!(folder.names(), ["grid.toml"]);
}

#[test]
fn misspelt_names_are_recognised() {
    let folder = Folder::new();
    for (arguments, hint) in [
        ("models ozaki2018-larg", "help: did you mean `ozaki2018-large`?\n"),
        ("models direct_drive", "help: did you mean `direct-drive`?\n"),
        ("models zebra", "help: `flap models MODEL` lists the parameters and columns of a model\n"),
        ("run ozaki2018-larg", "help: did you mean `ozaki2018-large`?\n"),
        ("run ozaki2018-large --set drive_freqency=100", "help: did you mean `drive_frequency`?\n"),
    ] {
        let ended = folder.ends(2, arguments);
        assert!(ended.stderr.ends_with(hint), "{arguments}: {}", ended.stderr);
    }
}

#[test]
fn wrong_values_on_the_command_line_say_what_is_allowed() {
    let folder = Folder::new();
    for (value, message) in [
        ("drive_frequency=120 mm", "drive_frequency"),
        ("drive_frequency=120 Hzz", "unknown unit `Hzz`"),
        ("drive_frequency=fast", "must start with a number"),
        ("drive_frequency=-5", "must be more than zero"),
        ("drive_frequency=inf", "finite"),
        ("drive_frequency=", "must start with a number"),
    ] {
        folder.ends_with(2, &["run", "ozaki2018-large", "--set", value]).says(message);
    }
}

#[test]
fn threads_are_as_many_as_a_machine_could_have() {
    let folder = Folder::with_grid("preset = \"ozaki2018-large\"\n");
    for threads in ["0", "100000", "two"] {
        folder.ends(2, &format!("sweep --grid grid.toml --threads {threads}")).says("from 1 to 1024");
    }
}

/// If a command gets a grid file or a sidecar instead of results, it prints an error that names the kind of the file.
#[test]
fn grids_and_sidecars_are_not_results() {
    let folder = Folder::with_grid(&frequencies(2));
    for command in [
        "plot",
        "top --by cycles",
        "describe",
        "results resume",
        "results convert --force",
        "results rerun --status unsettled --out o.csv",
    ] {
        let end = command.find(" --").unwrap_or(command.len());
        let (name, options) = command.split_at(end);
        let out = if name == "results convert" { "o.csv" } else { "" };
        folder.refuses(
            &format!("{name} grid.toml {out} {options}"),
            "error: grid.toml is a grid file, not a file of results\nhelp: `flap sweep grid.toml` writes its results\n",
        );
        folder.refuses(
            &format!("{name} rows.csv.meta.toml {out} {options}"),
            "error: rows.csv.meta.toml is the sidecar of results, not a file of results\nhelp: give the file of results instead: rows.csv\n",
        );
    }
}

/// flap rejects numbers that are too large for a float, and other impossible numbers, with a message.
#[test]
fn impossible_numbers_are_named() {
    let folder = Folder::new();
    for (arguments, message) in [
        (
            "run ozaki2018-large --set drive_frequency=1e999",
            "`1e999` is too large for `drive_frequency` (largest about 1.8e308)\n",
        ),
        ("run ozaki2018-large --accuracy 1e999", "expected a finite number more than zero"),
        ("run ozaki2018-large --max-cycles 1e999", "expected a whole number from 1 to 4294967295"),
        ("run ozaki2018-large --max-cycles 0", "expected a whole number from 1 to 4294967295"),
        ("test chirp ozaki2018-large --from 1e999", "`1e999` is too large for the value"),
        ("test chirp ozaki2018-large --rate 1e999", "expected a finite number"),
        ("test resonance ozaki2018-large --from 1e999", "`1e999` is too large for the value"),
        ("test resonance ozaki2018-large --tolerance 0", "the tolerance must be more than zero, not 0 Hz\n"),
    ] {
        folder.refuses(arguments, message);
    }
}

/// If points do not settle, flap prints a command that runs the points longer. The printed command works.
#[test]
fn unsettled_points_come_with_a_command() {
    let grid = frequencies(2) + "[solver]\nmax_cycles = 4\n";
    let folder = Folder::with_grid(&grid);
    let command = "results rerun grid.csv --status unsettled --max-cycles 40 --out grid.unsettled.csv";
    folder.ends(0, "sweep grid.toml").says(&format!(
        "2 points did not settle within 4 drive periods. To run them longer: flap {command}. If"
    ));
    // A rerun that changes nothing does not recommend itself.
    let ended = folder.ends(0, "results rerun grid.csv --status unsettled --max-cycles 4 --out same.csv");
    ended.says("2 points did not settle within 4 drive periods. Run them longer with --max-cycles only if ");
    ended.says("a motion that stays unsettled is quasi-periodic or chaotic\n");
    assert!(!ended.stderr.contains("flap results rerun"), "{}", ended.stderr);
    folder.ends(0, command).says("2 periodic in ").says("2 rows in grid.unsettled.csv\n");
    folder.ends(0, "sweep grid.toml --out -").says("To run them longer, raise max_cycles in [solver]");

    let command = "run grid.toml --point 1 --set 'drive_voltage_pp=80 V' --max-cycles 40";
    let ended = folder.ends_with(0, &["run", "grid.toml", "--point", "1", "--set", "drive_voltage_pp=80 V"]);
    ended.says(&format!(
        "the point did not settle within 4 drive periods. To run it longer: flap {command}. If"
    ));
    let options = "--settle-tol 1e-9 --rtol 1e-7 --accuracy 0.01";
    folder
        .ends(0, &format!("run grid.toml {options}"))
        .says("flap run grid.toml --rtol 1e-7 --accuracy 0.01 --settle-tol 1e-9 --max-cycles 40. If");
    let one = Folder::with_grid(&(frequencies(1) + "[solver]\nmax_cycles = 1\n"));
    one.ends(0, "sweep grid.toml").says("1 point did not settle within 1 drive period. To run it longer");
    one.ends(0, "results convert grid.csv o.csv").says("1 row in o.csv\n");
}
