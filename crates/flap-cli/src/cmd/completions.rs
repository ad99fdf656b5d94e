//! `flap completions`: a script that completes commands and options in a shell.

use clap::CommandFactory as _;
use clap_complete::generate;

use crate::args::{Args, CompletionsArgs};
use crate::console;
use crate::failure::{Exit, Failure};

pub(crate) fn run(args: &CompletionsArgs) -> Result<Exit, Failure> {
    let mut script = Vec::new();
    generate(args.shell, &mut Args::command(), "flap", &mut script);
    console::results(&String::from_utf8_lossy(&script))?;
    Ok(Exit::Done)
}
