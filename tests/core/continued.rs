//! Points whose motion begins at a given state, and single periods.

use flap_core::num::Backend;
use flap_core::simulate::{Point, PointRun, Simulator, SolverSettings, Status, all};
use nalgebra::DMatrix;

use crate::data::assert_close;
use crate::robustness::designs;
use crate::rows;

const SOLVER: SolverSettings = SolverSettings {
    rtol: 1e-8,
    atol: 1e-10,
    settle_tol: 1e-6,
    max_cycles: 1000,
    max_steps: 20_000,
    accuracy: 1e-3,
    newton: true,
    progressive: true,
    symmetry: true,
    loads: false,
};

/// Every preset of a model.
fn presets(model: &dyn Simulator) -> Vec<Vec<f64>> {
    model.presets().iter().map(|preset| (preset.values)()).collect()
}

#[test]
fn a_motion_that_begins_on_its_orbit_is_found_there_at_once() {
    for &model in all() {
        let from_rest = rows::of(model, &presets(model), Backend::best(), &SOLVER);
        let again = (0..).zip(presets(model)).zip(&from_rest).map(|((index, values), row)| Point {
            index,
            values,
            begin: Some(row.state.clone()),
        });
        let again: Vec<Point> = again.collect();
        let again = rows::assert_lanes_equal_scalars_at(model, &again, &SOLVER);
        for (row, again) in from_rest.iter().zip(&again) {
            assert_eq!((row.status, again.status), (Status::Periodic, Status::Periodic));
            // A period of marching, one with responses, one measured, and two for its error. Those of symmetric orbits are half
            // periods, but for the measured ones of an orbit that is not centred on zero.
            let cycles = match model.name() {
                "bimorph" => 1 + (5 + 1 + 2) / 2,
                "direct-drive" => 1 + 3 + 2,
                _ => 1 + 5 + 1 + 2,
            };
            assert_eq!(again.cycles, cycles, "{}: {again:?}", model.name());
            for (column, (one, other)) in model.columns().iter().zip(row.measures.iter().zip(&again.measures))
            {
                let size = one.abs().max(0.1);
                assert!((one - other).abs() < 1e-4 * size || one.is_nan(), "{}: {one} {other}", column.name);
            }
        }
    }
}

#[test]
fn what_is_no_state_is_refused() {
    for &model in all() {
        let values = &presets(model)[0];
        for begin in [&[][..], &[0.0; 3], &[0.0; 5], &[0.0, f64::NAN, 0.0, 0.0]] {
            let row = model.run_point(&PointRun::new(Backend::best(), &SOLVER, values), Some(begin));
            assert_eq!(row.status, Status::Invalid);
            assert!(row.reason.unwrap().contains("a state consists of 4 finite numbers"));
            assert!(
                model
                    .motions()
                    .unwrap()
                    .period(&PointRun::new(Backend::best(), &SOLVER, values), begin)
                    .is_err()
            );
        }
    }
}

/// The state after some periods from `begin`, and the derivative of this state with respect to `begin`.
fn follow(model: &dyn Simulator, values: &[f64], begin: &[f64], periods: u32) -> (Vec<f64>, DMatrix<f64>) {
    let (mut state, mut product) = (begin.to_vec(), DMatrix::identity(4, 4));
    for _ in 0..periods {
        let period = model
            .motions()
            .unwrap()
            .period(&PointRun::new(Backend::best(), &SOLVER, values), &state)
            .unwrap();
        product = DMatrix::from_fn(4, 4, |i, j| period.responses[j][i]) * product;
        state = period.end;
    }
    (state, product)
}

#[test]
fn a_period_is_what_rows_are_made_of() {
    let whole = SolverSettings { symmetry: false, ..SOLVER };
    for &model in all() {
        for values in presets(model) {
            let row = model.run_point(&PointRun::new(Backend::best(), &whole, &values), None);
            let period = model
                .motions()
                .unwrap()
                .period(&PointRun::new(Backend::best(), &SOLVER, &values), &row.state)
                .unwrap();
            // Efficiencies without power are not numbers.
            let bits = |measures: &[f64]| -> Vec<u64> { measures.iter().map(|m| m.to_bits()).collect() };
            assert_eq!(bits(&period.measures), bits(&row.measures));
            let (_, monodromy) = follow(model, &values, &row.state, 1);
            let multipliers = monodromy.complex_eigenvalues();
            let largest = multipliers.iter().fold(0.0_f64, |largest, one| largest.max(one.norm()));
            assert_close(largest, row.floquet_max, 1e-4, model.name());
        }
    }
}

#[test]
fn subharmonic_orbits_close_and_decay_by_their_multipliers() {
    let solver = SolverSettings { max_cycles: 300, ..SOLVER };
    let model = all()[0];
    let designs = designs(model, 300);
    let rows = rows::of(model, &designs, Backend::best(), &solver);
    let subharmonic = || rows.iter().zip(&designs).filter(|(row, _)| row.status == Status::Subharmonic);
    assert!(subharmonic().count() > 0, "one of the designs has such an orbit");
    for (row, values) in subharmonic() {
        let (end, product) = follow(model, values, &row.state, row.period);
        let scale = model
            .motions()
            .unwrap()
            .period(&PointRun::new(Backend::best(), &SOLVER, values), &row.state)
            .unwrap()
            .scale;
        for i in 0..4 {
            assert!((end[i] - row.state[i]).abs() < 1e-4 * scale[i], "{end:?} {row:?}");
        }
        let multipliers = product.complex_eigenvalues();
        let largest = multipliers.iter().fold(0.0_f64, |largest, one| largest.max(one.norm()));
        assert_close(largest, row.floquet_max, 1e-3, "multiplier");
        assert_eq!(row.stable(), Some(largest < 1.0));
        assert!(row.measures.is_empty(), "a cycle of it is not the next");
    }
}
