//! Arguments of `flap run`.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use clap::value_parser;

use super::options::{ChangeArgs, OutputFormat, OverwriteArgs, PointArgs, SolverArgs};
use super::values::{assignment, index};

#[derive(clap::Args)]
#[command(after_help = RUN_HELP)]
pub(crate) struct RunArgs {
    /// Preset, device file or grid file; `-` reads a grid from stdin. You can give several designs
    #[arg(value_name = "PRESET|FILE", required = true)]
    what: Vec<String>,

    /// Index of the point in the grid file, counted from 0
    #[arg(short, long, value_name = "I", default_value_t = 0, value_parser = index)]
    point: u64,

    #[command(flatten)]
    changes: ChangeArgs,

    /// Run each design with each of the given values of a parameter. You can repeat --each
    ///
    /// Values are separated by commas, as in --each 'drive_voltage_pp=100 V, 150 V, 200 V'.
    #[arg(long, value_name = "NAME=VALUE,...", value_parser = values)]
    pub(crate) each: Vec<(String, Vec<String>)>,

    /// CSV file with the waveform of the drive. The waveform in the file replaces the parameter drive_shape
    ///
    /// The columns of the file are time_s (or time_ms) and wave. The drive period is the time between the
    /// first and the last sample of the file, unless drive_frequency is set.
    #[arg(long, value_name = "FILE", conflicts_with = "stroke")]
    pub(crate) waveform: Option<PathBuf>,

    /// CSV file with a prescribed stroke
    ///
    /// The columns of the file are time_s (or time_ms) and stroke_deg (or stroke_rad). The drive period is
    /// the time between the first and the last sample of the file, unless drive_frequency is set.
    #[arg(long, value_name = "FILE")]
    pub(crate) stroke: Option<PathBuf>,

    /// Simulate the waveform or the prescribed stroke only once, from rest, instead of periodically
    #[arg(long, requires = "trajectory")]
    pub(crate) once: bool,

    /// CSV file for the motion over time; `-` prints the motion to stdout instead of the summary
    ///
    /// If you give several designs, the first columns contain the name of the design and the parameters of
    /// --each.
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

impl RunArgs {
    /// For each preset or file on the command line, returns one design for each combination of the values of
    /// the options `--each`.
    pub(crate) fn designs(&self) -> Vec<PointArgs> {
        let mut all = vec![self.changes.clone()];
        for (name, values) in &self.each {
            let with = |changes: &ChangeArgs, value: &String| {
                let mut changes = changes.clone();
                changes.each.push((name.clone(), value.clone()));
                changes
            };
            all =
                all.iter().flat_map(|changes| values.iter().map(move |value| with(changes, value))).collect();
        }
        let design = |what: &String, changes: &ChangeArgs| PointArgs {
            what: what.clone(),
            point: self.point,
            changes: changes.clone(),
        };
        self.what.iter().flat_map(|what| all.iter().map(move |changes| design(what, changes))).collect()
    }

    /// Returns a name for the preset or file `what`, or `None` if the command line contains only one preset
    /// or file. The name of a file is its file name without ending, or its path if two file names are equal.
    pub(crate) fn name(&self, what: &str) -> Option<String> {
        let short = |what: &String| {
            Path::new(what)
                .file_stem()
                .map_or_else(|| what.clone(), |stem| stem.to_string_lossy().into_owned())
        };
        let names: BTreeSet<String> = self.what.iter().map(short).collect();
        let whole: BTreeSet<&String> = self.what.iter().collect();
        let name = if names.len() == whole.len() { short(&what.to_owned()) } else { what.to_owned() };
        (self.what.len() > 1).then_some(name)
    }
}

/// Parses `NAME=VALUE,...`.
fn values(text: &str) -> Result<(String, Vec<String>), String> {
    let (name, values) = assignment(text)?;
    let values: Vec<String> = values.split(',').map(|value| value.trim().to_owned()).collect();
    if values.iter().any(String::is_empty) {
        return Err(
            "a value is empty; write NAME=VALUE,VALUE, such as drive_voltage_pp='100 V, 150 V'".to_owned()
        );
    }
    Ok((name, values))
}

const RUN_HELP: &str = "\
Examples:
  flap run ozaki2018-large
  flap run ozaki2018-large --set drive_frequency='120 Hz' --set drive_voltage_pp=150
  flap run ozaki2018-large --gradient lift_mean_mn
  flap run grid.toml --point 17 --trajectory point17.csv
  flap run ozaki2018-large --each drive_voltage_pp='100 V, 150 V, 200 V' --trajectory motions.csv
  flap run my_robot.toml jafferis2016 --trajectory motions.csv
  flap run ozaki2018-large --trajectory - --from-rest --cycles 50
  flap run jafferis2016 --format json";
