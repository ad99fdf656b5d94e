//! `flap generate`: files for shells, manual pages, and a schema for editors.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use clap_complete::env::Shells;
use clap_mangen::Man;
use flap_sweep::grid::schema;

use crate::args::{self, CompletionsArgs, GenerateCommand, ManArgs, SchemaArgs};
use crate::complete::VARIABLE;
use crate::console;
use crate::failure::{Exit, Failure};
use crate::models;

/// Runs a command of the group `flap generate`.
pub(crate) fn run(command: &GenerateCommand) -> Result<Exit, Failure> {
    match command {
        GenerateCommand::Completions(args) => completions(args),
        GenerateCommand::Man(args) => man(args),
        GenerateCommand::Schema(args) => schema(args),
    }
}

/// Prints a script for a shell. With this script, the shell requests completions from the command `flap`.
fn completions(args: &CompletionsArgs) -> Result<Exit, Failure> {
    let program = args::line().first().map_or_else(|| "flap".into(), PathBuf::from);
    let name = program.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    // If the shell found the program by name, the script keeps that name: another version may be installed later.
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

/// Writes the manual pages, one per command.
fn man(args: &ManArgs) -> Result<Exit, Failure> {
    let folder = &args.folder;
    let mut command = args::command().disable_help_subcommand(true);
    command.build();
    let mut pages = Vec::new();
    add_pages(command, folder, &mut pages)?;
    let is_other = |path: &Path, text: &[u8]| path.exists() && fs::read(path).ok().as_deref() != Some(text);
    if let Some((path, _)) = pages.iter().find(|(path, text)| !args.overwrite.force && is_other(path, text)) {
        let failure = Failure::usage(format!("{} exists and has another text", path.display()));
        return Err(failure.help("use --force to overwrite the files of all pages, or choose another folder"));
    }
    let write = || {
        fs::create_dir_all(folder)?;
        pages.iter().try_for_each(|(path, text)| fs::write(path, text))
    };
    write().map_err(|error| Failure::cannot_write(folder, &error))?;
    console::say(&format!(
        "manual pages in {}: `man -l {}` shows the first",
        folder.display(),
        folder.join("flap.1").display()
    ));
    Ok(Exit::Done)
}

/// Adds the manual pages of a command and of its subcommands, each with the path of its file in `folder`.
fn add_pages(command: clap::Command, folder: &Path, pages: &mut Vec<(PathBuf, Vec<u8>)>) -> io::Result<()> {
    for subcommand in command.get_subcommands().filter(|subcommand| !subcommand.is_hide_set()) {
        add_pages(subcommand.clone(), folder, pages)?;
    }
    let (page, mut text) = (Man::new(command), Vec::new());
    page.render(&mut text)?;
    pages.push((folder.join(page.get_filename()), text));
    Ok(())
}

/// Prints a JSON schema of grid files.
fn schema(args: &SchemaArgs) -> Result<Exit, Failure> {
    let schema = match &args.preset {
        None => schema::of_models(models::all()),
        Some(name) => {
            let (model, preset) = models::preset(name).ok_or_else(|| {
                let failure = Failure::usage(format!("there is no preset `{name}`"));
                failure.nearest(name, models::presets(), "`flap models` lists models and presets")
            })?;
            schema::of_preset(model, preset)
        }
    };
    console::results(&format!("{schema:#}\n"))?;
    Ok(Exit::Done)
}
