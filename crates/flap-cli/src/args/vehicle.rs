//! Arguments of `flap vehicle`.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use clap::value_parser;
use flap_sweep::study::wrench_map::WrenchMap;

use super::options::{OutputFormat, OverwriteArgs, PointArgs, SolverArgs};
use super::values::{NamedRange, assignment, named_range, target, threads, time};

#[derive(clap::Args)]
#[command(after_help = VEHICLE_HELP)]
pub(crate) struct VehicleArgs {
    #[command(flatten)]
    pub(crate) point: PointArgs,

    /// Inputs of the vehicle, separated by commas: parameters, or the words for inputs that are listed at the end of
    /// this help
    ///
    /// The default inputs are amplitude, bias and, with drive_shape = "harmonics", second_harmonic. flap uses
    /// each default input twice: for all wings together, and as the difference between left and right wings.
    #[arg(short, long, value_name = "NAME,...", value_delimiter = ',')]
    pub(crate) inputs: Vec<String>,

    /// Find values of the inputs for which the force (mN) or torque (uN*m) COLUMN has the value VALUE. The search begins at
    /// the design point. You can repeat --trim
    ///
    /// With `--trim hover`, force_up equals the weight, and all torques are zero.
    #[arg(short, long, value_name = "COLUMN=VALUE", value_parser = target)]
    pub(crate) trim: Vec<(String, String)>,

    /// Fit a quadratic map of force and torque to rows that are spread over the given ranges of inputs
    ///
    /// Model-predictive controllers use quadratic maps. Inputs have the same names as for --inputs.
    #[arg(long, value_name = "INPUT=FROM:TO,...", value_delimiter = ',', value_parser = named_range, conflicts_with_all = ["inputs", "trim", "damping", "hover", "export"])]
    pub(crate) wrench_map: Vec<NamedRange>,

    /// Number of rows of --wrench-map; every fifth row is left out of the fit, to test the map
    #[arg(long, value_name = "N", default_value_t = WrenchMap::SAMPLES, value_parser = value_parser!(u32).range(1..=i64::from(WrenchMap::MOST_SAMPLES)), requires = "wrench_map")]
    pub(crate) samples: u32,

    /// Number of worker threads of --wrench-map; the number does not change the map [default: one thread per core]
    #[arg(short = 'j', long, value_name = "N", value_parser = threads, requires = "wrench_map")]
    pub(crate) threads: Option<NonZeroUsize>,

    /// Print the damping matrix: the change of force and torque with the velocity and the angular rates of the body
    #[arg(long)]
    pub(crate) damping: bool,

    /// Print the modes of the linear model about hover, and the trim residual
    ///
    /// The vehicle must have a total_mass, and the moments of inertia, such as body_inertia_roll. The entry
    /// `about` in [vehicle] must be the centre of mass.
    #[arg(long)]
    pub(crate) hover: bool,

    /// Simulate a flight of this duration, such as 0.5s, and print the mean states, inputs, force and torque
    /// of each wing beat
    ///
    /// The simulation couples the motions of wings and body. --fly requires the entries that --hover requires.
    #[arg(long, value_name = "TIME", value_parser = time, conflicts_with_all = ["wrench_map", "damping", "hover", "export"])]
    pub(crate) fly: Option<f64>,

    /// Initial velocity, angular rate or angle of the body in the flight of --fly. You can repeat --disturb
    #[arg(long, value_name = "STATE=VALUE", value_parser = assignment, requires = "fly")]
    pub(crate) disturb: Vec<(String, String)>,

    /// Keep the motion of the wings unchanged when the body moves, as in papers with prescribed wing motion
    #[arg(long)]
    pub(crate) frozen: bool,

    /// Write the linear model about hover in SI units: a .json, .mat (MATLAB), .py (python-control) or .fmu file (FMI 3.0)
    #[arg(long, value_name = "FILE")]
    pub(crate) export: Option<PathBuf>,

    #[command(flatten)]
    pub(crate) overwrite: OverwriteArgs,

    /// Output format
    ///
    /// csv and json contain one table with all digits: the control matrix, or the table of --damping, --hover or --fly.
    #[arg(long, value_enum, default_value_t = OutputFormat::Table)]
    pub(crate) format: OutputFormat,

    #[command(flatten)]
    pub(crate) solver: SolverArgs,
}

const VEHICLE_HELP: &str = "\
flap prints the mean force and torque of a vehicle at a point of a grid file with [vehicle], and the derivatives of \
force and torque with respect to each input. flap also prints the combinations of inputs with the largest effects \
(singular values). flap computes the derivatives of the settled motion without finite differences, with one exception. \
In the four-bar model, derivatives with respect to the motion of the body are central differences, with steps of 0.01 \
m/s and 1 rad/s.

The words for inputs are amplitude, bias, frequency, second_harmonic, second_phase and third_harmonic. Each word may \
have the ending _difference. For example, the input amplitude_difference is the amplitude of the left wings minus the \
amplitude of the right wings. Put the name of a wing before the word to change only this wing, as in left_amplitude.
The components of force and torque are force_forward, force_left, force_up (mN); torque_roll, torque_pitch, torque_yaw \
(uN*m). A positive roll torque lifts the left side, a positive pitch torque lowers the nose, and a positive yaw torque \
turns the nose to the left.

Examples:
  flap vehicle vehicle.toml
  flap vehicle vehicle.toml --inputs amplitude_difference,bias,second_harmonic_difference
  flap vehicle vehicle.toml --inputs amplitude,amplitude_difference,bias --trim torque_roll=0.5 --trim torque_pitch=0
  flap vehicle vehicle.toml --wrench-map amplitude=180V:220V,bias=-10V:10V,amplitude_difference=-20V:20V,second_harmonic=-0.1:0.1
  flap vehicle vehicle.toml --damping --frozen
  flap vehicle vehicle.toml --trim hover --hover --export model.mat
  flap vehicle vehicle.toml --trim hover --fly 0.5s --disturb velocity_forward=0.1m/s --format csv
  flap vehicle vehicle.toml --set left_wing_area=\"54 mm^2\" --format csv";
