//! Arguments of `flap results resume`, `rerun`, `merge`, `convert` and `verify`.

use std::path::PathBuf;

use clap::Subcommand;
use flap_core::simulate::Status;

use super::options::{BeginArgs, OutputFormat, OverwriteArgs, ReadArgs, SolverArgs, WorkArgs};
use super::values::status;

#[derive(Subcommand)]
pub(crate) enum ResultsCommand {
    /// Continue an interrupted sweep with the grid that the sidecar records
    Resume(ResumeArgs),
    /// Run points of earlier results again with different solver settings
    Rerun(RerunArgs),
    /// Join the shards of a sweep into one file
    Merge(MergeArgs),
    /// Write results to a file of another format
    Convert(ConvertArgs),
    /// Compare results with the checksums in the sidecars of the results
    Verify(VerifyArgs),
}

#[derive(clap::Args)]
#[command(after_help = VERIFY_HELP)]
pub(crate) struct VerifyArgs {
    /// Result files; for each file, the sidecar FILE.meta.toml must be in the same folder
    #[arg(value_name = "FILE", required = true)]
    pub(crate) results: Vec<PathBuf>,

    /// Output format
    ///
    /// In the format `table`, flap prints one line per file.
    #[arg(long, value_enum, default_value_t = OutputFormat::Table)]
    pub(crate) format: OutputFormat,
}

const VERIFY_HELP: &str = "\
flap compares each FILE with the checksums in the sidecar FILE.meta.toml. For each file, flap prints one line with the \
verdict, such as `sound` or `damaged`, and the damaged rows. In an unfinished file, flap compares the rows that the \
journal records. flap counts rows from 1, and compares blocks of 256 rows. If a row is missing or added, all later \
rows count as damaged.

Exit codes:
  0    all files are sound
  1    no file is damaged, but flap could not verify some files, because the sidecar is missing or has no checksums
  2    the ending of a name is not the ending of a result file
  3    some files are damaged or cannot be read

Example:
  flap results verify results/*.parquet";

#[derive(clap::Args)]
#[command(after_help = RESUME_HELP)]
pub(crate) struct ResumeArgs {
    /// Unfinished results; the sidecar FILE.meta.toml must be in the same folder
    #[arg(value_name = "FILE")]
    pub(crate) results: PathBuf,

    #[command(flatten)]
    pub(crate) read: ReadArgs,

    #[command(flatten)]
    pub(crate) work: WorkArgs,
}

const RESUME_HELP: &str = "\
flap continues after the last row of FILE that the journal FILE.journal records. The finished file has the same bytes \
as a sweep without interruption. flap reads the grid from FILE.meta.toml. flap stops with an error if the sweep was \
started by a different build of flap or on a different kind of machine, or if complete results are damaged.

Merged shards of a grid with [refine] contain only the points of the axes. If FILE consists of merged shards, flap \
runs the points that [refine] adds.

Example:
  flap results resume results/run1.csv";

#[derive(clap::Args)]
#[command(after_help = RERUN_HELP)]
pub(crate) struct RerunArgs {
    /// Earlier results; the sidecar RESULTS.meta.toml must be in the same folder
    #[arg(value_name = "RESULTS")]
    pub(crate) results: PathBuf,

    /// Statuses, separated by commas: flap runs the points with the listed statuses again
    #[arg(
        long,
        value_name = "STATUS,...",
        required_unless_present = "inaccurate",
        value_delimiter = ',',
        value_parser = status
    )]
    pub(crate) status: Vec<Status>,

    /// Run all points again that have an `error_estimate` larger than the setting `accuracy` with which
    /// RESULTS was computed
    #[arg(long)]
    pub(crate) inaccurate: bool,

    /// File for the rows. The ending of the name sets the format: .csv, .csv.zst or .parquet
    #[arg(short, long, value_name = "FILE")]
    pub(crate) out: PathBuf,

    #[command(flatten)]
    pub(crate) solver: SolverArgs,

    #[command(flatten)]
    pub(crate) read: ReadArgs,

    #[command(flatten)]
    pub(crate) begin: BeginArgs,
}

const RERUN_HELP: &str = "\
The new rows have the same point indices as in RESULTS. For a solver setting that you do not give, flap uses the value \
from RESULTS.

Examples:
  flap results rerun sweep.csv --status unsettled --max-cycles 10000 --out again.csv
  flap results rerun sweep.csv --status diverged,step_limit --rtol 1e-8 --out again.csv
  flap results rerun sweep.csv --inaccurate --rtol 1e-10 --out again.csv";

#[derive(clap::Args)]
#[command(after_help = MERGE_HELP)]
pub(crate) struct MergeArgs {
    /// File for the rows; `-` prints CSV to stdout. The ending of the name sets the format: .csv, .csv.zst or .parquet
    #[arg(value_name = "OUT")]
    pub(crate) out: PathBuf,

    /// Results of all shards; for each shard, the sidecar SHARD.meta.toml must be in the same folder
    #[arg(value_name = "SHARD", required = true)]
    pub(crate) shards: Vec<PathBuf>,

    /// Merge shards that different builds of flap computed; the sidecar of OUT lists the builds
    #[arg(long)]
    pub(crate) mixed_builds: bool,

    #[command(flatten)]
    pub(crate) read: ReadArgs,

    #[command(flatten)]
    pub(crate) overwrite: OverwriteArgs,
}

const MERGE_HELP: &str = "\
OUT has the same bytes as the results of a sweep on one machine. flap stops with an error if a shard is missing, \
unfinished, damaged, given twice, or part of a different sweep. flap only joins the rows and computes no row again. \
OUT.meta.toml records the build of flap that computed the shards. Rows of different builds may differ, so flap merges \
shards of several builds only if you give --mixed-builds.

Example, with the shards of `flap sweep grid.toml --shard 1/2` and `--shard 2/2`:
  flap results merge grid.csv grid.1of2.csv grid.2of2.csv";

#[derive(clap::Args)]
#[command(after_help = CONVERT_HELP)]
pub(crate) struct ConvertArgs {
    /// Results; the sidecar IN.meta.toml must be in the same folder
    #[arg(value_name = "IN")]
    pub(crate) from: PathBuf,

    /// File for the rows; `-` prints CSV to stdout. The ending of the name sets the format: .csv, .csv.zst or .parquet
    #[arg(value_name = "OUT")]
    pub(crate) to: PathBuf,

    #[command(flatten)]
    pub(crate) read: ReadArgs,

    #[command(flatten)]
    pub(crate) overwrite: OverwriteArgs,
}

const CONVERT_HELP: &str = "\
OUT has the same bytes as a file that `flap sweep` writes in the format of OUT. If IN is unfinished, flap converts the \
rows up to the last checkpoint.

Examples:
  flap results convert sweep.csv sweep.parquet
  flap results convert sweep.parquet - | head";
