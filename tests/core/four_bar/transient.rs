//! The motion from rest against the reference.

use flap_core::num::Backend;
use flap_core::simulate::{PointRun, SolverSettings, TrajectoryRequest};

use super::steady::model;
use super::{assert_close_to, params};
use crate::data::table;

#[test]
fn five_cycles_from_rest_equal_the_reference() {
    let solver = SolverSettings { rtol: 1e-9, atol: 1e-11, ..SolverSettings::default() };
    let request = TrajectoryRequest { cycles: 5, samples_per_cycle: 10, settled: false };
    let values = params("sys75").to_values();
    let motion = model()
        .motions()
        .unwrap()
        .trajectory(&PointRun::new(Backend::best(), &solver, &values), &request)
        .unwrap();
    let reference = table("four-bar/transient_sys75.csv");
    assert_eq!(motion.rows.len(), reference.len());
    let mut largest = 0.0_f64;
    for (row, record) in motion.rows.iter().zip(reference) {
        assert_close_to(row[0], record.number("t"), 1.0, 1e-15, "time");
        // Sizes: largest values of the motion.
        for (i, (column, size)) in
            [("theta", 0.3), ("phi", 0.6), ("theta_dot", 140.0), ("phi_dot", 300.0)].into_iter().enumerate()
        {
            let expected = record.number(column);
            largest = largest.max((row[i + 1] - expected).abs() / size);
            assert_close_to(row[i + 1], expected, size, 1e-6, &format!("{column} of {}", record.name));
        }
    }
    println!("largest error {largest:.1e}");
}
