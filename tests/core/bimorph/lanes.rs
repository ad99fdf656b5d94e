//! Rows from lanes against rows from scalars.

use flap_core::drive::{Shape, WaveformParameters};
use flap_core::model::bimorph::{ActuatorStiffness, CentreOfPressure, FieldTransition, Params};
use flap_core::simulate::Status;
use flap_core::springs::HingeParameters;

use super::model;
use crate::rows::{QUICK, assert_lanes_equal_scalars};
use crate::waveforms::third_harmonic;

/// Designs, drives and readings in a fixed irregular order; every tenth point is impossible or its motion diverges.
fn points() -> Vec<Vec<f64>> {
    (0..90)
        .map(|i| {
            let k = f64::from(i);
            let p = Params::jafferis2016().with_transmission_scaled(0.6 + (0.13 * k) % 0.5);
            let p = Params {
                drive_voltage_pp: 60.0 + (37.3 * k) % 190.0,
                drive_frequency: 70.0 + (23.1 * k) % 130.0,
                hinge_stiffness: p.hinge_stiffness * (0.5 + (0.37 * k) % 1.5),
                // Without a size, the hinge's strain is not a number.
                hinge: HingeParameters {
                    hinge_thickness: Some(12.5e-6),
                    hinge_length: Some(80e-6),
                    ..Params::jafferis2016().hinge
                },
                ..p
            };
            let p = match i % 10 {
                1 => Params { field_transition: FieldTransition::Printed, ..p },
                3 => Params {
                    centre_of_pressure: CentreOfPressure::Directional,
                    circulation_factor: 0.5,
                    added_mass_factor: 0.3,
                    stroke_stiffening: 1e-6,
                    modulus_decline: 1e-8,
                    ..p
                },
                5 => Params { centre_of_pressure: CentreOfPressure::Literal, ..p },
                7 => Params { actuator_stiffness: ActuatorStiffness::Constant, ..p },
                4 => Params { waveform: WaveformParameters::new(Shape::Square), ..p },
                6 => Params { waveform: third_harmonic(-0.2), ..p },
                0 => Params {
                    transmission_growth: 1e9 * (k % 5.0),
                    plate_ratio: 0.9,
                    stroke_damping: 1e-9,
                    ..p
                },
                2 => Params { drive_offset: 10.0, stroke_loss_factor: 0.05, hinge_damping: 1e-10, ..p },
                8 => Params { actuator_width_ratio: 2.5, ..p },
                9 => Params { wing_inertia_product: 1e-3, ..p },
                _ => p,
            };
            p.to_values()
        })
        .collect()
}

#[test]
fn rows_equal_the_scalar_path_bit_for_bit() {
    let rows = assert_lanes_equal_scalars(model(), &points(), &QUICK);
    for row in &rows {
        assert!(row.measures.iter().all(|m| m.is_finite()), "{row:?}");
    }
    for status in [Status::Periodic, Status::Invalid] {
        assert!(rows.iter().any(|row| row.status == status), "no row is {}", status.name());
    }
}
