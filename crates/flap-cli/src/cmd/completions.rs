//! `flap completions`: a script with which a shell asks this program for completions.

use std::env;
use std::path::{Path, PathBuf};

use clap_complete::env::Shells;

use crate::args::CompletionsArgs;
use crate::complete::VARIABLE;
use crate::console;
use crate::failure::{Exit, Failure};

pub(crate) fn run(args: &CompletionsArgs) -> Result<Exit, Failure> {
    let program = env::args_os().next().map_or_else(|| "flap".into(), PathBuf::from);
    let name = program.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    // One that the shell finds by its name stays so: another may be installed later.
    let is_found = program.parent().is_none_or(|folder| folder == Path::new(""));
    let called = if is_found { program } else { std::path::absolute(program)? };
    let mut script = Vec::new();
    let shell = args.shell.to_string();
    let shells = Shells::builtins();
    let shell = shells.completer(&shell).ok_or_else(|| Failure::Bug(format!("no scripts for {shell}")))?;
    shell.write_registration(VARIABLE, &name, &name, &called.to_string_lossy(), &mut script)?;
    console::results(&String::from_utf8_lossy(&script))?;
    Ok(Exit::Done)
}
