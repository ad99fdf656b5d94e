//! `flap man`: the manual pages, one per command.

use std::fs;

use clap::CommandFactory as _;
use clap_mangen::generate_to;

use crate::args::{Args, ManArgs};
use crate::console;
use crate::failure::{Exit, Failure};

pub(crate) fn run(args: &ManArgs) -> Result<Exit, Failure> {
    let folder = &args.folder;
    let written = fs::create_dir_all(folder).and_then(|()| generate_to(Args::command(), folder));
    written.map_err(|error| Failure::cannot_write(folder, &error))?;
    console::say(&format!(
        "manual pages in {}: `man -l {}` shows the first",
        folder.display(),
        folder.join("flap.1").display()
    ));
    Ok(Exit::Done)
}
