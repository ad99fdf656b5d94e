//! `flap test`: experiments on one wing.

mod chirp;
mod impulse;
mod lift;
mod resonance;
mod terms;
mod track;

use crate::args::TestCommand;
use crate::failure::{Exit, Failure};

/// Runs a command of the group `flap test`.
pub(crate) fn run(command: &TestCommand) -> Result<Exit, Failure> {
    match command {
        TestCommand::Chirp(args) => chirp::run(args),
        TestCommand::Impulse(args) => impulse::run(args),
        TestCommand::Lift(args) => lift::run(args),
        TestCommand::Resonance(args) => resonance::run(args),
        TestCommand::Terms(args) => terms::run(args),
        TestCommand::Track(args) => track::run(args),
    }
}
