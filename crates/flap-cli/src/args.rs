//! What is typed on the command line.

#[cfg(feature = "plots")]
mod plot;
mod respond;
mod results;

use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::sync::LazyLock;

use clap::{Parser, Subcommand, ValueEnum, value_parser};
use flap_sweep::notation::units;
use flap_sweep::plan::selection::Shard;
use flap_sweep::run::identity;
#[cfg(feature = "plots")]
pub(crate) use plot::{Aim, PictureKind, PlotArgs, Size};
pub(crate) use respond::RespondArgs;
pub(crate) use results::{ConvertArgs, MergeArgs, ReadArgs, RerunArgs, ResumeArgs, VerifyArgs, WorkArgs};

/// Sweeps of insect-scale flapping-wing designs: a grid file goes in, one row per design point comes out.
#[derive(Parser)]
#[command(name = "flap", version, long_version = long_version(), max_term_width = 100, after_help = EXIT_CODES)]
pub(crate) struct Args {
    #[command(subcommand)]
    pub(crate) command: Command,
}

/// The version with what tells two builds of it apart.
fn long_version() -> &'static str {
    static TEXT: LazyLock<String> = LazyLock::new(|| {
        let (version, build) = (env!("CARGO_PKG_VERSION"), identity::build());
        format!("{version}\nbuild {build} (a hash of the sources that decide the bytes of rows)")
    });
    &TEXT
}

#[derive(Subcommand)]
pub(crate) enum Command {
    /// Run every point of a grid file and write one row per point
    Sweep(SweepArgs),
    /// Go on with an interrupted sweep
    Resume(ResumeArgs),
    /// Run points of earlier results again with other solver settings
    Rerun(RerunArgs),
    /// Put the shards of a sweep together
    Merge(MergeArgs),
    /// Write results in another format
    Convert(ConvertArgs),
    /// Check that results are as they were written
    Verify(VerifyArgs),
    /// Run one point and print what it measures
    Run(RunArgs),
    /// Follow the response of designs up and down in frequency or another parameter, and find hysteresis
    Respond(RespondArgs),
    /// Draw results: a picture, or a page to explore them
    #[cfg(feature = "plots")]
    Plot(PlotArgs),
    /// Compare the resonances of one point: linear, free and driven
    Resonance(ResonanceArgs),
    /// Check a grid file and show what it would run
    Check(CheckArgs),
    /// Forces on a wing whose stroke and pitch are given, as filmed
    Lift(LiftArgs),
    /// Stroke, pitch and rotation centre of a filmed wing from tracked points
    Track(TrackArgs),
    /// List the parameters and output columns of a model
    Params(ParamsArgs),
    /// List the models and their presets
    Models,
}

const EXIT_CODES: &str = "\
Results go to stdout, everything else to stderr.

Exit codes:
  0    done
  1    with --strict: done, but not every point is periodic; `verify`: not every file has checksums
  2    the command line or the grid file must be corrected
  3    reading or writing failed, or results are damaged
  130  interrupted; `flap resume` goes on
  101  a mistake in flap itself";

#[derive(clap::Args)]
#[command(after_help = SWEEP_HELP)]
pub(crate) struct SweepArgs {
    /// The grid file: preset, parameters and axes
    #[arg(short, long, value_name = "FILE", required_unless_present = "from_sidecar")]
    pub(crate) grid: Option<PathBuf>,

    /// Run again what the sidecar of other results tells of, .meta.toml
    #[arg(long, value_name = "FILE", conflicts_with_all = ["grid", "shard"], requires = "out")]
    pub(crate) from_sidecar: Option<PathBuf>,

    /// Where to write rows, or `-` for stdout [default: the output path in the grid file, else the grid
    /// file's name with the ending .csv, in the working directory]. The ending chooses the format: .csv, .csv.zst or
    /// .parquet
    #[arg(short, long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,

    /// Run only one of N equal parts, for several machines; `flap merge` puts them together. Without --out, rows go to a
    /// name such as grid.2of8.csv
    #[arg(long, value_name = "I/N")]
    pub(crate) shard: Option<Shard>,

    /// Go on if the sweep was interrupted; start it if there are no results, do nothing if they are complete
    #[arg(long, conflicts_with = "force")]
    pub(crate) resume: bool,

    /// Replace existing results. They are kept beside the new ones, as in grid.old.csv, until those are complete
    #[arg(short, long)]
    pub(crate) force: bool,

    #[command(flatten)]
    pub(crate) work: WorkArgs,
}

const SWEEP_HELP: &str = "\
Rows leave in point order as they are computed. Ctrl-C and SIGTERM leave the points in hand half a second, \
keep the rows and exit with 130; a second one exits at once. Beside FILE, FILE.meta.toml says where the rows come \
from. Until the sweep is complete, FILE.journal says how far they are, so that `flap resume FILE` can go on, \
whatever ended it.

Examples:
  flap sweep --grid grid.toml
  flap sweep --grid grid.toml --out results/run1.csv --threads 8
  flap sweep --grid grid.toml --out run1.parquet --resume
  flap sweep --grid grid.toml --shard 2/8
  flap sweep --from-sidecar run1.csv.meta.toml --out again.csv
  flap sweep --grid grid.toml --out - | head";

#[derive(clap::Args)]
#[command(after_help = RUN_HELP)]
pub(crate) struct RunArgs {
    #[command(flatten)]
    pub(crate) point: PointArgs,

    /// Drive: `steady` runs the point's own drive until the motion settles; `chirp` sweeps the frequency from
    /// rest and prints one CSV row per cycle; `impulse` gives the resting stroke an impulse and holds the drive
    /// still
    #[arg(long, value_enum, default_value_t = Drive::Steady)]
    pub(crate) drive: Drive,

    /// Frequency at which the chirp begins (Hz) [default: 1]
    #[arg(long, value_name = "HZ")]
    pub(crate) chirp_from: Option<f64>,

    /// Frequency at which the chirp ends (Hz) [default: twice the point's drive frequency]
    #[arg(long, value_name = "HZ")]
    pub(crate) chirp_to: Option<f64>,

    /// Rate of change of the chirp's frequency (Hz/s); negative for a falling chirp [default: 15]
    #[arg(long, value_name = "HZ/S", allow_negative_numbers = true)]
    pub(crate) chirp_rate: Option<f64>,

    /// Write the chirp's rows per cycle to a CSV file instead of stdout
    #[arg(long, value_name = "FILE")]
    pub(crate) envelope: Option<PathBuf>,

    /// Drive with the waveform in a CSV file in place of drive_shape: columns time_s (or time_ms) and wave. The
    /// file's duration is the drive period, unless drive_frequency is set
    #[arg(long, value_name = "FILE", conflicts_with = "stroke")]
    pub(crate) waveform: Option<PathBuf>,

    /// Prescribe the stroke in a CSV file: columns time_s (or time_ms) and stroke_deg (or stroke_rad). The
    /// file's duration is the drive period, unless drive_frequency is set
    #[arg(long, value_name = "FILE")]
    pub(crate) stroke: Option<PathBuf>,

    /// The waveform or stroke does not repeat: follow it once, from rest
    #[arg(long, requires = "trajectory")]
    pub(crate) once: bool,

    /// Impulse on the stroke, as the amplitude that the first mode alone would reach without damping: `20 deg` is a
    /// stroke rate of 2 pi f_1 20 deg [default: 20 deg]
    #[arg(long, value_name = "ANGLE", value_parser = angle, allow_hyphen_values = true)]
    pub(crate) impulse: Option<f64>,

    /// How long the motion after the impulse is followed, such as `50 ms` [default: ten periods of the first
    /// mode]
    #[arg(long, value_name = "TIME", value_parser = time)]
    pub(crate) duration: Option<f64>,

    /// Write the motion over time to a CSV file, or to stdout with `-` instead of the summary
    #[arg(short, long, value_name = "FILE")]
    pub(crate) trajectory: Option<PathBuf>,

    /// Drive periods of the trajectory
    #[arg(long, value_name = "N", default_value_t = 2, requires = "trajectory",
          value_parser = value_parser!(u32).range(1..=100_000))]
    pub(crate) cycles: u32,

    /// Samples of the trajectory per drive period; after an impulse, at least as many per period of the first mode
    #[arg(long, value_name = "N", default_value_t = 200, requires = "trajectory",
          value_parser = value_parser!(u32).range(1..=1_000_000))]
    pub(crate) samples: u32,

    /// Start the trajectory at rest instead of on the settled orbit
    #[arg(long, requires = "trajectory")]
    pub(crate) from_rest: bool,

    /// Overwrite existing files
    #[arg(short, long)]
    pub(crate) force: bool,

    #[command(flatten)]
    pub(crate) solver: SolverArgs,
}

/// What `flap run` drives a point with.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Drive {
    Steady,
    Chirp,
    Impulse,
}

const RUN_HELP: &str = "\
Examples:
  flap run ozaki2018-large
  flap run ozaki2018-large --set drive_frequency='120 Hz' --set drive_voltage_pp=150
  flap run grid.toml --point 17 --trajectory point17.csv
  flap run ozaki2018-large --trajectory - --from-rest --cycles 50
  flap run ozaki2018-small --drive chirp --chirp-from 150 --chirp-to 250 --envelope envelope.csv
  flap run ozaki2018-small --drive impulse --impulse '20 deg' --duration '50 ms' --trajectory free.csv";

#[derive(clap::Args)]
#[command(after_help = RESONANCE_HELP)]
pub(crate) struct ResonanceArgs {
    #[command(flatten)]
    pub(crate) point: PointArgs,

    /// Impulse on the stroke, as the amplitude that the first mode alone would reach without damping
    #[arg(long, value_name = "ANGLE", default_value = "20 deg", value_parser = angle, allow_hyphen_values = true)]
    pub(crate) impulse: f64,

    /// Periods of the first mode that the damped sine is fitted to
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = value_parser!(u32).range(2..=1000))]
    pub(crate) window_cycles: u32,

    /// Length of the motion whose spectrum is taken
    #[arg(long, value_name = "TIME", default_value = "1 s", value_parser = time)]
    pub(crate) spectrum_window: f64,

    /// Lowest drive frequency (Hz) [default: half of the lower natural frequency]
    #[arg(long, value_name = "HZ", value_parser = frequency)]
    pub(crate) from: Option<f64>,

    /// Highest drive frequency (Hz) [default: one and a half times the upper natural frequency]
    #[arg(long, value_name = "HZ", value_parser = frequency)]
    pub(crate) to: Option<f64>,

    /// How closely the peaks of the driven stroke are located (Hz)
    #[arg(long, value_name = "HZ", default_value = "0.05", value_parser = frequency)]
    pub(crate) tolerance: f64,

    /// A table to be read, or CSV with all digits
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub(crate) format: Format,

    #[command(flatten)]
    pub(crate) solver: SolverArgs,
}

/// How results are printed.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    Text,
    Csv,
}

const RESONANCE_HELP: &str = "\
Natural frequencies of small undamped motions; the damped sine and the peaks of the spectrum of the motion after an \
impulse on the resting stroke; the drive frequencies at which the settled stroke is largest, at the point's own \
voltage.

Examples:
  flap resonance ozaki2018-large
  flap resonance ozaki2018-large --impulse '5 deg' --window-cycles 10
  flap resonance jafferis2016 --set 'drive_voltage_pp=160 V' --from 100 --to 150 --format csv";

/// Which design point.
#[derive(clap::Args)]
pub(crate) struct PointArgs {
    /// A preset, or a grid file
    #[arg(value_name = "PRESET|FILE")]
    pub(crate) what: String,

    /// Which point of the grid file
    #[arg(short, long, value_name = "I", default_value_t = 0)]
    pub(crate) point: u64,

    /// Set a parameter: a number in SI units, a number with a unit, or an option. May be repeated
    #[arg(short, long, value_name = "NAME=VALUE", value_parser = assignment)]
    pub(crate) set: Vec<(String, String)>,
}

/// How points are integrated.
#[derive(clap::Args, Default)]
pub(crate) struct SolverArgs {
    /// Relative tolerance of the integrator; the absolute one follows, a hundredth of it
    #[arg(long, value_name = "TOL", value_parser = tolerance)]
    pub(crate) rtol: Option<f64>,

    /// Largest estimated error of a row; points whose rows exceed it are integrated again more finely
    #[arg(long, value_name = "ERROR", value_parser = more_than_zero)]
    pub(crate) accuracy: Option<f64>,

    /// Change of the state per drive period below which an orbit counts as settled
    #[arg(long, value_name = "TOL", value_parser = tolerance)]
    pub(crate) settle_tol: Option<f64>,

    /// Drive periods after which a point counts as unsettled
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(1..))]
    pub(crate) max_cycles: Option<u32>,
}

#[derive(clap::Args)]
#[command(after_help = LIFT_HELP)]
pub(crate) struct LiftArgs {
    #[command(flatten)]
    pub(crate) point: PointArgs,

    /// The motion, a CSV file: columns time_s (or time_ms), stroke_deg (or stroke_rad), pitch_deg (or pitch_rad)
    #[arg(value_name = "MOTION")]
    pub(crate) motion: PathBuf,

    /// The motion is one period: its last sample is the first of the next
    #[arg(long)]
    pub(crate) periodic: bool,

    /// Write motion and forces over time to a CSV file, or to stdout with `-` instead of the summary
    #[arg(short, long, value_name = "FILE")]
    pub(crate) trajectory: Option<PathBuf>,

    /// Samples from the beginning of the motion to its end
    #[arg(long, value_name = "N", default_value_t = 2000, value_parser = value_parser!(u32).range(1..=5_000_000))]
    pub(crate) samples: u32,

    /// Overwrite existing files
    #[arg(short, long)]
    pub(crate) force: bool,
}

const LIFT_HELP: &str = "\
Angles are those of the model's own conventions, see docs/model.md. Between samples the motion is a cubic \
spline: noise in the samples is amplified twice in their acceleration, so smooth them first.

Examples:
  flap track points.csv --chord 6.5 --out motion.csv
  flap lift ozaki2018-small motion.csv --trajectory forces.csv";

#[derive(clap::Args)]
#[command(after_help = TRACK_HELP)]
pub(crate) struct TrackArgs {
    /// Points in every image, a CSV file: columns root_x, root_y, tip_x, tip_y of the leading edge, and edge_x,
    /// edge_y of a point of the lower edge for the pitch, all in one unit; and time_s or time_ms
    #[arg(value_name = "POINTS")]
    pub(crate) points: PathBuf,

    /// Chord from the leading edge to the point of the lower edge, in the unit of the points
    #[arg(long, value_name = "LENGTH", value_parser = positive)]
    pub(crate) chord: Option<f64>,

    /// Write stroke_deg and pitch_deg against time to a CSV file [default: stdout]
    #[arg(short, long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,

    /// Overwrite an existing file
    #[arg(short, long)]
    pub(crate) force: bool,
}

const TRACK_HELP: &str = "\
Ozaki and Hamaguchi 2018: stroke from the leading edge against the x-axis, pitch from the projected chord \
(42), centre of rotation by least squares (43).

Example:
  flap track points.csv --chord 6.5 --out motion.csv";

#[derive(clap::Args)]
#[command(after_help = CHECK_HELP)]
pub(crate) struct CheckArgs {
    /// The grid file
    #[arg(value_name = "FILE")]
    pub(crate) grid: PathBuf,
}

const CHECK_HELP: &str = "\
Shows what each axis spans, what [where] excludes, the first and the last point, and an estimate of the time, for \
which it runs up to 32 points for about a second. Lists the parameters that differ from the preset, and warns of those \
that are more than a hundred times away. Up to a million points are counted one by one; of more, a million \
are looked at.

Example:
  flap check grid.toml";

#[derive(clap::Args)]
#[command(after_help = "Examples:\n  flap params direct-drive\n  flap params ozaki2018-large")]
pub(crate) struct ParamsArgs {
    /// A model, or a preset to see its values
    #[arg(value_name = "MODEL|PRESET")]
    pub(crate) what: String,
}

/// `name=value`, both without the blanks around them.
fn assignment(text: &str) -> Result<(String, String), String> {
    let (name, value) = text.split_once('=').ok_or("write NAME=VALUE, such as drive_frequency='120 Hz'")?;
    Ok((name.trim().to_owned(), value.trim().to_owned()))
}

/// A number of threads that a machine could have.
fn threads(text: &str) -> Result<NonZeroUsize, String> {
    let number = text.parse::<NonZeroUsize>().ok().filter(|number| number.get() <= 1024);
    number.ok_or_else(|| "expected a whole number from 1 to 1024".to_owned())
}

/// A number more than 0.
fn positive(text: &str) -> Result<f64, String> {
    let number = text.parse::<f64>().ok().filter(|number| number.is_finite() && *number > 0.0);
    number.ok_or_else(|| "expected a number of more than 0".to_owned())
}

/// A number more than 0 and less than 0.1: a looser one would mean nothing.
fn tolerance(text: &str) -> Result<f64, String> {
    let number: f64 = text.parse().map_err(|_| "expected a number, such as 1e-6".to_owned())?;
    if number > 0.0 && number < 0.1 {
        Ok(number)
    } else {
        Err("must be more than 0 and less than 0.1".into())
    }
}

/// A number more than zero.
fn more_than_zero(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|number: &f64| *number > 0.0 && number.is_finite());
    number.ok_or_else(|| "expected a number more than zero, such as 1e-3".to_owned())
}

/// An angle with its unit, in radians.
fn angle(text: &str) -> Result<f64, String> {
    quantity(text, "rad", "20 deg")
}

/// A time with its unit, in seconds.
fn time(text: &str) -> Result<f64, String> {
    quantity(text, "s", "50 ms")
}

/// A frequency (Hz); a bare number is one.
fn frequency(text: &str) -> Result<f64, String> {
    units::parse_as(text, "").or_else(|_| quantity(text, "Hz", "120 Hz"))
}

fn quantity(text: &str, si_unit: &str, example: &str) -> Result<f64, String> {
    units::parse_as(text, si_unit).map_err(|error| {
        format!("{}: write a number with a unit, such as `{example}`", error.message("the value"))
    })
}
