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

    /// File for the picture. The ending of the name sets the format: .svg or .png. [default: the name
    /// of FILE with the ending .svg, in the working directory; no picture with --html]
    #[arg(short, long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,

    /// File for an HTML page, on which you explore the results in a browser
    ///
    /// On the page you choose columns, filter rows and read values. The page works without a network.
    #[arg(long, value_name = "FILE")]
    pub(crate) html: Option<PathBuf>,

    /// Kind of picture [default: depends on the columns of the file; the text below the options explains the
    /// choice]
    #[arg(short, long, value_enum)]
    pub(crate) kind: Option<PictureKind>,

    /// Column on the horizontal axis; in a histogram or a tornado picture, the measure that the picture shows
    #[arg(short, long, value_name = "COLUMN")]
    pub(crate) x: Option<String>,

    /// Column on the vertical axis
    #[arg(short, long, value_name = "COLUMN")]
    pub(crate) y: Option<String>,

    /// Column that distinguishes the lines: flap draws one line for each value of this column
    #[arg(long, value_name = "COLUMN")]
    pub(crate) by: Option<String>,

    /// Column that sets the colour of the cells of a map, or of the points of a scatter or Pareto picture. In a scatter,
    /// the column can contain text, such as device
    #[arg(long, value_name = "COLUMN")]
    pub(crate) color: Option<String>,

    /// Use only the rows that satisfy the condition. You can repeat --where
    ///
    /// In COLUMN=VALUE, VALUE is a number in the unit of the column, a number with a unit, or a text. A
    /// comparison may have several parts, such as 'lift_mean_mn > 1 and drive_frequency < 0.1 kHz'. Put text
    /// in a comparison in quotes: "device == 'long'". If the picture does not show an axis of the sweep, flap
    /// draws only the rows at the middle value of this axis. Use --where to choose a different value of the
    /// axis. A Pareto picture shows the designs at all values of all axes.
    #[arg(long = "where", value_name = "COLUMN=VALUE|COMPARISON", value_parser = filter)]
    pub(crate) filters: Vec<Filter>,

    /// Axis along which flap compares rows and draws only the best row. For each cell of a map, and for each
    /// point of a line, flap chooses from the rows at all values of the axis. You can repeat --best-over
    ///
    /// The best row is the row with the largest value of the drawn measure. For power, current, strain,
    /// field, drag, force_1, force_2 and hover_growth_1_s, the best row has the smallest value. With --where,
    /// flap chooses the best row only among the rows that satisfy the conditions. Without --best-over, flap
    /// draws the rows at the middle value of the axis.
    #[arg(long, value_name = "COLUMN")]
    pub(crate) best_over: Vec<String>,

    /// Direction in which column x is better in a Pareto picture [default: min for power, current, strain,
    /// field, drag, force_1, force_2 and hover_growth_1_s, otherwise max]
    #[arg(long, value_enum)]
    pub(crate) x_aim: Option<Aim>,

    /// Direction in which column y is better in a Pareto picture [default: min or max, by the rule of
    /// --x-aim]
    #[arg(long, value_enum)]
    pub(crate) y_aim: Option<Aim>,

    /// In a tornado picture, show the change of the measure per standard deviation of each parameter. flap computes
    /// this change twice: from derivatives and from the sample
    ///
    /// The derivatives are the columns of [gradient], averaged over the designs. If the file has no columns
    /// of [gradient], flap computes the derivatives at the means of the parameters, from the grid in the
    /// sidecar.
    #[arg(long, conflicts_with = "html")]
    pub(crate) derivatives: bool,

    /// Heading of the picture; '' draws no heading [default: the name of the results file]
    #[arg(long, value_name = "TEXT")]
    pub(crate) title: Option<String>,

    /// Width and height of the picture: in pixels, such as 900x560, or on paper, such as 84x60mm, 8.4x6cm or
    /// 3.3x2.4in
    ///
    /// If you give the size in pixels, a PNG has twice the given number of pixels in each direction. If you
    /// give the size on paper, an SVG has this size, and a PNG has the resolution of --dpi.
    #[arg(long, value_name = "WxH", default_value = "900x560", value_parser = size)]
    pub(crate) size: PictureSize,

    /// Size of the text on paper (points); requires a --size with a unit of length, such as 84x60mm [default:
    /// 8]
    #[arg(long, value_name = "PT", value_parser = font_size)]
    pub(crate) font_size: Option<f64>,

    /// Pixels per inch of a PNG; requires a --size with a unit of length, such as 84x60mm [default: 300]
    #[arg(long, value_name = "N", value_parser = dpi)]
    pub(crate) dpi: Option<f64>,

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
    /// Two measures of every design as points, coloured by a third column, or by device or preset if the file has
    /// several devices or presets
    Scatter,
    /// The number of designs in each range of a measure, with the 5th, 50th and 95th percentile
    Histogram,
    /// The rank correlation (Spearman) of a measure with each varied parameter, as bars
    Tornado,
    /// Two measures of every design, with the Pareto front: the designs for which no other design is better in both
    /// measures
    Pareto,
    /// Stroke and pitch over time, and the phase portraits of stroke and pitch (rate against angle)
    Trajectory,
    /// The rising and the falling branch of a response; unstable orbits are dashed
    Hysteresis,
    /// The effect of each input of a vehicle on force and torque, read from the output of `flap vehicle --format csv`
    Matrix,
}

impl PictureKind {
    /// Returns the name of the picture on the command line, such as `tornado`.
    pub(crate) fn name(self) -> String {
        self.to_possible_value().map(|value| value.get_name().to_owned()).unwrap_or_default()
    }
}

/// The size of a picture: width and height.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum PictureSize {
    /// Width and height in pixels. A PNG has twice the given number of pixels in each direction.
    Pixels([u16; 2]),
    /// Width and height on paper (mm).
    Print([f64; 2]),
}

const PLOT_HELP: &str = "\
If you do not give --kind, flap chooses the kind of picture from the file: `hysteresis` for results of `flap respond`, \
`trajectory` for a motion, `matrix` for the output of `flap vehicle --format csv`, and `scatter` for results of a sample. \
For a sweep of one parameter, or of the drive frequency and other parameters, the kind is `response`. For other sweeps of \
two or more parameters, the kind is `map`. If --x and --y are measures, the kind is `pareto`, or `scatter` for a sample \
and for a sweep of one parameter.

If you give no columns, a scatter or Pareto picture shows the mean lift against the mean power. The points of a \
scatter picture are coloured by the peak-to-peak stroke. A histogram or a tornado picture shows the mean lift. If the file \
does not have the default measures, flap draws other measures of the file. If a grid combines a sample with an axis, \
flap draws only the rows at the middle value of the axis.

Examples:
  flap plot sweep.csv
  flap plot sweep.csv --y lift_mean_mn --by hinge_stiffness --where drive_voltage_pp=100 --out lift.svg
  flap plot sweep.csv --kind map --color efficiency_gf_per_w --out map.png
  flap plot sweep.csv --kind map --best-over drive_frequency --where 'stroke_pp_deg < 100 deg'
  flap plot sweep.csv --kind pareto --x lift_mean_mn --y power_mean_mw --color drive_frequency
  flap plot sample.csv --kind histogram --x lift_mean_mn --out lift.png
  flap plot sample.csv --kind tornado --x efficiency_gf_per_w
  flap plot sample.csv --kind tornado --derivatives --out effects.png
  flap plot loop.csv --y stroke_pp_deg --out loop.png --size 700x500
  flap plot loop.csv --y stroke_pp_deg --out loop.svg --size 84x60mm --font-size 8
  flap plot sweep.parquet --html sweep.html";

/// Units of length for the size of a picture on paper, with the length of each unit in mm.
const LENGTHS: [(&str, f64); 3] = [("mm", 1.0), ("cm", 10.0), ("in", 25.4)];

/// Parses a size `WxH`: in pixels from 200 to 4000, or with a unit of length, from 10 mm to 2000 mm.
fn size(text: &str) -> Result<PictureSize, String> {
    let text = text.trim();
    let unit = LENGTHS.into_iter().find_map(|(unit, mm)| Some((text.strip_suffix(unit)?, unit, mm)));
    let (sides, unit, mm) = unit.unwrap_or((text, "", 1.0));
    // The unit may also follow the width.
    let number = |side: &str| {
        let side = side.trim();
        side.strip_suffix(unit).unwrap_or(side).trim().parse::<f64>().ok()
    };
    let sides = sides.split_once(['x', 'X', '×', ',']);
    let sides = sides.and_then(|(width, height)| Some([number(width)?, number(height)?]));
    if unit.is_empty() {
        let pixels = |side: f64| (200.0..=4000.0).contains(&side) && side.fract() == 0.0;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 200 to 4000")]
        return match sides {
            Some(sides) if sides.into_iter().all(pixels) => Ok(PictureSize::Pixels(sides.map(|side| side as u16))),
            _ => Err("expected WxH in pixels, each from 200 to 4000, such as 900x560, or in print, such as 84x60mm".to_owned()),
        };
    }
    let sides = sides.map(|sides| sides.map(|side| side * mm));
    match sides {
        Some(sides) if sides.into_iter().all(|side| (10.0..=2000.0).contains(&side)) => {
            Ok(PictureSize::Print(sides))
        }
        _ => Err(
            "expected WxH with a unit of length, each from 10 mm to 2000 mm, such as 84x60mm or 3.3x2.4in"
                .to_owned(),
        ),
    }
}

/// Parses the size of the text on paper (pt).
fn font_size(text: &str) -> Result<f64, String> {
    between(text.trim().trim_end_matches("pt"), 4.0, 72.0, "points, such as 8")
}

/// Parses the resolution of a PNG on paper (pixels per inch).
fn dpi(text: &str) -> Result<f64, String> {
    between(text, 50.0, 2400.0, "pixels per inch, such as 600")
}

/// Parses a number within a range.
fn between(text: &str, low: f64, high: f64, meaning: &str) -> Result<f64, String> {
    let number = text.trim().parse::<f64>().ok().filter(|number| (low..=high).contains(number));
    number.ok_or_else(|| format!("expected a number from {low} to {high}: {meaning}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_pixels_or_lengths() {
        assert_eq!(size("900x560"), Ok(PictureSize::Pixels([900, 560])));
        for text in ["84x60mm", "84mmx60mm", "84mm,60mm", "8.4 x 6 cm", " 84 mm × 60 mm"] {
            let Ok(PictureSize::Print(sides)) = size(text) else { panic!("{text}") };
            assert!((sides[0] - 84.0).abs() < 1e-9 && (sides[1] - 60.0).abs() < 1e-9, "{text}: {sides:?}");
        }
        assert_eq!(size("2x1in"), Ok(PictureSize::Print([50.8, 25.4])));
        for text in ["10x10", "84x60cm2", "84mm", "84x60 m", "4x4mm", "900.5x560", "nanx60mm", "84mmx6cm"] {
            assert!(size(text).is_err(), "{text}");
        }
    }

    #[test]
    fn text_and_resolution_have_ranges() {
        assert_eq!((font_size("8"), font_size("6.5 pt"), dpi("600")), (Ok(8.0), Ok(6.5), Ok(600.0)));
        assert!(font_size("0").is_err() && font_size("x").is_err() && dpi("1e9").is_err());
    }
}
