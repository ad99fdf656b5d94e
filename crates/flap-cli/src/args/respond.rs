//! `flap respond`.

use std::path::PathBuf;

use super::options::{BeginArgs, OutputFormat, SolverArgs};
use super::values::assignment;

#[derive(clap::Args)]
#[command(after_help = RESPOND_HELP)]
pub(crate) struct RespondArgs {
    /// A preset, or a grid file: each of its points, without the axis that is followed, is a design with a curve
    #[arg(value_name = "PRESET|FILE")]
    pub(crate) what: String,

    /// The parameter that rises and falls
    #[arg(short, long, value_name = "PARAMETER", default_value = "drive_frequency")]
    pub(crate) along: String,

    /// Its first value: a number in SI units, or with a unit [default: the first value of the grid file's axis]
    #[arg(long, value_name = "VALUE", allow_hyphen_values = true)]
    pub(crate) from: Option<String>,

    /// Its last value [default: the last value of the grid file's axis]
    #[arg(long, value_name = "VALUE", allow_hyphen_values = true)]
    pub(crate) to: Option<String>,

    /// The step from one value to the next [default: the steps of the grid file's axis]
    #[arg(long, value_name = "VALUE")]
    pub(crate) step: Option<String>,

    /// Longest step at the ends of bistable bands and where the response is steep [default: a sixteenth of the shortest step]
    #[arg(long, value_name = "VALUE")]
    pub(crate) tolerance: Option<String>,

    /// Continue the branches of bistable bands around their ends: adds the unstable orbits between them, as rows of the
    /// branch `unstable`
    #[arg(long)]
    pub(crate) unstable: bool,

    /// Set a parameter of all designs: a number in SI units, a number with a unit, or an option. May be repeated
    #[arg(short, long, value_name = "NAME=VALUE", value_parser = assignment)]
    pub(crate) set: Vec<(String, String)>,

    /// Write the motions, a row each, to a file, or to stdout with `-`. The ending chooses the format: .csv, .csv.zst or
    /// .parquet
    #[arg(short, long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,

    /// Output format of the summary: csv and json have one row per band in which a design is bistable, or its motions are
    /// not periodic
    #[arg(long, value_enum, default_value_t = OutputFormat::Table)]
    pub(crate) format: OutputFormat,

    #[command(flatten)]
    pub(crate) begin: BeginArgs,

    #[command(flatten)]
    pub(crate) solver: SolverArgs,
}

const RESPOND_HELP: &str = "\
The parameter first rises, then falls. The first point of each way starts at rest, every other one from the settled \
motion of the point before it. Where the way up and the way down settle to different motions, the design is bistable. \
Steps with an end of such a band in them are halved, and so are steps in which the motion changes by more than a tenth, where a narrow \
band may be. One line per design summarizes its response; it goes to stdout, \
with --out - to stderr.

Rows leave in the order of the designs, a whole curve at a time. Ctrl-C and SIGTERM give the running curves half a \
second to finish, keep the rows and exit with 130; a second one exits at once. Beside FILE, FILE.meta.toml records the command's \
options. Until all curves are there, FILE.journal records the progress. Whatever ended the run, the same command continues it.

Examples:
  flap respond jafferis2016 --from '60 Hz' --to '200 Hz' --step '1 Hz'
  flap respond jafferis2016 --set 'hinge_stiffness=0.7486 uN*m/rad' --set 'drive_voltage_pp=160 V' \
--from '110 Hz' --to '140 Hz' --step '1 Hz' --out response.csv
  flap respond ozaki2018-large --along drive_voltage_pp --from '20 V' --to '200 V' --step '5 V'";
