//! The wing of the bimorph model on a moving body.
//!
//! The paper's wing is lumped. Body motion changes the direction of the flow along the span, so the wing is cut into four
//! strips ([`super::strips`]). At zero body motion their sums are the forces of [`super::rhs`], to rounding.

use core::f64::consts::FRAC_2_PI;

use super::constants::Constants;
use super::params::CentreOfPressure;
use super::rhs::{Plate, elastic_force, plate_forces, stroke_damping};
use super::strips::Moving;
use super::transmission::{Law, Transmission, stroke};
use crate::aero::oblique_forces;
use crate::model::Load;
use crate::num::Real;

/// Loads of the air on a wing, and its inertial moment on a turning body.
#[derive(Clone, Copy, Debug)]
pub(super) struct Air<R> {
    /// Load of the air.
    pub(super) load: Load<R>,
    /// Part of the load's span moment from the rotational drag (9) (N·m).
    pub(super) rotation_moment: R,
    /// Inertial moment per rate g (N·m·s), see [`Shoulder::gyroscopic`](crate::body::Shoulder::gyroscopic).
    pub(super) gyroscopic: R,
}

/// Returns the loads at a stroke φ, stroke rate φ̇ (rad/s), pitch and pitch rate.
#[inline(always)]
pub(super) fn air<R: Real>(
    c: &Constants<R>,
    centre_of_pressure: CentreOfPressure,
    [phi, phi_dot]: [R; 2],
    [psi, psi_dot]: [R; 2],
) -> Air<R> {
    let Moving { motion, strips, inertia, product } = &c.moving;
    let (sin, cos) = psi.sin_cos();
    let pitch = [sin, cos];
    let shoulder = motion.along(phi);
    let forces = oblique_forces(
        strips.iter().copied(),
        &shoulder.sections(phi_dot, psi_dot, cos),
        pitch,
        #[inline(always)]
        |_, flow| {
            let attack = match centre_of_pressure {
                CentreOfPressure::Directional => flow.attack(),
                CentreOfPressure::Folded | CentreOfPressure::Literal => flow.folded_attack(),
            };
            (flow.harmonic_forces([c.b_1, c.b_2, c.b_l]), c.p_min + c.p_swing * (attack * FRAC_2_PI))
        },
    );
    let [lift, drag] = forces.lift_and_drag(pitch);
    let [lift_moment, drag_moment] = forces.moments(pitch);
    let rate = shoulder.pitch_rate(psi_dot);
    let rotation_moment = -(c.c_c * rate.abs() * rate);
    Air {
        load: Load {
            stroke: phi,
            lift,
            drag,
            lift_moment,
            drag_moment,
            span_moment: forces.pitch_moment + rotation_moment,
        },
        rotation_moment,
        gyroscopic: shoulder.gyroscopic(*inertia, *product, pitch),
    }
}

/// Returns the loads of a state, for signals.
#[inline(always)]
pub(super) fn air_at<R: Real>(
    c: &Constants<R>,
    law: Law,
    centre_of_pressure: CentreOfPressure,
    [x, x_dot, psi, psi_dot]: [R; 4],
) -> Air<R> {
    let rate = c.ratio * Transmission::at(c, law, x).times(x_dot);
    air(c, centre_of_pressure, [stroke(c, law, x), rate], [psi, psi_dot])
}

/// Returns the derivative of the state on a moving body: (1), (2) with the moments of the strips, and the inertial moment of
/// the hinge. (1) contains no reaction of the hinge, and no inertial moment either.
///
/// ```text
/// m_e ẍ + (K_act(x) + K_t) x + T M_D = F₁ − F₂
/// I_xx ψ̈ + κ_wh ψ = M_s + I_xz T ẍ cos ψ + ½ I_xx (Tẋ)² sin 2ψ − g φ̇
/// ```
#[inline(always)]
pub(super) fn derivative<R: Real>(
    c: &Constants<R>,
    law: Law,
    centre_of_pressure: CentreOfPressure,
    plates: &[Plate<R>; 2],
    y: &[R; 4],
) -> [R; 4] {
    let [x, x_dot, psi, psi_dot] = *y;
    let transmission = Transmission::at(c, law, x);
    let rate = transmission.times(x_dot);
    let phi_dot = c.ratio * rate;
    let air = air(c, centre_of_pressure, [stroke(c, law, x), phi_dot], [psi, psi_dot]);

    let [f_1, f_2] = plate_forces(c, plates, x);
    let restoring = elastic_force(c, x) + c.k_t * x;
    let drag = transmission.times(c.ratio * air.load.drag_moment);
    let force = f_1 - f_2 - restoring - drag - stroke_damping(c, &transmission, x_dot, rate);
    let x_ddot = transmission.acceleration(c, force, x_dot);

    let (sin, cos) = psi.sin_cos();
    let psi_ddot = (air.load.span_moment
        + c.coupling * transmission.stroke_acceleration(x_ddot, x_dot) * cos
        + c.centrifugal * rate * rate * (sin * cos * 2.0)
        - c.kappa_wh * psi
        - c.hinge_damping * psi_dot
        - air.gyroscopic * phi_dot)
        * c.inverse_i_xx;
    [x_dot, x_ddot, psi_dot, psi_ddot]
}
