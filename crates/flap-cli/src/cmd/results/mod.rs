//! `flap results`: commands for results files.

mod convert;
mod merge;
mod rerun;
mod resume;
mod verify;

use crate::args::ResultsCommand;
use crate::failure::{Exit, Failure};

/// Runs a command of the group `flap results`.
pub(crate) fn run(command: &ResultsCommand) -> Result<Exit, Failure> {
    match command {
        ResultsCommand::Convert(args) => convert::run(args),
        ResultsCommand::Merge(args) => merge::run(args),
        ResultsCommand::Rerun(args) => rerun::run(args),
        ResultsCommand::Resume(args) => resume::run(args),
        ResultsCommand::Verify(args) => verify::run(args),
    }
}
