//! A folder of its own for every test, and the command in it.

use std::fs;
use std::path::PathBuf;

use assert_cmd::Command;
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
            .timeout(std::time::Duration::from_secs(120))
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
