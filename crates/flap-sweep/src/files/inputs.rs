//! The files that a command reads, none of which it may write to.

use std::fs;
use std::path::{Path, PathBuf};

use crate::files::journal;
use crate::files::output;
use crate::files::session;
use crate::files::sidecar;
use crate::plan::Plan;

/// The files that a command reads.
#[derive(Clone, Debug, Default)]
pub struct Inputs {
    files: Vec<(&'static str, PathBuf)>,
}

/// A file that was to be written is one that is read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("writing {} would overwrite {what} {}", output.display(), input.display())]
pub struct Overlap {
    /// The file that was to be written.
    pub output: PathBuf,
    /// What the other one is read for.
    pub what: &'static str,
    /// The file that is read.
    pub input: PathBuf,
}

impl Inputs {
    /// No files.
    pub fn new() -> Inputs {
        Inputs::default()
    }

    /// Adds a file that is read; `what` it is, in words such as "the grid file".
    pub fn add(&mut self, what: &'static str, path: &Path) -> &mut Inputs {
        self.files.push((what, path.to_owned()));
        self
    }

    /// Adds results, with what lies beside them.
    pub fn add_results(&mut self, what: &'static str, path: &Path) -> &mut Inputs {
        self.add(what, path);
        for beside in [sidecar::path_of(path), journal::path_of(path), session::part_of(path)] {
            self.add("the companion of results", &beside);
        }
        self
    }

    /// Adds the files that `plan` was read from.
    pub fn add_plan(&mut self, plan: &Plan) -> &mut Inputs {
        // The plan of a preset has the preset's name, and no file.
        if plan.source.name != plan.preset {
            self.add("the grid file", Path::new(&plan.source.name));
        }
        if let Some(points) = &plan.points_file {
            self.add("the file of points", &points.path);
        }
        self
    }

    /// Checks that writing the single file `output` overwrites none of these, under this name or another one: a link, or
    /// another spelling. That goes for the temporary file beside it, too.
    ///
    /// # Errors
    /// [`Overlap`] with the first that it would.
    pub fn protect(&self, output: &Path) -> Result<(), Overlap> {
        self.refuse(output).and_then(|()| self.refuse(&output::temporary_of(output)))
    }

    /// Checks the same of results with what is written beside them.
    ///
    /// # Errors
    /// [`Overlap`] with the first that would be overwritten.
    pub fn protect_from_results(&self, output: &Path) -> Result<(), Overlap> {
        let beside = [sidecar::path_of(output), journal::path_of(output), session::part_of(output)];
        self.protect(output)?;
        beside.iter().try_for_each(|path| self.protect(path))
    }

    fn refuse(&self, output: &Path) -> Result<(), Overlap> {
        match self.files.iter().find(|(_, input)| is_same_file(output, input)) {
            None => Ok(()),
            Some((what, input)) => Err(Overlap { output: output.to_owned(), what, input: input.clone() }),
        }
    }
}

/// Whether both names are of one file. Devices and pipes keep nothing that could be lost.
pub fn is_same_file(a: &Path, b: &Path) -> bool {
    match (fs::metadata(a), fs::metadata(b)) {
        (Ok(of_a), Ok(of_b)) => of_a.is_file() && of_b.is_file() && output::is_same((a, &of_a), (b, &of_b)),
        _ => false,
    }
}

/// Whether two files that are to be written are one, be they there or not.
pub fn is_same_target(a: &Path, b: &Path) -> bool {
    let place = |path: &Path| {
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        Some((fs::canonicalize(folder).ok()?, path.file_name()?.to_owned()))
    };
    a == b || is_same_file(a, b) || place(a).is_some_and(|a| Some(a) == place(b))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[cfg(unix)]
    fn files_are_recognised_by_any_name() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        fs::write(path("grid.toml"), "text").unwrap();
        fs::hard_link(path("grid.toml"), path("hard.csv")).unwrap();
        std::os::unix::fs::symlink("grid.toml", path("soft.csv")).unwrap();
        fs::write(path("other.csv"), "text").unwrap();
        let mut inputs = Inputs::new();
        inputs.add("the grid file", &path("grid.toml"));
        for name in ["grid.toml", "hard.csv", "soft.csv", "./grid.toml"] {
            let overlap = inputs.protect(&path(name)).unwrap_err();
            assert_eq!((overlap.what, overlap.input), ("the grid file", path("grid.toml")), "{name}");
        }
        for name in ["other.csv", "new.csv"] {
            assert_eq!(inputs.protect(&path(name)), Ok(()), "{name}");
        }
    }

    #[test]
    fn what_is_written_beside_results_is_looked_at_too() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        for (number, beside) in
            [".meta.toml", ".journal", ".part", ".tmp", ".meta.toml.tmp"].iter().enumerate()
        {
            let (results, input) = (format!("{number}.csv"), path(&format!("{number}.csv{beside}")));
            fs::write(&input, "text").unwrap();
            let mut inputs = Inputs::new();
            inputs.add("the grid file", &input);
            let overlap = inputs.protect_from_results(&path(&results)).unwrap_err();
            assert_eq!(overlap.output, input);
        }
    }

    #[test]
    fn targets_need_not_be_there() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        assert!(is_same_target(&path("new.csv"), &path("./new.csv")));
        assert!(!is_same_target(&path("new.csv"), &path("newer.csv")));
    }
}
