//! The `flap` command, for programs that bring models of their own.
//!
//! ```no_run
//! use flap_core::simulate::{self, Simulator};
//!
//! fn main() -> std::process::ExitCode {
//!     // Models of your own stand beside those of the papers.
//!     let own: &[&'static dyn Simulator] = &[];
//!     flap_cli::run([simulate::all(), own].concat())
//! }
//! ```

mod args;
mod cmd;
mod complete;
mod console;
mod data;
mod duration;
mod failure;
mod job;
mod models;
#[cfg(feature = "plots")]
mod plot;
mod progress;
mod signals;
mod statuses;
mod table;

use std::process::ExitCode;

use args::{Args, Command};
use clap::Parser;
use flap_core::simulate::Simulator;

/// Runs the command line of this process with these models.
///
/// Returns its exit code; a command line with mistakes ends the process. Only the first call of a process sets the models.
pub fn run(models: Vec<&'static dyn Simulator>) -> ExitCode {
    models::set(models);
    complete::answer();
    let args = Args::parse();
    if args.quiet {
        console::be_quiet();
    }
    signals::refuse_large_files();
    let ended = match args.command {
        Command::Sweep(args) => cmd::sweep::run(&args),
        Command::Resume(args) => cmd::resume::run(&args),
        Command::Rerun(args) => cmd::rerun::run(&args),
        Command::Merge(args) => cmd::merge::run(&args),
        Command::Convert(args) => cmd::convert::run(&args),
        Command::Verify(args) => cmd::verify::run(&args),
        Command::Run(args) => cmd::run::run(&args),
        Command::Respond(args) => cmd::respond::run(&args),
        Command::Vehicle(args) => cmd::vehicle::run(&args),
        #[cfg(feature = "live")]
        Command::Live(args) => cmd::live::run(&args),
        Command::Top(args) => cmd::top::run(&args),
        Command::Describe(args) => cmd::describe::run(&args),
        #[cfg(feature = "plots")]
        Command::Plot(args) => plot::run(&args),
        Command::Resonance(args) => cmd::resonance::run(&args),
        Command::Check(args) => cmd::check::run(&args),
        Command::Lift(args) => cmd::lift::run(&args),
        Command::Track(args) => cmd::track::run(&args),
        Command::New(args) => cmd::new::run(&args),
        Command::Wing(args) => cmd::wing::run(&args),
        Command::Params(args) => cmd::params::run(&args),
        Command::Explain(args) => cmd::explain::run(&args),
        Command::Models => cmd::models::run(),
        Command::Schema(args) => cmd::schema::run(&args),
        Command::Completions(args) => cmd::completions::run(&args),
        Command::Man(args) => cmd::man::run(&args),
    };
    let exit = ended.unwrap_or_else(failure::Failure::report);
    ExitCode::from(exit as u8)
}
