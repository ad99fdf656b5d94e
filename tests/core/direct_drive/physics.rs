//! Symmetries and conservation laws.

use std::ops::Range;

use flap_core::drive::Wave;
use flap_core::model::direct_drive::{
    AddedMass, CentreOfPressure, Constants, DirectDrive, FlowDirection, Params,
};
use flap_core::ode::{Ode, Start};
use proptest::prelude::*;
use proptest::sample::select;

use super::params;
use crate::by_name::scaled;
use crate::probe::Probe;
use crate::span::{self, tolerances};

/// Kinetic energy of structure and added mass plus elastic energy (J).
fn energy(c: &Constants<f64>, y: &[f64; 4]) -> f64 {
    let [phi, psi, phi_dot, psi_dot] = *y;
    let (sin, cos) = psi.sin_cos();
    0.5 * (c.m11 + c.m_s * sin * sin) * phi_dot * phi_dot
        + c.m12 * cos * phi_dot * psi_dot
        + 0.5 * c.m22 * psi_dot * psi_dot
        + 0.5 * c.added.a11 * cos * cos * phi_dot * phi_dot
        - c.added.a12 * cos * phi_dot * psi_dot
        + 0.5 * c.added.a22 * psi_dot * psi_dot
        + 0.5 * c.k_phi * phi * phi
        + 0.5 * c.k_w * psi * psi
}

/// The model with the flow direction of `p`.
fn model(p: &Params) -> DirectDrive {
    DirectDrive { flow: p.flow_direction, ..DirectDrive::SINE }
}

const STATES: [Range<f64>; 4] = [-0.5..0.5, -1.4..1.4, -400.0..400.0, -800.0..800.0];

/// Both presets with their parameters changed by up to 30 %.
fn any_params() -> impl Strategy<Value = Params> {
    let presets = vec![Params::ozaki2018_small().to_values(), Params::ozaki2018_large().to_values()];
    let names = "wing_length mean_chord wing_mass hinge_stiffness \
                 leading_edge_inertia piezo_thickness drag_coefficient_max wing_inertia_product";
    (scaled(Params::TABLE, presets, names, 0.7..1.3), select(AddedMass::ALL), select(FlowDirection::ALL))
        .prop_map(|(values, added_mass, flow_direction)| Params {
            added_mass,
            flow_direction,
            ..Params::from_values(&values)
        })
}

proptest! {
    /// dE/dt = Γ V φ̇ + aerodynamic power, for any state: inertia, added mass and springs keep energy.
    #[test]
    fn energy_changes_by_work_alone(p in any_params(), y in STATES, volts in -100.0..100.0, up in prop::bool::ANY) {
        let c = Constants::derive(&p).unwrap();
        let side = if up { 1.0 } else { -1.0 };
        let model = model(&p);
        let drive = Wave::with_rate(volts, 0.0);
        let dy = model.rhs(&c, &drive, side, &y);
        let signals = Probe { model: &model, constants: &c, input: &drive, side }.signals(&y, &dy);
        let work = c.gamma * volts * y[2] - signals.power_translational - signals.power_rotational;

        // Central difference along the motion, in a time in which the state changes by a millionth.
        let fastest = (dy[2] / 400.0).abs().max((dy[3] / 800.0).abs()).max(1.0);
        let dt = 1e-6 / fastest;
        let at = |dt: f64| energy(&c, &std::array::from_fn(|i| y[i] + dt * dy[i]));
        let rate = (at(dt) - at(-dt)) / (2.0 * dt);
        let size = energy(&c, &y) * fastest + work.abs();
        prop_assert!((rate - work).abs() < 1e-8 * size, "{rate} against {work}");
    }

    /// (φ, ψ, V) → −(φ, ψ, V) mirrors the motion and does not change lift and power.
    #[test]
    fn half_strokes_are_mirror_images(p in any_params(), y in STATES, volts in -100.0..100.0, folded in prop::bool::ANY) {
        let reading = if folded { CentreOfPressure::Folded } else { CentreOfPressure::Directional };
        let model = model(&p);
        let c = Constants::derive(&Params { centre_of_pressure: reading, ..p }).unwrap();
        let [dy, mirrored] = [1.0, -1.0].map(|m| {
            model.rhs(&c, &Wave::with_rate(m * volts, 0.0), m, &y.map(|y| m * y))
        });
        prop_assert_eq!(dy, mirrored.map(|d| -d));
        let [plus, minus] = [(1.0, dy), (-1.0, mirrored)].map(|(m, dy)| {
            let y = y.map(|y| m * y);
            let drive = Wave::with_rate(m * volts, m * 1e4);
            let signals = Probe { model: &model, constants: &c, input: &drive, side: m }.signals(&y, &dy);
            [signals.lift, signals.power]
        });
        prop_assert_eq!(plus, minus);
    }
}

/// As printed, Eq. (24) treats the two half strokes differently.
#[test]
fn the_literal_reading_breaks_the_mirror_symmetry() {
    let p = Params { centre_of_pressure: CentreOfPressure::Literal, ..Params::ozaki2018_large() };
    let c = Constants::derive(&p).unwrap();
    let y = [0.1, 0.7, 100.0, 50.0];
    let [dy, mirrored] =
        [1.0, -1.0].map(|m| DirectDrive::SINE.rhs(&c, &Wave::with_rate(0.0, 0.0), m, &y.map(|y| m * y)));
    assert!((dy[3] + mirrored[3]).abs() > 0.1 * dy[3].abs());
}

/// Without air and at constant voltage, E − Γ V φ is conserved along a whole motion.
#[test]
fn a_wing_in_vacuum_keeps_its_energy() {
    for kind in ["small", "large"] {
        let p = Params { air_density: 0.0, drive_voltage_pp: 0.0, drive_bias: Some(30.0), ..params(kind) };
        let constants = Constants::derive(&p).unwrap();
        let total = |y: &[f64; 4]| energy(&constants, y) - constants.gamma * 30.0 * y[0];
        let start = Start::new(constants, [0.2, 0.5, 30.0, -80.0], 0.05, [0.1, 0.3, 70.0, 200.0]);
        span::assert_conserved(&DirectDrive::SINE, &tolerances(1e-10), &start, 1e-7, total, kind);
    }
}
