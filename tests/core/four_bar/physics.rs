//! Symmetries and conservation laws.

use std::ops::Range;

use flap_core::drive::Wave;
use flap_core::model::four_bar::{Arms, Constants, FourBar, Params, Signals, transmission};
use flap_core::ode::{Ode, Start, Tolerances};
use proptest::prelude::*;
use proptest::sample::select;

use super::{mass_matrix, moments, params, side};
use crate::by_name::scaled;
use crate::probe::{Probe, modes};
use crate::span::{self, tolerances};

/// Kinetic energy of the wing plus elastic energy of hinge, actuator and series spring, minus the work of a constant
/// voltage (J).
fn energy(c: &Constants<f64>, volts: f64, y: &[f64; 4]) -> f64 {
    let [theta, phi, theta_dot, phi_dot] = *y;
    let links = transmission(c, theta);
    let [m11, m12, m22] = mass_matrix(c, theta, phi);
    let stretch = links.displacement - c.actuator.deflection * (volts - c.actuator.rest_voltage);
    0.5 * (m11 * theta_dot * theta_dot + 2.0 * m12 * theta_dot * phi_dot + m22 * phi_dot * phi_dot)
        + 0.5 * c.wing.hinge_stiffness * phi * phi
        + 0.5 * c.actuator.stiffness * stretch * stretch
}

const STATES: [Range<f64>; 4] = [-1.0..1.0, -3.5..3.5, -200.0..200.0, -800.0..800.0];

/// Both systems with their parameters changed by up to 20 %.
fn any_params() -> impl Strategy<Value = Params> {
    let presets = vec![Params::arabagi2013_75hz().to_values(), Params::arabagi2013_30hz().to_values()];
    let names = "wing_length root_chord wing_mass hinge_stiffness \
                 series_stiffness crank_radius mass_centre_depth wing_inertia_product";
    (scaled(Params::TABLE, presets, names, 0.8..1.2), select(Arms::ALL))
        .prop_map(|(values, arms)| Params { arms, ..Params::from_values(&values) })
}

/// The signals at a state with this derivative.
fn signals(c: &Constants<f64>, drive: &Wave<f64>, y: &[f64; 4], dy: &[f64; 4]) -> Signals<f64> {
    Probe { model: &FourBar::SINE, constants: c, input: drive, side: side(c, y) }.signals(y, dy)
}

proptest! {
    /// dE/dt is the power of air and damping, for any state: inertia, springs and actuator keep energy.
    #[test]
    fn energy_changes_by_dissipation_alone(p in any_params(), y in STATES, volts in -100.0..100.0) {
        let c = Constants::derive(&p).unwrap();
        let drive = Wave::with_rate(volts, 0.0);
        let dy = FourBar::SINE.rhs(&c, &drive, side(&c, &y), &y);
        let air = signals(&c, &drive, &y, &dy);
        let damping = c.wing.stroke_damping * y[2] * y[2] + c.wing.hinge_damping * y[3] * y[3];
        let work = -air.power_translational - air.power_rotational - damping;

        // Central difference along the motion, in a time in which the state changes by a hundred-thousandth: the
        // rounding of the links' positions, which a shorter time would magnify, stays below the bound.
        let fastest = (dy[2] / 200.0).abs().max((dy[3] / 800.0).abs()).max(800.0);
        let dt = 1e-5 / fastest;
        let at = |dt: f64| energy(&c, volts, &std::array::from_fn(|i| y[i] + dt * dy[i]));
        let rate = (at(dt) - at(-dt)) / (2.0 * dt);
        // The actuator's stretch is the difference of two displacements, whose rounding the quotient magnifies.
        let free = c.actuator.deflection * (volts - c.actuator.rest_voltage);
        let parts = energy(&c, volts, &y) + 0.5 * c.actuator.stiffness * free * free;
        let size = parts * fastest + work.abs();
        prop_assert!((rate - work).abs() < 1e-7 * size, "{rate} against {work}");
    }

    /// Rotational drag takes energy from the wing. Translational forces take energy from the wing except through the
    /// lift of a pitching wing.
    #[test]
    fn rotational_drag_always_dissipates(p in any_params(), y in STATES) {
        let c = Constants::derive(&p).unwrap();
        prop_assert!(moments(&c, side(&c, &y), &y).rotation_pitch * y[3] <= 0.0);
        let still = moments(&c, side(&c, &y), &[y[0], y[1], y[2], 0.0]);
        prop_assert!(still.stroke * y[2] <= 0.0);
    }

    /// (θ̇, φ, φ̇) → −(θ̇, φ, φ̇) mirrors the forces of the air and does not change the lift. The four-bar is not
    /// symmetric, so the whole motion is not symmetric either.
    #[test]
    fn the_air_treats_both_half_strokes_alike(p in any_params(), y in STATES) {
        let c = Constants::derive(&p).unwrap();
        let dy = [y[2], y[3], 1e4, -3e4];
        let [one, other] = [1.0, -1.0].map(|m| {
            let y = y.map(|y| m * y);
            let air = signals(&c, &Wave::with_rate(0.0, 0.0), &y, &dy.map(|d| m * d));
            let lift = [air.lift_translational, air.lift_rotational, air.lift_added_mass];
            let about = moments(&c, side(&c, &y), &y);
            let mirrored = [air.drag, about.stroke, about.pitch, about.rotation_stroke, about.rotation_pitch];
            (lift, mirrored.map(|x| m * x))
        });
        prop_assert_eq!(one, other);
    }

    /// V·i = F·δ̇ + d/dt of the energy stored in capacitance and springs: the actuator has no losses.
    #[test]
    fn the_actuator_loses_nothing(p in any_params(), theta in -1.0..1.0, theta_dot in -200.0..200.0, value in -100.0..100.0, rate in -1e5..1e5) {
        let c = Constants::derive(&p).unwrap();
        let drive = Wave::with_rate(value, rate);
        let at = |theta: f64, theta_dot: f64, drive: &Wave<f64>| signals(&c, drive, &[theta, 0.0, theta_dot, 0.0], &[0.0; 4]);
        // Tip stiffness k_a from 1/k_eff = 1/k_a + 1/k_sc; the tip is bent by δ_a − γ(V − V_ref) against it.
        let soft = 1.0 / c.actuator.stiffness - c.actuator.series_compliance;
        let stored = |theta: f64, value: f64| {
            let Signals { power_drive, tip, .. } = at(theta, 1.0, &Wave::with_rate(value, 0.0));
            let force = power_drive / transmission(&c, theta).slope;
            // Capacitance, bent tip with the offset of V_ref, series spring.
            0.5 * c.actuator.capacitance * value * value
                + 0.5 * tip * tip / soft
                + tip * c.actuator.deflection * c.actuator.rest_voltage / soft
                + 0.5 * c.actuator.series_compliance * force * force
        };
        let Signals { power: electrical, power_drive: mechanical, .. } = at(theta, theta_dot, &drive);
        let dt = 1e-7;
        let at = |dt: f64| stored(theta + dt * theta_dot, value + dt * rate);
        let change = (at(dt) - at(-dt)) / (2.0 * dt);
        let size = (value * rate).abs() * c.actuator.capacitance + mechanical.abs() + 1e-3;
        prop_assert!((electrical - mechanical - change).abs() < 1e-6 * size, "{} {}", electrical - mechanical, change);
    }
}

/// Without air, damping and drive a wing keeps its energy along a whole motion.
#[test]
fn a_wing_in_vacuum_keeps_its_energy() {
    for system in ["sys75", "sys30"] {
        let p = Params {
            air_density: 0.0,
            stroke_damping: 0.0,
            hinge_damping: 0.0,
            drive_voltage_pp: 0.0,
            rest_voltage: Some(20.0),
            ..params(system)
        };
        let constants = Constants::derive(&p).unwrap();
        let start = Start::new(constants, [0.3, 0.5, 30.0, -80.0], 0.1, [0.3, 0.5, 100.0, 200.0]);
        let total = |y: &[f64; 4]| energy(&constants, p.drive_bias, y);
        span::assert_conserved(&FourBar::SINE, &tolerances(1e-10), &start, 1e-7, total, system);
    }
}

/// After an impulse on the stroke, the wing oscillates at its natural frequencies.
#[test]
fn small_motions_have_the_natural_frequencies() {
    let p = Params {
        stroke_damping: 0.0,
        hinge_damping: 0.0,
        drive_voltage_pp: 0.0,
        ..Params::arabagi2013_75hz()
    };
    let constants = Constants::derive(&p).unwrap();
    let [low, high] = modes::<FourBar>(&constants);
    // Amplitudes small enough that the air, which is quadratic, does nothing.
    let tolerances = Tolerances { rtol: 1e-10, atol: 1e-18, max_steps: 1_000_000 };
    let links = transmission(&constants, 0.0);
    let [m11, m12, _] = mass_matrix(&constants, 0.0, 0.0);
    let stiffness = constants.actuator.stiffness * links.slope * links.slope;
    for frequency in [low, high] {
        // The mode's shape: (K − ω²M) q = 0.
        let square = (2.0 * std::f64::consts::PI * frequency).powi(2);
        let shape = [square * m12, stiffness - square * m11];
        let mut y = [0.0; 4];
        for i in 0..2 {
            y[i] = 1e-7 * shape[i] / shape[0].abs().max(shape[1].abs());
        }
        let start = Start::new(constants, y, 10.0 / frequency, [1.0, 1.0, 100.0, 100.0]);
        let end = span::end(&FourBar::SINE, &tolerances, &start);
        for i in 0..2 {
            assert!((end[i] / y[i] - 1.0).abs() < 1e-4, "{frequency} Hz: {y:?} → {end:?}");
        }
    }
}
