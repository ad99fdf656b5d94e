//! `flap device new`: prints a device file.

use flap_sweep::grid;
use flap_sweep::plan::Plan;

use crate::args::NewArgs;
use crate::cmd::point;
use crate::console;
use crate::failure::{Exit, Failure};
use crate::table::assignment;

pub(super) fn run(args: &NewArgs) -> Result<Exit, Failure> {
    let plan = point::plan(&args.what)?;
    point::check_one_wing(&plan, &args.what, "`flap device new`")?;
    let text = grid::device(&plan)?;
    let written: Vec<String> = plan.axes().varied().map(|axis| before_axes(&plan, axis)).collect();
    if !written.is_empty() {
        console::say(&format!(
            "a device has no axes: it has the values before the axes are applied, {}",
            written.join(", ")
        ));
    }
    console::results(&text)?;
    Ok(Exit::Done)
}

/// Returns a varied parameter with its value in the printed device. The printed device does not use the axes
/// of the grid file. If the grid file lists several devices, flap prints the values of the first device.
fn before_axes(plan: &Plan, index: usize) -> String {
    let parameter = &plan.parameters()[index];
    let value = match (plan.base()[index], plan.in_designs(index)) {
        _ if plan.design() == Some(index) => plan.point(0).values[index],
        (_, Some(of_designs)) => of_designs[0],
        (value, None) => value.in_point(),
    };
    if value.is_nan() { format!("{} is not set", parameter.name) } else { assignment(parameter, value) }
}
