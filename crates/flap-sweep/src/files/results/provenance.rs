//! Where rows come from, as far as it decides them: what Parquet files carry inside.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::files::sidecar;
use crate::plan::Plan;
use crate::run::identity::Identity;
use crate::run::identity::Solver;
use crate::table::layout::{Column, Layout};

/// The columns of a file and where its rows come from.
///
/// Nothing in it depends on when, where or on how many threads a plan is run, so that equal rows are equal files.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Provenance {
    /// The columns, from left to right.
    pub columns: Vec<Column>,
    /// Keys with their texts.
    pub entries: Vec<(String, String)>,
}

impl Provenance {
    /// Where the rows of `plan` come from; `identity` says by which version and arithmetic.
    pub fn of(plan: &Plan, identity: &Identity) -> Provenance {
        let columns = Layout::of(plan).columns();
        let units = columns.iter().filter(|column| !column.unit.is_empty());
        let units: BTreeMap<&str, &str> = units.map(|column| (column.name.as_str(), column.unit)).collect();
        let mut entries = vec![
            ("flap", identity.flap.clone()),
            ("flap.build", identity.build.clone()),
            ("flap.model", plan.simulator.name().to_owned()),
            ("flap.preset", plan.preset.to_owned()),
            ("flap.arithmetic", identity.arithmetic.clone()),
            ("flap.solver", text(&Solver::from(&plan.solver))),
            ("flap.parameters", text(&sidecar::parameters(plan))),
            ("flap.units", text(&units)),
            ("flap.grid", plan.source.text.clone()),
        ];
        entries.extend(plan.points_file.as_ref().map(|file| ("flap.points_file", file.hash())));
        let entries = entries.into_iter().map(|(key, text)| (key.to_owned(), text)).collect();
        Provenance { columns, entries }
    }
}

/// `value` as TOML. Names, numbers and words always have a text.
fn text(value: &impl Serialize) -> String {
    toml::to_string(value).unwrap_or_default()
}
