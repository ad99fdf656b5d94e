//! Arguments of commands on grid files: `flap sweep` and `flap check`.

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use flap_sweep::plan::selection::Shard;

use super::options::{BeginArgs, OutputFormat};
use super::values::threads;

#[derive(clap::Args)]
#[command(after_help = SWEEP_HELP)]
pub(crate) struct SweepArgs {
    /// Grid file with preset, parameters and axes; `-` reads a grid from stdin
    ///
    /// To repeat the sweep of earlier results, give the sidecar of the earlier results (FILE.meta.toml).
    #[arg(value_name = "GRID", required_unless_present = "named_grid")]
    first_grid: Option<PathBuf>,

    /// Grid file; --grid GRID has the same effect as the argument GRID
    #[arg(short = 'g', long = "grid", value_name = "GRID", conflicts_with = "first_grid")]
    named_grid: Option<PathBuf>,

    /// File for the rows; `-` prints the rows to stdout. The ending of the name sets the format: .csv,
    /// .csv.zst or .parquet. [default: the path in [output] of the grid file; without this path, the grid
    /// file's name with the ending .csv, in the working directory]
    #[arg(short, long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,

    /// Run only part I of N equal parts of the grid, so that several machines can share a sweep
    ///
    /// `flap results merge` joins the results of all parts. Without --out, the file for the rows of a part has
    /// a name such as grid.2of8.csv.
    /// The parts do not contain points of [refine]: `flap results resume` adds the points of [refine] to the merged
    /// file.
    #[arg(long, value_name = "I/N")]
    pub(crate) shard: Option<Shard>,

    #[command(flatten)]
    pub(crate) begin: BeginArgs,
}

impl SweepArgs {
    /// Returns the path of the grid file.
    pub(crate) fn grid(&self) -> &Path {
        self.first_grid.as_deref().or(self.named_grid.as_deref()).unwrap_or(Path::new(""))
    }
}

const SWEEP_HELP: &str = "\
flap writes each row as soon as possible, in the order of the points. After Ctrl-C or SIGTERM, flap waits up to half a \
second for the points that are being computed. flap keeps the complete rows and exits with code 130. A second Ctrl-C \
or SIGTERM stops flap at once. FILE.meta.toml (the sidecar), in the folder of FILE, records the origin of the rows. \
Until the sweep is complete, FILE.journal records the progress. To continue an interrupted sweep, run the same command \
again. If FILE already has all rows, flap runs no points. flap replaces rows of a different grid or of a different \
build of flap only if you give --restart.

Examples:
  flap sweep grid.toml
  flap sweep grid.toml --out results/run1.csv --threads 8
  flap sweep grid.toml --restart
  flap sweep grid.toml --shard 2/8
  flap sweep run1.csv.meta.toml --out again.csv
  flap sweep grid.toml --out - | head
  sed 's/n = 21/n = 81/' grid.toml | flap sweep - --out fine.csv";

#[derive(clap::Args)]
#[command(after_help = CHECK_HELP)]
pub(crate) struct CheckArgs {
    /// Grid file; `-` reads a grid from stdin
    ///
    /// Paths of files in a grid from stdin are relative to the working directory.
    #[arg(value_name = "GRID")]
    pub(crate) grid: PathBuf,

    /// Number of threads of the sweep; the estimate assumes that threads are as fast as on this machine
    /// [default: one thread per core]
    #[arg(short = 'j', long, value_name = "N", value_parser = threads)]
    pub(crate) threads: Option<NonZeroUsize>,

    /// Estimate the time of `flap sweep --shard I/N`, which runs part I of N equal parts
    #[arg(long, value_name = "I/N")]
    pub(crate) shard: Option<Shard>,

    /// Output format
    ///
    /// The formats csv and json have one row per value of the summary, with the section, the name and the key of the
    /// value.
    #[arg(long, value_enum, default_value_t = OutputFormat::Table)]
    pub(crate) format: OutputFormat,
}

const CHECK_HELP: &str = "\
flap shows the range of each axis, the number of points that [where] excludes, the first and the last point, and \
estimates of the time of the sweep and of the size of the CSV file. For the estimates, flap runs up to 256 points for \
about a second. The command also lists the parameters that differ from the preset, and unchanged parameters that \
usually change together with a varied parameter. flap warns if a value is more than a hundred times larger or smaller \
than the value of the preset. If a grid has more than a million points, flap counts the excluded points in a sample of \
a million points. If the grid has [refine], the estimates are for `max_points` points.

Examples:
  flap check grid.toml
  flap check grid.toml --shard 1/16 --threads 32
  flap check - < grid.toml";
