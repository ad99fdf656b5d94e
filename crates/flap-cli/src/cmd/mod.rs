//! Commands, one module each, and the code that they share.

mod check;
mod describe;
mod device;
mod far;
mod generate;
mod gradient;
mod grid;
#[cfg(feature = "live")]
mod live;
mod look;
mod models;
mod motion;
pub(crate) mod outputs;
mod point;
mod respond;
mod results;
mod run;
mod samples;
mod shown;
mod sweep;
mod test;
mod top;
mod vehicle;

use crate::args::Command;
use crate::failure::{Exit, Failure};
#[cfg(feature = "plots")]
use crate::plot;

/// Runs a command.
pub(crate) fn run(command: &Command) -> Result<Exit, Failure> {
    match command {
        Command::Sweep(args) => sweep::run(args),
        Command::Run(args) => run::run(args),
        Command::Respond(args) => respond::run(args),
        Command::Vehicle(args) => vehicle::run(args),
        #[cfg(feature = "live")]
        Command::Live(args) => live::run(args),
        Command::Check(args) => check::run(args),
        Command::Top(args) => top::run(args),
        Command::Describe(args) => describe::run(args),
        #[cfg(feature = "plots")]
        Command::Plot(args) => plot::run(args),
        Command::Results(command) => results::run(command),
        Command::Test(command) => test::run(command),
        Command::Device(command) => device::run(command),
        Command::Models(args) => models::run(args),
        Command::Generate(command) => generate::run(command),
    }
}
