//! Commands on results: `resume`, `rerun`, `merge`, `convert`, `verify`.

use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::time::Duration;

use flap_core::simulate::Status;
use flap_sweep::files::integrity::OnDamage;
use flap_sweep::notation::nearest;

use super::{SolverArgs, threads, time};

/// How the points of a sweep are worked through.
#[derive(clap::Args)]
pub(crate) struct WorkArgs {
    /// Worker threads; the rows do not depend on it [default: one per core]
    #[arg(short = 'j', long, value_name = "N", value_parser = threads)]
    pub(crate) threads: Option<NonZeroUsize>,

    /// Exit with 1 if some points are not periodic
    #[arg(long)]
    pub(crate) strict: bool,

    /// Time between checkpoints: what a killed sweep computes again
    #[arg(long, value_name = "TIME", default_value = "1 s", value_parser = interval)]
    pub(crate) checkpoint: Duration,
}

/// Options of commands that read results.
#[derive(clap::Args)]
pub(crate) struct ReadArgs {
    /// Use results all the same if they are not as they were written, as far as they can be read
    #[arg(long)]
    ignore_damage: bool,
}

impl ReadArgs {
    /// The treatment of damage.
    pub(crate) fn on_damage(&self) -> OnDamage {
        if self.ignore_damage { OnDamage::Tolerate } else { OnDamage::Refuse }
    }
}

#[derive(clap::Args)]
#[command(after_help = VERIFY_HELP)]
pub(crate) struct VerifyArgs {
    /// Results with their sidecars beside them
    #[arg(value_name = "FILE", required = true)]
    pub(crate) results: Vec<PathBuf>,
}

const VERIFY_HELP: &str = "\
Reads all of each FILE and compares it with the checksums in FILE.meta.toml. Says of each whether it is sound, or where it is \
damaged; of an unfinished one, whether it is sound as far as its journal goes. Rows are counted from 1, in blocks of 256: \
of a file with a row too few or too many, those behind it are damaged too.

Exit codes:
  0    all are sound
  1    none is damaged, but some could not be verified: there is no sidecar, or it has no checksums
  2    a name stands for no results
  3    some are damaged or cannot be read

Example:
  flap verify results/*.parquet";

#[derive(clap::Args)]
#[command(after_help = RESUME_HELP)]
pub(crate) struct ResumeArgs {
    /// The unfinished results
    #[arg(value_name = "FILE")]
    pub(crate) results: PathBuf,

    #[command(flatten)]
    pub(crate) read: ReadArgs,

    #[command(flatten)]
    pub(crate) work: WorkArgs,
}

const RESUME_HELP: &str = "\
Goes on after the last row that is safe in FILE, to the same bytes as if nothing had happened. The grid is the one in \
FILE.meta.toml. Refuses if another build of flap or another kind of machine began the sweep, or if complete results are \
damaged.

Example:
  flap resume results/run1.csv";

#[derive(clap::Args)]
#[command(after_help = RERUN_HELP)]
pub(crate) struct RerunArgs {
    /// Results with their sidecar beside them
    #[arg(value_name = "RESULTS")]
    pub(crate) results: PathBuf,

    /// Which points: those with one of these statuses
    #[arg(
        long,
        value_name = "STATUS,...",
        required_unless_present = "inaccurate",
        value_delimiter = ',',
        value_parser = status
    )]
    pub(crate) status: Vec<Status>,

    /// Those whose `error_estimate` exceeds the accuracy of RESULTS
    #[arg(long)]
    pub(crate) inaccurate: bool,

    /// Where to write their rows
    #[arg(short, long, value_name = "FILE")]
    pub(crate) out: PathBuf,

    #[command(flatten)]
    pub(crate) solver: SolverArgs,

    #[command(flatten)]
    pub(crate) read: ReadArgs,

    #[command(flatten)]
    pub(crate) work: WorkArgs,

    /// Replace existing results. They are kept beside the new ones, as in again.old.csv, until those are complete
    #[arg(short, long)]
    pub(crate) force: bool,
}

const RERUN_HELP: &str = "\
The rows keep the indices of their points. Solver settings that are not given are those of RESULTS.

Examples:
  flap rerun sweep.csv --status unsettled --max-cycles 10000 --out again.csv
  flap rerun sweep.csv --status diverged,step_limit --rtol 1e-8 --out again.csv
  flap rerun sweep.csv --inaccurate --rtol 1e-10 --out again.csv";

#[derive(clap::Args)]
#[command(after_help = MERGE_HELP)]
pub(crate) struct MergeArgs {
    /// File for all rows: .csv, .csv.zst, .parquet, or `-` for CSV to stdout
    #[arg(value_name = "OUT")]
    pub(crate) out: PathBuf,

    /// The results of every shard, with their sidecars beside them
    #[arg(value_name = "SHARD", required = true)]
    pub(crate) shards: Vec<PathBuf>,

    #[command(flatten)]
    pub(crate) read: ReadArgs,

    /// Overwrite an existing file of results
    #[arg(short, long)]
    pub(crate) force: bool,
}

const MERGE_HELP: &str = "\
The result has the bytes of a sweep on one machine. Refuses if a shard is missing, unfinished, damaged, given twice or of \
another sweep.

Example:
  flap sweep --grid grid.toml --shard 1/2
  flap sweep --grid grid.toml --shard 2/2
  flap merge grid.csv grid.1of2.csv grid.2of2.csv";

#[derive(clap::Args)]
#[command(after_help = CONVERT_HELP)]
pub(crate) struct ConvertArgs {
    /// Results with their sidecar beside them
    #[arg(value_name = "IN")]
    pub(crate) from: PathBuf,

    /// File for the same rows: .csv, .csv.zst, .parquet, or `-` for CSV to stdout
    #[arg(value_name = "OUT")]
    pub(crate) to: PathBuf,

    #[command(flatten)]
    pub(crate) read: ReadArgs,

    /// Overwrite an existing file of results
    #[arg(short, long)]
    pub(crate) force: bool,
}

const CONVERT_HELP: &str = "\
The result has the bytes of a sweep that wrote OUT. Of unfinished results, the rows up to the last checkpoint are converted.

Example:
  flap convert sweep.csv sweep.parquet
  flap convert sweep.parquet - | head";

/// A time from 0 to a day.
fn interval(text: &str) -> Result<Duration, String> {
    let seconds = time(text)?;
    let allowed = Some(seconds).filter(|seconds| (0.0..=86_400.0).contains(seconds));
    allowed.map(Duration::from_secs_f64).ok_or_else(|| "must be from 0 s to 86400 s".to_owned())
}

fn status(text: &str) -> Result<Status, String> {
    let found = Status::ALL.into_iter().find(|status| status.name() == text);
    found.ok_or_else(|| {
        let names = Status::ALL.map(Status::name);
        let hint = nearest(text, names).map_or_else(String::new, |name| format!("; did you mean `{name}`?"));
        format!("statuses are {}{hint}", names.join(", "))
    })
}
