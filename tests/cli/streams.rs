//! Standard streams, closed pipes and signals.

use std::io::{BufRead, BufReader, Read};
#[cfg(target_os = "linux")]
use std::os::unix::fs::FileTypeExt as _;
use std::thread;
use std::time::{Duration, Instant};

#[cfg(unix)]
use crate::support::start_in_background;
use crate::support::{Folder, frequencies, send, start, sweep_until, wait, wait_for_rows};

#[test]
fn stdout_carries_rows_and_nothing_else() {
    let folder = Folder::with_grid(&frequencies(3));
    let ended = folder.ends(0, "sweep --grid grid.toml --out -");
    assert_eq!(ended.stdout.lines().count(), 4);
    assert!(ended.stdout.starts_with("point,drive_frequency,status,"));
    assert!(ended.stderr.ends_with("3 rows in stdout\n"), "{}", ended.stderr);
    assert_eq!(folder.names(), ["grid.toml"]);
}

/// Devices and pipes contain no earlier results, and flap writes neither a sidecar nor a lock for them.
#[test]
#[cfg(target_os = "linux")]
fn rows_go_to_devices_and_pipes() {
    let folder = Folder::with_grid(&frequencies(3));
    let rows = folder.ends(0, "sweep grid.toml --out -").stdout;
    let flap = env!("CARGO_BIN_EXE_flap");
    let null = folder.ends(0, "sweep grid.toml --out /dev/null");
    assert!(null.stderr.ends_with("3 rows in /dev/null\n"), "{}", null.stderr);
    folder.ends(0, "respond grid.toml --out /dev/null");
    assert!(std::fs::metadata("/dev/null").unwrap().file_type().is_char_device());
    for line in [
        "mkfifo pipe; cat pipe & $flap sweep grid.toml --out pipe; wait; rm pipe",
        "$flap sweep grid.toml --out /dev/stdout | cat",
        "$flap sweep grid.toml --out /dev/stdout > rows.csv; cat rows.csv; rm rows.csv",
        "$flap sweep grid.toml --out /dev/fd/3 3>&1 | cat",
    ] {
        let ended = folder.shell(&format!("flap={flap}; {line}"));
        assert_eq!(ended.stdout, rows, "{line}: {}", ended.stderr);
    }
    // A name without an ending that leads to a file is refused.
    folder.shell(&format!("{flap} sweep grid.toml --out /dev/fd/3 3> rows.csv")).says("must end in .csv");
    assert_eq!(folder.names(), ["grid.toml", "rows.csv"]);
}

#[test]
fn a_reader_who_has_seen_enough_is_no_error() {
    let folder = Folder::with_grid(&frequencies(100_000_000));
    for arguments in
        [&["sweep", "--grid", "grid.toml", "--out", "-"][..], &["models", "ozaki2018-large"], &["models"]]
    {
        let mut child = start(&folder, arguments);
        let mut line = String::new();
        BufReader::new(child.stdout.take().unwrap()).read_line(&mut line).unwrap();
        assert!(!line.is_empty());
        assert_eq!(wait(&mut child), Some(0), "{arguments:?}");
        let mut stderr = String::new();
        child.stderr.take().unwrap().read_to_string(&mut stderr).unwrap();
        // So many frequencies end far above the preset's.
        let mut told = stderr.lines().filter(|line| !line.starts_with("warning: drive_frequency"));
        assert_eq!(told.next(), None, "{arguments:?}");
    }
}

#[test]
#[cfg(unix)]
fn an_interrupted_sweep_keeps_the_rows_of_the_first_points() {
    for signal in ["INT", "TERM"] {
        let folder = Folder::with_grid(&frequencies(100_000_000));
        let mut child = sweep_until(&folder, 100);
        send(signal, &child);
        assert_eq!(wait(&mut child), Some(130));

        let text = folder.read("grid.csv");
        assert!(text.ends_with('\n'));
        let rows = text.lines().count() - 1;
        assert!(rows >= 100, "{rows}");
        let mut stderr = String::new();
        child.stderr.take().unwrap().read_to_string(&mut stderr).unwrap();
        let last = format!(
            "interrupted: the rows of the first {rows} of 100000000 points are in grid.csv\n\
             `flap results resume grid.csv` continues the run\n"
        );
        assert!(stderr.ends_with(&last), "{stderr}");
        let sidecar: toml::Table = folder.read("grid.csv.meta.toml").parse().unwrap();
        assert_eq!(sidecar["state"].as_str(), Some("interrupted"));
        assert_eq!(sidecar["summary"]["rows"].as_integer(), i64::try_from(rows).ok());

        // Another sweep of the same points begins with the same bytes.
        let mut again = start(&folder, &["sweep", "--grid", "grid.toml", "--out", "-"]);
        let first = BufReader::new(again.stdout.take().unwrap()).lines().take(100);
        assert!(first.map(Result::unwrap).eq(text.lines().take(100)));
        wait(&mut again);
    }
}

#[test]
#[cfg(unix)]
fn a_second_signal_ends_at_once() {
    let folder = Folder::with_grid(&frequencies(100_000_000));
    let mut child = sweep_until(&folder, 1);
    send("INT", &child);
    send("INT", &child);
    assert_eq!(wait(&mut child), Some(130));
}

/// Solver settings with which no point ends.
const ENDLESS: &str = "\n[solver]\nnewton = false\nmax_cycles = 1000000000\nsettle_tol = 1e-300\n";

/// The largest time in which a command must end. Commands should need one second, but busy machines need longer.
const SOON: Duration = Duration::from_secs(5);

/// A signal ends each command whose computation is endless.
#[test]
#[cfg(unix)]
fn signals_end_every_command_within_a_point() {
    let grid = format!("preset = \"ozaki2018-small\"\n\n[axes]\ndrive_frequency = [90, 100]\n{ENDLESS}");
    // A motion that never repeats.
    let design = "jafferis2016 --set hinge_stiffness=0.7486uN*m/rad --set drive_voltage_pp=180 --max-cycles 4294967295";
    for command in [
        "sweep --grid grid.toml".to_owned(),
        "sweep --grid grid.toml --out -".to_owned(),
        "respond grid.toml --along drive_voltage_pp --from 100 --to 110 --step 1".to_owned(),
        "check grid.toml".to_owned(),
        format!("run {design} --set drive_frequency=82"),
        format!("run {design} --set drive_frequency=82 --trajectory motion.csv"),
        format!("test resonance {design} --from 81 --to 83"),
    ] {
        let arguments: Vec<&str> = command.split_whitespace().collect();
        let children = ["INT", "TERM"].map(|signal| {
            let folder = Folder::with_grid(&grid);
            let child = start(&folder, &arguments);
            (signal, child, folder)
        });
        thread::sleep(Duration::from_millis(500));
        let ended = children.map(|(signal, mut child, _folder)| {
            assert!(child.try_wait().unwrap().is_none(), "{command} ended by itself");
            let sent = Instant::now();
            send(signal, &child);
            (wait(&mut child), sent.elapsed())
        });
        for (code, time) in ended {
            assert!(time < SOON, "{command} took {time:?}");
            // Commands that have nothing to put in order end by the signal.
            let has_rows = command.starts_with("sweep") || command.starts_with("respond");
            assert_eq!(code, has_rows.then_some(130), "{command}");
        }
    }
}

#[test]
#[cfg(unix)]
fn an_endless_point_does_not_lose_the_rows_before_it() {
    let axis = "drive_frequency = [90, 92, 100]";
    let invalid_below_95 = "hinge_stiffness = \"1e-6 * (drive_frequency - 95)\"";
    let folder = Folder::with_grid(&format!(
        "preset = \"ozaki2018-small\"\n\n[axes]\n{axis}\n\n[derived]\n{invalid_below_95}\n{ENDLESS}"
    ));
    let mut child = sweep_until(&folder, 2);
    send("TERM", &child);
    assert_eq!(wait(&mut child), Some(130));
    assert_eq!(folder.read("grid.csv").lines().count(), 3);
}

#[test]
#[cfg(unix)]
fn a_sweep_in_the_background_ignores_ctrl_c() {
    let folder = Folder::with_grid(&frequencies(100_000_000));
    let mut child = start_in_background(&folder, &["sweep", "--grid", "grid.toml"]);
    wait_for_rows(&folder, 100);
    send("INT", &child);
    let rows = folder.read("grid.csv").lines().count();
    wait_for_rows(&folder, rows + 1000);
    assert!(child.try_wait().unwrap().is_none());
    send("TERM", &child);
    assert_eq!(wait(&mut child), Some(130));
}

/// The folder for commands without messages, with a stroke file and results.
fn folder_of_quiet_commands() -> Folder {
    let folder = Folder::with_grid(&frequencies(3));
    folder.ends(0, "sweep grid.toml --out rows.csv");
    folder
}

#[test]
fn quiet_commands_print_neither_progress_nor_notes() {
    let folder = folder_of_quiet_commands();
    for arguments in [
        "sweep grid.toml --out a.csv",
        "sweep grid.toml --out a.csv",
        "results resume a.csv",
        "sweep grid.toml --shard 1/2 --out 1of2.csv",
        "sweep grid.toml --shard 2/2 --out 2of2.csv",
        "results merge --force a.csv 1of2.csv 2of2.csv",
        "results convert a.csv b.csv.zst",
        "results rerun a.csv --status unsettled --out c.csv",
        "top rows.csv --by lift_mean_mn",
        "run ozaki2018-large --trajectory motion.csv",
        "respond ozaki2018-large --from 100Hz --to 102Hz --step 1Hz --out response.csv",
        "test resonance ozaki2018-large",
        "generate man pages",
    ] {
        let loud = folder.ends(0, &arguments.replace(".csv", ".loud.csv").replace("rows.loud", "rows"));
        let quiet = folder.ends(0, &format!("{arguments} --quiet"));
        assert_eq!(quiet.stderr, "", "{arguments} --quiet; without: {}", loud.stderr);
    }
    let quiet = folder.ends(0, "-q sweep grid.toml --out -");
    assert_eq!((quiet.stdout.lines().count(), quiet.stderr.as_str()), (4, ""));
}

#[test]
fn quiet_commands_print_warnings_and_errors() {
    let folder = folder_of_quiet_commands();
    folder.ends(2, "models nothing --quiet").says("error: there is no model");
    let far = folder.ends(0, "run ozaki2018-large --set wing_length=17 --quiet");
    far.says("warning: wing_length");
    std::fs::write(folder.path("grid.toml"), "preset = 3\n").unwrap();
    folder.ends(2, "check grid.toml -q").says("`preset` must be text in quotes");
}
