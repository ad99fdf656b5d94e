//! Rows of many points, from lanes.

use flap_core::num::InstructionSet;
use flap_core::simulate::{Jobs, Point, Row, Simulator, SolverSettings, Status};

/// Points given in order; rows kept by index.
struct Listed<'a> {
    points: &'a [Vec<f64>],
    next: usize,
    rows: Vec<Option<Row>>,
}

impl Jobs for Listed<'_> {
    fn next(&mut self, _idle: bool) -> Option<Point> {
        let values = self.points.get(self.next)?.clone();
        self.next += 1;
        Some(Point { index: self.next as u64 - 1, values })
    }

    fn done(&mut self, index: u64, row: Row) {
        let slot = &mut self.rows[index as usize];
        assert!(slot.is_none(), "point {index} has two rows");
        *slot = Some(row);
    }
}

/// The rows of `points` on the lanes of `set`, in their order.
pub(crate) fn of(
    model: &dyn Simulator,
    points: &[Vec<f64>],
    set: InstructionSet,
    solver: &SolverSettings,
) -> Vec<Row> {
    let mut listed = Listed { next: 0, rows: vec![None; points.len()], points };
    model.run(set, solver, &mut listed);
    listed.rows.into_iter().map(|row| row.expect("every point has a row")).collect()
}

/// A row's numbers as bits, so that NaN equals NaN.
pub(crate) fn bits(row: &Row) -> (Status, Vec<u64>, u32, u64, u32, u64, &Option<String>) {
    let measures = row.measures.iter().map(|m| m.to_bits()).collect();
    (row.status, measures, row.cycles, row.residual.to_bits(), row.period, row.rhs_evals, &row.reason)
}

/// Fails unless rows from the lanes of every instruction set equal those of the scalar path to the last bit; gives
/// those of the best set.
pub(crate) fn assert_lanes_equal_scalars(
    model: &dyn Simulator,
    points: &[Vec<f64>],
    solver: &SolverSettings,
) -> Vec<Row> {
    let mut best = None;
    for set in InstructionSet::available() {
        let rows = of(model, points, set, solver);
        for (i, (values, row)) in points.iter().zip(&rows).enumerate() {
            let alone = model.run_point(set, solver, values);
            assert_eq!(bits(row), bits(&alone), "point {i} with {set}");
            let measured = row.status == Status::Periodic;
            assert_eq!(row.measures.len(), if measured { model.columns().len() } else { 0 });
        }
        best.get_or_insert(rows);
    }
    best.unwrap()
}
