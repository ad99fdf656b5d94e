//! Arguments of commands that summarize results: `flap top` and `flap describe`.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use super::filter::{Filter, filter};
use super::options::{Aim, OutputFormat, ReadArgs};
use super::values;

#[derive(clap::Args)]
#[command(after_help = TOP_HELP)]
pub(crate) struct TopArgs {
    /// Column by which flap ranks the rows
    #[arg(long, value_name = "COLUMN")]
    pub(crate) by: String,

    /// Number of rows to list
    #[arg(short = 'n', long, value_name = "N", default_value = "10", value_parser = values::rows)]
    pub(crate) rows: NonZeroUsize,

    /// Additional columns to list, separated by commas
    #[arg(long, value_name = "COLUMN,...", value_delimiter = ',')]
    pub(crate) columns: Vec<String>,

    #[command(flatten)]
    pub(crate) look: LookArgs,
}

const TOP_HELP: &str = "\
For each of the best rows, flap lists the varied and derived parameters, the ranking column, and the status. The table \
shows numbers with six digits and units with prefixes; csv and json contain the cells exactly as in FILE. Rows whose \
ranking column is empty are left out. Rows with equal values in the ranking column are listed in the order of FILE. If \
the best row is at the end of an axis, flap prints a note, because points beyond this end could be better. If FILE is \
unfinished, flap ranks the rows up to the last checkpoint.

Examples:
  flap top sweep.csv --by efficiency_gf_per_w
  flap top sweep.csv --by lift_mean_mn -n 3 --where 'power_mean_mw<20' --where drive_voltage_pp='80 V'
  flap top sweep.parquet --by floquet_max --aim max --columns period,stable --all
  flap top sweep.csv --by lift_mean_mn --format csv > best.csv";

#[derive(clap::Args)]
#[command(after_help = DESCRIBE_HELP)]
pub(crate) struct DescribeArgs {
    /// Measures, separated by commas: for each measure, flap lists the values of the axes in the best row.
    /// [default: lift_mean_mn and efficiency_gf_per_w, or the first measure if the file has neither column]
    #[arg(long, value_name = "COLUMN,...", value_delimiter = ',')]
    pub(crate) by: Vec<String>,

    /// Columns to summarize, separated by commas [default: all columns after the parameters]
    ///
    /// For a column with numbers, flap prints mean, standard deviation and percentiles. For a column with text, such as
    /// true and false, flap counts the rows with each text.
    #[arg(long, value_name = "COLUMN,...", value_delimiter = ',')]
    pub(crate) columns: Vec<String>,

    #[command(flatten)]
    pub(crate) look: LookArgs,
}

const DESCRIBE_HELP: &str = "\
flap prints three kinds of tables. The first table has the number of rows with each status. For each measure, the \
second table has the mean, the standard deviation, the smallest value, the 5th, 50th and 95th percentile and the \
largest value; csv and json also have the standard error of the mean. For each measure of --by, one more table shows \
the best values of the axes. For each axis, this table has the value in the best row, and the range of values in the \
best tenth of the rows. If the best tenth of the rows has a wide range of values of an axis, this axis has little \
influence on the measure. `at the end` means that the best value is at an end of the axis: a wider axis could contain \
better designs. An axis is a varied parameter. In results of `flap respond`, the branch is also an axis.

Examples:
  flap describe sweep.csv
  flap describe sweep.csv --by power_mean_mw --aim min --where 'lift_mean_mn>1'
  flap describe sweep.parquet --columns lift_mean_mn,stroke_pp_deg --format json";

/// Options of commands that summarize results: the rows to use, and the output format.
#[derive(clap::Args)]
pub(crate) struct LookArgs {
    /// Results of `flap sweep`, `flap respond --out` or `flap results`
    #[arg(value_name = "FILE")]
    pub(crate) results: PathBuf,

    /// Direction in which the measure is better: larger or smaller values [default: min for power, current,
    /// strain, field, drag, force_1, force_2 and hover_growth_1_s, otherwise max]
    #[arg(long, value_enum)]
    pub(crate) aim: Option<Aim>,

    /// Use only the rows that satisfy the condition. You can repeat --where
    ///
    /// In COLUMN=VALUE, VALUE is a number in the unit of the column, a number with a unit, or a text. A
    /// comparison may have several parts, such as 'lift_mean_mn > 1 and drive_frequency < 0.1 kHz'. Put text
    /// in a comparison in quotes: "device == 'long'".
    #[arg(long = "where", value_name = "COLUMN=VALUE|COMPARISON", value_parser = filter)]
    pub(crate) filters: Vec<Filter>,

    /// Use rows of every status, not only rows with the status `periodic`
    #[arg(long)]
    pub(crate) all: bool,

    /// Output format
    #[arg(long, value_enum, default_value_t = OutputFormat::Table)]
    pub(crate) format: OutputFormat,

    #[command(flatten)]
    pub(crate) read: ReadArgs,
}
