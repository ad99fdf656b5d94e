//! Rows of many points, from lanes.

use flap_core::num::Backend;
use flap_core::simulate::{Point, PointRun, Row, Simulator, SolverSettings, Status, never, run_list};

/// Settings for many points: large tolerances, and few periods for motions that do not settle.
pub(crate) const QUICK: SolverSettings = SolverSettings {
    rtol: 1e-5,
    atol: 1e-7,
    settle_tol: 1e-5,
    max_cycles: 60,
    max_steps: 500,
    accuracy: 1e-3,
    newton: true,
    progressive: true,
    symmetry: true,
    loads: false,
};

/// Points at rest.
fn at_rest(points: &[Vec<f64>]) -> Vec<Point> {
    (0..).zip(points).map(|(index, values)| Point::at_rest(index, values.clone())).collect()
}

/// The rows of `points` on the lanes of `backend`, in their order, each from rest.
pub(crate) fn of(
    model: &dyn Simulator,
    points: &[Vec<f64>],
    backend: Backend,
    solver: &SolverSettings,
) -> Vec<Row> {
    of_points(model, &at_rest(points), backend, solver)
}

/// The rows of `points` on the lanes of `backend`, in the order of `points`.
pub(crate) fn of_points(
    model: &dyn Simulator,
    points: &[Point],
    backend: Backend,
    solver: &SolverSettings,
) -> Vec<Row> {
    run_list(model, backend, solver, points.to_vec(), &never).expect("every point has a row")
}

/// A row's numbers as bits, so that NaN equals NaN.
pub(crate) fn bits(row: &Row) -> (Status, Vec<u64>, u32, u32, u64, &Option<String>) {
    let numbers =
        [&row.measures[..], &row.state, &[row.residual, row.floquet_max, row.error_estimate]].concat();
    let numbers = numbers.iter().map(|number| number.to_bits()).collect();
    (row.status, numbers, row.cycles, row.period, row.rhs_evals, &row.reason)
}

/// Fails unless rows from the lanes of every backend equal the rows of the scalar path to the last bit. Returns the
/// rows of the best backend.
pub(crate) fn assert_lanes_equal_scalars(
    model: &dyn Simulator,
    points: &[Vec<f64>],
    solver: &SolverSettings,
) -> Vec<Row> {
    assert_lanes_equal_scalars_at(model, &at_rest(points), solver)
}

/// [`assert_lanes_equal_scalars`] for points with any initial state.
pub(crate) fn assert_lanes_equal_scalars_at(
    model: &dyn Simulator,
    points: &[Point],
    solver: &SolverSettings,
) -> Vec<Row> {
    let mut best = None;
    for backend in Backend::available() {
        let rows = of_points(model, points, backend, solver);
        for (i, (point, row)) in points.iter().zip(&rows).enumerate() {
            let alone =
                model.run_point(&PointRun::new(backend, solver, &point.values), point.begin.as_deref());
            assert_eq!(bits(row), bits(&alone), "point {i} with {backend}");
            let measured = row.status == Status::Periodic;
            assert_eq!(row.measures.len(), if measured { model.columns().len() } else { 0 });
        }
        best.get_or_insert(rows);
    }
    best.unwrap()
}

/// The larger of two errors; NaN if one of the errors is NaN.
pub(crate) fn worse(one: f64, other: f64) -> f64 {
    if one.is_nan() || one > other { one } else { other }
}
