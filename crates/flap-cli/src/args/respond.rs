//! Arguments of `flap respond`.

use std::path::PathBuf;

use super::options::{BeginArgs, ChangeArgs, OutputFormat, SolverArgs};
use super::values::index;

#[derive(clap::Args)]
#[command(after_help = RESPOND_HELP)]
pub(crate) struct RespondArgs {
    /// Preset, device file or grid file; `-` reads a grid from stdin
    ///
    /// The grid may have an axis for the followed parameter, which is the parameter of `--along`. flap
    /// computes one curve for each combination of the values of all axes except the axis of the followed
    /// parameter.
    #[arg(value_name = "PRESET|FILE")]
    pub(crate) what: String,

    /// Followed parameter: the parameter that first rises and then falls
    #[arg(short, long, value_name = "PARAMETER", default_value = "drive_frequency")]
    pub(crate) along: String,

    /// First value of the followed parameter, in SI units or with a unit [default: the first value of the grid file's axis]
    #[arg(long, value_name = "VALUE", allow_hyphen_values = true)]
    pub(crate) from: Option<String>,

    /// Last value of the followed parameter [default: the last value of the grid file's axis]
    #[arg(long, value_name = "VALUE", allow_hyphen_values = true)]
    pub(crate) to: Option<String>,

    /// Step between two values of the followed parameter [default: the steps of the grid file's axis]
    #[arg(long, value_name = "VALUE")]
    pub(crate) step: Option<String>,

    /// Longest step of the followed parameter at ends of bistable bands, and where the motion changes
    /// strongly [default: a sixteenth of the shortest step]
    #[arg(long, value_name = "VALUE")]
    pub(crate) tolerance: Option<String>,

    /// Also compute the unstable orbits, by continuation of the branches around the ends of bistable bands
    ///
    /// The continuation finds the unstable orbits between the rising and the falling branch. flap writes these orbits
    /// as rows of the branch `unstable`.
    #[arg(long)]
    pub(crate) unstable: bool,

    /// Follow the ends of bistable bands in the plane of two parameters: the followed parameter and PARAMETER
    ///
    /// flap first computes the response with the design's own value of PARAMETER. Each end of a bistable band
    /// is then a point in the plane of the two parameters. From the design's own value of PARAMETER, flap
    /// follows the end of the band in this plane in both directions.
    #[arg(
        long,
        value_name = "PARAMETER",
        requires_all = ["edge_from", "edge_to"],
        conflicts_with_all = ["out", "unstable", "strict"],
        help_heading = EDGES
    )]
    pub(crate) edge: Option<String>,

    /// Smallest value of the PARAMETER that --edge names
    #[arg(long, value_name = "VALUE", allow_hyphen_values = true, requires = "edge", help_heading = EDGES)]
    pub(crate) edge_from: Option<String>,

    /// Largest value of the PARAMETER that --edge names
    #[arg(long, value_name = "VALUE", allow_hyphen_values = true, requires = "edge", help_heading = EDGES)]
    pub(crate) edge_to: Option<String>,

    /// Print only the cusps, the ends of each edge, and the points where PARAMETER is --edge-from plus a
    /// multiple of VALUE [default: all computed points]
    #[arg(long, value_name = "VALUE", requires = "edge", help_heading = EDGES)]
    pub(crate) edge_step: Option<String>,

    /// At each value in a bistable band, start N motions from random initial states, and count the motions that settle
    /// on each branch
    #[arg(
        long,
        value_name = "N",
        value_parser = clap::value_parser!(u32).range(1..=1_000_000),
        conflicts_with_all = ["out", "unstable", "edge", "strict"],
        help_heading = BASINS
    )]
    pub(crate) basins: Option<u32>,

    /// Seed of the random initial states
    #[arg(long, value_name = "NUMBER", default_value_t = 0, value_parser = index, requires = "basins", help_heading = BASINS)]
    pub(crate) seed: u64,

    #[command(flatten)]
    pub(crate) changes: ChangeArgs,

    /// File for the rows, one per motion; `-` prints the rows to stdout. The ending of the name sets the format: .csv, .csv.zst or .parquet
    #[arg(short, long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,

    /// Output format of the summary
    ///
    /// The formats csv and json have one row per band of parameter values in which the design is bistable or the
    /// motions are not periodic.
    /// With --edge, csv and json have one row per point of an edge. With --basins, csv and json have one row
    /// per value in a bistable band.
    #[arg(long, value_enum, default_value_t = OutputFormat::Table)]
    pub(crate) format: OutputFormat,

    #[command(flatten)]
    pub(crate) begin: BeginArgs,

    #[command(flatten)]
    pub(crate) solver: SolverArgs,
}

/// Heading above the options for edges in the help.
const EDGES: &str = "Edges";

/// Heading above the options for basins in the help.
const BASINS: &str = "Basins";

const RESPOND_HELP: &str = "\
The followed parameter first rises, then falls. At the first value of each branch, the motion starts at rest. At each \
later value, the motion starts from the settled motion at the previous value. If the motions of the rising and of the \
falling branch differ, the design is bistable. flap halves a step of the followed parameter if a bistable band ends \
within the step. flap also halves a step in which the motion changes by more than a tenth, because the step could \
contain a narrow bistable band. The summary has one line per design. flap prints the summary to stdout, or to stderr \
if you give `--out -`.

flap writes rows in the order of the designs, one whole curve at a time. After Ctrl-C or SIGTERM, flap waits up to \
0.4 s for the curves that are being computed. flap keeps the complete rows and exits with code 130. A second \
Ctrl-C or SIGTERM stops flap at once. FILE.meta.toml, in the folder of FILE, records the options of the command. Until \
all curves are complete, FILE.journal records the progress. To continue an interrupted command, run the same command \
again.

Examples:
  flap respond jafferis2016 --from '60 Hz' --to '200 Hz' --step '1 Hz'
  flap respond jafferis2016 --set 'hinge_stiffness=0.7486 uN*m/rad' --set 'drive_voltage_pp=160 V' --from '110 Hz' --to \
'140 Hz' --step '1 Hz' --out response.csv
  flap respond jafferis2016 --set 'hinge_stiffness=0.7486 uN*m/rad' --set 'drive_voltage_pp=160 V' --from '110 Hz' --to \
'140 Hz' --step '1 Hz' --edge drive_voltage_pp --edge-from '60 V' --edge-to '300 V' --format csv
  flap respond ozaki2018-large --along drive_voltage_pp --from '20 V' --to '200 V' --step '5 V'";
