//! `flap device`: device files.

mod new;
mod wing;

use crate::args::DeviceCommand;
use crate::failure::{Exit, Failure};

/// Runs a command of the group `flap device`.
pub(crate) fn run(command: &DeviceCommand) -> Result<Exit, Failure> {
    match command {
        DeviceCommand::New(args) => new::run(args),
        DeviceCommand::Wing(args) => wing::run(args),
    }
}
