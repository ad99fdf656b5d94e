//! The wing of the bimorph model on a moving body.
//!
//! The paper's wing is lumped. Body motion changes the direction of the flow along the span, so the wing is cut into four
//! strips, see [`strips`]. At zero body motion their sums are the forces of [`super::rhs`], to rounding.

use core::f64::consts::FRAC_2_PI;

use super::constants::Constants;
use super::params::{CentreOfPressure, Params};
use super::rhs::{Plate, elastic_force, plate_forces, stroke_damping};
use super::transmission::{Law, Transmission, stroke};
use crate::aero::{ObliqueStrip, oblique_forces};
use crate::body::{BodyMotion, BodyTerms};
use crate::model::Load;
use crate::num::Real;
use crate::parameter::Invalid;
use crate::quadrature::gauss_beta;

/// Number of strips. Four are exact for the forces at zero body motion, and for the first derivatives with respect to it.
const STRIPS: usize = 4;

crate::per_lane! {
    /// Motion of the body, and the parts of the wing on which it acts.
    pub struct Moving<R> {
        /// Motion of the shoulder.
        pub motion: BodyMotion<R>,
        /// Strips of the wing. Their chord is the mean chord, to which the centre of pressure (11) refers.
        pub strips: [ObliqueStrip<R>; STRIPS],
        /// Moment of inertia about the hinge's axis I_xx (kg·m²).
        pub inertia: R,
        /// Product of inertia I_xz (kg·m²).
        pub product: R,
    }
}

impl Moving<f64> {
    /// A body at rest.
    pub(super) const REST: Moving<f64> =
        Moving { motion: BodyMotion::REST, strips: [ObliqueStrip::NONE; STRIPS], inertia: 0.0, product: 0.0 };

    /// Returns the constants of a point with these terms.
    ///
    /// # Errors
    /// If another reading of the paper or another shape of the wing is required.
    pub(super) fn of(p: &Params, terms: BodyTerms) -> Result<Moving<f64>, Invalid> {
        if terms == BodyTerms::None {
            return Ok(Moving::REST);
        }
        if p.centre_of_pressure == CentreOfPressure::Literal {
            return Err(Invalid::together(
                &["centre_of_pressure", "body_velocity_forward"],
                "centre_of_pressure = \"literal\" has no meaning on a moving body: set it to \"folded\" or \"directional\"",
            ));
        }
        let (inertia, product) = (p.wing_inertia_hinge, p.wing_inertia_product);
        Invalid::unless_finite(Moving { motion: p.body.motion(), strips: strips(p)?, inertia, product })
    }
}

/// Returns the strips of the wing: the nodes of the Gauss rule for a chord with a beta distribution (Ellington 1984).
///
/// ```text
/// c ∝ r̂^(P−1) (1 − r̂)^(Q−1)     P = r̂₁ K     Q = (1 − r̂₁) K     K = r̂₁ (1 − r̂₁)/(r̂₂² − r̂₁²) − 1
/// ```
///
/// Moments about the stroke axis have the levers λ r, so that lift and drag act at R_cp at zero body motion:
///
/// ```text
/// λ = R_cp r̂₂²/(R r̂₃³)     r̂₃³ = P (P + 1) (P + 2)/((P + Q) (P + Q + 1) (P + Q + 2))
/// ```
fn strips(p: &Params) -> Result<[ObliqueStrip<f64>; STRIPS], Invalid> {
    let second = p.wing_radius_2;
    let first = p.wing_radius_1.unwrap_or_else(|| libm::pow(second / 0.929, 1.0 / 0.732));
    if !(second * second < first && first < second) {
        return Err(Invalid::together(
            &["wing_radius_1", "wing_radius_2"],
            format!(
                "no wing has wing_radius_1 = {first} and wing_radius_2 = {second}: wing_radius_1 must lie between \
                 wing_radius_2^2 and wing_radius_2"
            ),
        ));
    }
    let k = first * (1.0 - first) / (second * second - first * first) - 1.0;
    let (a, b) = (first * k, (1.0 - first) * k);
    let third = a * (a + 1.0) * (a + 2.0) / (k * (k + 1.0) * (k + 2.0));
    let lever = p.pressure_radius * second * second / (p.wing_length * third);
    let dynamic = 0.5 * p.air_density * p.wing_area;
    let nodes = gauss_beta(STRIPS, a, b);
    Ok(core::array::from_fn(|i| {
        let radius = p.wing_length * nodes[i].x;
        ObliqueStrip {
            weight: dynamic * nodes[i].weight,
            radius,
            lever: lever * radius,
            behind: 0.0,
            chord: p.wing_area / p.wing_length,
        }
    }))
}

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
