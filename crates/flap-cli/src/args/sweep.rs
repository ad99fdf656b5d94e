//! Commands on grid files: `sweep`, `check`.

use std::path::{Path, PathBuf};

use flap_sweep::plan::selection::Shard;

use super::options::{BeginArgs, OutputFormat};

#[derive(clap::Args)]
#[command(after_help = SWEEP_HELP)]
pub(crate) struct SweepArgs {
    /// The grid file: preset, parameters and axes; `-` for stdin. The sidecar of earlier results (.meta.toml) repeats
    /// their sweep
    #[arg(value_name = "GRID", required_unless_present = "named_grid")]
    first_grid: Option<PathBuf>,

    /// The grid file, as an option
    #[arg(short = 'g', long = "grid", value_name = "GRID", conflicts_with = "first_grid")]
    named_grid: Option<PathBuf>,

    /// File for the rows, or `-` for stdout [default: the output path in the grid file, else the grid
    /// file's name with the ending .csv, in the working directory]. The ending chooses the format: .csv, .csv.zst or
    /// .parquet
    #[arg(short, long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,

    /// Run only part I of N equal parts, so that several machines can share a sweep; `flap results merge` joins the parts.
    /// Without --out, the rows go to a file such as grid.2of8.csv
    #[arg(long, value_name = "I/N")]
    pub(crate) shard: Option<Shard>,

    #[command(flatten)]
    pub(crate) begin: BeginArgs,
}

impl SweepArgs {
    /// The grid file, however it is named.
    pub(crate) fn grid(&self) -> &Path {
        self.first_grid.as_deref().or(self.named_grid.as_deref()).unwrap_or(Path::new(""))
    }
}

const SWEEP_HELP: &str = "\
Rows are written in the order of the points, as soon as they are computed. Ctrl-C or SIGTERM gives the running points \
half a second to finish, keeps the rows and exits with 130; a second one exits at once. Beside FILE, \
FILE.meta.toml (the sidecar) records the origin of the rows. Until the sweep is complete, FILE.journal records its \
progress. Whatever ended a sweep, the same command continues it, and runs nothing if all rows are there. Rows of another grid \
or of another build of flap are not replaced without --restart.

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
    /// The grid file; `-` for stdin. Files that a grid from stdin names are relative to the working directory
    #[arg(value_name = "GRID")]
    pub(crate) grid: PathBuf,

    /// Output format: csv and json have one value per row, with its section, name and key
    #[arg(long, value_enum, default_value_t = OutputFormat::Table)]
    pub(crate) format: OutputFormat,
}

const CHECK_HELP: &str = "\
Shows the range of each axis, the number of points that [where] excludes, the first and the last point, and an estimate \
of the time that the sweep takes. For the estimate, it runs up to 256 points for about a second. Lists the parameters \
that differ from the preset, and warns of values more than a hundred times larger or smaller. Of a grid of more than a \
million points, it counts excluded points among a million of them.

Examples:
  flap check grid.toml
  flap check - < grid.toml";
