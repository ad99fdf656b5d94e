//! Writes and reads the origin of rows in the metadata of Parquet files.

use std::collections::BTreeMap;
use std::path::Path;

use flap_core::parameter::Parameter;
use flap_core::simulate::Simulator;
use serde::{Deserialize, Serialize};
use toml::Value;

use crate::grid;
use crate::notation::text;
use crate::plan::{Plan, PointsFile, Source};
use crate::run::identity::Identity;
use crate::table::layout::{Column, Layout};

/// Columns of a result file, and the origin of the rows of this file.
///
/// The origin does not depend on the time, the machine or the number of threads. Two files with equal rows
/// therefore have equal bytes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Provenance {
    /// Columns, from left to right.
    pub columns: Vec<Column>,
    /// Entries of the metadata, as pairs of a key and a text.
    pub entries: Vec<(String, String)>,
}

impl Provenance {
    /// Returns the origin of the rows of `plan`. `identity` contains the version of flap, the build of flap,
    /// and the kind of floating-point arithmetic.
    pub fn of(plan: &Plan, identity: &Identity) -> Provenance {
        let columns = Layout::of(plan).columns();
        let units = columns.iter().filter(|column| !column.unit.is_empty());
        let units: BTreeMap<&str, &str> =
            units.map(|column| (column.name.as_str(), column.unit.as_ref())).collect();
        let mut entries = vec![
            ("flap", identity.flap.clone()),
            ("flap.build", identity.build.clone()),
            ("flap.model", plan.simulator().name().to_owned()),
            ("flap.preset", plan.preset().to_owned()),
            ("flap.arithmetic", identity.arithmetic.clone()),
            ("flap.solver", toml_text(&plan.solver())),
            ("flap.parameters", toml_text(&parameters(plan))),
            ("flap.units", toml_text(&units)),
            ("flap.grid", plan.source().text.clone()),
        ];
        let devices = devices(plan);
        if !devices.device.is_empty() {
            entries.push(("flap.devices", toml_text(&devices)));
        }
        entries.extend(plan.points_file().map(|file| ("flap.points_file", file.hash())));
        entries.extend(identity.followed.clone().map(|followed| ("flap.followed", followed)));
        let entries = entries.into_iter().map(|(key, text)| (key.to_owned(), text)).collect();
        Provenance { columns, entries }
    }
}

/// Devices of a grid, as `[[device]]` tables.
#[derive(Debug, Default, Serialize, Deserialize)]
struct Devices {
    /// Devices of the grid. The paths of the devices are relative to the folder of the grid file. The same
    /// grid in a different folder therefore gives the same result file.
    #[serde(default)]
    device: Vec<Source>,
}

fn devices(plan: &Plan) -> Devices {
    let folder = Path::new(&plan.source().name).parent().unwrap_or(Path::new(""));
    let device = plan.devices().iter().map(|Source { name, text }| {
        let path = Path::new(name);
        let name = path.strip_prefix(folder).unwrap_or(path).display().to_string();
        Source { name, text: text.clone() }
    });
    Devices { device: device.collect() }
}

/// Returns the value that each parameter has if no axis varies this parameter. Parameters without a fixed
/// value, such as computed parameters, are left out.
pub(crate) fn parameters(plan: &Plan) -> BTreeMap<String, Value> {
    let value = |parameter: &Parameter, value: f64| match text::option(parameter, value) {
        Some(option) => Value::String(option.to_owned()),
        None => Value::Float(value),
    };
    let base = plan.parameters().iter().zip(plan.base());
    let set = base.filter_map(|(parameter, base)| Some((parameter, base.given()?)));
    set.map(|(parameter, base)| (parameter.name.to_owned(), value(parameter, base))).collect()
}

/// Converts `value` into TOML text. The conversion cannot fail, because `value` contains only names, numbers
/// and words.
fn toml_text(value: &impl Serialize) -> String {
    toml::to_string(value).unwrap_or_default()
}

/// Entries of the metadata that [`Provenance`] wrote into a file. Each entry has a key.
#[derive(Clone, Debug)]
pub struct Recorded<'a>(BTreeMap<&'a str, &'a str>);

impl<'a> Recorded<'a> {
    /// Returns the entries of the metadata of a file, or `None` if flap did not write the file.
    pub fn of(entries: &'a [(String, String)]) -> Option<Recorded<'a>> {
        let entries: BTreeMap<&str, &str> =
            entries.iter().map(|(key, text)| (key.as_str(), text.as_str())).collect();
        entries.contains_key("flap").then_some(Recorded(entries))
    }

    /// Returns the unit of each column that has a unit.
    pub fn units(&self) -> BTreeMap<String, String> {
        toml::from_str(self.text("flap.units")).unwrap_or_default()
    }

    /// Returns the plan from which the rows were computed. The file may contain rows of only some points of
    /// the plan.
    ///
    /// Returns `None` if this version of flap cannot parse the recorded grid file, or if the file does not
    /// record the devices of the grid. Returns `None` also if a file of points was moved or changed.
    pub fn plan(&self, models: &[&'static dyn Simulator]) -> Option<Plan> {
        let Devices { device } = toml::from_str(self.text("flap.devices")).ok()?;
        // Devices are named relative to the folder of the grid file, which is the folder of this name.
        let plan = grid::parse_recorded("grid", self.text("flap.grid"), &device, models).ok()?;
        let solver = toml::from_str(self.text("flap.solver")).ok()?;
        let plan = plan.with_solver(solver).ok()?;
        let points = plan.points_file().map(PointsFile::hash);
        (points.as_deref() == self.0.get("flap.points_file").copied()).then_some(plan)
    }

    /// Returns the text of the entry `key`, such as `flap.build`. The text is empty if there is no such
    /// entry.
    pub fn text(&self, key: &str) -> &'a str {
        self.0.get(key).copied().unwrap_or_default()
    }
}
