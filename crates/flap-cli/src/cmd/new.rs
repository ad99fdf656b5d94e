//! `flap new`: a device as text, to be edited.

use flap_sweep::grid;

use super::point;
use crate::args::NewArgs;
use crate::console;
use crate::failure::{Exit, Failure};

pub(crate) fn run(args: &NewArgs) -> Result<Exit, Failure> {
    let plan = point::plan(&args.what)?;
    point::check_one_wing(&plan, &args.what, "a device, which `flap new` writes,")?;
    console::results(&grid::device(&plan))?;
    Ok(Exit::Done)
}
