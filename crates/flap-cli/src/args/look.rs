//! Arguments of commands that summarize results: `flap top` and `flap describe`.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use super::filter::{Filter, filter};
use super::options::{Aim, OutputFormat, ReadArgs};
use super::values;

#[derive(clap::Args)]
#[command(after_help = TOP_HELP)]
pub(crate) struct TopArgs {
    /// Column by which rows are ranked
    #[arg(long, value_name = "COLUMN")]
    pub(crate) by: String,

    /// Number of rows to list
    #[arg(short = 'n', long, value_name = "N", default_value = "10", value_parser = values::rows)]
    pub(crate) rows: NonZeroUsize,

    /// More columns to list, separated by commas
    #[arg(long, value_name = "COLUMN,...", value_delimiter = ',')]
    pub(crate) columns: Vec<String>,

    #[command(flatten)]
    pub(crate) look: LookArgs,
}

const TOP_HELP: &str = "\
Lists the varied and derived parameters of the best rows, the column that ranks them, and their status. The table shows \
six digits and prefixes of units; csv and json contain the cells of FILE. Rows without a value are left out. Rows with equal \
values keep their order. If FILE is unfinished, the rows up to the last checkpoint are ranked.

Examples:
  flap top sweep.csv --by efficiency_gf_per_w
  flap top sweep.csv --by lift_mean_mn -n 3 --where 'power_mean_mw<20' --where drive_voltage_pp='80 V'
  flap top sweep.parquet --by floquet_max --aim max --columns period,stable --all
  flap top sweep.csv --by lift_mean_mn --format csv > best.csv";

#[derive(clap::Args)]
#[command(after_help = DESCRIBE_HELP)]
pub(crate) struct DescribeArgs {
    /// Measures for which the best values of each axis are listed, separated by commas. [default: lift_mean_mn and
    /// efficiency_gf_per_w, or the first measure of a file that has neither]
    #[arg(long, value_name = "COLUMN,...", value_delimiter = ',')]
    pub(crate) by: Vec<String>,

    /// Columns to summarize, separated by commas [default: all columns after the parameters]
    ///
    /// Columns of numbers are summarized by percentiles. In columns of words, such as true and false, each word is counted.
    #[arg(long, value_name = "COLUMN,...", value_delimiter = ',')]
    pub(crate) columns: Vec<String>,

    #[command(flatten)]
    pub(crate) look: LookArgs,
}

const DESCRIBE_HELP: &str = "\
Prints three kinds of tables. The first has the number of rows of each status. The second has the smallest value, the 5th, \
50th and 95th percentile and the largest value of each measure. There is one table of the third kind for each \
main measure. For each axis, it has the value in the best row, and the values in the best tenth of the rows. If that range \
is wide, the axis matters little. `at the end` means that a wider axis may contain better designs. An axis is a varied parameter; in results of \
`flap respond`, the branch is an axis too.

Examples:
  flap describe sweep.csv
  flap describe sweep.csv --by power_mean_mw --aim min --where 'lift_mean_mn>1'
  flap describe sweep.parquet --columns lift_mean_mn,stroke_pp_deg --format json";

/// The choice of rows, and the format of a summary.
#[derive(clap::Args)]
pub(crate) struct LookArgs {
    /// Results of `flap sweep`, `flap respond --out` or `flap results`
    #[arg(value_name = "FILE")]
    pub(crate) results: PathBuf,

    /// Better direction of the measure [default: min for power, current, strain, field, drag and force, max for other columns]
    #[arg(long, value_enum)]
    pub(crate) aim: Option<Aim>,

    /// Use only the rows that satisfy this condition. May be repeated
    ///
    /// COLUMN=VALUE takes a number as in the file, a number with a unit, or a word. A comparison may have several parts, as in
    /// 'lift_mean_mn > 1 and drive_frequency < 0.1 kHz'.
    #[arg(long = "where", value_name = "COLUMN=VALUE|COMPARISON", value_parser = filter)]
    pub(crate) filters: Vec<Filter>,

    /// Use rows of every status, not only periodic ones
    #[arg(long)]
    pub(crate) all: bool,

    /// Output format
    #[arg(long, value_enum, default_value_t = OutputFormat::Table)]
    pub(crate) format: OutputFormat,

    #[command(flatten)]
    pub(crate) read: ReadArgs,
}
