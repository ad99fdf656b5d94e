//! Arguments of `flap vehicle`.

use super::options::{OutputFormat, PointArgs, SolverArgs};
use super::values::assignment;

#[derive(clap::Args)]
#[command(after_help = VEHICLE_HELP)]
pub(crate) struct VehicleArgs {
    #[command(flatten)]
    pub(crate) point: PointArgs,

    /// Inputs, separated by commas: parameters of the vehicle, or the words below
    ///
    /// By default: amplitude, bias and, with drive_shape = "harmonics", second_harmonic. Each is taken for all wings together
    /// and as a left-right difference.
    #[arg(short, long, value_name = "NAME,...", value_delimiter = ',')]
    pub(crate) inputs: Vec<String>,

    /// Find inputs near the point that give this force (mN) or torque (uN*m). May be repeated
    #[arg(short, long, value_name = "COLUMN=VALUE", value_parser = assignment)]
    pub(crate) trim: Vec<(String, String)>,

    /// Output format
    ///
    /// csv and json contain the matrix with all digits.
    #[arg(long, value_enum, default_value_t = OutputFormat::Table)]
    pub(crate) format: OutputFormat,

    #[command(flatten)]
    pub(crate) solver: SolverArgs,
}

const VEHICLE_HELP: &str = "\
Prints the mean force and torque of a vehicle at a point of a grid file with [vehicle], and their changes with each input. \
It also prints the combinations of inputs with the largest effects (singular values). The derivatives are exact \
derivatives of the settled motion.

Words for inputs: amplitude, bias, frequency, second_harmonic, second_phase, third_harmonic. Append _difference for left \
minus right, or prefix the name of a wing, as in left_amplitude.
Components: force_forward, force_left, force_up (mN); torque_roll, torque_pitch, torque_yaw (uN*m). Roll > 0 lifts the left \
side, pitch > 0 lowers the nose, yaw > 0 turns the nose to the left.

Examples:
  flap vehicle vehicle.toml
  flap vehicle vehicle.toml --inputs amplitude_difference,bias,second_harmonic_difference
  flap vehicle vehicle.toml --inputs amplitude,amplitude_difference,bias --trim torque_roll=0.5 --trim torque_pitch=0
  flap vehicle vehicle.toml --set left_wing_area=\"54 mm^2\" --format csv";
