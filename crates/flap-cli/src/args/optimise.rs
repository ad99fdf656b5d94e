//! `flap optimise`.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use clap::{ArgGroup, value_parser};
use flap_sweep::study::optimum::Settings;

use super::options::{OutputFormat, OverwriteArgs, SolverArgs};
use super::values::{rows, threads};

#[derive(clap::Args)]
#[command(after_help = OPTIMISE_HELP, group = ArgGroup::new("goal").required(true).multiple(true))]
pub(crate) struct OptimiseArgs {
    /// Grid file whose axes are the ranges of the search; `-` reads a grid from stdin
    #[arg(value_name = "GRID")]
    pub(crate) grid: PathBuf,

    /// Goal that flap makes as large as possible: a measure, or an expression of measures and parameters
    #[arg(long, visible_alias = "maximize", value_name = "EXPRESSION", group = "goal")]
    pub(crate) maximise: Option<String>,

    /// Goal that flap makes as small as possible: a measure, or an expression of measures and parameters
    #[arg(long, visible_alias = "minimize", value_name = "EXPRESSION", group = "goal")]
    pub(crate) minimise: Option<String>,

    /// Condition that the design must satisfy: a comparison of measures and parameters with <, <=, > or >=, or several
    /// comparisons joined with `and`. A number may have a unit. You can repeat --where
    ///
    /// A condition on parameters alone may also contain `or`, `not`, == and !=, such as "device == 'long'".
    #[arg(long = "where", value_name = "COMPARISON")]
    pub(crate) conditions: Vec<String>,

    /// Compute a Pareto front of --maximise and --minimise with at most N designs; each design optimises one
    /// goal under a limit on the other goal
    ///
    /// --points requires both --maximise and --minimise
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(2..=10_000), conflicts_with = "out")]
    pub(crate) points: Option<u32>,

    /// Largest number of searches; each search begins at one of the best points of the grid
    #[arg(long, value_name = "N", default_value_t = Settings::STARTS, value_parser = starts)]
    pub(crate) starts: usize,

    /// Largest number of grid points to compute. If the grid has more points, flap computes N points that are spread
    /// over the grid
    #[arg(long, value_name = "N", default_value_t = Settings::POINTS, value_parser = value_parser!(u64).range(1..=10_000_000))]
    pub(crate) sample: u64,

    /// File for the best design, as a device file that `flap run` can read
    #[arg(short, long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,

    /// Number of worker threads; the best design does not depend on this number [default: one thread per core]
    #[arg(short = 'j', long, value_name = "N", value_parser = threads)]
    pub(crate) threads: Option<NonZeroUsize>,

    /// Output format
    #[arg(long, value_enum, default_value_t = OutputFormat::Table)]
    pub(crate) format: OutputFormat,

    #[command(flatten)]
    pub(crate) overwrite: OverwriteArgs,

    #[command(flatten)]
    pub(crate) solver: SolverArgs,
}

/// Parses a number of searches from 1 to 10 000.
fn starts(text: &str) -> Result<usize, String> {
    let number = rows(text).ok().map(NonZeroUsize::get).filter(|number| *number <= 10_000);
    number.ok_or_else(|| "expected a whole number from 1 to 10000".to_owned())
}

const OPTIMISE_HELP: &str = "\
flap first computes the points of the grid. The search then improves the best points step by step, with the \
derivatives of the measures. The search may choose any value between the smallest and the largest value of an axis. \
Parameters with named options, whole numbers, and parameters that change together can have only the values of the \
grid. Every motion begins at rest, as in a sweep.

The status is `optimal` if the derivatives confirm that no small change of the design is better. If a derivative is \
missing, flap uses the difference of two rows instead. The status is `approximate` if the derivatives do not confirm \
that the design is optimal. The status is `infeasible` if no design satisfies all conditions: flap then prints the \
design with the smallest violation of the conditions, and the exit code is 1.

With --points, each row is one design of the Pareto front. This design has the best value of one goal under a limit on \
the other goal. The front has fewer than N designs if one design is the best for several limits. With `--format csv`, \
rows contain all measures, so that `flap plot` can draw the rows.

Examples:
  flap optimise grid.toml --maximise vehicle_lift_mgf --where 'stroke_pp_deg < 100 deg' --where 'strain_surface_max < 0.08 %'
  flap optimise grid.toml --minimise power_mean_mw --where 'lift_mean_mn > 1.2 mN' --out best.toml
  flap optimise grid.toml --maximise 'lift_mean_mn / power_mean_mw' --starts 20 --format json
  flap optimise grid.toml --maximise lift_mean_mn --minimise power_mean_mw --points 15 --format csv > front.csv";
