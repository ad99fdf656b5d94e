//! `flap check`: what a grid file would run.

use std::fmt::Write as _;

use flap_core::parameter::Parameter;
use flap_core::simulate::{Point, SolverSettings};
use flap_sweep::plan::Plan;
use flap_sweep::resonance::Range;
use flap_sweep::{spec, text};

use crate::args::CheckArgs;
use crate::console;
use crate::failure::{Exit, Failure};
use crate::table::Table;

pub(crate) fn run(args: &CheckArgs) -> Result<Exit, Failure> {
    let plan = spec::read(&args.grid)?;
    console::results(&page(&plan))?;
    Ok(Exit::Done)
}

fn page(plan: &Plan) -> String {
    let points = if plan.len() == 1 { "1 point".to_owned() } else { format!("{} points", plan.len()) };
    let mut page = format!("{points} of {} from {}\n", plan.simulator.name(), plan.preset);
    if !plan.axes.is_empty() {
        page += "\n";
        page += &axes(plan);
        page += "\n";
        page += &ends(plan);
    }
    if let Some(resonance) = &plan.resonance {
        page += "\n";
        page += &at_resonance(resonance.range());
    }
    page += "\n";
    page += &solver(&plan.solver);
    if let Some(path) = &plan.output.path {
        let _ = write!(page, "\nrows go to {}\n", path.display());
    }
    page
}

/// One line per varied parameter; parameters that move together have the same axis number.
fn axes(plan: &Plan) -> String {
    let mut table = Table::with_headings(&["axis", "parameter", "from", "to", "count", "unit"]);
    for (number, axis) in plan.axes.iter().enumerate() {
        for (index, values) in &axis.parameters {
            let parameter = &plan.parameters()[*index];
            let show = |position| text::value(parameter, values.get(position));
            table.row([
                (number + 1).to_string(),
                parameter.name.to_owned(),
                show(0),
                show(values.len() - 1),
                values.len().to_string(),
                parameter.unit.to_owned(),
            ]);
        }
    }
    table.text()
}

/// The varied parameters of the first and the last point.
fn ends(plan: &Plan) -> String {
    let mut text = String::new();
    for (which, index) in [("first", 0), ("last", plan.len() - 1)] {
        let point = plan.point(index);
        let varied =
            plan.varied().map(|parameter| assignment(&plan.parameters()[parameter], parameter, &point));
        let _ = writeln!(text, "{which} point, {index}: {}", varied.collect::<Vec<_>>().join(", "));
    }
    text
}

fn assignment(parameter: &Parameter, index: usize, point: &Point) -> String {
    let text =
        format!("{} = {} {}", parameter.name, text::value(parameter, point.values[index]), parameter.unit);
    text.trim_end().to_owned()
}

/// Where the drive frequency of each point is looked for.
fn at_resonance(range: &Range) -> String {
    let Range { of, from, to, tolerance } = range;
    let from =
        from.map_or_else(|| "half of the lower natural frequency".to_owned(), |from| format!("{from} Hz"));
    let to = to.map_or_else(
        || "one and a half times the upper natural frequency".to_owned(),
        |to| format!("{to} Hz"),
    );
    format!(
        "drive_frequency: that of the largest {}, from {from} to {to}, within {tolerance} Hz\n",
        of.name()
    )
}

fn solver(settings: &SolverSettings) -> String {
    let SolverSettings { rtol, atol, settle_tol, max_cycles, max_steps, newton } = *settings;
    let [rtol, atol, settle_tol] = [rtol, atol, settle_tol].map(text::float);
    format!(
        "rtol = {rtol}, atol = {atol}, settle_tol = {settle_tol}, max_cycles = {max_cycles}, \
         max_steps = {max_steps}, newton = {newton}\n"
    )
}
