//! Grids that commands read: from a file, or from stdin.

use std::io;
use std::path::Path;

use flap_sweep::grid;
use flap_sweep::plan::Plan;

use super::outputs::is_stdout;
use crate::console;
use crate::failure::Failure;
use crate::models;

/// The name of stdin in messages and sidecars.
const STDIN: &str = "<stdin>";

/// The plan of the grid file at `path`, or of the grid that comes from stdin if the path is `-`.
pub(super) fn read(path: &Path) -> Result<Plan, Failure> {
    let plan = if is_stdin(path) {
        grid::read_from(io::stdin().lock(), Path::new(STDIN), models::all())
    } else {
        grid::read(path, models::all())
    };
    let plan = plan?;
    for parameter in plan.renamed() {
        console::warn(&format!("{}: {}", plan.source().name, parameter.renamed()));
    }
    for parameter in plan.unreached() {
        console::warn(&format!(
            "{}: `{1}` reaches no wing: each has a `{1}` of its own",
            plan.source().name,
            parameter.name
        ));
    }
    Ok(plan)
}

/// True for `-`, the name of stdin where a grid is read.
pub(super) fn is_stdin(path: &Path) -> bool {
    is_stdout(path)
}
