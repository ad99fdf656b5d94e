//! Grids and their rows.

use flap_core::num::Backend;
use flap_core::simulate::{Jobs, Point, Row, Rows, SolverSettings, all};
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

/// Points in order; rows by index.
struct Listed {
    points: Vec<Vec<f64>>,
    next: usize,
    rows: Vec<Option<Row>>,
}

impl Jobs for Listed {
    fn next(&mut self, _idle: bool) -> Option<Point> {
        let values = self.points.get(self.next)?.clone();
        self.next += 1;
        Some(Point::at_rest(self.next as u64 - 1, values))
    }

    fn done(&mut self, index: u64, row: Row) {
        let place = &mut self.rows[usize::try_from(index).expect("few points")];
        assert!(place.is_none(), "point {index} has two rows");
        *place = Some(row);
    }
}

/// The rows of points, on lanes.
pub(crate) fn rows(what: &dyn Rows, solver: &SolverSettings, points: Vec<Vec<f64>>) -> Vec<Row> {
    let mut listed = Listed { rows: vec![None; points.len()], points, next: 0 };
    what.run(Backend::best(), solver, &mut listed);
    listed.rows.into_iter().map(|row| row.expect("every point has a row")).collect()
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
