//! Identity of rows: everything that determines the bytes of rows. Rows with equal identity may be in the same file.

use std::sync::LazyLock;

use flap_core::simulate::SolverSettings;
use serde::{Deserialize, Serialize};
use xxhash_rust::xxh3::xxh3_64;

use super::RunOptions;
use crate::notation::text;
use crate::plan::selection::Selection;
use crate::plan::{Along, Plan, PointsFile, Source};

/// Returns the build of flap: a hash of the sources that determine the bytes of rows, in hexadecimal digits.
///
/// Builds of the same version may compute different rows. Builds of the same sources compute equal rows.
pub fn build() -> &'static str {
    static BUILD: LazyLock<String> = LazyLock::new(|| {
        let sources = [flap_core::SOURCES, env!("FLAP_SOURCES")].join(" ");
        format!("{:016x}", xxh3_64(sources.as_bytes()))
    });
    &BUILD
}

/// Everything that determines the bytes of the rows of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Identity {
    /// Version of flap.
    pub flap: String,
    /// Build of flap, see [`build`].
    pub build: String,
    /// Class of arithmetic.
    pub arithmetic: String,
    /// Hash of the grid file's text.
    pub grid: String,
    /// Hash of the texts of the grid's devices, if the grid has devices.
    pub devices: Option<String>,
    /// Hash of the file that lists the points of the sample, if there is such a file.
    pub points_file: Option<String>,
    /// Description of the selected points.
    pub selection: String,
    /// Followed parameter, in words with a hash of its values and of the parameters of all designs; `None` if the
    /// rows belong to points.
    pub followed: Option<String>,
    /// Solver settings.
    pub solver: SolverSettings,
}

impl Identity {
    /// Returns the identity of the rows of `plan`.
    pub fn of(plan: &Plan, options: &RunOptions) -> Identity {
        Identity {
            flap: env!("CARGO_PKG_VERSION").to_owned(),
            build: build().to_owned(),
            arithmetic: options.instructions.arithmetic().name().to_owned(),
            grid: text::hash(&plan.source().text),
            devices: devices(plan.devices()),
            points_file: plan.points_file().map(PointsFile::hash),
            selection: selection(plan),
            followed: plan.followed().map(|along| followed(plan, along)),
            solver: *plan.solver(),
        }
    }

    /// Returns true if the same build of flap computed the rows of `other`, with the same arithmetic.
    pub fn is_by_program_of(&self, other: &Identity) -> bool {
        self.flap == other.flap && self.build == other.build && self.arithmetic == other.arithmetic
    }

    /// Returns descriptions of the differences to `other`. The list is empty if the rows are equal.
    pub fn differences(&self, other: &Identity) -> Vec<String> {
        let mut differences = Vec::new();
        if self.grid != other.grid {
            differences.push("the grid file differs".to_owned());
        }
        if self.devices != other.devices {
            differences.push("the device differs".to_owned());
        }
        if self.points_file != other.points_file {
            differences.push("the file of points differs".to_owned());
        }
        if self.solver != other.solver {
            differences.push("the solver settings differ".to_owned());
        }
        if self.followed != other.followed {
            differences.push(
                "the followed parameter, its values or the parameters of the designs differ".to_owned(),
            );
        }
        let mut compare = |what: &str, own: &str, others: &str| {
            if own != others {
                differences.push(format!("{what} {own}, not {others}"));
            }
        };
        compare("the rows cover", &self.selection, &other.selection);
        compare("the rows were computed by flap", &self.flap, &other.flap);
        compare("the arithmetic is", &self.arithmetic, &other.arithmetic);
        if self.flap == other.flap && self.build != other.build {
            let (own, others) = (&self.build, &other.build);
            differences.push(format!(
                "the rows were computed by build {own} of flap {}, not build {others}",
                self.flap
            ));
        }
        differences
    }
}

/// Returns the hash of the texts of devices; `None` if there are no devices.
pub(crate) fn devices(devices: &[Source]) -> Option<String> {
    let hashes: Vec<String> = devices.iter().map(|device| text::hash(&device.text)).collect();
    (!hashes.is_empty()).then(|| hashes.join(" "))
}

/// Returns a description of the selected points. Listed points may be points that a refinement added.
fn selection(plan: &Plan) -> String {
    let selection = plan.selection().to_string();
    if !matches!(plan.selection(), Selection::Listed(_)) || plan.added().is_empty() {
        return selection;
    }
    let bytes: Vec<u8> = plan.added().iter().flatten().copied().flat_map(f64::to_le_bytes).collect();
    format!("{selection}, {} added points ({:016x})", plan.added().len(), xxh3_64(&bytes))
}

/// Returns a description of the followed parameter.
///
/// The command line may set parameters that the grid file does not set, so the hash also contains these parameters.
fn followed(plan: &Plan, along: &Along) -> String {
    let base = plan.base().iter().map(|value| value.in_point());
    let numbers = along.values.iter().copied().chain([along.tolerance]).chain(base);
    let mut bytes: Vec<u8> = numbers.flat_map(f64::to_le_bytes).collect();
    bytes.push(u8::from(along.unstable));
    let name = plan.parameters()[along.parameter].name;
    format!("{name}, {} values ({:016x})", along.values.len(), xxh3_64(&bytes))
}
