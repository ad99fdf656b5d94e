//! Files that a command reads. The command must not write to its input files.

use std::path::{Path, PathBuf};

use crate::files::beside;
use crate::files::disk;
use crate::files::replacement;
use crate::plan::Plan;

/// Files that a command reads.
#[derive(Clone, Debug, Default)]
pub struct Inputs {
    files: Vec<(&'static str, PathBuf)>,
}

/// Error if an output file is also an input file of the same command.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("writing {} would overwrite {what} {}: choose another name", output.display(), input.display())]
pub struct Overlap {
    /// Output file.
    pub output: PathBuf,
    /// Words that describe the input file in the error message, such as "the grid file".
    pub what: &'static str,
    /// Input file.
    pub input: PathBuf,
}

impl Inputs {
    /// Returns an empty set.
    pub fn new() -> Inputs {
        Inputs::default()
    }

    /// Adds an input file. `what` describes the file in messages, for example "the grid file".
    pub fn add(&mut self, what: &'static str, path: &Path) -> &mut Inputs {
        self.files.push((what, path.to_owned()));
        self
    }

    /// Adds a result file to the input files, together with the files beside the result file, such as the
    /// sidecar.
    pub fn add_results(&mut self, what: &'static str, path: &Path) -> &mut Inputs {
        self.add(what, path);
        for beside in beside::all_of(path) {
            self.add("the file beside the results", &beside);
        }
        self
    }

    /// Adds the files from which `plan` was read to the input files: the grid file, the devices and the file
    /// of points.
    pub fn add_plan(&mut self, plan: &Plan) -> &mut Inputs {
        // The plan of a preset has the preset's name and no file.
        if plan.source().name != plan.preset() {
            self.add("the grid file", Path::new(&plan.source().name));
        }
        for device in plan.devices() {
            self.add("a device", Path::new(&device.name));
        }
        if let Some(points) = plan.points_file() {
            self.add("the file of points", &points.path);
        }
        self
    }

    /// Checks that a job with the result file `output` overwrites no input file. The function applies
    /// [`Inputs::protect`] to `output`, to the path of new results that will replace `output`, and to the
    /// files beside these two paths.
    ///
    /// # Errors
    /// Returns an [`Overlap`] with the first input file that would be overwritten.
    pub fn protect_from_results(&self, output: &Path) -> Result<(), Overlap> {
        for results in [output.to_owned(), replacement::of(output)] {
            self.protect(&results)?;
            beside::all_of(&results).iter().try_for_each(|path| self.protect(path))?;
        }
        Ok(())
    }

    /// Checks that `output` is not an input file, even if the path has a different spelling or is a link to
    /// an input file.
    ///
    /// # Errors
    /// Returns an [`Overlap`] with the first input file that would be overwritten.
    pub fn protect(&self, output: &Path) -> Result<(), Overlap> {
        match self.files.iter().find(|(_, input)| disk::is_same_file(output, input)) {
            None => Ok(()),
            Some((what, input)) => Err(Overlap { output: output.to_owned(), what, input: input.clone() }),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::fs;
    use temp_dir::TempDir;

    use super::*;

    #[test]
    #[cfg(unix)]
    fn files_are_recognised_by_any_name() {
        let folder = TempDir::new().unwrap();
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
        let folder = TempDir::new().unwrap();
        let path = |name: &str| folder.path().join(name);
        let written =
            [".csv.meta.toml", ".csv.journal", ".csv.part", ".csv.lock", ".new.csv", ".new.csv.meta.toml"];
        for (number, ending) in written.iter().enumerate() {
            let (results, input) = (format!("{number}.csv"), path(&format!("{number}{ending}")));
            fs::write(&input, "text").unwrap();
            let mut inputs = Inputs::new();
            inputs.add("the grid file", &input);
            let overlap = inputs.protect_from_results(&path(&results)).unwrap_err();
            assert_eq!(overlap.output, input);
        }
    }
}
