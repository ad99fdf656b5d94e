//! Options that several commands have.

use std::num::NonZeroUsize;
use std::time::Duration;

use clap::ValueEnum;
use flap_sweep::files::integrity::OnDamage;
use flap_sweep::files::job::OnExisting;
use flap_sweep::table::labels::{self, Direction};

use super::values::{assignment, count, index, interval, positive, threads, tolerance};

/// Options that choose a design point.
#[derive(Clone, PartialEq, clap::Args)]
pub(crate) struct PointArgs {
    /// Preset, device file or grid file; `-` reads a grid from stdin
    #[arg(value_name = "PRESET|FILE")]
    pub(crate) what: String,

    /// Index of the point in the grid file, counted from 0
    #[arg(short, long, value_name = "I", default_value_t = 0, value_parser = index)]
    pub(crate) point: u64,

    #[command(flatten)]
    pub(crate) changes: ChangeArgs,
}

/// Option that changes parameters of designs.
#[derive(Clone, PartialEq, clap::Args)]
pub(crate) struct ChangeArgs {
    /// Set a parameter to a number in SI units, to a number with a unit, or to one of its named options. You
    /// can repeat --set
    #[arg(short, long, value_name = "NAME=VALUE", value_parser = assignment)]
    pub(crate) set: Vec<(String, String)>,

    /// Parameters that `--each` varies, with the value of each parameter in one design.
    #[arg(skip)]
    pub(crate) each: Vec<(String, String)>,
}

impl ChangeArgs {
    /// For each change on the command line, returns the name of the option (`--set` or `--each`), the
    /// parameter, and the new value.
    pub(crate) fn all(&self) -> impl Iterator<Item = (&'static str, &str, &str)> {
        let set = self.set.iter().map(|(name, value)| ("--set", name.as_str(), value.as_str()));
        set.chain(self.each.iter().map(|(name, value)| ("--each", name.as_str(), value.as_str())))
    }
}

/// Options that set the solver.
#[derive(clap::Args, Default)]
pub(crate) struct SolverArgs {
    /// Relative tolerance of the integrator. Unless the grid file sets atol, the absolute tolerance is a hundredth of
    /// the relative tolerance
    #[arg(long, value_name = "TOL", value_parser = tolerance)]
    pub(crate) rtol: Option<f64>,

    /// Largest allowed estimate of the relative error of a row; if the error is larger, flap integrates the point again with a
    /// smaller tolerance
    #[arg(long, value_name = "ERROR", value_parser = positive)]
    pub(crate) accuracy: Option<f64>,

    /// Largest allowed change of the states from one drive period to the next in a settled motion, as a fraction of each
    /// state's typical size
    #[arg(long, value_name = "TOL", value_parser = tolerance)]
    pub(crate) settle_tol: Option<f64>,

    /// Largest allowed number of drive periods until the motion settles; a slower motion has the status `unsettled`
    #[arg(long, value_name = "N", value_parser = count)]
    pub(crate) max_cycles: Option<u32>,
}

/// Options of a sweep: threads, exit code and checkpoints.
#[derive(clap::Args)]
pub(crate) struct WorkArgs {
    /// Number of worker threads; the number does not change the rows [default: one thread per core]
    #[arg(short = 'j', long, value_name = "N", value_parser = threads)]
    pub(crate) threads: Option<NonZeroUsize>,

    /// Exit with code 1 if the motions of some points are not periodic
    #[arg(long)]
    pub(crate) strict: bool,

    /// Time between checkpoints, such as `60 s`; after a crash, flap repeats at most the work since the last checkpoint
    #[arg(long, value_name = "TIME", default_value = "1 s", value_parser = interval)]
    pub(crate) checkpoint: Duration,
}

/// Option of commands that write small files.
#[derive(clap::Args)]
pub(crate) struct OverwriteArgs {
    /// Overwrite existing files
    #[arg(short, long)]
    pub(crate) force: bool,
}

/// Options of commands that write a new file of results or continue an unfinished file.
#[derive(clap::Args)]
pub(crate) struct BeginArgs {
    /// Compute all rows again, and replace existing results when the new results are complete
    ///
    /// Until the new results are complete, the file with the new rows has a name such as results.new.csv.
    #[arg(short = 'f', long, visible_alias = "force")]
    pub(crate) restart: bool,

    #[command(flatten)]
    pub(crate) work: WorkArgs,
}

impl BeginArgs {
    /// Returns `Restart` if the user gave `--restart`, otherwise `Continue`.
    pub(crate) fn on_existing(&self) -> OnExisting {
        if self.restart { OnExisting::Restart } else { OnExisting::Continue }
    }
}

/// Output format of a command.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum OutputFormat {
    /// Aligned columns; numbers have six digits
    Table,
    /// Comma-separated values; numbers have all digits
    Csv,
    /// JSON; numbers have all digits
    Json,
}

/// Direction in which a measure is better.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Aim {
    /// Larger values are better
    Max,
    /// Smaller values are better
    Min,
}

impl Aim {
    /// Returns `Min` if smaller values of the column `name` are better, otherwise `Max`.
    pub(crate) fn of(name: &str) -> Aim {
        if labels::better(name) == Some(Direction::Smaller) { Aim::Min } else { Aim::Max }
    }
}

/// Option of commands that read results.
#[derive(clap::Args)]
pub(crate) struct ReadArgs {
    /// If results are damaged, use only the rows that flap can read
    #[arg(long)]
    ignore_damage: bool,
}

impl ReadArgs {
    /// Returns `Tolerate` if the user gave `--ignore-damage`, otherwise `Refuse`.
    pub(crate) fn on_damage(&self) -> OnDamage {
        if self.ignore_damage { OnDamage::Tolerate } else { OnDamage::Refuse }
    }
}
