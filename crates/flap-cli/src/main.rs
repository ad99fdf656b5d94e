//! The `flap` command.

mod args;
mod cmd;
mod console;
mod failure;
mod job;
#[cfg(feature = "plots")]
mod plot;
mod progress;
mod signals;
mod table;

use std::process::ExitCode;

use args::{Args, Command};
use clap::Parser;

fn main() -> ExitCode {
    let ended = match Args::parse().command {
        Command::Sweep(args) => cmd::sweep::run(&args),
        Command::Resume(args) => cmd::resume::run(&args),
        Command::Rerun(args) => cmd::rerun::run(&args),
        Command::Merge(args) => cmd::merge::run(&args),
        Command::Convert(args) => cmd::convert::run(&args),
        Command::Verify(args) => cmd::verify::run(&args),
        Command::Run(args) => cmd::run::run(&args),
        Command::Respond(args) => cmd::respond::run(&args),
        #[cfg(feature = "plots")]
        Command::Plot(args) => plot::run(&args),
        Command::Resonance(args) => cmd::resonance::run(&args),
        Command::Check(args) => cmd::check::run(&args),
        Command::Lift(args) => cmd::lift::run(&args),
        Command::Track(args) => cmd::track::run(&args),
        Command::Params(args) => cmd::params::run(&args),
        Command::Models => cmd::models::run(),
    };
    let exit = ended.unwrap_or_else(failure::Failure::report);
    ExitCode::from(exit as u8)
}
