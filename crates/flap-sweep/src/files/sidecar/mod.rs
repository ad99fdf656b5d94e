//! The sidecar `<results>.meta.toml` records the origin of results.
//!
//! The sidecar is written when a sweep starts, with `state = "running"`, and again when the sweep ends. Each
//! new version replaces the whole sidecar at once, so a reader never gets an incomplete sidecar. With the
//! contents of the sidecar, flap can repeat the sweep and check the results. The first line of a sidecar is
//! the checksum of the other lines.

use std::collections::BTreeMap;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use memchr::memmem;
use serde::{Deserialize, Serialize};
use toml::Value;
use xxhash_rust::xxh3::xxh3_64;

use super::disk;
use super::results::{Checksums, parameters};
use crate::input::{self, InputError, MOST_LISTED};
use crate::notation::text;
use crate::plan::selection::{self, Selection};
use crate::plan::{Along, Plan, Source};
use crate::run::identity::Identity;
use crate::run::{RunOptions, Summary};
use crate::table::layout::Layout;
pub use to_plan::PlanError;

mod to_plan;

/// Contents of a sidecar.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sidecar {
    /// State of the sweep.
    pub state: State,
    /// Error message of a failed sweep.
    pub error: Option<String>,
    /// Name of the model.
    pub model: String,
    /// Name of the preset.
    pub preset: String,
    /// Number of points of the grid.
    pub points: u64,
    /// Shard of the sweep, such as `2/3`; `None` if the sweep computes all points.
    pub shard: Option<String>,
    /// Time at which the sweep was first started, in the format of RFC 3339 and in UTC.
    pub started: String,
    /// Time at which the sweep last ended, in the format of RFC 3339 and in UTC.
    pub finished: Option<String>,
    /// Total running time of the sweep in seconds, without the time of interruptions.
    pub seconds: Option<f64>,
    /// Number of worker threads.
    pub threads: usize,
    /// Name of the processor's instruction set with which the lanes were computed.
    pub instructions: String,
    /// Path of the file that lists the points of the sample; `None` if there is no such file. A relative path
    /// is relative to the working directory.
    pub points_file: Option<String>,
    /// Build, settings and hashes that determine the rows.
    pub identity: Identity,
    /// Summary of the rows; `None` until the sweep has ended.
    pub summary: Option<Summary>,
    /// Points that were computed again; `None` if the sweep is not a rerun.
    pub rerun: Option<Rerun>,
    /// Parameter along which response curves were computed; `None` if the rows contain no response curves.
    pub followed: Option<Followed>,
    /// The value that each parameter has if no axis varies this parameter. Parameters without a fixed
    /// value, such as computed parameters, are left out.
    parameters: BTreeMap<String, Value>,
    /// Varied parameters.
    varied: Vec<Unit>,
    /// Measures in the rows.
    columns: Vec<Unit>,
    /// Grid file.
    pub grid: Source,
    /// Devices: first the device that the grid names, then the devices on which that device is based.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub devices: Vec<Source>,
    /// Checksums of complete results.
    pub checksums: Option<Checksums>,
}

/// State of a sweep.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum State {
    /// The sweep has not ended, or its process was killed.
    Running,
    /// All rows are written.
    Complete,
    /// The sweep was stopped before the end.
    Interrupted,
    /// The sweep failed before the end.
    Failed,
}

/// Earlier results whose points a rerun computes again.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Origin {
    /// Result file.
    pub of: String,
    /// Kinds of rows that the rerun computes again, such as `unsettled` or `inaccurate`.
    pub statuses: Vec<String>,
}

/// Points that a rerun computes again, and the earlier results of these points.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Rerun {
    /// Earlier results.
    #[serde(flatten)]
    pub origin: Origin,
    /// Indices of the points, such as `3,17,20-31`.
    pub points: String,
    /// Points that a refinement has added. Each point is a list with one position for each axis. For
    /// example, the position 1.5 is midway between the second and the third value of an axis.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub added: Vec<Vec<f64>>,
}

/// Parameter that rises and falls during the computation of response curves: see [`Along`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Followed {
    /// Name of the parameter.
    pub parameter: String,
    /// Values, in ascending order.
    pub values: Vec<f64>,
    /// Largest accepted error of the parameter values at which bistable bands end.
    pub tolerance: f64,
    /// True if flap also computes the unstable orbits in bistable bands.
    pub unstable: bool,
}

/// The name and the unit of a column.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Unit {
    name: String,
    unit: String,
}

impl Unit {
    fn new(name: &str, unit: &str) -> Unit {
        Unit { name: name.to_owned(), unit: unit.to_owned() }
    }
}

impl Sidecar {
    /// Returns the sidecar of a sweep of `plan` that starts at the time `started`.
    ///
    /// For a rerun, `origin` describes the earlier results whose points are computed again.
    pub fn new(plan: &Plan, started: String, options: &RunOptions, origin: Option<Origin>) -> Sidecar {
        let layout = Layout::of(plan);
        let (shard, rerun) = match plan.selection() {
            Selection::All => (None, None),
            Selection::Shard(shard) => (Some(shard.to_string()), None),
            Selection::Listed(list) => {
                let (origin, points) = (origin.unwrap_or_default(), selection::list_text(list));
                (None, Some(Rerun { origin, points, added: plan.added().to_vec() }))
            }
        };
        Sidecar {
            state: State::Running,
            error: None,
            model: plan.simulator().name().to_owned(),
            preset: plan.preset().to_owned(),
            points: plan.len(),
            shard,
            started,
            finished: None,
            seconds: None,
            threads: options.threads.get(),
            instructions: options.instructions.name().to_owned(),
            points_file: plan.points_file().map(|file| file.path.display().to_string()),
            identity: Identity::of(plan, options),
            summary: None,
            rerun,
            followed: followed(plan),
            parameters: parameters(plan),
            varied: layout.varied.iter().map(|(_, p)| Unit::new(p.name, p.unit)).collect(),
            columns: layout.measures().map(|m| Unit::new(&m.column.name, &m.column.unit)).collect(),
            grid: plan.source().clone(),
            devices: plan.devices().to_vec(),
            checksums: None,
        }
    }

    /// Records the end of a complete or interrupted sweep. `seconds` is the duration of the sweep.
    pub fn finish(&mut self, summary: &Summary, finished: String, seconds: f64) {
        self.state = if summary.is_interrupted() { State::Interrupted } else { State::Complete };
        self.summary = Some(summary.clone());
        if summary.refined.is_some() {
            self.points = summary.points;
        }
        self.finished = Some(finished);
        self.seconds = Some(seconds);
    }

    /// Records that the sweep failed with the message `error`. `seconds` is the duration of the sweep.
    pub fn fail(&mut self, error: String, finished: String, seconds: f64) {
        self.state = State::Failed;
        self.error = Some(error);
        self.finished = Some(finished);
        self.seconds = Some(seconds);
    }

    /// Returns the number of rows of complete results, and `None` for unfinished results.
    pub fn rows(&self) -> Option<u64> {
        let summary = self.summary.as_ref().filter(|_| self.state == State::Complete);
        summary.map(|summary| summary.rows)
    }

    /// For the results of a rerun, returns the earlier results whose points were computed again.
    pub fn origin(&self) -> Option<&Origin> {
        self.rerun.as_ref().map(|rerun| &rerun.origin)
    }
}

/// Returns the parameter along which a plan computes response curves, or `None` if the plan has no response
/// curves.
fn followed(plan: &Plan) -> Option<Followed> {
    let Along { parameter, values, tolerance, unstable } = plan.followed()?.clone();
    let parameter = plan.parameters()[parameter].name.to_owned();
    Some(Followed { parameter, values, tolerance, unstable })
}

/// Beginning of the first line of a sidecar. The first line is valid TOML, so any TOML parser can read the
/// sidecar.
const CHECKSUM: &str = "checksum = \"";

/// Reason why a file cannot be used as a sidecar.
#[derive(Debug, thiserror::Error)]
pub enum SidecarError {
    /// The file cannot be read.
    #[error("cannot read {}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// Error that the operating system reported.
        source: io::Error,
    },
    /// The file is not a sidecar.
    #[error("{}: not a sidecar of results: {reason}", path.display())]
    Format {
        /// The file.
        path: PathBuf,
        /// Mistake in the file.
        reason: String,
    },
    /// Another program has changed the file.
    #[error("{} is damaged: {reason}", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// Description of the damage to the file.
        reason: &'static str,
    },
}

impl Sidecar {
    /// Returns the text of the sidecar file.
    ///
    /// # Errors
    /// [`toml::ser::Error`] if TOML cannot represent a number, such as 2^63 points.
    pub fn text(&self) -> Result<String, toml::ser::Error> {
        let contents = toml::to_string(self)?;
        Ok(format!("{CHECKSUM}{}\"\n{contents}", text::hash(&contents)))
    }

    /// Reads the file.
    ///
    /// # Errors
    /// - [`SidecarError::Io`] if the file cannot be read.
    /// - [`SidecarError::Format`] if the file is not a sidecar.
    /// - [`SidecarError::Damaged`] if the file does not match its checksum.
    pub fn read(path: &Path) -> Result<Sidecar, SidecarError> {
        Sidecar::parse(path, &bytes(path)?)
    }

    /// Reads the sidecar at `path`, even if the checksum of the sidecar is wrong.
    ///
    /// # Errors
    /// - [`SidecarError::Io`] if the file cannot be read.
    /// - [`SidecarError::Format`] if the file is not a sidecar.
    pub fn read_damaged(path: &Path) -> Result<Sidecar, SidecarError> {
        Sidecar::parse_damaged(path, &bytes(path)?)
    }

    /// Parses a sidecar from the bytes of a file. Errors contain `path`, the path of the file.
    ///
    /// # Errors
    /// - [`SidecarError::Format`] if the bytes are not a sidecar.
    /// - [`SidecarError::Damaged`] if the bytes do not match their checksum.
    pub fn parse(path: &Path, bytes: &[u8]) -> Result<Sidecar, SidecarError> {
        let damaged = |reason| SidecarError::Damaged { path: path.to_owned(), reason };
        if let Some(rest) = bytes.strip_prefix(CHECKSUM.as_bytes())
            && let Some(end) = memmem::find(rest, b"\"\n")
        {
            let (checksum, contents) = (&rest[..end], &rest[end + 2..]);
            if checksum != text::digits(xxh3_64(contents)).as_bytes() {
                return Err(damaged("its first line is not the checksum of the others"));
            }
            return Sidecar::parse_damaged(path, contents);
        }
        Sidecar::parse_damaged(path, bytes)?;
        Err(damaged("its first line is not its checksum"))
    }

    /// Parses a sidecar from the bytes of a file, without checking the checksum. The line with the checksum
    /// may be missing. Bytes that are not UTF-8 become U+FFFD.
    fn parse_damaged(path: &Path, bytes: &[u8]) -> Result<Sidecar, SidecarError> {
        toml::from_str(&String::from_utf8_lossy(bytes)).map_err(|error| SidecarError::Format {
            path: path.to_owned(),
            reason: error.message().to_owned(),
        })
    }

    /// Writes the sidecar to `path`, and replaces an earlier sidecar.
    ///
    /// # Errors
    /// Returns the error of the operating system if the file cannot be written.
    pub fn write(&self, path: &Path) -> io::Result<()> {
        self.prepare(path)?.commit()
    }

    /// Writes the sidecar into a file with a temporary name. [`disk::Whole::commit`] gives the sidecar its
    /// final name.
    pub(crate) fn prepare(&self, path: &Path) -> io::Result<disk::Whole> {
        let text = self.text().map_err(io::Error::other)?;
        let whole = disk::Whole::begin(path)?;
        whole.file().write_all(text.as_bytes())?;
        Ok(whole)
    }
}

fn bytes(path: &Path) -> Result<Vec<u8>, SidecarError> {
    input::bytes(path, MOST_LISTED).map_err(|error| {
        let path = path.to_owned();
        match error {
            InputError::Missing | InputError::Unreadable(_) => {
                SidecarError::Io { path, source: error.into() }
            }
            _ => SidecarError::Format { path, reason: error.to_string() },
        }
    })
}
