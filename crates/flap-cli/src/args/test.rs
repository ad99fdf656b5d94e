//! Arguments of experiments on one wing: `flap test chirp`, `impulse`, `resonance`, `lift`, `terms` and `track`.

use std::path::PathBuf;

use clap::{Subcommand, value_parser};

use super::options::{OutputFormat, OverwriteArgs, PointArgs, SolverArgs};
use super::values::{finite, frequency, impulse, positive, time};

#[derive(Subcommand)]
pub(crate) enum TestCommand {
    /// Simulate a chirp: the drive frequency changes at a constant rate; print one row per drive period
    Chirp(ChirpArgs),
    /// Compute the free motion after an impulse on the stroke of the wing at rest
    Impulse(ImpulseArgs),
    /// Compare the resonances of a design point in linear, free and driven motion
    Resonance(ResonanceArgs),
    /// Compute the forces on a wing from its measured stroke and pitch
    Lift(LiftArgs),
    /// Compare the effects of terms that the papers leave out, such as damping or rotational circulation
    Terms(TermsArgs),
    /// Compute stroke, pitch and rotation centre of a filmed wing from tracked points
    Track(TrackArgs),
}

#[derive(clap::Args)]
#[command(after_help = CHIRP_HELP)]
pub(crate) struct ChirpArgs {
    #[command(flatten)]
    pub(crate) point: PointArgs,

    /// Drive frequency at which the chirp begins (Hz)
    #[arg(long, value_name = "HZ", default_value_t = 1.0, value_parser = frequency)]
    pub(crate) from: f64,

    /// Drive frequency at which the chirp ends (Hz) [default: twice the point's drive frequency]
    #[arg(long, value_name = "HZ", value_parser = frequency)]
    pub(crate) to: Option<f64>,

    /// Rate of change of the drive frequency (Hz/s); with a negative rate, the frequency falls
    ///
    /// A chirp has at most 100,000 drive periods.
    #[arg(long, value_name = "HZ/S", default_value_t = 15.0, value_parser = finite, allow_negative_numbers = true)]
    pub(crate) rate: f64,

    /// CSV file for the rows, one per drive period [default: stdout, in the format of --format]
    #[arg(short, long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,

    /// CSV file for the motion over time; `-` prints the motion to stdout instead of one row per drive period
    #[arg(short, long, value_name = "FILE")]
    pub(crate) trajectory: Option<PathBuf>,

    /// Number of samples of the trajectory per drive period
    #[arg(long, value_name = "N", default_value_t = 200, requires = "trajectory",
          value_parser = value_parser!(u32).range(1..=1_000_000))]
    pub(crate) samples: u32,

    /// Output format of the rows on stdout
    #[arg(long, value_enum, default_value_t = OutputFormat::Csv)]
    pub(crate) format: OutputFormat,

    #[command(flatten)]
    pub(crate) overwrite: OverwriteArgs,

    #[command(flatten)]
    pub(crate) solver: SolverArgs,
}

const CHIRP_HELP: &str = "\
Examples:
  flap test chirp ozaki2018-small --from 150 --to 250 --out chirp.csv
  flap test chirp mybee.toml --rate 5 --trajectory motion.csv > chirp.csv";

#[derive(clap::Args)]
#[command(after_help = IMPULSE_HELP)]
pub(crate) struct ImpulseArgs {
    #[command(flatten)]
    pub(crate) point: PointArgs,

    /// Size of the impulse on the stroke: an angle with its unit
    ///
    /// The angle is the stroke amplitude that the impulse causes in the first mode alone, without damping. For example,
    /// an impulse of `20 deg` causes an initial stroke rate of 2 pi f_1 20 deg, where f_1 is the frequency of the first
    /// mode.
    #[arg(long, value_name = "ANGLE", default_value = "20 deg", value_parser = impulse, allow_hyphen_values = true)]
    pub(crate) amplitude: f64,

    /// Duration of the motion, such as `50 ms` [default: ten periods of the first mode]
    #[arg(long, value_name = "TIME", value_parser = time)]
    pub(crate) duration: Option<f64>,

    /// CSV file for the motion over time; `-` prints the motion to stdout instead of the summary
    #[arg(short, long, value_name = "FILE")]
    pub(crate) trajectory: Option<PathBuf>,

    /// Smallest number of samples of the motion per period of the first mode
    #[arg(long, value_name = "N", default_value_t = 200, value_parser = value_parser!(u32).range(1..=1_000_000))]
    pub(crate) samples: u32,

    /// Output format of the summary
    #[arg(long, value_enum, default_value_t = OutputFormat::Table)]
    pub(crate) format: OutputFormat,

    #[command(flatten)]
    pub(crate) overwrite: OverwriteArgs,

    #[command(flatten)]
    pub(crate) solver: SolverArgs,
}

const IMPULSE_HELP: &str = "\
During the motion, the drive voltage has a constant value, at which a wing at rest has zero stroke and pitch (see the \
manual, How to, Resonance).

Examples:
  flap test impulse ozaki2018-small
  flap test impulse ozaki2018-small --amplitude '5 deg' --duration '50 ms' --trajectory free.csv";

#[derive(clap::Args)]
#[command(after_help = TERMS_HELP)]
pub(crate) struct TermsArgs {
    #[command(flatten)]
    pub(crate) point: PointArgs,

    /// Output format
    #[arg(long, value_enum, default_value_t = OutputFormat::Table)]
    pub(crate) format: OutputFormat,

    #[command(flatten)]
    pub(crate) solver: SolverArgs,
}

const TERMS_HELP: &str = "\
Each line of the output changes one parameter. If the design leaves out a term, flap switches the term on with a typical \
size; if the design has the term, flap switches the term off.

Examples:
  flap test terms jafferis2016
  flap test terms mybee.toml --set drive_voltage_pp='160 V'";

#[derive(clap::Args)]
#[command(after_help = RESONANCE_HELP)]
pub(crate) struct ResonanceArgs {
    #[command(flatten)]
    pub(crate) point: PointArgs,

    /// Size of the impulse on the stroke: an angle with its unit
    ///
    /// The angle is the stroke amplitude that the impulse causes in the first mode alone, without damping.
    #[arg(long, value_name = "ANGLE", default_value = "20 deg", value_parser = impulse, allow_hyphen_values = true)]
    pub(crate) impulse: f64,

    /// Length of the free motion to which flap fits a damped sine, in periods of the first mode
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = value_parser!(u32).range(2..=1000))]
    pub(crate) window_cycles: u32,

    /// Duration of the free motion from which flap computes the spectrum
    #[arg(long, value_name = "TIME", default_value = "1 s", value_parser = time)]
    pub(crate) spectrum_window: f64,

    /// Lowest drive frequency of the search (Hz) [default: half of the lower natural frequency]
    #[arg(long, value_name = "HZ", value_parser = frequency)]
    pub(crate) from: Option<f64>,

    /// Highest drive frequency of the search (Hz) [default: one and a half times the upper natural frequency]
    #[arg(long, value_name = "HZ", value_parser = frequency)]
    pub(crate) to: Option<f64>,

    /// Largest allowed error of the drive frequencies at which the settled stroke has a peak (Hz)
    #[arg(long, value_name = "HZ", default_value = "0.05", value_parser = frequency)]
    pub(crate) tolerance: f64,

    /// Output format
    #[arg(long, value_enum, default_value_t = OutputFormat::Table)]
    pub(crate) format: OutputFormat,

    #[command(flatten)]
    pub(crate) solver: SolverArgs,
}

const RESONANCE_HELP: &str = "\
flap prints three kinds of resonance. The linear resonances are the natural frequencies of small undamped motions. For \
the free resonances, flap simulates the motion after an impulse on the stroke of the wing at rest. The free resonances \
are the frequency of a damped sine that is fitted to the motion, and the peaks of the motion's spectrum. The driven \
resonances are the drive frequencies at which the settled stroke has a peak, at the drive voltage of the design point.

Examples:
  flap test resonance ozaki2018-large
  flap test resonance ozaki2018-large --impulse '5 deg' --window-cycles 10
  flap test resonance jafferis2016 --set 'drive_voltage_pp=160 V' --from 100 --to 150 --format csv";

#[derive(clap::Args)]
#[command(after_help = LIFT_HELP)]
pub(crate) struct LiftArgs {
    #[command(flatten)]
    pub(crate) point: PointArgs,

    /// CSV file with the motion of the wing
    ///
    /// The columns of the file are time_s (or time_ms), stroke_deg (or stroke_rad) and pitch_deg (or pitch_rad).
    #[arg(value_name = "MOTION")]
    pub(crate) motion: PathBuf,

    /// Treat the motion as one period of a periodic motion; the last sample is also the first sample of the next period
    #[arg(long)]
    pub(crate) periodic: bool,

    /// CSV file for motion and forces over time; `-` prints motion and forces to stdout instead of the summary
    #[arg(short, long, value_name = "FILE")]
    pub(crate) trajectory: Option<PathBuf>,

    /// Number of samples of the trajectory from the beginning to the end of the motion
    #[arg(long, value_name = "N", default_value_t = LiftArgs::SAMPLES, requires = "trajectory", value_parser = value_parser!(u32).range(1..=5_000_000))]
    pub(crate) samples: u32,

    /// Output format of the summary
    #[arg(long, value_enum, default_value_t = OutputFormat::Table)]
    pub(crate) format: OutputFormat,

    #[command(flatten)]
    pub(crate) overwrite: OverwriteArgs,
}

impl LiftArgs {
    /// Default number of samples of the trajectory.
    pub(crate) const SAMPLES: u32 = 2000;
}

const LIFT_HELP: &str = "\
Angles have the sign conventions of the model: see the manual, Models, Direct drive. Between samples, the motion is a \
cubic spline. The acceleration of the spline amplifies the noise of the samples, so smooth the samples first.

Examples:
  flap test lift ozaki2018-small motion.csv --trajectory forces.csv
  flap test track points.csv --chord 6.5 --out motion.csv     (the motion of a filmed wing)";

#[derive(clap::Args)]
#[command(after_help = TRACK_HELP)]
pub(crate) struct TrackArgs {
    /// CSV file with the tracked points in every image of the film
    ///
    /// The columns of the file are time_s (or time_ms), and root_x, root_y, tip_x and tip_y, two points of the leading edge.
    /// To compute the pitch, flap also requires edge_x and edge_y, a point on the lower edge. All lengths have the same
    /// unit. The pitch is positive if the lower edge lags behind the leading edge while the stroke rises. For
    /// four-bar, multiply the pitch by -1.
    #[arg(value_name = "POINTS")]
    pub(crate) points: PathBuf,

    /// Length of the chord from the leading edge to the point on the lower edge, in the unit of the columns
    #[arg(long, value_name = "LENGTH", value_parser = positive)]
    pub(crate) chord: Option<f64>,

    /// CSV file for stroke_deg and pitch_deg over time; `-` prints both angles to stdout [default: stdout, in the
    /// format of --format]
    #[arg(short, long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,

    /// Output format of the motion on stdout
    #[arg(long, value_enum, default_value_t = OutputFormat::Csv)]
    pub(crate) format: OutputFormat,

    #[command(flatten)]
    pub(crate) overwrite: OverwriteArgs,
}

const TRACK_HELP: &str = "\
flap uses the method of Ozaki and Hamaguchi (2018). The stroke is the angle from the x-axis to the leading edge. flap \
computes the pitch from the projected chord (eq. 42 of their paper), and fits the rotation centre by least squares (eq. 43).

Example:
  flap test track points.csv --chord 6.5 --out motion.csv";
