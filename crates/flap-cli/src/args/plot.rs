//! Arguments of `flap plot`.

use std::path::PathBuf;

use clap::ValueEnum;

use super::filter::{Filter, filter};
use super::options::{Aim, OverwriteArgs, ReadArgs};

#[derive(clap::Args)]
#[command(after_help = PLOT_HELP)]
pub(crate) struct PlotArgs {
    /// Results of `flap sweep`, `flap respond --out` or `flap results`, a trajectory of `flap run`, or a matrix of `flap vehicle`
    #[arg(value_name = "FILE")]
    pub(crate) results: PathBuf,

    /// File for the picture. The ending of the name sets the format: .svg or .png. [default: FILE's name with the ending .svg, in
    /// the working directory. No picture with --html]
    #[arg(short, long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,

    /// File for an HTML page, on which you explore the results in a browser
    ///
    /// On the page you choose columns, filter rows and read values. The page works without a network.
    #[arg(long, value_name = "FILE")]
    pub(crate) html: Option<PathBuf>,

    /// Kind of picture [default: depends on the columns of the file; the text below the options lists the kinds]
    #[arg(short, long, value_enum)]
    pub(crate) kind: Option<PictureKind>,

    /// Column on the horizontal axis; for a histogram or a tornado, the measure
    #[arg(short, long, value_name = "COLUMN")]
    pub(crate) x: Option<String>,

    /// Column on the vertical axis
    #[arg(short, long, value_name = "COLUMN")]
    pub(crate) y: Option<String>,

    /// Column that distinguishes the lines: flap draws one line for each value of this column
    #[arg(long, value_name = "COLUMN")]
    pub(crate) by: Option<String>,

    /// Column that sets the colour of the cells of a map, or of the points of a scatter or Pareto picture
    #[arg(long, value_name = "COLUMN")]
    pub(crate) color: Option<String>,

    /// Use only the rows that satisfy the condition. You can repeat --where
    ///
    /// In COLUMN=VALUE, VALUE is a number as in the file, a number with a unit, or a text. A comparison may have several parts,
    /// such as 'lift_mean_mn > 1 and drive_frequency < 0.1 kHz'. If the picture does not show an axis of the sweep,
    /// flap draws only the rows at the middle value of this axis. With --where you choose another value of the axis.
    #[arg(long = "where", value_name = "COLUMN=VALUE|COMPARISON", value_parser = filter)]
    pub(crate) filters: Vec<Filter>,

    /// Axis that the picture does not show. Each cell of a map, or each point of a line, shows the best row of all
    /// values of this axis. You can repeat --best-over
    ///
    /// The best row is the row with the largest value of the measure. For power, current, strain, field, drag and
    /// force, the best row is the row with the smallest value. With --where, flap chooses among the rows that satisfy
    /// the conditions. Without --best-over, flap draws the rows at the middle value of the axis.
    #[arg(long, value_name = "COLUMN")]
    pub(crate) best_over: Vec<String>,

    /// Better direction of the column x in a Pareto picture [default: min for power, current, strain, field,
    /// drag and force, max for other columns]
    #[arg(long, value_enum)]
    pub(crate) x_aim: Option<Aim>,

    /// Better direction of the column y in a Pareto picture [default: as for x]
    #[arg(long, value_enum)]
    pub(crate) y_aim: Option<Aim>,

    /// Heading of the picture [default: the name of the file]
    #[arg(long, value_name = "TEXT")]
    pub(crate) title: Option<String>,

    /// Width and height of an SVG (pixels); a PNG has twice as many pixels in each direction
    #[arg(long, value_name = "WxH", default_value = "900x560", value_parser = size)]
    pub(crate) size: Size,

    #[command(flatten)]
    pub(crate) read: ReadArgs,

    #[command(flatten)]
    pub(crate) overwrite: OverwriteArgs,
}

impl PlotArgs {
    /// Returns the conditions `COLUMN=VALUE` as names and values.
    pub(crate) fn values(&self) -> Vec<(String, String)> {
        let value = |filter: &Filter| match filter {
            Filter::Equal(name, value) => Some((name.clone(), value.clone())),
            Filter::Comparison(_) => None,
        };
        self.filters.iter().filter_map(value).collect()
    }

    /// Returns the conditions that are comparisons.
    pub(crate) fn comparisons(&self) -> Vec<Filter> {
        self.filters.iter().filter(|filter| matches!(filter, Filter::Comparison(_))).cloned().collect()
    }
}

/// The kind of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum PictureKind {
    /// A measure against a parameter, with one line for each value of another column
    Response,
    /// A measure as the colour of cells, against two parameters
    Map,
    /// Two measures of every design as points, coloured by a third column
    Scatter,
    /// The number of designs in each range of a measure, with the 5th, 50th and 95th percentile
    Histogram,
    /// The rank correlation (Spearman) of a measure with each varied parameter, as bars
    Tornado,
    /// Two measures of every design, with the Pareto front: the designs for which no other design is better in both
    /// measures
    Pareto,
    /// Stroke and pitch over time, and their phase portrait (rates against angles)
    Trajectory,
    /// The rising and the falling branch of a response; unstable orbits are dashed
    Hysteresis,
    /// The effect of each input of a vehicle on force and torque, read from the output of `flap vehicle --format csv`
    Matrix,
}

impl PictureKind {
    /// Returns the name on the command line.
    pub(crate) fn name(self) -> String {
        self.to_possible_value().map(|value| value.get_name().to_owned()).unwrap_or_default()
    }
}

/// The size of a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Size {
    pub(crate) width: f64,
    pub(crate) height: f64,
}

const PLOT_HELP: &str = "\
If you do not give --kind, flap chooses the kind of picture from the file: `hysteresis` for results of `flap respond`, \
`trajectory` for a motion, `matrix` for the output of `flap vehicle --format csv`, and `scatter` for results of a sample. \
For a sweep of one parameter, or of the drive frequency and other parameters, the kind is `response`. For other sweeps of \
two or more parameters, the kind is `map`. If --x and --y are measures, the kind is `pareto`, or `scatter` for a sample \
and for a sweep of one parameter.

If you give no columns, a scatter or Pareto picture shows the mean lift against the mean power. The points of a scatter \
picture are coloured by the peak-to-peak stroke. A histogram or a tornado shows the mean lift. If the file does not have \
these measures, flap draws other measures. If a grid combines a sample with an axis, flap draws only the rows at the \
middle value of the axis.

Examples:
  flap plot sweep.csv
  flap plot sweep.csv --y lift_mean_mn --by hinge_stiffness --where drive_voltage_pp=100 --out lift.svg
  flap plot sweep.csv --kind map --color efficiency_gf_per_w --out map.png
  flap plot sweep.csv --kind map --best-over drive_frequency --where 'stroke_pp_deg < 100 deg'
  flap plot sweep.csv --kind pareto --x lift_mean_mn --y power_mean_mw --color drive_frequency
  flap plot sample.csv --kind histogram --x lift_mean_mn --out lift.png
  flap plot sample.csv --kind tornado --x efficiency_gf_per_w
  flap plot loop.csv --y stroke_pp_deg --out loop.png --size 700x500
  flap plot sweep.parquet --html sweep.html";

/// Parses a size `WxH` (pixels); both numbers are from 200 to 4000.
fn size(text: &str) -> Result<Size, String> {
    let number = |text: &str| text.trim().parse::<u16>().ok().filter(|side| (200..=4000).contains(side));
    let sides = text.split_once(['x', 'X', '×']).and_then(|(w, h)| number(w).zip(number(h)));
    let (width, height) = sides.ok_or("expected WxH, each from 200 to 4000, such as 900x560")?;
    Ok(Size { width: f64::from(width), height: f64::from(height) })
}
