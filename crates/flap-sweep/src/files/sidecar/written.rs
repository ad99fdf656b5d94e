//! The sidecar of a sweep that runs here.

use std::collections::BTreeMap;

use super::contents::Unit;
use super::{Followed, Grid, Origin, PointsFile, Rerun, Sidecar, State};
use crate::files::results::parameters;
use crate::files::tallies;
use crate::notation::text;
use crate::plan::selection::{self, Selection};
use crate::plan::{Along, Plan, Source};
use crate::run::identity::{self, Identity};
use crate::run::{RunOptions, Summary};
use crate::table::layout::Layout;

/// The start of a sweep.
#[derive(Clone, Debug)]
pub struct Start {
    /// Start of the sweep, as RFC 3339 in UTC.
    pub started: String,
    /// Options of the run.
    pub options: RunOptions,
    /// The earlier results that the points of a rerun are taken from.
    pub rerun: Option<Origin>,
}

/// The end of a sweep.
#[derive(Clone, Debug)]
pub struct End {
    /// End of the sweep, as RFC 3339 in UTC.
    pub finished: String,
    /// Running time (s).
    pub seconds: f64,
}

impl Sidecar {
    /// The contents for a sweep of `plan` that is about to start.
    pub fn new(plan: &Plan, start: Start) -> Sidecar {
        let layout = Layout::of(plan);
        let shard = match plan.selection() {
            Selection::Shard(shard) => Some(shard.to_string()),
            Selection::All | Selection::Listed(_) => None,
        };
        let rerun = match (plan.selection(), start.rerun) {
            (Selection::Listed(list), origin) => {
                Some(Rerun { origin: origin.unwrap_or_default(), points: selection::list_text(list) })
            }
            _ => None,
        };
        Sidecar {
            flap: env!("CARGO_PKG_VERSION").to_owned(),
            build: identity::build().to_owned(),
            state: State::Running,
            error: None,
            model: plan.simulator().name().to_owned(),
            preset: plan.preset().to_owned(),
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
            solver: *plan.solver(),
            rerun,
            followed: followed(plan, &start.options),
            parameters: parameters(plan),
            varied: layout.varied.iter().map(|(_, p)| Unit::new(p.name, p.unit)).collect(),
            columns: layout.measures().map(|m| Unit::new(&m.column.name, &m.column.unit)).collect(),
            invalid: Vec::new(),
            points_file: plan
                .points_file()
                .map(|file| PointsFile { path: file.path.display().to_string(), xxh3: file.hash() }),
            grid: recorded(plan.source()),
            devices: plan.devices().iter().map(recorded).collect(),
            checksums: None,
        }
    }

    /// Records the end of the sweep, complete or interrupted.
    pub fn finish(&mut self, summary: &Summary, end: End) {
        self.state = if summary.interrupted { State::Interrupted } else { State::Complete };
        self.rows = Some(summary.rows);
        self.excluded = Some(summary.excluded);
        self.finished = Some(end.finished);
        self.seconds = Some(end.seconds);
        self.cycles = Some(summary.cycles);
        self.rhs_evals = Some(summary.rhs_evals);
        self.statuses = Some(tallies::by_name(&summary.counts));
        self.doubts = Some(summary.doubts);
        self.unsatisfied = summary.unsatisfied.iter().cloned().collect();
        self.invalid = summary.invalid.iter().map(From::from).collect();
    }

    /// Records that the sweep failed with `error`.
    pub fn fail(&mut self, error: String, end: End) {
        self.state = State::Failed;
        self.error = Some(error);
        self.finished = Some(end.finished);
        self.seconds = Some(end.seconds);
    }
}

/// A grid file or a device as a sidecar records it.
fn recorded(source: &Source) -> Grid {
    let Source { name, text } = source;
    Grid { name: name.clone(), xxh3: text::hash(text), text: text.clone() }
}

/// The parameter that a plan follows.
fn followed(plan: &Plan, options: &RunOptions) -> Option<Followed> {
    let Along { parameter, values, tolerance, unstable } = plan.followed()?.clone();
    let parameter = plan.parameters()[parameter].name.to_owned();
    let identity = Identity::of(plan, options).followed?;
    Some(Followed { parameter, values, tolerance, unstable, identity })
}
