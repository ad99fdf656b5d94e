//! Reads grids from a file or from stdin.

use std::io;
use std::path::Path;

use flap_sweep::grid;
use flap_sweep::plan::Plan;

use crate::console;
use crate::failure::Failure;
use crate::models;

/// The name that messages and sidecars use for a grid from stdin.
const STDIN: &str = "<stdin>";

/// Reads the grid file at `path`, or a grid from stdin if the path is `-`. Returns the plan, which contains
/// the points of the grid.
pub(super) fn read(path: &Path) -> Result<Plan, Failure> {
    let plan = if is_stdin(path) {
        grid::read_from(io::stdin().lock(), Path::new(STDIN), models::all())
    } else {
        grid::read(path, models::all())
    };
    let plan = plan?;
    for parameter in plan.unreached() {
        console::warn(&format!(
            "{}: `{1}` has no effect: every wing sets its own `{1}`",
            plan.source().name,
            parameter.name
        ));
    }
    Ok(plan)
}

/// Returns true for `-`, which stands for stdin.
pub(super) fn is_stdin(path: &Path) -> bool {
    path.as_os_str() == "-"
}
