//! Claims about the aerodynamic damping of the body's motion.

use flap_core::vehicle::{FORCES, TORQUES};

use super::flier::Flier;
use crate::claim::{Claim, assumed, measured, said};

/// Change of the body's velocity (m/s) with which derivatives are estimated by central differences.
const VELOCITY: f64 = 0.02;

/// Change of the body's angular rate (rad/s) with which derivatives are estimated by central differences.
const RATE: f64 = 2.0;

/// Returns a damping coefficient in SI units: minus the derivative of a force or torque with respect to a
/// velocity or rate of the body.
fn damping(flier: &Flier, column: &str, motion: &'static str, step: f64) -> f64 {
    let sides = flier.settle(&[vec![(motion, step)], vec![(motion, -step)]]);
    let unit = if FORCES.contains(&column) { 1e-3 } else { 1e-6 };
    -(sides[0].get(column) - sides[1].get(column)) * unit / (2.0 * step)
}

/// Returns a vehicle with two wings of a preset. The wings are 2 mm to the left and to the right of the
/// middle, and 3 mm above the centre of mass.
fn flier(preset: &str, voltage: f64, frequency: f64) -> Flier {
    Flier::new(preset, &[("left", false), ("right", true)]).with(&[
        ("left_position_y", 2e-3),
        ("right_position_y", 2e-3),
        ("about_z", -3e-3),
        ("drive_voltage_pp", voltage),
        ("drive_frequency", frequency),
    ])
}

pub(super) fn claims() -> Vec<Claim> {
    let first = flier("jafferis2016", 140.0, 120.0);
    let improved = flier("jafferis2016-improved", 165.0, 155.0);
    let forward = damping(&first, FORCES[0], "body_velocity_forward", VELOCITY);
    let sideways = damping(&first, FORCES[1], "body_velocity_left", VELOCITY);
    let of_improved = damping(&improved, FORCES[0], "body_velocity_forward", VELOCITY);
    let yaw = damping(&improved, TORQUES[2], "body_rate_yaw", RATE);
    let force = |value: f64| format!("{:.1}·10⁻⁴ N·s/m", value * 1e4);
    let torque = |value: f64| format!("{:.1}·10⁻⁷ N·m·s", value * 1e7);
    vec![
        said("Robofly_simulator, robot.py", "damping of forward motion in a wind tunnel", "2.0·10⁻⁴ N·s/m")
            .is(&measured(2.0e-4, 0.05e-4), forward, force(forward)),
        said("Robofly_simulator, robot.py", "damping of sideways motion in a wind tunnel", "2.0·10⁻⁴ N·s/m")
            .is(&measured(2.0e-4, 0.05e-4), sideways, force(sideways)),
        said("robobee_simulator", "damping of forward motion at 155 Hz, set by hand", "7.0·10⁻⁴ N·s/m").is(
            &assumed(7.0e-4, 0.05e-4),
            of_improved,
            force(of_improved),
        ),
        said("robobee_simulator", "damping of yaw at 155 Hz, set by hand", "3.5·10⁻⁷ N·m·s").is(
            &assumed(3.5e-7, 0.05e-7),
            yaw,
            torque(yaw),
        ),
    ]
}
