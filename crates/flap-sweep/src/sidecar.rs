//! The file beside the results that says where they come from: `<results>.meta.toml`.
//!
//! It is written when a sweep starts, with `state = "running"`, and again when it ends. Each time it is replaced
//! as a whole, so that a reader never sees half of it.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use flap_core::parameter::Parameter;
use flap_core::simulate::SolverSettings;
use serde::Serialize;
use toml::Value;

use crate::layout::Layout;
use crate::plan::Plan;
use crate::run::{RunOptions, Summary};
use crate::text;

/// What the caller knows about a sweep that is about to start.
#[derive(Clone, Debug)]
pub struct Start {
    /// Start of the sweep, as RFC 3339 in UTC.
    pub started: String,
    /// How the plan is run.
    pub options: RunOptions,
}

/// What the caller knows about a sweep that has ended.
#[derive(Clone, Debug)]
pub struct End {
    /// End of the sweep, as RFC 3339 in UTC.
    pub finished: String,
    /// Seconds from start to end.
    pub seconds: f64,
}

/// The contents of the file.
#[derive(Clone, Debug, Serialize)]
pub struct Sidecar {
    flap: &'static str,
    state: &'static str,
    error: Option<String>,
    model: &'static str,
    preset: &'static str,
    points: u64,
    rows: Option<u64>,
    excluded: Option<u64>,
    started: String,
    finished: Option<String>,
    seconds: Option<f64>,
    threads: usize,
    arithmetic: &'static str,
    instructions: &'static str,
    cycles: Option<u64>,
    rhs_evals: Option<u64>,
    statuses: Option<BTreeMap<&'static str, u64>>,
    /// For each condition, how many points do not satisfy it.
    unsatisfied: BTreeMap<String, u64>,
    solver: Solver,
    parameters: BTreeMap<&'static str, Value>,
    varied: Vec<Varied>,
    columns: Vec<Column>,
    invalid: Vec<InvalidPoint>,
    points_file: Option<PointsFile>,
    grid: Grid,
}

#[derive(Clone, Debug, Serialize)]
struct Solver {
    rtol: f64,
    atol: f64,
    settle_tol: f64,
    max_cycles: u32,
    max_steps: u32,
    newton: bool,
}

#[derive(Clone, Debug, Serialize)]
struct Varied {
    name: &'static str,
    unit: &'static str,
}

#[derive(Clone, Debug, Serialize)]
struct Column {
    name: String,
    unit: &'static str,
}

#[derive(Clone, Debug, Serialize)]
struct InvalidPoint {
    point: u64,
    reason: String,
}

#[derive(Clone, Debug, Serialize)]
struct PointsFile {
    path: String,
    xxh3: String,
}

#[derive(Clone, Debug, Serialize)]
struct Grid {
    name: String,
    xxh3: String,
    text: String,
}

impl Sidecar {
    /// The contents for a sweep of `plan` that is about to start.
    pub fn new(plan: &Plan, start: Start) -> Sidecar {
        let layout = Layout::of(plan);
        Sidecar {
            flap: env!("CARGO_PKG_VERSION"),
            state: "running",
            error: None,
            model: plan.simulator.name(),
            preset: plan.preset,
            points: plan.len(),
            rows: None,
            excluded: None,
            started: start.started,
            finished: None,
            seconds: None,
            threads: start.options.threads.get(),
            arithmetic: start.options.instructions.arithmetic().name(),
            instructions: start.options.instructions.name(),
            cycles: None,
            rhs_evals: None,
            statuses: None,
            unsatisfied: BTreeMap::new(),
            solver: Solver::from(&plan.solver),
            parameters: parameters(plan),
            varied: layout.varied.iter().map(|(_, p)| Varied { name: p.name, unit: p.unit }).collect(),
            columns: layout.measures.into_iter().map(|m| Column { name: m.name, unit: m.unit }).collect(),
            invalid: Vec::new(),
            points_file: plan.points_file.as_ref().map(|file| PointsFile {
                path: file.path.display().to_string(),
                xxh3: format!("{:016x}", file.xxh3),
            }),
            grid: Grid {
                name: plan.source.name.clone(),
                xxh3: format!("{:016x}", xxhash_rust::xxh3::xxh3_64(plan.source.text.as_bytes())),
                text: plan.source.text.clone(),
            },
        }
    }

    /// Notes how the sweep ended.
    pub fn finish(&mut self, summary: &Summary, end: End) {
        self.state = if summary.interrupted { "interrupted" } else { "complete" };
        self.rows = Some(summary.rows);
        self.excluded = Some(summary.excluded);
        self.finished = Some(end.finished);
        self.seconds = Some(end.seconds);
        self.cycles = Some(summary.cycles);
        self.rhs_evals = Some(summary.rhs_evals);
        self.statuses = Some(summary.counts.iter().map(|(status, count)| (status.name(), count)).collect());
        self.unsatisfied = summary.unsatisfied.iter().cloned().collect();
        let invalid =
            |(point, reason): &(u64, String)| InvalidPoint { point: *point, reason: reason.clone() };
        self.invalid = summary.invalid.iter().map(invalid).collect();
    }

    /// Notes that the sweep failed.
    pub fn fail(&mut self, error: String, end: End) {
        self.state = "failed";
        self.error = Some(error);
        self.finished = Some(end.finished);
        self.seconds = Some(end.seconds);
    }

    /// The text of the file.
    ///
    /// # Errors
    /// If a number has no place in TOML, such as 2^63 points.
    pub fn text(&self) -> Result<String, toml::ser::Error> {
        toml::to_string(self)
    }

    /// Writes the file, in place of an earlier one.
    ///
    /// # Errors
    /// What writing says.
    pub fn write(&self, path: &Path) -> io::Result<()> {
        let text = self.text().map_err(io::Error::other)?;
        let mut temporary = path.as_os_str().to_owned();
        temporary.push(".tmp");
        let temporary = PathBuf::from(temporary);
        let mut file = File::create(&temporary)?;
        file.write_all(text.as_bytes())?;
        file.sync_all()?;
        fs::rename(&temporary, path)
    }
}

/// The path of the file that belongs to a result file.
pub fn path_of(results: &Path) -> PathBuf {
    let mut path = results.as_os_str().to_owned();
    path.push(".meta.toml");
    PathBuf::from(path)
}

impl From<&SolverSettings> for Solver {
    fn from(settings: &SolverSettings) -> Solver {
        let SolverSettings { rtol, atol, settle_tol, max_cycles, max_steps, newton } = *settings;
        Solver { rtol, atol, settle_tol, max_cycles, max_steps, newton }
    }
}

/// The parameters before the axes are applied, without those that follow others.
fn parameters(plan: &Plan) -> BTreeMap<&'static str, Value> {
    let value = |parameter: &Parameter, value: f64| match text::option(parameter, value) {
        Some(option) => Value::String(option.to_owned()),
        None => Value::Float(value),
    };
    let set = plan.parameters().iter().zip(&plan.base).filter(|(_, base)| !base.is_nan());
    set.map(|(parameter, &base)| (parameter.name, value(parameter, base))).collect()
}
