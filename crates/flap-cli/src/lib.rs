//! The `flap` command as a library, for programs with additional models.
//!
//! ```no_run
//! use flap_core::simulate::{self, Simulator};
//!
//! fn main() -> std::process::ExitCode {
//!     // Your models are added to the models of the papers.
//!     let own: &[&'static dyn Simulator] = &[];
//!     flap_cli::run([simulate::all(), own].concat())
//! }
//! ```

mod args;
mod cmd;
mod complete;
mod console;
#[cfg_attr(not(feature = "plots"), allow(dead_code, reason = "some functions are only for pictures"))]
mod data;
mod duration;
mod failure;
mod job;
mod models;
#[cfg(feature = "plots")]
mod plot;
mod print;
mod progress;
mod statuses;
mod system;
mod table;

use std::env;
use std::ffi::OsString;
use std::process::ExitCode;

use args::Command;
use failure::{Exit, Failure};
use flap_core::simulate::Simulator;

/// Runs the command line of this process with the given models, and returns the exit code.
///
/// If the command line has mistakes, the process ends. Only the first call in a process sets the models.
pub fn run(models: Vec<&'static dyn Simulator>) -> ExitCode {
    ExitCode::from(run_line(env::args_os().collect(), models))
}

/// Runs a command line with the given models, and returns the exit code. The first word is the name of the program.
///
/// If the command line has mistakes, the process ends. Only the first call in a process sets the line and the models.
pub fn run_line(line: Vec<OsString>, models: Vec<&'static dyn Simulator>) -> u8 {
    models::set(models);
    args::set_line(line);
    complete::answer();
    let args = args::parse();
    if args.quiet {
        console::be_quiet();
    }
    system::refuse_large_files();
    run_command(&args.command).unwrap_or_else(Failure::report) as u8
}

/// Runs a command.
fn run_command(command: &Command) -> Result<Exit, Failure> {
    match command {
        Command::Sweep(args) => cmd::sweep::run(args),
        Command::Run(args) => cmd::run::run(args),
        Command::Respond(args) => cmd::respond::run(args),
        Command::Vehicle(args) => cmd::vehicle::run(args),
        Command::Optimise(args) => cmd::optimise::run(args),
        #[cfg(feature = "live")]
        Command::Live(args) => cmd::live::run(args),
        Command::Check(args) => cmd::check::run(args),
        Command::Top(args) => cmd::top::run(args),
        Command::Describe(args) => cmd::describe::run(args),
        #[cfg(feature = "plots")]
        Command::Plot(args) => plot::run(args),
        Command::Results(command) => cmd::results::run(command),
        Command::Test(command) => cmd::test::run(command),
        Command::Device(command) => cmd::device::run(command),
        Command::Models(args) => cmd::models::run(args),
        Command::Generate(command) => cmd::generate::run(command),
    }
}
