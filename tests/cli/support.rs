//! A separate folder for every test, and the command `flap` in this folder.

use std::fs;
use std::path::PathBuf;
use std::process::{self, Child, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use assert_cmd::Command;
use flap_sweep::files::sidecar::Sidecar;
use temp_dir::TempDir;

/// A folder with files, in which the command runs.
pub(crate) struct Folder(TempDir);

/// The exit code and the output of a command that has ended.
pub(crate) struct Ended {
    /// The arguments, for messages of failed tests.
    arguments: String,
    pub(crate) code: i32,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
}

impl Folder {
    pub(crate) fn new() -> Folder {
        Folder(TempDir::new().unwrap())
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

    /// Changes the sidecar of results, with a valid checksum.
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

    /// Runs `flap` with the words of `arguments`; fails the test if it ends with another exit code.
    #[track_caller]
    pub(crate) fn ends(&self, code: i32, arguments: &str) -> Ended {
        self.ends_with(code, &arguments.split_whitespace().collect::<Vec<_>>())
    }

    /// Runs `flap`; fails the test if it ends with another exit code.
    #[track_caller]
    pub(crate) fn ends_with(&self, code: i32, arguments: &[&str]) -> Ended {
        let ended = self.flap_with(arguments);
        assert_eq!(ended.code, code, "{}: {}", ended.arguments, ended.stderr);
        ended
    }

    /// Fails the test unless `flap` refuses the arguments, with `message` and without results.
    #[track_caller]
    pub(crate) fn refuses(&self, arguments: &str, message: &str) {
        let ended = self.ends(2, arguments);
        ended.says(message);
        assert_eq!(ended.stdout, "", "{arguments}");
    }

    /// Runs `flap`.
    pub(crate) fn flap_with(&self, arguments: &[&str]) -> Ended {
        self.flap_reading("", arguments)
    }

    /// Runs a command line in a shell.
    #[cfg(target_os = "linux")]
    pub(crate) fn shell(&self, line: &str) -> Ended {
        let output = Command::new("bash")
            .args(["-c", line])
            .current_dir(self.0.path())
            .env_remove("COLUMNS")
            .timeout(Duration::from_secs(60))
            .output()
            .unwrap();
        Ended::of(line.to_owned(), &output)
    }

    /// Runs `flap` with the text `stdin` on its standard input.
    pub(crate) fn flap_reading(&self, stdin: &str, arguments: &[&str]) -> Ended {
        let output = Command::new(env!("CARGO_BIN_EXE_flap"))
            .args(arguments)
            .write_stdin(stdin)
            .current_dir(self.0.path())
            .env_remove("COLUMNS")
            .timeout(Duration::from_secs(120))
            .output()
            .unwrap();
        Ended::of(arguments.join(" "), &output)
    }
}

impl Ended {
    fn of(arguments: String, output: &process::Output) -> Ended {
        Ended {
            code: output.status.code().unwrap_or_else(|| panic!("{arguments}: it was killed")),
            arguments,
            stdout: String::from_utf8(output.stdout.clone()).unwrap(),
            stderr: String::from_utf8(output.stderr.clone()).unwrap(),
        }
    }

    /// Fails the test if stderr does not contain `text`.
    #[track_caller]
    pub(crate) fn says(&self, text: &str) -> &Ended {
        assert!(self.stderr.contains(text), "{}: {text} is not in\n{}", self.arguments, self.stderr);
        self
    }

    /// Fails the test if stdout does not contain `text`.
    #[track_caller]
    pub(crate) fn prints(&self, text: &str) -> &Ended {
        assert!(self.stdout.contains(text), "{}: {text} is not in\n{}", self.arguments, self.stdout);
        self
    }
}

/// The cells of the column `name` of comma-separated text.
#[track_caller]
pub(crate) fn column(text: &str, name: &str) -> Vec<String> {
    let mut lines = text.lines();
    let place = lines.next().unwrap().split(',').position(|column| column == name).expect(name);
    lines.map(|line| line.split(',').nth(place).unwrap().to_owned()).collect()
}

/// The numbers of a column; NaN for other cells.
#[track_caller]
pub(crate) fn numbers(text: &str, name: &str) -> Vec<f64> {
    column(text, name).iter().map(|cell| cell.parse().unwrap_or(f64::NAN)).collect()
}

/// Fails the test if the numbers differ by more than a share of the wanted number.
#[track_caller]
pub(crate) fn near(found: f64, wanted: f64, share: f64) {
    assert!((found - wanted).abs() <= share * wanted.abs(), "{found}, not {wanted}");
}

/// A grid of `points` drive frequencies from 60 Hz, a tenth of a hertz apart.
pub(crate) fn frequencies(points: u64) -> String {
    let last = 600 + points - 1;
    let range = format!("{{ from = 60, to = {}.{}, step = 0.1 }}", last / 10, last % 10);
    format!("preset = \"ozaki2018-large\"\n\n[axes]\ndrive_frequency = {range}\n")
}

/// A grid with `points` points that take little time: each point runs for one drive period, and no point settles.
pub(crate) fn quick(points: u64) -> String {
    frequencies(points) + "\n[solver]\nrtol = 1e-3\nsettle_tol = 1e-3\nmax_cycles = 1\n"
}

/// The text of [`WINGS`] as a literal, which `concat!` requires.
macro_rules! wings {
    () => {
        "[[vehicle.wings]]\nname = \"left\"\nposition = [0, \"2 mm\", 0]\n\
         [[vehicle.wings]]\nname = \"right\"\nposition = [0, \"2 mm\", 0]\nmirrored = true\n"
    };
}

/// Two wings of a vehicle, the right wing a mirror image of the left.
pub(crate) const WINGS: &str = wings!();

/// A grid with one point: a vehicle with [`WINGS`].
pub(crate) const VEHICLE: &str = concat!(
    "preset = \"jafferis2016\"\n[vehicle]\nabout = [0, 0, \"-3 mm\"]\ntotal_mass = \"85 mg\"\n",
    wings!()
);

/// Starts `flap` and does not wait for its end. SIGINT ends `flap`, even if the parent process of the tests ignores
/// SIGINT.
pub(crate) fn start(folder: &Folder, arguments: &[&str]) -> Child {
    let mut command = command(folder, arguments);
    #[cfg(unix)]
    set_interrupt(&mut command, libc::SIG_DFL);
    command.spawn().unwrap()
}

/// Starts `flap sweep --grid grid.toml`, and waits until more than `rows` lines are in `grid.csv`.
pub(crate) fn sweep_until(folder: &Folder, rows: usize) -> Child {
    let child = start(folder, &["sweep", "--grid", "grid.toml"]);
    wait_for_rows(folder, rows);
    child
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

/// Sets the action of SIGINT at the start of the command.
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

/// The exit code; `None` if the command was killed. Fails the test if the command does not end.
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
