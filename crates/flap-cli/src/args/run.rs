//! Commands on one design point: `run`, `resonance`.

use std::path::PathBuf;

use clap::{ValueEnum, value_parser};

use super::options::{OverwriteArgs, PointArgs, SolverArgs};
use super::values::{finite, frequency, impulse, time};

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
    #[arg(long, value_name = "HZ", value_parser = frequency)]
    pub(crate) chirp_from: Option<f64>,

    /// Frequency at which the chirp ends (Hz) [default: twice the point's drive frequency]
    #[arg(long, value_name = "HZ", value_parser = frequency)]
    pub(crate) chirp_to: Option<f64>,

    /// Rate of change of the chirp's frequency (Hz/s); negative for a falling chirp. A chirp has at most 100,000 drive
    /// periods [default: 15]
    #[arg(long, value_name = "HZ/S", value_parser = finite, allow_negative_numbers = true)]
    pub(crate) chirp_rate: Option<f64>,

    /// CSV file for the chirp's rows per cycle [default: stdout]
    #[arg(long, value_name = "FILE")]
    pub(crate) envelope: Option<PathBuf>,

    /// CSV file with the waveform of the drive, in place of drive_shape: columns time_s (or time_ms) and wave. The
    /// file's duration is the drive period, unless drive_frequency is set
    #[arg(long, value_name = "FILE", conflicts_with = "stroke")]
    pub(crate) waveform: Option<PathBuf>,

    /// CSV file with a prescribed stroke: columns time_s (or time_ms) and stroke_deg (or stroke_rad). The
    /// file's duration is the drive period, unless drive_frequency is set
    #[arg(long, value_name = "FILE")]
    pub(crate) stroke: Option<PathBuf>,

    /// Follow the waveform or stroke once, from rest, instead of repeating it
    #[arg(long, requires = "trajectory")]
    pub(crate) once: bool,

    /// Size of the impulse on the stroke, as the amplitude that the first mode alone would reach without damping:
    /// `20 deg` is a stroke rate of 2 pi f_1 20 deg [default: 20 deg]
    #[arg(long, value_name = "ANGLE", value_parser = impulse, allow_hyphen_values = true)]
    pub(crate) impulse: Option<f64>,

    /// Duration of the motion after the impulse, such as `50 ms` [default: ten periods of the first mode]
    #[arg(long, value_name = "TIME", value_parser = time)]
    pub(crate) duration: Option<f64>,

    /// CSV file for the motion over time; the summary is printed as well. `-` prints the motion instead
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

    /// Print the ten parameters by which this measure of the settled motion changes most, in its unit per per cent of the
    /// parameter
    #[arg(long, value_name = "COLUMN")]
    pub(crate) gradient: Option<String>,

    #[command(flatten)]
    pub(crate) overwrite: OverwriteArgs,

    #[command(flatten)]
    pub(crate) solver: SolverArgs,
}

/// The drive of `flap run`.
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
  flap run ozaki2018-large --gradient lift_mean_mn
  flap run grid.toml --point 17 --trajectory point17.csv
  flap run ozaki2018-large --trajectory - --from-rest --cycles 50
  flap run ozaki2018-small --drive chirp --chirp-from 150 --chirp-to 250 --envelope envelope.csv
  flap run ozaki2018-small --drive impulse --impulse '20 deg' --duration '50 ms' --trajectory free.csv";

#[derive(clap::Args)]
#[command(after_help = RESONANCE_HELP)]
pub(crate) struct ResonanceArgs {
    #[command(flatten)]
    pub(crate) point: PointArgs,

    /// Size of the impulse on the stroke, as the amplitude that the first mode alone would reach without damping
    #[arg(long, value_name = "ANGLE", default_value = "20 deg", value_parser = impulse, allow_hyphen_values = true)]
    pub(crate) impulse: f64,

    /// Periods of the first mode to which the damped sine is fitted
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = value_parser!(u32).range(2..=1000))]
    pub(crate) window_cycles: u32,

    /// Duration of the motion from which the spectrum is computed
    #[arg(long, value_name = "TIME", default_value = "1 s", value_parser = time)]
    pub(crate) spectrum_window: f64,

    /// Lowest drive frequency of the search (Hz) [default: half of the lower natural frequency]
    #[arg(long, value_name = "HZ", value_parser = frequency)]
    pub(crate) from: Option<f64>,

    /// Highest drive frequency of the search (Hz) [default: one and a half times the upper natural frequency]
    #[arg(long, value_name = "HZ", value_parser = frequency)]
    pub(crate) to: Option<f64>,

    /// Largest error of the frequencies at which the driven stroke peaks (Hz)
    #[arg(long, value_name = "HZ", default_value = "0.05", value_parser = frequency)]
    pub(crate) tolerance: f64,

    /// Output format: a table to read, or CSV with all digits
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub(crate) format: Format,

    #[command(flatten)]
    pub(crate) solver: SolverArgs,
}

/// The format in which results are printed.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    Text,
    Csv,
}

const RESONANCE_HELP: &str = "\
Prints three kinds of resonance. Linear: the natural frequencies of small undamped motions. Free: a damped sine and the \
peaks of a spectrum, both of the motion after an impulse on the resting stroke. Driven: the drive frequencies at which \
the settled stroke is largest, at the point's own voltage.

Examples:
  flap resonance ozaki2018-large
  flap resonance ozaki2018-large --impulse '5 deg' --window-cycles 10
  flap resonance jafferis2016 --set 'drive_voltage_pp=160 V' --from 100 --to 150 --format csv";
