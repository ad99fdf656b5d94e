//! Grids and their rows.

use flap_core::num::Backend;
use flap_core::simulate::{Point, Row, Rows, SolverSettings, all, never, run_list};
use flap_sweep::plan::Plan;

/// The plan of a grid file.
pub(crate) fn plan(grid: &str) -> Plan {
    flap_sweep::grid::parse("grid.toml", grid, all()).unwrap_or_else(|problems| panic!("{problems:?}"))
}

/// The messages about a grid file with mistakes.
pub(crate) fn mistakes(grid: &str) -> Vec<String> {
    let problems = flap_sweep::grid::parse("grid.toml", grid, all()).err().expect("there are mistakes");
    problems.iter().map(ToString::to_string).collect()
}

/// The rows of points, on lanes.
pub(crate) fn rows(what: &dyn Rows, solver: &SolverSettings, points: Vec<Vec<f64>>) -> Vec<Row> {
    let points = (0..).zip(points).map(|(index, values)| Point::at_rest(index, values)).collect();
    run_list(what, Backend::best(), solver, points, &never).expect("every point has a row")
}

/// The index of a column.
pub(crate) fn column(what: &dyn Rows, name: &str) -> usize {
    what.columns().iter().position(|column| column.name == name).expect("a column")
}

/// The index of a parameter.
pub(crate) fn parameter(plan: &Plan, name: &str) -> usize {
    plan.parameters().iter().position(|parameter| parameter.name == name).expect("a parameter")
}

/// Numbers as bits, so that NaN equals NaN.
pub(crate) fn bits(numbers: &[f64]) -> Vec<u64> {
    numbers.iter().map(|number| number.to_bits()).collect()
}
