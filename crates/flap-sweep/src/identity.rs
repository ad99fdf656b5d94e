//! What decides the bytes of rows: rows of the same identity may stand in one file.

use serde::{Deserialize, Serialize};

use crate::plan::{Plan, PointsFile};
use crate::run::RunOptions;
use crate::selection::{self, Selection};
use crate::sidecar::{Sidecar, Solver, grid_hash};

/// All that decides the bytes of the rows of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Identity {
    /// Version of flap.
    pub flap: String,
    /// Class of arithmetic.
    pub arithmetic: String,
    /// Hash of the grid file's text.
    pub grid: String,
    /// Hash of the file that lists the points of the sample, if one does.
    pub points_file: Option<String>,
    /// Which points are run, in words.
    pub selection: String,
    /// How they are integrated.
    pub solver: Solver,
}

impl Identity {
    /// What a run of `plan` is.
    pub fn of(plan: &Plan, options: &RunOptions) -> Identity {
        Identity {
            flap: env!("CARGO_PKG_VERSION").to_owned(),
            arithmetic: options.instructions.arithmetic().name().to_owned(),
            grid: grid_hash(&plan.source.text),
            points_file: plan.points_file.as_ref().map(PointsFile::hash),
            selection: plan.selection.to_string(),
            solver: Solver::from(&plan.solver),
        }
    }

    /// What the rows are that `sidecar` tells of.
    pub fn recorded(sidecar: &Sidecar) -> Identity {
        let list = |points: &str| selection::read_list(points, sidecar.points).unwrap_or_default();
        let selection = match (&sidecar.shard, &sidecar.rerun) {
            (Some(shard), _) => format!("shard {shard}"),
            (None, Some(rerun)) => Selection::Listed(list(&rerun.points)).to_string(),
            (None, None) => Selection::All.to_string(),
        };
        Identity {
            flap: sidecar.flap.clone(),
            arithmetic: sidecar.arithmetic.clone(),
            grid: grid_hash(&sidecar.grid.text),
            points_file: sidecar.points_file.as_ref().map(|file| file.xxh3.clone()),
            selection,
            solver: sidecar.solver,
        }
    }

    /// What is different in `other`, in words; nothing if the rows are the same.
    pub fn differences(&self, other: &Identity) -> Vec<String> {
        let mut differences = Vec::new();
        if self.grid != other.grid {
            differences.push("the grid file is another".to_owned());
        }
        if self.points_file != other.points_file {
            differences.push("the file of points is another".to_owned());
        }
        if self.solver != other.solver {
            differences.push("the solver settings are others".to_owned());
        }
        let mut compare = |what: &str, own: &str, others: &str| {
            if own != others {
                differences.push(format!("{what} {own}, not {others}"));
            }
        };
        compare("the rows are of", &self.selection, &other.selection);
        compare("the rows are by flap", &self.flap, &other.flap);
        compare("the arithmetic is", &self.arithmetic, &other.arithmetic);
        differences
    }
}
