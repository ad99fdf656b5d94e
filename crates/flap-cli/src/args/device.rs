//! Device files: `device new`, `wing`.

use std::path::PathBuf;

use clap::Subcommand;

use super::values::{density, length, line_density, mass};

#[derive(Subcommand)]
pub(crate) enum DeviceCommand {
    /// Print the device file of a preset, to be edited: every parameter with value, unit, range and meaning
    New(NewArgs),
    /// Turn the outline of a wing into a device file: areas, radii, inertias, and the chord as a table
    Wing(WingArgs),
}

#[derive(clap::Args)]
#[command(
    after_help = "Examples:\n  flap device new jafferis2016 > mybee.toml\n  flap run mybee.toml\n  flap device new mybee.toml > copy.toml"
)]
pub(crate) struct NewArgs {
    /// A preset, or a device or grid file whose values are written out
    #[arg(value_name = "PRESET|FILE")]
    pub(crate) what: String,
}

#[derive(clap::Args)]
#[command(after_help = WING_HELP)]
pub(crate) struct WingArgs {
    /// CSV file with the columns `span [mm]`, `leading_edge [mm]` and `trailing_edge [mm]`, from root to tip
    #[arg(value_name = "OUTLINE")]
    pub(crate) outline: PathBuf,

    /// The preset or device that the wing is put on; its model decides the parameters
    #[arg(long, value_name = "PRESET|FILE")]
    pub(crate) preset: String,

    /// Distance of the wing's root from the stroke axis, such as `2 mm`; 0 m without this option
    #[arg(long, value_name = "LENGTH", value_parser = length)]
    pub(crate) offset: Option<f64>,

    /// Thickness of the wing's membrane, such as `1.5 um`
    #[arg(long, value_name = "LENGTH", value_parser = length)]
    pub(crate) thickness: Option<f64>,

    /// Density of the membrane, such as `1400 kg/m^3`
    #[arg(long, value_name = "DENSITY", value_parser = density)]
    pub(crate) density: Option<f64>,

    /// Mass per length of a spar along the leading edge, such as `20 mg/m`
    #[arg(long, value_name = "MASS/LENGTH", value_parser = line_density)]
    pub(crate) spar: Option<f64>,

    /// Mass of the wing as weighed, such as `0.6 mg`: membrane and spar are scaled to it; alone, it is spread evenly
    #[arg(long, value_name = "MASS", value_parser = mass)]
    pub(crate) mass: Option<f64>,
}

const WING_HELP: &str = "\
The edges are distances from the hinge's axis: the leading edge ahead of it, the trailing edge behind it. Between stations they are \
straight. docs/how-to/wings.md says which numbers belong together when a wing changes.

Examples:
  flap device wing outline.csv --preset jafferis2016 --offset '2 mm' --mass '0.6 mg' > wing.toml
  flap run wing.toml";
