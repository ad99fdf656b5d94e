//! Rows from lanes against rows from scalars.

use flap_core::drive::{Shape, StrokeParameters, WaveformParameters};
use flap_core::model::four_bar::{AddedMassSign, Arms, Params, Quadrature};
use flap_core::simulate::{SolverSettings, Status};

use super::steady::model;
use crate::rows::{QUICK, assert_lanes_equal_scalars};
use crate::waveforms::third_harmonic;

/// Designs, drives and readings in a fixed irregular order. Wings with different numbers of strips are in neighbouring
/// lanes. Some points are impossible, or their motion diverges.
fn points() -> Vec<Vec<f64>> {
    (0..90)
        .map(|i| {
            let k = f64::from(i);
            let p = if i % 2 == 0 { Params::arabagi2013_75hz() } else { Params::arabagi2013_30hz() };
            let p = Params {
                drive_voltage_pp: 60.0 + (37.3 * k) % 120.0,
                drive_frequency: p.drive_frequency * (0.7 + (0.231 * k) % 0.8),
                hinge_stiffness: p.hinge_stiffness * (0.6 + (0.37 * k) % 1.5),
                strips: 1.0 + (7.0 * k) % 24.0,
                ..p
            };
            let p = match i % 9 {
                1 => Params { arms: Arms::Axis, ..p },
                2 => Params { am_sign: AddedMassSign::Printed, ..p },
                3 => Params { quadrature: Quadrature::Midpoint, strips: 64.0, ..p },
                4 => Params { waveform: WaveformParameters::new(Shape::Square), ..p },
                5 => Params { waveform: third_harmonic(-0.2), ..p },
                6 => Params { stroke: StrokeParameters::prescribed(0.01 * k), ..p },
                7 => Params { output_link: 0.03, ..p },
                8 => Params { wing_inertia_product: 1e-8, ..p },
                _ => p,
            };
            p.to_values()
        })
        .collect()
}

#[test]
fn rows_equal_the_scalar_path_bit_for_bit() {
    let solver = SolverSettings { settle_tol: 1e-4, ..QUICK };
    let rows = assert_lanes_equal_scalars(model(), &points(), &solver);
    let count = |status| rows.iter().filter(|row| row.status == status).count();
    assert!(count(Status::Periodic) > 55, "{} periodic", count(Status::Periodic));
    assert!(count(Status::Invalid) >= 10, "{} invalid", count(Status::Invalid));
}
