//! Responses to changes of the initial state, against Floquet multipliers of reference orbits.

use flap_core::model::Model;
use flap_core::model::bimorph::Bimorph;
use flap_core::model::direct_drive::{self, DirectDrive};
use flap_core::ode::variation::{Variation, initial, response};
use flap_core::ode::{Start, Tolerances};
use nalgebra::Matrix4;

use crate::data::{Record, assert_close, table};
use crate::span;

const TOLERANCES: Tolerances = Tolerances { rtol: 1e-8, atol: 1e-10, max_steps: 20_000 };

/// States at the end of a period that begins at `y`, without and with responses to changes of `y`.
fn period<M: Model<4, S>, const S: usize>(
    model: &M,
    values: &[f64],
    y: [f64; 4],
) -> ([f64; 4], [f64; 20], [f64; 4]) {
    let model = &model.variant(values);
    let start = Start { y, ..model.start(values).unwrap() };
    let alone = span::end(model, &TOLERANCES, &start);
    let mut scale = [0.0; 20];
    scale[..4].copy_from_slice(&start.scale);
    let varied = Start {
        constants: start.constants,
        y: initial(&y, &start.scale),
        span: start.span,
        scale,
        tighten: 1.0,
    };
    let all = span::end(&Variation(model), &TOLERANCES, &varied);
    (alone, all, start.scale)
}

/// The largest modulus of the multipliers, from the responses of a period.
fn largest_multiplier(all: &[f64; 20], scale: &[f64; 4]) -> f64 {
    let monodromy = Matrix4::from_fn(|i, j| response::<4, 20>(all, j)[i] / scale[i]);
    monodromy.complex_eigenvalues().iter().fold(0.0, |largest, multiplier| multiplier.norm().max(largest))
}

/// Compares the largest multiplier of the orbit through the states in `states` with the column `multiplier`.
fn check<M: Model<4, S>, const S: usize>(
    model: &M,
    values: &[f64],
    record: &Record,
    states: [&str; 4],
    multiplier: &str,
) {
    let y = states.map(|column| record.number(column));
    let (alone, all, scale) = period(model, values, y);
    assert_eq!(alone, all[..4], "the responses change nothing");
    assert_close(largest_multiplier(&all, &scale), record.number(multiplier), 1e-4, &record.name);
}

#[test]
fn multipliers_of_direct_drive_orbits_equal_the_reference() {
    for record in table("direct-drive/steady_cases.csv") {
        let p = direct_drive::Params {
            drive_voltage_pp: 2.0 * record.number("V0_V"),
            drive_frequency: record.number("f_Hz"),
            ..crate::direct_drive::params(record.text("type"))
        };
        let states = ["x_phi0", "x_psi0", "x_phidot0", "x_psidot0"];
        check(&DirectDrive::default(), &p.to_values(), &record, states, "floquet_max");
    }
}

#[test]
fn multipliers_of_bimorph_orbits_equal_the_reference() {
    for record in table("bimorph/steady_cases.csv") {
        let p = crate::bimorph::driven(&crate::bimorph::params(record.text("set")), &record);
        let states = ["x0_m", "v0_m_per_s", "psi0_rad", "psidot0_rad_per_s"];
        check(&Bimorph::default(), &p.to_values(), &record, states, "floquet_abs_max");
    }
}
