//! The command line: commands, their options and help texts.

mod film;
mod filter;
#[cfg(feature = "live")]
mod live;
mod look;
mod options;
#[cfg(feature = "plots")]
mod plot;
mod respond;
mod results;
mod run;
mod sweep;
mod values;
mod vehicle;
mod wing;

use std::path::PathBuf;
use std::sync::LazyLock;

use clap::{Parser, Subcommand};
use clap_complete::Shell;
pub(crate) use film::{LiftArgs, TrackArgs};
pub(crate) use filter::Filter;
use flap_sweep::run::identity;
#[cfg(feature = "live")]
pub(crate) use live::LiveArgs;
pub(crate) use look::{DescribeArgs, Listing, LookArgs, TopArgs};
pub(crate) use options::{Aim, PointArgs, ReadArgs, SolverArgs, WorkArgs};
#[cfg(feature = "plots")]
pub(crate) use plot::{PictureKind, PlotArgs, Size};
pub(crate) use respond::RespondArgs;
pub(crate) use results::{ConvertArgs, MergeArgs, RerunArgs, ResumeArgs, VerifyArgs};
pub(crate) use run::{Drive, Format, ResonanceArgs, RunArgs};
pub(crate) use sweep::{CheckArgs, SweepArgs};
pub(crate) use vehicle::VehicleArgs;
pub(crate) use wing::WingArgs;

/// Sweeps of insect-scale flapping-wing designs: a grid file goes in, one row per design point comes out.
#[derive(Parser)]
#[command(name = "flap", version, long_version = long_version(), max_term_width = 100, after_help = EXIT_CODES)]
pub(crate) struct Args {
    /// Print neither progress nor notes: stderr gets warnings and errors alone
    #[arg(long, short, global = true)]
    pub(crate) quiet: bool,
    #[command(subcommand)]
    pub(crate) command: Command,
}

/// The version and the build identity, which differs between builds whose rows may differ.
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
    /// Continue an interrupted sweep
    Resume(ResumeArgs),
    /// Run points of earlier results again with other solver settings
    Rerun(RerunArgs),
    /// Join the shards of a sweep into one file
    Merge(MergeArgs),
    /// Write results in another format
    Convert(ConvertArgs),
    /// Compare results with their recorded checksums
    Verify(VerifyArgs),
    /// Run one design point and print its measures
    Run(RunArgs),
    /// Follow the response of designs up and down in frequency or another parameter, and find hysteresis
    Respond(RespondArgs),
    /// Compute the force and torque of a vehicle, what each drive does to them, and trims
    Vehicle(VehicleArgs),
    /// Open a page in the browser on which curves follow the parameters that you drag
    #[cfg(feature = "live")]
    Live(LiveArgs),
    /// List the best rows of results
    Top(TopArgs),
    /// Summarize results: statuses, percentiles, and the best value of each axis
    Describe(DescribeArgs),
    /// Draw results as a picture, or as a page to explore in a browser
    #[cfg(feature = "plots")]
    Plot(PlotArgs),
    /// Compare the resonances of one design point: linear, free and driven
    Resonance(ResonanceArgs),
    /// Check a grid file and summarize the sweep that it describes
    Check(CheckArgs),
    /// Compute the forces on a wing whose stroke and pitch are given, as filmed
    Lift(LiftArgs),
    /// Compute stroke, pitch and rotation centre of a filmed wing from tracked points
    Track(TrackArgs),
    /// Print a device file of a preset, to be edited: every parameter with value, unit, range and meaning
    New(NewArgs),
    /// Turn the outline of a wing into a device: areas, radii, inertias, and the chord as a table
    Wing(WingArgs),
    /// List the parameters and output columns of a model
    Params(ParamsArgs),
    /// Explain parameters, columns of results, and statuses
    Explain(ExplainArgs),
    /// List the models and their presets
    Models,
    /// Print a JSON schema of grid files, for editors that complete their keys
    Schema(SchemaArgs),
    /// Print a script that completes commands and options in a shell
    Completions(CompletionsArgs),
    /// Write manual pages
    Man(ManArgs),
}

const EXIT_CODES: &str = "\
Results go to stdout, everything else to stderr.

Exit codes:
  0    done
  1    with --strict: done, but not every point is periodic; `verify`: not every file has checksums
  2    the command line or the grid file must be corrected
  3    reading or writing failed, or results are damaged
  130  interrupted; `flap resume` continues the sweep
  101  a mistake in flap itself";

#[derive(clap::Args)]
#[command(
    after_help = "Examples:\n  flap params direct-drive\n  flap params ozaki2018-large\n  flap params jafferis2016 --long\n  \
                  flap params jafferis2016 --format csv > parameters.csv"
)]
pub(crate) struct ParamsArgs {
    /// A model; or a preset, a device or a grid file, to list with its values
    #[arg(value_name = "MODEL|PRESET|FILE")]
    pub(crate) what: String,

    /// Print whole meanings, not their first sentences, and the symbols and allowed values of parameters
    #[arg(long)]
    pub(crate) long: bool,

    /// Output format: csv and json have all texts, and numbers in SI units
    #[arg(long, value_enum, default_value_t = Listing::Table)]
    pub(crate) format: Listing,
}

#[derive(clap::Args)]
#[command(
    after_help = "Examples:\n  flap new jafferis2016 > mybee.toml\n  flap run mybee.toml\n  flap new mybee.toml > copy.toml"
)]
pub(crate) struct NewArgs {
    /// A preset, or a device or grid file whose values are written out
    #[arg(value_name = "PRESET|FILE")]
    pub(crate) what: String,
}

#[derive(clap::Args)]
#[command(after_help = "Examples:\n  flap explain hinge_stiffness\n  flap explain floquet_max unsettled\n  \
                  flap explain hinge_stiffness --model four-bar")]
pub(crate) struct ExplainArgs {
    /// Only the meaning in this model, or in that of this preset
    #[arg(long, value_name = "MODEL|PRESET")]
    pub(crate) model: Option<String>,

    /// Names of parameters, columns or statuses
    #[arg(value_name = "NAME", required = true)]
    pub(crate) names: Vec<String>,
}

#[derive(clap::Args)]
#[command(
    after_help = "Example:\n  flap schema > flap.schema.json     (and #:schema ./flap.schema.json as the first line of a grid)"
)]
pub(crate) struct SchemaArgs {
    /// Only the parameters of this preset's model, with the preset's values as defaults
    #[arg(long, value_name = "PRESET")]
    pub(crate) preset: Option<String>,
}

#[derive(clap::Args)]
#[command(after_help = COMPLETIONS_HELP)]
pub(crate) struct CompletionsArgs {
    /// The shell
    #[arg(value_name = "SHELL")]
    pub(crate) shell: Shell,
}

const COMPLETIONS_HELP: &str = "\
Examples:
  flap completions bash > ~/.local/share/bash-completion/completions/flap
  source <(flap completions zsh)               (in ~/.zshrc, behind compinit)
  flap completions fish > ~/.config/fish/completions/flap.fish
  flap completions powershell >> $PROFILE";

#[derive(clap::Args)]
#[command(after_help = "Example:\n  flap man ~/.local/share/man/man1")]
pub(crate) struct ManArgs {
    /// Folder for the pages, one per command; pages that are there are overwritten
    #[arg(value_name = "FOLDER")]
    pub(crate) folder: PathBuf,
}
