//! `flap plot`.

use std::path::PathBuf;

use clap::ValueEnum;

use super::filter::{Filter, filter};
use super::options::{Aim, OverwriteArgs, ReadArgs};

#[derive(clap::Args)]
#[command(after_help = PLOT_HELP)]
pub(crate) struct PlotArgs {
    /// Results of `flap sweep`, `flap respond --out` or `flap results`, or a trajectory of `flap run`
    #[arg(value_name = "FILE")]
    pub(crate) results: PathBuf,

    /// File for the picture; the ending chooses the format: .svg or .png [default: FILE's name with the ending
    /// .svg, in the working directory; none with --html]
    #[arg(short, long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,

    /// File for a page to explore in a browser: choose columns, filter rows, read their values. It needs no network
    #[arg(long, value_name = "FILE")]
    pub(crate) html: Option<PathBuf>,

    /// Kind of picture [default: the one that fits the columns of the file, see below]
    #[arg(short, long, value_enum)]
    pub(crate) kind: Option<PictureKind>,

    /// Column of the horizontal axis; the measure of a histogram or a tornado
    #[arg(short, long, value_name = "COLUMN")]
    pub(crate) x: Option<String>,

    /// Column of the vertical axis
    #[arg(short, long, value_name = "COLUMN")]
    pub(crate) y: Option<String>,

    /// One line for each value of this column
    #[arg(long, value_name = "COLUMN")]
    pub(crate) by: Option<String>,

    /// Column shown as the colour of the cells of a map, or of the points of a scatter or a Pareto picture
    #[arg(long, value_name = "COLUMN")]
    pub(crate) color: Option<String>,

    /// Draw only the rows with this value (a number as in the file, a number with a unit, or a word), or for which this
    /// comparison holds: 'lift_mean_mn > 1 and cycles < 100'. May be repeated. An axis of the sweep that the picture does
    /// not show is fixed at its middle value, unless its value is given here
    #[arg(long = "where", value_name = "COLUMN=VALUE|COMPARISON", value_parser = filter)]
    pub(crate) filters: Vec<Filter>,

    /// The better direction of x in a Pareto picture [default: min for power, current, strain, field, drag and force,
    /// max for other columns]
    #[arg(long, value_enum)]
    pub(crate) x_aim: Option<Aim>,

    /// The better direction of y in a Pareto picture [default: as for x]
    #[arg(long, value_enum)]
    pub(crate) y_aim: Option<Aim>,

    /// Heading [default: the name of the file]
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
    /// The columns that must have a value, with it.
    pub(crate) fn values(&self) -> Vec<(String, String)> {
        let value = |filter: &Filter| match filter {
            Filter::Equal(name, value) => Some((name.clone(), value.clone())),
            Filter::Comparison(_) => None,
        };
        self.filters.iter().filter_map(value).collect()
    }

    /// The comparisons that rows must satisfy.
    pub(crate) fn comparisons(&self) -> Vec<Filter> {
        self.filters.iter().filter(|filter| matches!(filter, Filter::Comparison(_))).cloned().collect()
    }
}

/// The kind of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum PictureKind {
    /// A measure over a parameter, one line for each value of another
    Response,
    /// A measure as the colour of cells over two parameters
    Map,
    /// Two measures of every design as points, in the colours of a third
    Scatter,
    /// The number of designs over a measure, with the percentiles 5, 50 and 95
    Histogram,
    /// The rank correlation (Spearman) of each parameter that varies with a measure, as bars
    Tornado,
    /// Two measures of every design, and the Pareto front: the designs that no other design beats in both
    Pareto,
    /// Stroke and pitch over time, and their phase portrait: rates over angles
    Trajectory,
    /// The branches up and down of a response, unstable orbits dashed
    Hysteresis,
    /// The effect of each input of a vehicle on force and torque, as `flap vehicle --format csv` writes it
    Matrix,
}

impl PictureKind {
    /// The name on the command line.
    pub(crate) fn name(self) -> String {
        self.to_possible_value().map(|value| value.get_name().to_owned()).unwrap_or_default()
    }
}

/// Width and height of a picture (pixels).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Size {
    pub(crate) width: f64,
    pub(crate) height: f64,
}

const PLOT_HELP: &str = "\
The default of --kind is `hysteresis` for results of `flap respond`, `trajectory` for a motion, `matrix` for what `flap vehicle \
--format csv` writes, `scatter` for a sample, \
`response` for a sweep of one parameter or of the drive frequency and others, `map` for other sweeps of two or more \
parameters. With measures as --x and --y it is `pareto`, or `scatter` for a sample and for a sweep of one parameter.

Without names of columns, a scatter or a Pareto picture shows the mean lift over the mean power, a scatter in the colours \
of the stroke from peak to peak; a histogram or a tornado shows the mean lift. Another measure of the file takes the place \
of one that is missing. An axis that is crossed with a sample is fixed at its middle value.

Examples:
  flap plot sweep.csv
  flap plot sweep.csv --y lift_mean_mn --by hinge_stiffness --where drive_voltage_pp=100 --out lift.svg
  flap plot sweep.csv --kind map --color efficiency_gf_per_w --out map.png
  flap plot sweep.csv --kind pareto --x lift_mean_mn --y power_mean_mw --color drive_frequency
  flap plot sample.csv --kind histogram --x lift_mean_mn --out lift.png
  flap plot sample.csv --kind tornado --x efficiency_gf_per_w
  flap plot loop.csv --y stroke_pp_deg --out loop.png --size 700x500
  flap plot sweep.parquet --html sweep.html";

/// Width and height from `WxH` (pixels), each from 200 to 4000.
fn size(text: &str) -> Result<Size, String> {
    let number = |text: &str| text.trim().parse::<u16>().ok().filter(|side| (200..=4000).contains(side));
    let sides = text.split_once(['x', 'X', '×']).and_then(|(w, h)| number(w).zip(number(h)));
    let (width, height) = sides.ok_or("expected WxH, each from 200 to 4000, such as 900x560")?;
    Ok(Size { width: f64::from(width), height: f64::from(height) })
}
