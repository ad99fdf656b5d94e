//! `flap device new`: prints a device file.

use flap_sweep::grid;

use crate::args::NewArgs;
use crate::cmd::point;
use crate::console;
use crate::failure::{Exit, Failure};

pub(super) fn run(args: &NewArgs) -> Result<Exit, Failure> {
    let plan = point::plan(&args.what)?;
    point::check_one_wing(&plan, &args.what, "`flap device new`")?;
    console::results(&grid::device(&plan))?;
    Ok(Exit::Done)
}
