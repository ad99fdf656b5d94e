//! The contents of a sidecar.

use std::collections::BTreeMap;

use flap_core::simulate::SolverSettings;
use serde::{Deserialize, Serialize};
use toml::Value;

use crate::files::results::Checksums;
use crate::files::tallies::InvalidPoint;
use crate::notation::text;
use crate::plan::selection::{self, Selection};
use crate::run::Doubts;
use crate::run::identity::{self, Identity};
use crate::run::solver::SolverFields;

/// The contents of a sidecar.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sidecar {
    /// Version of flap.
    pub flap: String,
    /// Build of flap, as [`identity::build`](crate::run::identity::build) gives it; empty in files of early versions.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub build: String,
    /// State of the sweep.
    pub state: State,
    /// Reason of a failure.
    pub error: Option<String>,
    /// Name of the model.
    pub model: String,
    /// Name of the preset.
    pub preset: String,
    /// Number of points of the grid.
    pub points: u64,
    /// The shard that is run, such as `2/3`; `None` for all points.
    pub shard: Option<String>,
    /// Number of rows written.
    pub rows: Option<u64>,
    /// Number of points that conditions exclude.
    pub excluded: Option<u64>,
    /// Start of the first session, as RFC 3339 in UTC.
    pub started: String,
    /// End of the last session, as RFC 3339 in UTC.
    pub finished: Option<String>,
    /// Running time of all sessions (s).
    pub seconds: Option<f64>,
    /// Number of worker threads.
    pub threads: usize,
    /// Class of arithmetic.
    pub arithmetic: String,
    /// Instructions of the lanes.
    pub instructions: String,
    /// Number of drive periods integrated.
    pub cycles: Option<u64>,
    /// Number of evaluations of right-hand sides.
    pub rhs_evals: Option<u64>,
    /// Number of rows by status.
    pub statuses: Option<BTreeMap<String, u64>>,
    /// Rows to be read with care.
    pub doubts: Option<Doubts>,
    /// Number of points that do not satisfy each condition.
    #[serde(default)]
    pub unsatisfied: BTreeMap<String, u64>,
    /// Solver settings.
    #[serde(with = "SolverFields")]
    pub solver: SolverSettings,
    /// The points of a rerun.
    pub rerun: Option<Rerun>,
    /// The parameter that is followed, if the points are designs with a curve of rows each.
    #[serde(default)]
    pub followed: Option<Followed>,
    /// The parameters before the axes are applied, without those that follow others.
    pub(super) parameters: BTreeMap<String, Value>,
    /// The parameters that are varied.
    pub(super) varied: Vec<Unit>,
    /// The measures in the rows.
    pub(super) columns: Vec<Unit>,
    /// The first few invalid points.
    #[serde(default)]
    pub invalid: Vec<InvalidPoint>,
    /// The file that lists the points of the sample, if one does.
    pub points_file: Option<PointsFile>,
    /// The grid file.
    pub grid: Grid,
    /// The devices that the grid begins with: its own, then those that this one begins with.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub devices: Vec<Grid>,
    /// Checksums of complete results; `None` before, and in files of early versions.
    pub checksums: Option<Checksums>,
}

/// State of a sweep.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum State {
    /// Running, or killed while it was.
    Running,
    /// Every row is written.
    Complete,
    /// Stopped before the end.
    Interrupted,
    /// Failed before the end.
    Failed,
}

/// The earlier results that the points of a rerun are taken from.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Origin {
    /// The result file.
    pub of: String,
    /// The statuses of the points there.
    pub statuses: Vec<String>,
}

/// The points of a rerun.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Rerun {
    /// The earlier results.
    #[serde(flatten)]
    pub origin: Origin,
    /// The indices of the points, such as `3,17,20-31`.
    pub points: String,
}

/// The parameter that rises and falls in a response, see [`Along`](crate::plan::Along).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Followed {
    /// Its name.
    pub parameter: String,
    /// Its values, rising.
    pub values: Vec<f64>,
    /// Largest error of the ends of bistable bands.
    pub tolerance: f64,
    /// True if the unstable orbits of bistable bands are looked for.
    pub unstable: bool,
    /// The text of [`Identity::followed`].
    pub identity: String,
}

/// A column and its unit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Unit {
    name: String,
    unit: String,
}

impl Unit {
    pub(super) fn new(name: &str, unit: &str) -> Unit {
        Unit { name: name.to_owned(), unit: unit.to_owned() }
    }
}

/// A file that lists the points of a sample.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct PointsFile {
    /// Its path, from the working directory.
    pub path: String,
    /// XXH3 of its text.
    pub xxh3: String,
}

/// A grid file or a device.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Grid {
    /// Its name.
    pub name: String,
    /// XXH3 of its text.
    pub xxh3: String,
    /// Its text.
    pub text: String,
}

impl Sidecar {
    /// The identity of the rows that this file describes.
    pub fn identity(&self) -> Identity {
        let list = |points: &str| selection::read_list(points, self.points).unwrap_or_default();
        let selection = match (&self.shard, &self.rerun) {
            (Some(shard), _) => format!("shard {shard}"),
            (None, Some(rerun)) => Selection::Listed(list(&rerun.points)).to_string(),
            (None, None) => Selection::All.to_string(),
        };
        Identity {
            flap: self.flap.clone(),
            build: self.build.clone(),
            arithmetic: self.arithmetic.clone(),
            grid: text::hash(&self.grid.text),
            devices: identity::devices(self.devices.iter().map(|device| device.text.as_str())),
            points_file: self.points_file.as_ref().map(|file| file.xxh3.clone()),
            selection,
            followed: self.followed.as_ref().map(|followed| followed.identity.clone()),
            solver: self.solver,
        }
    }

    /// The earlier results that the points are taken from, if these are the results of a rerun.
    pub fn origin(&self) -> Option<&Origin> {
        self.rerun.as_ref().map(|rerun| &rerun.origin)
    }
}
