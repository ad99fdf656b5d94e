//! A folder of its own for every test, and the command in it.

use std::fs;
use std::path::PathBuf;
use std::process::{self, Child, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use assert_cmd::Command;
use flap_sweep::files::sidecar::Sidecar;
use tempfile::TempDir;

/// A folder with files, in which the command runs.
pub(crate) struct Folder(TempDir);

/// How a command ended.
pub(crate) struct Ended {
    pub(crate) code: i32,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
}

impl Folder {
    pub(crate) fn new() -> Folder {
        Folder(tempfile::tempdir().unwrap())
    }

    /// A folder with the grid file `grid.toml`.
    pub(crate) fn with_grid(text: &str) -> Folder {
        let folder = Folder::new();
        fs::write(folder.path("grid.toml"), text).unwrap();
        folder
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub(crate) fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap()
    }

    /// Changes the sidecar of results, as if it had been written so.
    pub(crate) fn rewrite_sidecar(&self, results: &str, change: impl FnOnce(&mut Sidecar)) {
        let path = self.path(&format!("{results}.meta.toml"));
        let mut sidecar = Sidecar::read(&path).unwrap();
        change(&mut sidecar);
        sidecar.write(&path).unwrap();
    }

    /// Names of the files, sorted.
    pub(crate) fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(self.0.path()).unwrap();
        let mut names: Vec<String> =
            entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    /// Runs `flap` with the words of `arguments`.
    pub(crate) fn flap(&self, arguments: &str) -> Ended {
        self.flap_with(&arguments.split_whitespace().collect::<Vec<_>>())
    }

    /// Runs `flap`.
    pub(crate) fn flap_with(&self, arguments: &[&str]) -> Ended {
        let output = Command::new(env!("CARGO_BIN_EXE_flap"))
            .args(arguments)
            .current_dir(self.0.path())
            .timeout(Duration::from_secs(120))
            .output()
            .unwrap();
        Ended {
            code: output.status.code().expect("it was not killed"),
            stdout: String::from_utf8(output.stdout).unwrap(),
            stderr: String::from_utf8(output.stderr).unwrap(),
        }
    }
}

/// A grid of `points` drive frequencies from 60 Hz, a tenth of a hertz apart.
pub(crate) fn frequencies(points: u64) -> String {
    let last = 600 + points - 1;
    let range = format!("{{ from = 60, to = {}.{}, step = 0.1 }}", last / 10, last % 10);
    format!("preset = \"ozaki2018-large\"\n\n[axes]\ndrive_frequency = {range}\n")
}

/// A grid of `points` points that take no time: one drive period each, and none settles.
pub(crate) fn quick(points: u64) -> String {
    frequencies(points) + "\n[solver]\nrtol = 1e-3\nsettle_tol = 1e-3\nmax_cycles = 1\n"
}

/// Starts `flap` and does not wait for it. It heeds SIGINT, whatever the parent of the tests does.
pub(crate) fn start(folder: &Folder, arguments: &[&str]) -> Child {
    let mut command = command(folder, arguments);
    #[cfg(unix)]
    set_interrupt(&mut command, libc::SIG_DFL);
    command.spawn().unwrap()
}

/// Starts `flap` as shells start jobs in the background: SIGINT is ignored.
#[cfg(unix)]
pub(crate) fn start_in_background(folder: &Folder, arguments: &[&str]) -> Child {
    let mut command = command(folder, arguments);
    set_interrupt(&mut command, libc::SIG_IGN);
    command.spawn().unwrap()
}

fn command(folder: &Folder, arguments: &[&str]) -> process::Command {
    let mut command = process::Command::new(env!("CARGO_BIN_EXE_flap"));
    command.args(arguments).current_dir(folder.path(""));
    command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

/// What SIGINT is to do when the command starts.
#[cfg(unix)]
#[expect(unsafe_code, reason = "there is no other way to set it")]
fn set_interrupt(command: &mut process::Command, action: libc::sighandler_t) {
    use std::os::unix::process::CommandExt;

    let set = move || {
        // SAFETY: `signal` may be called between fork and exec, and the action is one of the two that are no function.
        unsafe { libc::signal(libc::SIGINT, action) };
        Ok(())
    };
    // SAFETY: `set` does nothing else.
    unsafe { command.pre_exec(set) };
}

/// The exit code, none if it was killed; fails the test if the command does not end.
pub(crate) fn wait(child: &mut Child) -> Option<i32> {
    let start = Instant::now();
    loop {
        if let Some(status) = child.try_wait().unwrap() {
            return status.code();
        }
        if start.elapsed() > Duration::from_secs(60) {
            child.kill().unwrap();
            panic!("it does not end");
        }
        thread::sleep(Duration::from_millis(10));
    }
}

/// Waits until more than `rows` lines are in `grid.csv`.
pub(crate) fn wait_for_rows(folder: &Folder, rows: usize) {
    let start = Instant::now();
    while fs::read_to_string(folder.path("grid.csv")).unwrap_or_default().lines().count() <= rows {
        assert!(start.elapsed() < Duration::from_secs(60), "no rows are written");
        thread::sleep(Duration::from_millis(10));
    }
}

/// Sends a signal.
pub(crate) fn send(signal: &str, child: &Child) {
    let status =
        process::Command::new("kill").arg(format!("-{signal}")).arg(child.id().to_string()).status().unwrap();
    assert!(status.success());
}
