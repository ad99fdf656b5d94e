//! The file beside the results that says where they come from: `<results>.meta.toml`.
//!
//! It is written when a sweep starts, with `state = "running"`, and again when it ends. Each time it is replaced
//! as a whole, so that a reader never sees half of it. It holds all that it takes to run the sweep again, and to check the
//! results. Its first line is the checksum of the others.

mod file;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

pub use file::{ParseError, ReadError};
use flap_core::parameter::Parameter;
use flap_core::simulate::{Simulator, SolverSettings};
use serde::{Deserialize, Serialize};
use toml::Value;

use crate::files::results::Checksums;
use crate::grid;
use crate::grid::diagnostic::Mistakes;
use crate::notation::text;
use crate::plan::selection::{self, Selection};
use crate::plan::{self, Plan};
use crate::run::identity::{self, Identity, Solver};
use crate::run::{Doubts, RunOptions, Summary};
use crate::table::layout::Layout;

/// What the caller knows about a sweep that is about to start.
#[derive(Clone, Debug)]
pub struct Start {
    /// Start of the sweep, as RFC 3339 in UTC.
    pub started: String,
    /// How the plan is run.
    pub options: RunOptions,
    /// Where the points of a plan that lists them come from.
    pub rerun: Option<Origin>,
}

/// What the caller knows about a sweep that has ended.
#[derive(Clone, Debug)]
pub struct End {
    /// End of the sweep, as RFC 3339 in UTC.
    pub finished: String,
    /// Seconds that it ran.
    pub seconds: f64,
}

/// The contents of the file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sidecar {
    /// Version of flap.
    pub flap: String,
    /// Build of flap, as [`identity::build`] gives it; empty if an earlier flap has not recorded it.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub build: String,
    /// How far the sweep is.
    pub state: State,
    /// Why it failed.
    pub error: Option<String>,
    /// The model.
    pub model: String,
    /// The preset.
    pub preset: String,
    /// Points of the grid.
    pub points: u64,
    /// Which of them are run, such as `2/3`; `None` for all.
    pub shard: Option<String>,
    /// Rows written.
    pub rows: Option<u64>,
    /// Points that conditions exclude.
    pub excluded: Option<u64>,
    /// Start, as RFC 3339 in UTC; of the first session if it was interrupted.
    pub started: String,
    /// End, as RFC 3339 in UTC.
    pub finished: Option<String>,
    /// Seconds that it ran, in all sessions.
    pub seconds: Option<f64>,
    /// Worker threads.
    pub threads: usize,
    /// Class of arithmetic.
    pub arithmetic: String,
    /// Instructions of the lanes.
    pub instructions: String,
    /// Drive periods integrated in all.
    pub cycles: Option<u64>,
    /// Right-hand sides evaluated in all.
    pub rhs_evals: Option<u64>,
    /// Rows by status.
    pub statuses: Option<BTreeMap<String, u64>>,
    /// Rows to be read with care.
    pub doubts: Option<Doubts>,
    /// For each condition, how many points do not satisfy it.
    #[serde(default)]
    pub unsatisfied: BTreeMap<String, u64>,
    /// How points were integrated.
    pub solver: Solver,
    /// The points of a rerun.
    pub rerun: Option<Rerun>,
    parameters: BTreeMap<String, Value>,
    varied: Vec<Unit>,
    columns: Vec<Unit>,
    /// The first few invalid points.
    #[serde(default)]
    pub invalid: Vec<InvalidPoint>,
    /// The file that lists the points of the sample, if one does.
    pub points_file: Option<PointsFile>,
    /// The grid file.
    pub grid: Grid,
    /// What complete results hold; `None` before, and of results by an earlier flap.
    pub checksums: Option<Checksums>,
}

/// How far a sweep is.
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

/// Where the points of a rerun come from.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Origin {
    /// The results whose points they are.
    pub of: String,
    /// The statuses they had there.
    pub statuses: Vec<String>,
}

/// The points of a rerun.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Rerun {
    /// The results whose points they are.
    pub of: String,
    /// The statuses they had there.
    pub statuses: Vec<String>,
    /// Their indices, such as `3,17,20-31`.
    pub points: String,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Unit {
    name: String,
    unit: String,
}

/// A point whose parameters are impossible together.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct InvalidPoint {
    /// Its index.
    pub point: u64,
    /// Why.
    pub reason: String,
}

/// A file that lists the points of a sample.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct PointsFile {
    /// Its path, from the working directory.
    pub path: String,
    /// XXH3 of its text.
    pub xxh3: String,
}

/// A grid file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Grid {
    /// Its name.
    pub name: String,
    /// XXH3 of its text.
    pub xxh3: String,
    /// Its text.
    pub text: String,
}

/// Why a sidecar is not a plan.
#[derive(Debug)]
pub enum PlanError {
    /// The grid file in it has mistakes for this version of flap.
    Grid(Mistakes),
    /// The grid file in it is not the one that was run: its hash is another.
    GridText,
    /// The points in it are not points of the grid.
    Points,
    /// The solver settings in it are not ones that a grid file may have.
    Solver,
    /// The file of points has changed.
    PointsFile,
}

impl Sidecar {
    /// The contents for a sweep of `plan` that is about to start.
    pub fn new(plan: &Plan, start: Start) -> Sidecar {
        let layout = Layout::of(plan);
        let unit = |name: &str, unit: &str| Unit { name: name.to_owned(), unit: unit.to_owned() };
        let shard = match plan.selection {
            Selection::Shard(shard) => Some(shard.to_string()),
            Selection::All | Selection::Listed(_) => None,
        };
        let rerun = match (&plan.selection, start.rerun) {
            (Selection::Listed(list), origin) => {
                let Origin { of, statuses } =
                    origin.unwrap_or(Origin { of: String::new(), statuses: vec![] });
                Some(Rerun { of, statuses, points: selection::list_text(list) })
            }
            _ => None,
        };
        Sidecar {
            flap: env!("CARGO_PKG_VERSION").to_owned(),
            build: identity::build().to_owned(),
            state: State::Running,
            error: None,
            model: plan.simulator.name().to_owned(),
            preset: plan.preset.to_owned(),
            points: plan.len(),
            shard,
            rows: None,
            excluded: None,
            started: start.started,
            finished: None,
            seconds: None,
            threads: start.options.threads.get(),
            arithmetic: start.options.instructions.arithmetic().name().to_owned(),
            instructions: start.options.instructions.name().to_owned(),
            cycles: None,
            rhs_evals: None,
            statuses: None,
            doubts: None,
            unsatisfied: BTreeMap::new(),
            solver: Solver::from(&plan.solver),
            rerun,
            parameters: parameters(plan),
            varied: layout.varied.iter().map(|(_, p)| unit(p.name, p.unit)).collect(),
            columns: layout.measures.iter().map(|m| unit(&m.name, m.unit)).collect(),
            invalid: Vec::new(),
            points_file: plan
                .points_file
                .as_ref()
                .map(|file| PointsFile { path: file.path.display().to_string(), xxh3: file.hash() }),
            grid: Grid {
                name: plan.source.name.clone(),
                xxh3: text::hash(&plan.source.text),
                text: plan.source.text.clone(),
            },
            checksums: None,
        }
    }

    /// Notes how the sweep ended.
    pub fn finish(&mut self, summary: &Summary, end: End) {
        self.state = if summary.interrupted { State::Interrupted } else { State::Complete };
        self.rows = Some(summary.rows);
        self.excluded = Some(summary.excluded);
        self.finished = Some(end.finished);
        self.seconds = Some(end.seconds);
        self.cycles = Some(summary.cycles);
        self.rhs_evals = Some(summary.rhs_evals);
        let statuses = summary.counts.iter().map(|(status, count)| (status.name().to_owned(), count));
        self.statuses = Some(statuses.collect());
        self.doubts = Some(summary.doubts);
        self.unsatisfied = summary.unsatisfied.iter().cloned().collect();
        let invalid =
            |(point, reason): &(u64, String)| InvalidPoint { point: *point, reason: reason.clone() };
        self.invalid = summary.invalid.iter().map(invalid).collect();
    }

    /// Notes that the sweep failed.
    pub fn fail(&mut self, error: String, end: End) {
        self.state = State::Failed;
        self.error = Some(error);
        self.finished = Some(end.finished);
        self.seconds = Some(end.seconds);
    }

    /// The plan whose rows these are, with the presets of `models`.
    ///
    /// # Errors
    /// If it was written by another version whose grid files differ, or edited.
    pub fn plan(&self, models: &[&'static dyn Simulator]) -> Result<Plan, PlanError> {
        if self.grid.xxh3 != text::hash(&self.grid.text) {
            return Err(PlanError::GridText);
        }
        let mut plan = grid::parse(&self.grid.name, &self.grid.text, models).map_err(PlanError::Grid)?;
        if !is_allowed(&self.solver) {
            return Err(PlanError::Solver);
        }
        plan.solver = SolverSettings::from(&self.solver);
        let points_file = plan.points_file.as_ref();
        if points_file.map(plan::PointsFile::hash) != self.points_file.as_ref().map(|file| file.xxh3.clone())
        {
            return Err(PlanError::PointsFile);
        }
        if let Some(shard) = &self.shard {
            plan.selection = Selection::Shard(shard.parse().map_err(|_| PlanError::Points)?);
        }
        if let Some(rerun) = &self.rerun {
            let list = selection::read_list(&rerun.points, plan.len()).ok_or(PlanError::Points)?;
            plan.selection = Selection::Listed(list);
        }
        Ok(plan)
    }

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
            points_file: self.points_file.as_ref().map(|file| file.xxh3.clone()),
            selection,
            solver: self.solver,
        }
    }

    /// Where the points come from, if they are those of a rerun.
    pub fn origin(&self) -> Option<Origin> {
        let rerun = self.rerun.as_ref()?;
        Some(Origin { of: rerun.of.clone(), statuses: rerun.statuses.clone() })
    }
}

/// The path of the file that belongs to a result file.
pub fn path_of(results: &Path) -> PathBuf {
    let mut path = results.as_os_str().to_owned();
    path.push(".meta.toml");
    PathBuf::from(path)
}

/// True if a grid file may have these settings.
fn is_allowed(solver: &Solver) -> bool {
    let tolerances = [solver.rtol, solver.atol, solver.settle_tol, solver.accuracy];
    let positive = tolerances.iter().all(|tolerance| *tolerance > 0.0);
    positive && solver.rtol < grid::LARGEST_RTOL && solver.max_cycles > 0 && solver.max_steps > 0
}

/// The parameters before the axes are applied, without those that follow others.
pub(crate) fn parameters(plan: &Plan) -> BTreeMap<String, Value> {
    let value = |parameter: &Parameter, value: f64| match text::option(parameter, value) {
        Some(option) => Value::String(option.to_owned()),
        None => Value::Float(value),
    };
    let set = plan.parameters().iter().zip(&plan.base).filter(|(_, base)| !base.is_nan());
    set.map(|(parameter, &base)| (parameter.name.to_owned(), value(parameter, base))).collect()
}
