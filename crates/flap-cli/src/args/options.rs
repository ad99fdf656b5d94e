//! Groups of options that several commands have.

use std::num::NonZeroUsize;
use std::time::Duration;

use clap::ValueEnum;
use flap_sweep::files::integrity::OnDamage;
use flap_sweep::files::job::Begin;
use flap_sweep::table::labels::{self, Direction};

use super::values::{assignment, count, interval, positive, threads, tolerance};

/// The choice of a design point.
#[derive(clap::Args)]
pub(crate) struct PointArgs {
    /// A preset, a device or a grid file; `-` for a grid from stdin
    #[arg(value_name = "PRESET|FILE")]
    pub(crate) what: String,

    /// Index of the point in the grid file, from 0
    #[arg(short, long, value_name = "I", default_value_t = 0)]
    pub(crate) point: u64,

    /// Set a parameter: a number in SI units, a number with a unit, or an option. May be repeated
    #[arg(short, long, value_name = "NAME=VALUE", value_parser = assignment)]
    pub(crate) set: Vec<(String, String)>,
}

/// Settings of the solver.
#[derive(clap::Args, Default)]
pub(crate) struct SolverArgs {
    /// Relative tolerance of the integrator; the absolute tolerance becomes a hundredth of it
    #[arg(long, value_name = "TOL", value_parser = tolerance)]
    pub(crate) rtol: Option<f64>,

    /// Largest estimated relative error of a row; points whose rows exceed it are integrated again with a smaller
    /// tolerance
    #[arg(long, value_name = "ERROR", value_parser = positive)]
    pub(crate) accuracy: Option<f64>,

    /// Change of the state per drive period below which an orbit counts as settled
    #[arg(long, value_name = "TOL", value_parser = tolerance)]
    pub(crate) settle_tol: Option<f64>,

    /// Drive periods after which a point counts as unsettled
    #[arg(long, value_name = "N", value_parser = count)]
    pub(crate) max_cycles: Option<u32>,
}

/// Settings of a sweep's work: threads and checkpoints.
#[derive(clap::Args)]
pub(crate) struct WorkArgs {
    /// Number of worker threads; it does not change the rows [default: one per core]
    #[arg(short = 'j', long, value_name = "N", value_parser = threads)]
    pub(crate) threads: Option<NonZeroUsize>,

    /// Exit with 1 if some points are not periodic
    #[arg(long)]
    pub(crate) strict: bool,

    /// Time between checkpoints: the most work that a killed sweep repeats
    #[arg(long, value_name = "TIME", default_value = "1 s", value_parser = interval)]
    pub(crate) checkpoint: Duration,
}

/// Options of commands that write small files.
#[derive(clap::Args)]
pub(crate) struct OverwriteArgs {
    /// Overwrite existing files
    #[arg(short, long)]
    pub(crate) force: bool,
}

/// Options of commands that begin or continue results.
#[derive(clap::Args)]
pub(crate) struct BeginArgs {
    /// Start over, and replace existing results when the new ones are complete. Until then the new ones have another
    /// name, as in results.new.csv
    #[arg(short = 'f', long, visible_alias = "force")]
    pub(crate) restart: bool,

    #[command(flatten)]
    pub(crate) work: WorkArgs,
}

impl BeginArgs {
    /// The treatment of results that are there already.
    pub(crate) fn treatment(&self) -> Begin {
        if self.restart { Begin::Restart } else { Begin::Continue }
    }
}

/// The format in which a command prints.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum OutputFormat {
    /// Aligned columns with six digits, to be read
    Table,
    /// Comma-separated values with all digits
    Csv,
    /// JSON with all digits
    Json,
}

/// The better direction of a measure.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Aim {
    /// Larger values are better
    Max,
    /// Smaller values are better
    Min,
}

impl Aim {
    /// The better direction of the column called `name`: that of its label, else larger values.
    pub(crate) fn of(name: &str) -> Aim {
        if labels::better(name) == Some(Direction::Smaller) { Aim::Min } else { Aim::Max }
    }
}

/// Options of commands that read results.
#[derive(clap::Args)]
pub(crate) struct ReadArgs {
    /// Use the readable rows of damaged results
    #[arg(long)]
    ignore_damage: bool,
}

impl ReadArgs {
    /// The treatment of damage.
    pub(crate) fn on_damage(&self) -> OnDamage {
        if self.ignore_damage { OnDamage::Tolerate } else { OnDamage::Refuse }
    }
}
