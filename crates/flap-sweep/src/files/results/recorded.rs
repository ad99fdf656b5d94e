//! What a Parquet file says of itself, read back.

use std::collections::BTreeMap;

use flap_core::simulate::{Simulator, SolverSettings};

use crate::grid;
use crate::plan::{self, Plan};
use crate::run::identity::Solver;

/// The entries that [`Provenance`](super::Provenance) writes, by their keys.
#[derive(Clone, Debug)]
pub struct Recorded<'a>(BTreeMap<&'a str, &'a str>);

impl<'a> Recorded<'a> {
    /// What `entries` say, if flap has written them.
    pub fn of(entries: &'a [(String, String)]) -> Option<Recorded<'a>> {
        let entries: BTreeMap<&str, &str> =
            entries.iter().map(|(key, text)| (key.as_str(), text.as_str())).collect();
        entries.contains_key("flap").then_some(Recorded(entries))
    }

    /// The version of flap that made the rows.
    pub fn flap(&self) -> &'a str {
        self.text("flap")
    }

    /// The build of flap that made the rows; empty if an earlier flap has not recorded it.
    pub fn build(&self) -> &'a str {
        self.text("flap.build")
    }

    /// The class of arithmetic of the rows.
    pub fn arithmetic(&self) -> &'a str {
        self.text("flap.arithmetic")
    }

    /// The unit of each column that has one.
    pub fn units(&self) -> BTreeMap<String, String> {
        toml::from_str(self.text("flap.units")).unwrap_or_default()
    }

    /// The plan whose rows these are, whether all of its points are here or some; none if it was written by another version
    /// whose grid files differ, or a file of points is not where it was.
    pub fn plan(&self, models: &[&'static dyn Simulator]) -> Option<Plan> {
        let mut plan = grid::parse("grid", self.text("flap.grid"), models).ok()?;
        let solver: Solver = toml::from_str(self.text("flap.solver")).ok()?;
        plan.solver = SolverSettings::from(&solver);
        let points = plan.points_file.as_ref().map(plan::PointsFile::hash);
        (points.as_deref() == self.0.get("flap.points_file").copied()).then_some(plan)
    }

    fn text(&self, key: &str) -> &'a str {
        self.0.get(key).copied().unwrap_or_default()
    }
}
