//! Commands on filmed wings: `lift`, `track`.

use std::path::PathBuf;

use clap::value_parser;

use super::options::{OverwriteArgs, PointArgs};
use super::values::positive;

#[derive(clap::Args)]
#[command(after_help = LIFT_HELP)]
pub(crate) struct LiftArgs {
    #[command(flatten)]
    pub(crate) point: PointArgs,

    /// CSV file with the motion: columns time_s (or time_ms), stroke_deg (or stroke_rad), pitch_deg (or pitch_rad)
    #[arg(value_name = "MOTION")]
    pub(crate) motion: PathBuf,

    /// The motion is one period: its last sample is the first of the next period
    #[arg(long)]
    pub(crate) periodic: bool,

    /// CSV file for motion and forces over time, or `-` for stdout in place of the summary
    #[arg(short, long, value_name = "FILE")]
    pub(crate) trajectory: Option<PathBuf>,

    /// Number of samples from the beginning of the motion to its end
    #[arg(long, value_name = "N", default_value_t = 2000, value_parser = value_parser!(u32).range(1..=5_000_000))]
    pub(crate) samples: u32,

    #[command(flatten)]
    pub(crate) overwrite: OverwriteArgs,
}

const LIFT_HELP: &str = "\
Angles follow the conventions of the model, see docs/model.md. Between samples the motion is a cubic spline. Its \
acceleration amplifies the noise of the samples, so smooth them first.

Examples:
  flap track points.csv --chord 6.5 --out motion.csv
  flap lift ozaki2018-small motion.csv --trajectory forces.csv";

#[derive(clap::Args)]
#[command(after_help = TRACK_HELP)]
pub(crate) struct TrackArgs {
    /// CSV file with the points of every image: columns root_x, root_y, tip_x, tip_y of the leading edge, and edge_x,
    /// edge_y of a point of the lower edge for the pitch, all in one unit; and time_s or time_ms
    #[arg(value_name = "POINTS")]
    pub(crate) points: PathBuf,

    /// Chord from the leading edge to the point of the lower edge, in the unit of the points
    #[arg(long, value_name = "LENGTH", value_parser = positive)]
    pub(crate) chord: Option<f64>,

    /// CSV file for stroke_deg and pitch_deg over time [default: stdout]
    #[arg(short, long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,

    #[command(flatten)]
    pub(crate) overwrite: OverwriteArgs,
}

const TRACK_HELP: &str = "\
Uses the method of Ozaki and Hamaguchi 2018: the stroke is the angle from the x-axis to the leading edge, the pitch \
follows from the projected chord (eq. 42), the centre of rotation is a least-squares fit (eq. 43).

Example:
  flap track points.csv --chord 6.5 --out motion.csv";
