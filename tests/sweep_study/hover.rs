//! Eigenvalues of the hover model against an independent computation: `tests/data/body`.

use std::collections::HashMap;

use flap_core::vehicle::MassProperties;
use flap_sweep::vehicle::hover::HoverModel;
use nalgebra::{Complex, DMatrix, Matrix6};

/// The rows of a table in `tests/data/body`, by case and mode: each row contains numbers by column.
fn rows(name: &str) -> HashMap<(String, String), HashMap<String, f64>> {
    let path = format!("{}/../../tests/data/body/{name}", env!("CARGO_MANIFEST_DIR"));
    let mut reader = csv::Reader::from_path(path).expect("a table");
    let headings = reader.headers().expect("headings").clone();
    let rows = reader.records().map(|row| {
        let row = row.expect("a row");
        let numbers = headings.iter().zip(&row).skip(2);
        let numbers = numbers.map(|(name, cell)| (name.to_owned(), cell.parse().expect("a number")));
        ((row[0].to_owned(), row[1].to_owned()), numbers.collect())
    });
    rows.collect()
}

#[test]
fn eigenvalues_are_those_of_an_independent_computation() {
    let forces = ["force_forward_n", "force_left_n", "force_up_n"];
    let torques = ["torque_roll_nm", "torque_pitch_nm", "torque_yaw_nm"];
    let wrench = [forces, torques].concat();
    let motion = ["u", "v", "w", "p", "q", "r"];
    let (dampings, hovers) = (rows("damping.csv"), rows("hover.csv"));
    assert_eq!(hovers.len(), 10);
    for (case, hover) in &hovers {
        let damping = &dampings[case];
        let damping = Matrix6::from_fn(|i, j| damping[&format!("{}_per_{}", wrench[i], motion[j])]);
        let body = MassProperties {
            mass: hover["mass_kg"],
            inertia: [hover["inertia_roll_kgm2"], hover["inertia_pitch_kgm2"], hover["inertia_yaw_kgm2"]],
            product: 0.0,
            gravity: 9.80665,
        };
        let mut at_hover = [0.0; 6];
        at_hover[2] = body.mass * body.gravity;
        for has_position in [false, true] {
            let model = HoverModel::new(body, damping, DMatrix::zeros(6, 0), at_hover, has_position);
            let model = model.unwrap_or_else(|error| panic!("{case:?}: {error}"));
            let (mut zeros, mut found) = (0, Vec::new());
            for eigenvalue in model.eigenvalues() {
                if eigenvalue == Complex::new(0.0, 0.0) { zeros += 1 } else { found.push(eigenvalue) }
            }
            // Heading and positions are not part of the reference.
            assert_eq!((zeros, found.len()), (if has_position { 4 } else { 1 }, 8), "{case:?}");
            for (i, found) in found.iter().enumerate() {
                let expected = Complex::new(hover[&format!("eig{i}_real")], hover[&format!("eig{i}_imag")]);
                // The reference lists the negative imaginary part of a pair first.
                let difference =
                    (found.re - expected.re).abs().max((found.im.abs() - expected.im.abs()).abs());
                assert!(difference < 1e-10 * expected.norm(), "{case:?}: {found} instead of {expected}");
            }
            assert!(model.warnings(1e4, 0.1).is_empty());
        }
    }
}

#[test]
fn modes_of_a_robot_with_passive_hinges() {
    let case = ("t1_140".to_owned(), "passive".to_owned());
    let damping = &rows("damping.csv")[&case];
    let at = |name: &str| damping[name];
    let mut matrix = Matrix6::zeros();
    // The entries of a vehicle with a plane of symmetry.
    for (i, j, name) in [
        (0, 0, "force_forward_n_per_u"),
        (0, 4, "force_forward_n_per_q"),
        (4, 0, "torque_pitch_nm_per_u"),
        (4, 4, "torque_pitch_nm_per_q"),
        (1, 1, "force_left_n_per_v"),
        (1, 3, "force_left_n_per_p"),
        (3, 1, "torque_roll_nm_per_v"),
        (3, 3, "torque_roll_nm_per_p"),
        (2, 2, "force_up_n_per_w"),
        (5, 5, "torque_yaw_nm_per_r"),
    ] {
        matrix[(i, j)] = at(name);
    }
    let body = MassProperties {
        mass: 6.915_643_907_926_958e-5,
        inertia: [1.5e-9, 1.5e-9, 5e-10],
        product: 0.0,
        gravity: 9.80665,
    };
    let model = HoverModel::new(body, matrix, DMatrix::zeros(6, 0), [0.0; 6], false).expect("a model");
    let modes: Vec<String> = model
        .modes
        .iter()
        .map(|mode| {
            let time = mode.time_to_double().or(mode.time_to_half()).unwrap_or(f64::INFINITY);
            format!("{time:.3} {:.3} {}", mode.period().unwrap_or(f64::INFINITY), mode.name())
        })
        .collect();
    assert_eq!(
        modes,
        [
            "0.225 0.622 pitch and forward velocity (longitudinal oscillation)",
            "0.250 0.505 roll and sideways velocity (lateral oscillation)",
            "inf inf heading (neutral)",
            "0.367 inf vertical velocity (longitudinal subsidence)",
            "0.043 inf pitch and forward velocity (longitudinal subsidence)",
            "0.026 inf roll (lateral subsidence)",
            "0.003 inf yaw (lateral subsidence)",
        ]
    );
    let warnings = model.warnings(120.0, 0.198);
    // Yaw is faster than half the drive frequency, and the weight is not balanced.
    assert_eq!(warnings.len(), 3, "{warnings:?}");
    assert!(warnings[1].starts_with("the mode \"yaw (lateral subsidence)\" is fast: "), "{warnings:?}");
}
