//! Arguments of `flap models`.

use super::options::OutputFormat;

#[derive(clap::Args)]
#[command(after_help = HELP)]
pub(crate) struct ModelsArgs {
    /// Names to list or explain [default: list the models and their presets]
    ///
    /// For a model, a preset, a device file or a grid file, flap lists parameters and columns.
    /// For a parameter, a column, a setting or a status, flap prints the meaning.
    #[arg(value_name = "NAME|FILE")]
    pub(crate) names: Vec<String>,

    /// Explain the names only for one model: the named model, or the model of the named preset
    #[arg(long, value_name = "MODEL|PRESET", requires = "names")]
    pub(crate) model: Option<String>,

    /// Print the whole meaning of each name, not only its first sentence, and also the symbols and allowed values of parameters
    #[arg(long, requires = "names")]
    pub(crate) long: bool,

    /// Output format
    ///
    /// The formats csv and json contain the whole meaning of each name, and the values of parameters in SI units.
    #[arg(long, value_enum, default_value_t = OutputFormat::Table)]
    pub(crate) format: OutputFormat,
}

const HELP: &str = "\
Examples:
  flap models
  flap models jafferis2016
  flap models direct-drive --long
  flap models hinge_stiffness floquet_max unsettled
  flap models hinge_stiffness --model four-bar
  flap models mybee.toml --format csv > parameters.csv";
