//! The command line: commands, their options and help texts.

mod device;
mod filter;
mod generate;
#[cfg(feature = "live")]
mod live;
mod look;
mod models;
mod optimise;
mod options;
#[cfg(feature = "plots")]
mod plot;
mod respond;
mod results;
mod run;
mod sweep;
mod test;
mod values;
mod vehicle;

use std::ffi::OsString;
use std::fmt::Write as _;
use std::sync::{LazyLock, OnceLock};

use clap::error::{ContextKind, ContextValue};
use clap::{CommandFactory as _, FromArgMatches as _, Parser, Subcommand};
pub(crate) use device::{DeviceCommand, NewArgs, WingArgs};
pub(crate) use filter::Filter;
use flap_sweep::run::identity;
pub(crate) use generate::{CompletionsArgs, GenerateCommand, ManArgs, SchemaArgs};
#[cfg(feature = "live")]
pub(crate) use live::LiveArgs;
pub(crate) use look::{DescribeArgs, LookArgs, TopArgs};
pub(crate) use models::ModelsArgs;
pub(crate) use optimise::OptimiseArgs;
pub(crate) use options::{Aim, OutputFormat, PointArgs, ReadArgs, SolverArgs, WorkArgs};
#[cfg(feature = "plots")]
pub(crate) use plot::{PictureKind, PictureSize, PlotArgs};
pub(crate) use respond::RespondArgs;
pub(crate) use results::{ConvertArgs, MergeArgs, RerunArgs, ResultsCommand, ResumeArgs, VerifyArgs};
pub(crate) use run::RunArgs;
pub(crate) use sweep::{CheckArgs, SweepArgs};
pub(crate) use test::{ChirpArgs, ImpulseArgs, LiftArgs, ResonanceArgs, TermsArgs, TestCommand, TrackArgs};
pub(crate) use values::HOVER;
pub(crate) use vehicle::VehicleArgs;

/// Simulate and sweep insect-scale flapping-wing robots.
///
/// A grid file describes a sweep. flap runs every design point of the grid and writes one row of results per point.
#[derive(Parser)]
#[command(name = "flap", version, long_version = long_version(), max_term_width = 100, after_help = EXIT_CODES)]
pub(crate) struct Args {
    /// Print only warnings and errors to stderr: no progress and no notes
    #[arg(long, short, global = true)]
    pub(crate) quiet: bool,
    #[command(subcommand)]
    pub(crate) command: Command,
}

/// Returns the version of flap and a hash of the sources that determine the rows. Two builds of flap with the
/// same hash write the same rows for the same grid.
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
    /// Run one design point and print its measures
    Run(RunArgs),
    /// Follow the motions of designs while a parameter rises and falls, and find hysteresis
    Respond(RespondArgs),
    /// Compute the force and torque of a vehicle, the effect of each input on force and torque, and trims
    Vehicle(VehicleArgs),
    /// Find the best design within the ranges of a grid file's axes, under conditions on measures
    Optimise(OptimiseArgs),
    /// Open a page with sliders for the parameters, and curves that change with the sliders
    #[cfg(feature = "live")]
    Live(LiveArgs),
    /// Check a grid file and summarize the sweep that it describes
    Check(CheckArgs),
    /// List the best rows of results
    Top(TopArgs),
    /// Summarize results: statuses, percentiles, and the values of the axes in the best rows
    Describe(DescribeArgs),
    /// Draw results as a picture, or write a page on which you explore the results in a browser
    #[cfg(feature = "plots")]
    Plot(PlotArgs),
    /// Resume, rerun, merge, convert or verify results
    #[command(subcommand)]
    Results(ResultsCommand),
    /// Simulate experiments on one wing: chirps, impulses, resonances, filmed motions
    #[command(subcommand)]
    Test(TestCommand),
    /// Write a device file, which describes your own robot
    #[command(subcommand)]
    Device(DeviceCommand),
    /// List models and presets, or explain parameters, columns, settings and statuses
    Models(ModelsArgs),
    /// Generate shell completions, manual pages, or the JSON schema of grid files
    #[command(subcommand)]
    Generate(GenerateCommand),
}

/// The groups of commands in `flap --help`, each with a title and the names of its commands.
const GROUPS: [(&str, &[&str]); 4] = [
    ("Compute", &["sweep", "run", "respond", "vehicle", "optimise", "live", "check"]),
    ("Results", &["top", "describe", "plot", "results"]),
    ("Your robot", &["test", "device"]),
    ("Reference", &["models", "generate", "help"]),
];

const EXIT_CODES: &str = "\
flap prints results to stdout, and all other messages to stderr.

Exit codes:
  0    done
  1    with --strict: some points are not periodic; `results verify`: some files have no checksums;
       `optimise`: no design satisfies all conditions
  2    the command line or an input file has a mistake, or an input file does not exist
  3    reading or writing failed, or results are damaged
  130  interrupted; run the same command again to continue a sweep
  101  an internal error in flap";

static LINE: OnceLock<Vec<OsString>> = OnceLock::new();

/// Stores the words of the command line. Only the first call has an effect.
pub(crate) fn set_line(line: Vec<OsString>) {
    LINE.get_or_init(|| line);
}

/// Returns the words of the command line, beginning with the name of the program.
pub(crate) fn line() -> &'static [OsString] {
    LINE.get().map_or(&[], Vec::as_slice)
}

/// Parses the command line. If the command line has mistakes, prints the mistakes and ends the process.
pub(crate) fn parse() -> Args {
    Args::try_parse_from(line()).unwrap_or_else(|_| {
        // clap prints help, which has groups and examples, as an error. Building them takes longer than parsing.
        let matches = command().try_get_matches_from(line()).unwrap_or_else(|error| with_hint(error).exit());
        Args::from_arg_matches(&matches).unwrap_or_else(|error| error.exit())
    })
}

/// Adds a hint to the error for an unknown command if a group contains a command with this name. For example,
/// the hint for `flap merge` is to use `flap results merge`.
fn with_hint(mut error: clap::Error) -> clap::Error {
    let Some(ContextValue::String(name)) = error.get(ContextKind::InvalidSubcommand) else { return error };
    let command = Args::command();
    let mut groups = command.get_subcommands().filter(|group| group.find_subcommand(name).is_some());
    if let Some(group) = groups.next() {
        let hint = format!("use `flap {} {name}`", group.get_name());
        error.insert(ContextKind::Suggested, ContextValue::StyledStrs(vec![hint.into()]));
    }
    error
}

/// Builds the clap command of `flap`. `flap --help` lists the commands in groups, and the help of each
/// command has an example at the top.
pub(crate) fn command() -> clap::Command {
    let mut command = Args::command();
    // Adds the command `help`, which the groups list.
    command.build();
    let groups = groups(&command);
    let template = format!(
        "{{about-with-newline}}\n{{usage-heading}} {{usage}}\n{groups}\nOptions:\n{{options}}{{after-help}}"
    );
    let command = Args::command().help_template(template).mut_subcommands(with_example);
    let is_negative = |word: &OsString| {
        let number = word.to_str().and_then(|word| word.strip_prefix('-'));
        number.is_some_and(|number| number.starts_with(|first: char| first.is_ascii_digit() || first == '.'))
    };
    if line().iter().any(is_negative) { with_negative_numbers(command) } else { command }
}

/// Lets every option of a command, and of its subcommands, have a value such as `-1s`. The parsers of the
/// options then explain which values are allowed.
fn with_negative_numbers(command: clap::Command) -> clap::Command {
    let allow = |arg: clap::Arg| {
        let is_option = !arg.is_positional() && arg.get_action().takes_values();
        if is_option { arg.allow_hyphen_values(true) } else { arg }
    };
    command.mut_args(allow).mut_subcommands(with_negative_numbers)
}

/// Returns the list of commands for `flap --help`, in groups, with the first line of each command's help.
fn groups(command: &clap::Command) -> String {
    let mut text = String::new();
    for (title, names) in GROUPS {
        let _ = writeln!(text, "\n{title}:");
        for name in names {
            // Some builds lack some commands.
            if let Some(about) = command.find_subcommand(name).and_then(clap::Command::get_about) {
                let _ = writeln!(text, "  {name:<10}{about}");
            }
        }
    }
    text
}

/// Adds the first example of a command, and of each of its subcommands, above the usage line.
fn with_example(command: clap::Command) -> clap::Command {
    let help = command.get_after_help().map(ToString::to_string).unwrap_or_default();
    let lines = help.lines().skip_while(|line| !line.starts_with("Example"));
    let first = lines.map(str::trim).find(|line| line.starts_with("flap "));
    let command = match first {
        Some(example) => command.help_template(format!(
            "{{about-with-newline}}\nExample: {example}\n\n{{usage-heading}} {{usage}}\n\n{{all-args}}{{after-help}}"
        )),
        None => command,
    };
    command.mut_subcommands(with_example)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn groups_list_every_command() {
        let mut listed: Vec<&str> = GROUPS.iter().flat_map(|(_, names)| names.iter().copied()).collect();
        listed.retain(|name| *name != "help");
        let command = Args::command();
        let known: Vec<&str> = command.get_subcommands().map(clap::Command::get_name).collect();
        for name in &known {
            assert!(listed.contains(name), "`flap --help` does not list {name}");
        }
    }
}
