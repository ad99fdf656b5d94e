//! Arguments of `flap device new` and `flap device wing`.

use std::path::PathBuf;

use clap::Subcommand;

use super::values::{density, length, line_density, mass};

#[derive(Subcommand)]
pub(crate) enum DeviceCommand {
    /// Print a device file with the values of a preset, as a start for your own device file
    ///
    /// The device file lists every parameter with its value, unit, range and meaning.
    New(NewArgs),
    /// Compute the parameters of a wing from its outline, and print them as a device file
    ///
    /// The computed parameters are areas, radii and inertias of the wing, and a table of the wing's chord.
    Wing(WingArgs),
}

#[derive(clap::Args)]
#[command(
    after_help = "Examples:\n  flap device new jafferis2016 > mybee.toml\n  flap run mybee.toml\n  flap device new mybee.toml > copy.toml"
)]
pub(crate) struct NewArgs {
    /// Preset, device file or grid file whose parameter values flap prints; flap leaves out the axes of a
    /// grid file
    #[arg(value_name = "PRESET|FILE")]
    pub(crate) what: String,
}

#[derive(clap::Args)]
#[command(after_help = WING_HELP)]
pub(crate) struct WingArgs {
    /// CSV file with the outline of the wing, from root to tip
    ///
    /// The columns of the file are `span [mm]`, `leading_edge [mm]` and `trailing_edge [mm]`.
    #[arg(value_name = "OUTLINE")]
    pub(crate) outline: PathBuf,

    /// Preset, device file or grid file of the robot to which flap adds the wing; the robot's model
    /// determines which parameters flap computes
    #[arg(long, value_name = "PRESET|FILE")]
    pub(crate) preset: String,

    /// Distance of the wing's root from the stroke axis, such as `2 mm` [default: 0 m]
    #[arg(long, value_name = "LENGTH", value_parser = length)]
    pub(crate) offset: Option<f64>,

    /// Thickness of the wing's membrane, such as `1.5 um`
    #[arg(long, value_name = "LENGTH", value_parser = length)]
    pub(crate) thickness: Option<f64>,

    /// Density of the wing's membrane, such as `1400 kg/m^3`
    #[arg(long, value_name = "DENSITY", value_parser = density)]
    pub(crate) density: Option<f64>,

    /// Mass per length of a spar along the leading edge, such as `20 mg/m`
    #[arg(long, value_name = "MASS/LENGTH", value_parser = line_density)]
    pub(crate) spar: Option<f64>,

    /// Measured mass of the wing, such as `0.6 mg`
    ///
    /// flap scales the masses of membrane and spar so that the sum of both masses is the measured mass. Without
    /// --thickness and --density, flap spreads the mass evenly over the area of the wing.
    #[arg(long, value_name = "MASS", value_parser = mass)]
    pub(crate) mass: Option<f64>,
}

const WING_HELP: &str = "\
In the file, the edges of the wing are given by their distances from the axis of the hinge. The leading edge lies \
ahead of the axis, and the trailing edge lies behind the axis. Between two rows of the file, the edges of the wing are \
straight. Some parameters must change together with the wing: see the manual, How to, Wings.

Examples:
  flap device wing outline.csv --preset jafferis2016 --offset '2 mm' --mass '0.6 mg' > wing.toml
  flap run wing.toml";
