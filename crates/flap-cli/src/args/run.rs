//! Arguments of `flap run`.

use std::path::PathBuf;

use clap::value_parser;

use super::options::{OutputFormat, OverwriteArgs, PointArgs, SolverArgs};

#[derive(clap::Args)]
#[command(after_help = RUN_HELP)]
pub(crate) struct RunArgs {
    #[command(flatten)]
    pub(crate) point: PointArgs,

    /// CSV file with the waveform of the drive. The file replaces the parameter drive_shape
    ///
    /// The columns are time_s (or time_ms) and wave. The drive period is the duration of the file's record, unless
    /// drive_frequency is set.
    #[arg(long, value_name = "FILE", conflicts_with = "stroke")]
    pub(crate) waveform: Option<PathBuf>,

    /// CSV file with a prescribed stroke
    ///
    /// The columns are time_s (or time_ms) and stroke_deg (or stroke_rad).
    /// The drive period is the duration of the file's record, unless drive_frequency is set.
    #[arg(long, value_name = "FILE")]
    pub(crate) stroke: Option<PathBuf>,

    /// Simulate the waveform or the prescribed stroke only once, from rest, instead of periodically
    #[arg(long, requires = "trajectory")]
    pub(crate) once: bool,

    /// CSV file for the motion over time; `-` prints the motion to stdout instead of the summary
    #[arg(short, long, value_name = "FILE")]
    pub(crate) trajectory: Option<PathBuf>,

    /// Number of drive periods in the trajectory file
    #[arg(long, value_name = "N", default_value_t = 2, requires = "trajectory",
          value_parser = value_parser!(u32).range(1..=100_000))]
    pub(crate) cycles: u32,

    /// Number of samples of the trajectory per drive period
    #[arg(long, value_name = "N", default_value_t = 200, requires = "trajectory",
          value_parser = value_parser!(u32).range(1..=1_000_000))]
    pub(crate) samples: u32,

    /// Begin the trajectory at rest instead of on the settled orbit
    #[arg(long, requires = "trajectory")]
    pub(crate) from_rest: bool,

    /// Print the ten parameters with the largest effect on the given measure
    ///
    /// The effect of a parameter is the change of the measure in the settled motion if the parameter becomes 1 %
    /// larger.
    #[arg(long, value_name = "COLUMN")]
    pub(crate) gradient: Option<String>,

    /// Output format
    ///
    /// With --gradient, csv and json contain the derivatives instead of the measures.
    #[arg(long, value_enum, default_value_t = OutputFormat::Table)]
    pub(crate) format: OutputFormat,

    #[command(flatten)]
    pub(crate) overwrite: OverwriteArgs,

    #[command(flatten)]
    pub(crate) solver: SolverArgs,
}

const RUN_HELP: &str = "\
Examples:
  flap run ozaki2018-large
  flap run ozaki2018-large --set drive_frequency='120 Hz' --set drive_voltage_pp=150
  flap run ozaki2018-large --gradient lift_mean_mn
  flap run grid.toml --point 17 --trajectory point17.csv
  flap run ozaki2018-large --trajectory - --from-rest --cycles 50
  flap run jafferis2016 --format json";
