//! Sweeps that are interrupted by a kill, a full disk or a lost permission, and then resumed.

#![cfg(unix)]

use std::fs;
use std::io::ErrorKind;
use std::os::unix::fs::{MetadataExt, PermissionsExt, chown};
use std::os::unix::process::CommandExt;
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use crate::support::{Folder, frequencies, quick, send, start, sweep_until, wait};

/// Number of points of sweeps that must last long enough to be killed several times.
const POINTS: u64 = 60_000;

/// Arguments that cause many checkpoints in a short time.
const OFTEN: [&str; 2] = ["--checkpoint", "5 ms"];

/// A folder with a grid and the rows of an uninterrupted sweep in `whole.<ending>`.
fn folder(points: u64, ending: &str) -> Folder {
    let folder = Folder::with_grid(&quick(points));
    folder.ends(0, &format!("sweep --grid grid.toml --out whole.{ending}"));
    folder
}

fn length(folder: &Folder, name: &str) -> u64 {
    fs::metadata(folder.path(name)).map_or(0, |metadata| metadata.len())
}

/// Waits until `what` is true; returns false if the command ends before.
fn wait_until(child: &mut Child, mut what: impl FnMut() -> bool) -> bool {
    let start = Instant::now();
    while !what() {
        if child.try_wait().unwrap().is_some() {
            return false;
        }
        assert!(start.elapsed() < Duration::from_secs(60), "it does not come so far");
        thread::sleep(Duration::from_millis(1));
    }
    true
}

/// Starts a sweep into `out` and waits for its first checkpoints.
fn begin(folder: &Folder, out: &str) -> Child {
    let mut arguments = vec!["sweep", "--grid", "grid.toml", "--out", out, "--threads", "1"];
    arguments.extend(OFTEN);
    let mut child = start(folder, &arguments);
    let journal = format!("{out}.journal");
    assert!(wait_until(&mut child, || length(folder, &journal) > 500));
    child
}

/// The sidecar without the entries that differ between two runs of the same sweep.
fn comparable(folder: &Folder, name: &str) -> toml::Table {
    let mut sidecar: toml::Table = folder.read(&format!("{name}.meta.toml")).parse().unwrap();
    for key in ["checksum", "started", "finished", "seconds", "threads"] {
        sidecar.remove(key);
    }
    sidecar
}

fn assert_same(folder: &Folder, ending: &str) {
    let bytes = |name: &str| fs::read(folder.path(&format!("{name}.{ending}"))).unwrap();
    assert!(bytes("whole") == bytes("rows"), "{ending}");
    assert_eq!(
        comparable(folder, &format!("whole.{ending}")),
        comparable(folder, &format!("rows.{ending}")),
        "{ending}"
    );
    for left in ["journal", "lock", "part", "meta.toml.tmp"] {
        assert!(!folder.path(&format!("rows.{ending}.{left}")).exists(), "{left}");
    }
}

/// Kills the sweep `kills` times at random moments, each after some progress, and then waits until the sweep ends.
fn killed(ending: &str, kills: u32, mut random: u64) {
    let folder = folder(POINTS, ending);
    let out = format!("rows.{ending}");
    let journal = format!("{out}.journal");
    let mut arguments = vec!["sweep", "--grid", "grid.toml", "--out", &out, "--threads", "1"];
    arguments.extend(OFTEN);
    for _ in 0..kills {
        let before = length(&folder, &journal);
        let mut child = start(&folder, &arguments);
        assert!(wait_until(&mut child, || length(&folder, &journal) > before), "{ending}: it is too quick");
        random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        thread::sleep(Duration::from_micros(random >> 50));
        child.kill().unwrap();
        assert_eq!(wait(&mut child), None, "{ending}: it ended before it was killed");
    }
    if ending == "parquet" {
        // Once more while the rows are turned into columns.
        let mut child = start(&folder, &arguments);
        if wait_until(&mut child, || length(&folder, &out) > 0) {
            child.kill().unwrap();
            wait(&mut child);
        }
    }
    folder.ends(0, &format!("results resume {out}"));
    assert_same(&folder, ending);
}

#[test]
fn a_killed_sweep_yields_the_same_csv() {
    killed("csv", 7, 1);
}

#[test]
fn a_killed_sweep_yields_the_same_compressed_csv() {
    killed("csv.zst", 7, 2);
}

#[test]
fn a_killed_sweep_yields_the_same_parquet() {
    killed("parquet", 7, 3);
}

/// A sweep that is interrupted with SIGINT loses no rows, in any format.
#[test]
fn an_interrupted_sweep_goes_on() {
    for (signal, ending) in [("INT", "csv"), ("TERM", "csv.zst"), ("INT", "parquet")] {
        let folder = folder(POINTS, ending);
        let out = format!("rows.{ending}");
        let mut child = begin(&folder, &out);
        send(signal, &child);
        assert_eq!(wait(&mut child), Some(130), "{ending}");
        let sidecar: toml::Table = folder.read(&format!("{out}.meta.toml")).parse().unwrap();
        assert_eq!(sidecar["state"].as_str(), Some("interrupted"));

        folder
            .ends(0, &format!("sweep --grid grid.toml --out {out}"))
            .says(&format!("of {POINTS} points of {out} are done\n"));
        assert_same(&folder, ending);
    }
}

/// Sweeps with derivatives can be resumed like other sweeps.
#[test]
fn an_interrupted_sweep_of_derivatives_goes_on() {
    let gradient = "\n[gradient]\nof = [\"lift_mean_mn\"]\nwith_respect_to = [\"hinge_stiffness\", \"drive_frequency\"]\n";
    for ending in ["csv", "parquet"] {
        let folder = Folder::with_grid(&(frequencies(2000) + gradient));
        folder.ends(0, &format!("sweep grid.toml --out whole.{ending}"));
        let out = format!("rows.{ending}");
        let mut child = begin(&folder, &out);
        send("INT", &child);
        assert_eq!(wait(&mut child), Some(130), "{ending}");
        let ended = folder.ends(0, &format!("results resume {out}"));
        assert!(!ended.stderr.starts_with("0 of 2000 points"), "{}", ended.stderr);
        assert_same(&folder, ending);
    }
}

#[test]
fn a_full_disk_loses_nothing() {
    for (ending, blocks) in [("csv", 200), ("csv.zst", 20), ("parquet", 20)] {
        let folder = folder(5_000, ending);
        let flap = env!("CARGO_BIN_EXE_flap");
        let sweep = format!("{flap} sweep --grid grid.toml --out rows.{ending} --checkpoint '5 ms'");
        let limited = Command::new("sh")
            .args(["-c", &format!("ulimit -f {blocks}; exec {sweep}")])
            .current_dir(folder.path(""))
            .output()
            .unwrap();
        let stderr = String::from_utf8(limited.stderr).unwrap();
        assert_eq!(limited.status.code(), Some(3), "{stderr}");
        assert!(stderr.starts_with("error: cannot write rows: "), "{stderr}");
        assert!(
            stderr.ends_with(&format!("help: `flap results resume rows.{ending}` continues the run\n")),
            "{stderr}"
        );
        folder.ends(0, &format!("results resume rows.{ending}"));
        assert_same(&folder, ending);
    }
}

/// The user id of `nobody`: the user root may write without permission.
const NOBODY: u32 = 65_534;

/// Starts a copy of the command. If another test starts a process at the same time, the new process keeps the copy open
/// for a moment. A program that is open for writing cannot be started.
fn spawn(mut command: Command) -> Child {
    loop {
        match command.spawn() {
            Err(error) if error.kind() == ErrorKind::ExecutableFileBusy => {
                thread::sleep(Duration::from_millis(10));
            }
            started => return started.unwrap(),
        }
    }
}

#[test]
fn a_lost_permission_loses_nothing() {
    let folder = folder(POINTS, "csv");
    let writable = |writable: bool| {
        let mode = if writable { 0o755 } else { 0o555 };
        fs::set_permissions(folder.path(""), fs::Permissions::from_mode(mode)).unwrap();
    };
    fs::copy(env!("CARGO_BIN_EXE_flap"), folder.path("flap")).unwrap();
    let command = |arguments: &str| {
        let mut command = Command::new(folder.path("flap"));
        command.args(arguments.split_whitespace()).current_dir(folder.path(""));
        command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let owner = fs::metadata(folder.path("")).unwrap().uid();
        if owner == 0 || owner == NOBODY {
            chown(folder.path(""), Some(NOBODY), Some(NOBODY)).unwrap();
            command.uid(NOBODY).gid(NOBODY);
        }
        command
    };
    let run = |arguments: &str| {
        let output = spawn(command(arguments)).wait_with_output().unwrap();
        (output.status.code(), String::from_utf8(output.stderr).unwrap())
    };

    // From the beginning.
    writable(false);
    let (code, stderr) = run("sweep --grid grid.toml --out rows.csv");
    assert_eq!(code, Some(3), "{stderr}");
    assert!(stderr.starts_with("error: cannot write rows.csv: "), "{stderr}");
    assert!(!folder.path("rows.csv").exists());

    // In the middle: the files that are open go on, what is beside them cannot be replaced.
    writable(true);
    let mut child = spawn(command("sweep --grid grid.toml --out rows.csv --threads 1"));
    assert!(wait_until(&mut child, || length(&folder, "rows.csv") > 10_000));
    writable(false);
    assert_eq!(wait(&mut child), Some(3));
    let (code, stderr) = run("results resume rows.csv");
    assert_eq!(code, Some(3), "{stderr}");
    assert!(stderr.contains("error: cannot write rows.csv.meta.toml: "), "{stderr}");
    writable(true);
    let (code, stderr) = run("results resume rows.csv");
    assert_eq!(code, Some(0), "{stderr}");
    assert_same(&folder, "csv");
}

#[test]
fn results_removed_meanwhile_are_noticed() {
    for (ending, removed) in [("csv", "rows.csv"), ("parquet", "rows.parquet.part")] {
        let folder = folder(POINTS, ending);
        let out = format!("rows.{ending}");
        let mut child = begin(&folder, &out);
        fs::remove_file(folder.path(removed)).unwrap();
        assert_eq!(wait(&mut child), Some(3), "{removed}");
        let stderr = std::io::read_to_string(child.stderr.take().unwrap()).unwrap();
        assert!(stderr.contains(&format!("{removed} was removed or replaced while it was open")), "{stderr}");

        folder
            .ends(0, &format!("results resume {out}"))
            .says(&format!(" missing from {out} and will be computed again\n"));
        assert_same(&folder, ending);
    }
}

/// Two processes cannot write to the same results, however the processes begin.
#[test]
fn a_running_sweep_is_not_resumed() {
    let folder = Folder::with_grid(&frequencies(100_000_000));
    let mut child = sweep_until(&folder, 1);
    for arguments in ["results resume grid.csv", "sweep --grid grid.toml", "sweep --grid grid.toml --restart"]
    {
        let ended = folder.ends(3, arguments);
        assert!(ended.stderr.ends_with("error: another run is writing to grid.csv\n"), "{}", ended.stderr);
    }
    child.kill().unwrap();
    wait(&mut child);
}

/// An unfinished sweep of `grid.toml`, with its rows in `grid.csv`.
fn unfinished() -> Folder {
    let folder = Folder::with_grid(&quick(100_000_000));
    let mut child = begin(&folder, "grid.csv");
    child.kill().unwrap();
    wait(&mut child);
    folder
}

#[test]
fn a_changed_grid_is_not_resumed() {
    let folder = unfinished();
    let rows = folder.read("grid.csv");
    let grid = folder.read("grid.toml").replace("rtol = 1e-3", "rtol = 1e-4");
    fs::write(folder.path("grid.toml"), grid).unwrap();
    let ended = folder.ends(2, "sweep --grid grid.toml");
    let told = "error: grid.csv cannot be resumed: the grid file differs; the solver settings differ\n\
                help: `flap results resume grid.csv` continues the run with its original grid\n\
                help: line 7 of the grid was `rtol = 1e-3`, it is `rtol = 1e-4`\n\
                help: an edited grid is another sweep: write its rows to another file with --out FILE\n\
                help: use --restart to delete the rows of this file and start over\n";
    assert!(ended.stderr.ends_with(told), "{}", ended.stderr);
    assert_eq!(folder.read("grid.csv"), rows, "nothing is lost");

    // Complete results of another grid have nothing to be continued.
    folder.ends(0, "sweep grid.toml --shard 1/1000000 --out part.csv");
    let ended = folder.ends(2, "sweep grid.toml --out part.csv");
    ended.says(
        "error: part.csv exists already, with other rows: the rows cover shard 1/1000000, not all points\n",
    );
    ended.says("help: use --out FILE to write to another file, or --restart to replace the file\n");
}

#[test]
fn another_shard_is_not_resumed() {
    let folder = unfinished();
    let ended = folder.ends(2, "sweep --grid grid.toml --out grid.csv --shard 2/3");
    let message = "grid.csv cannot be resumed: the rows cover all points, not shard 2/3\n";
    ended.says(message);
}

#[test]
fn rows_edited_meanwhile_are_not_resumed() {
    let folder = unfinished();
    let rows = folder.read("grid.csv").replacen("unsettled", "periodic!", 1);
    fs::write(folder.path("grid.csv"), &rows).unwrap();
    folder.ends(2, "results resume grid.csv").says("the file has changed since the sweep wrote it");
    assert_eq!(folder.read("grid.csv"), rows);
}
