//! The identity of rows is the set of all inputs and settings that determine the bytes of the rows. A file
//! may contain rows of several runs only if the identities of the runs are equal.

use std::sync::LazyLock;

use flap_core::simulate::SolverSettings;
use serde::{Deserialize, Serialize};
use xxhash_rust::xxh3::xxh3_64;

use super::RunOptions;
use crate::notation::text;
use crate::plan::selection::Selection;
use crate::plan::{Along, Plan, PointsFile, Source};

/// Returns the hash of the source files that determine the bytes of rows, in hexadecimal digits. flap uses
/// the hash of its source files as the name of the build.
///
/// Two builds with the same version number may compute different rows. Two builds from the same source files
/// compute equal rows.
pub fn build() -> &'static str {
    static BUILD: LazyLock<String> = LazyLock::new(|| {
        let sources = [flap_core::SOURCES, env!("FLAP_SOURCES")].join(" ");
        format!("{:016x}", xxh3_64(sources.as_bytes()))
    });
    &BUILD
}

/// All inputs and settings that determine the bytes of the rows of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Identity {
    /// Version of flap.
    pub flap: String,
    /// Hash of flap's source files, see [`build`].
    pub build: String,
    /// Name of the floating-point arithmetic. All instruction sets with this arithmetic compute the same
    /// bits.
    pub arithmetic: String,
    /// Hash of the grid file's text.
    pub grid: String,
    /// Hash of the texts of the grid's devices, if the grid has devices.
    pub devices: Option<String>,
    /// Hash of the file from which the points of the sample are read, if the sample comes from a file.
    pub points_file: Option<String>,
    /// Text that describes which points of the plan are selected.
    pub selection: String,
    /// For response curves: name of the parameter that rises and falls, number of its values, and a hash of
    /// the values of all parameters. `None` if the run computes points and not responses.
    pub followed: Option<String>,
    /// Solver settings.
    pub solver: SolverSettings,
}

impl Identity {
    /// Returns the identity of the rows that a run with `plan` and `options` computes.
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

    /// Returns true if this identity and `other` have the same version of flap, the same build and the same
    /// arithmetic.
    pub fn is_by_program_of(&self, other: &Identity) -> bool {
        self.flap == other.flap && self.build == other.build && self.arithmetic == other.arithmetic
    }

    /// Returns a description of each difference between this identity and `other`. If the list is empty, runs
    /// with these two identities compute equal rows.
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

/// Returns the hashes of the device files as one text, separated by spaces. Returns `None` if there are no
/// devices.
pub(crate) fn devices(devices: &[Source]) -> Option<String> {
    let hashes: Vec<String> = devices.iter().map(|device| text::hash(&device.text)).collect();
    (!hashes.is_empty()).then(|| hashes.join(" "))
}

/// Returns a text that describes which points of the plan are selected. If the selection is a list, the text
/// also describes the points that a refinement added.
fn selection(plan: &Plan) -> String {
    let selection = plan.selection().to_string();
    if !matches!(plan.selection(), Selection::Listed(_)) || plan.added().is_empty() {
        return selection;
    }
    let bytes: Vec<u8> = plan.added().iter().flatten().copied().flat_map(f64::to_le_bytes).collect();
    format!("{selection}, {} added points ({:016x})", plan.added().len(), xxh3_64(&bytes))
}

/// Returns a text that describes the parameter that rises and falls in a response.
///
/// The command line may set parameters that are not in the grid file. The hash in the text therefore covers
/// the values of all parameters.
fn followed(plan: &Plan, along: &Along) -> String {
    let base = plan.base().iter().map(|value| value.in_point());
    let numbers = along.values.iter().copied().chain([along.tolerance]).chain(base);
    let mut bytes: Vec<u8> = numbers.flat_map(f64::to_le_bytes).collect();
    bytes.push(u8::from(along.unstable));
    let name = plan.parameters()[along.parameter].name;
    format!("{name}, {} values ({:016x})", along.values.len(), xxh3_64(&bytes))
}
