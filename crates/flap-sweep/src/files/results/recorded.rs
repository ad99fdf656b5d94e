//! The metadata of a Parquet file, read back.

use std::collections::BTreeMap;

use flap_core::simulate::Simulator;

use super::provenance::{Device, Devices};
use crate::grid;
use crate::plan::{self, Plan};
use crate::run::solver::SolverTable;

/// The entries that [`Provenance`](super::Provenance) writes, by their keys.
#[derive(Clone, Debug)]
pub struct Recorded<'a>(BTreeMap<&'a str, &'a str>);

impl<'a> Recorded<'a> {
    /// The entries of a file, if flap has written them.
    pub fn of(entries: &'a [(String, String)]) -> Option<Recorded<'a>> {
        let entries: BTreeMap<&str, &str> =
            entries.iter().map(|(key, text)| (key.as_str(), text.as_str())).collect();
        entries.contains_key("flap").then_some(Recorded(entries))
    }

    /// The unit of each column that has one.
    pub fn units(&self) -> BTreeMap<String, String> {
        toml::from_str(self.text("flap.units")).unwrap_or_default()
    }

    /// The plan of these rows, which may be only some of its points. `None` if the grid file is of another version of flap, its
    /// devices were not recorded, or a file of points has moved or changed.
    pub fn plan(&self, models: &[&'static dyn Simulator]) -> Option<Plan> {
        let Devices { device } = toml::from_str(self.text("flap.devices")).ok()?;
        let devices: Vec<plan::Source> =
            device.into_iter().map(|Device { name, text }| plan::Source { name, text }).collect();
        // Devices were named from the folder of the grid file, which is that of the name here.
        let plan = grid::parse_recorded("grid", self.text("flap.grid"), &devices, models).ok()?;
        let SolverTable(solver) = toml::from_str(self.text("flap.solver")).ok()?;
        let plan = plan.with_solver(solver).ok()?;
        let points = plan.points_file().map(plan::PointsFile::hash);
        (points.as_deref() == self.0.get("flap.points_file").copied()).then_some(plan)
    }

    /// The entry `key`, such as `flap.build`; empty if there is none, as in files of early versions.
    pub fn text(&self, key: &str) -> &'a str {
        self.0.get(key).copied().unwrap_or_default()
    }
}
