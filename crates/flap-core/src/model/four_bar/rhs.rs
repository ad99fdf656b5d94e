//! Equations of motion of the four-bar model.
//!
//! Equation numbers refer to Arabagi, Hines and Sitti (2013), with the corrections listed in `docs/models/four-bar.md`.
//!
//! The state is `[θ, φ, θ̇, φ̇]`: stroke and pitch (rad), and their rates (rad/s). At φ = 0 the chord is vertical, and
//! the trailing edge is below the leading edge. If φ > 0, the trailing edge is displaced in the direction of positive
//! θ.

use super::aerodynamics::{Aerodynamics, aerodynamics};
use super::constants::{Actuator, Constants, Wing};
use crate::drive::Wave;
use crate::model::stroke_and_pitch::Balance;
use crate::num::Real;

/// Displacement and inertia of actuator, slider-crank and four-bar at one stroke angle.
#[derive(Clone, Copy, Debug)]
pub struct Transmission<R> {
    /// Displacement δ of the slider-crank (m).
    pub displacement: R,
    /// First derivative δ′ = dδ/dθ of the displacement δ with respect to the stroke (m).
    pub slope: R,
    /// Second derivative δ″ of the displacement δ with respect to the stroke (m).
    pub bend: R,
    /// Inertia G of links and actuator about the stroke axis (kg·m²): the sums in Eq. (13).
    pub inertia: R,
    /// Half of the derivative of the inertia G with respect to θ, G′/2 (kg·m²).
    pub half_inertia_slope: R,
}

/// Returns the transmission at the stroke `theta` (rad).
///
/// ```text
/// δ′ = δ_η θ₁′     δ″ = δ_ηη θ₁′² + δ_η θ₁″
/// G = Σ m_Li |x_i′|² + Σ J_Li θ_i′² + m_eff δ′²     ½G′ = Σ m_Li x_i′·x_i″ + Σ J_Li θ_i′ θ_i″ + m_eff δ′ δ″
/// ```
#[inline(always)]
pub fn transmission<R: Real>(c: &Constants<R>, theta: R) -> Transmission<R> {
    let links = c.four_bar.motion(theta);
    let [sin, cos] = links.turned;
    let slider = c.slider_crank.motion(sin, cos);
    let [input_p, input_pp] = links.input;
    let slope = slider.slope * input_p;
    let bend = slider.bend * input_p * input_p + slider.slope * input_pp;
    let [inertia, half_slope] = c.links.about_stroke(&links);
    Transmission {
        displacement: slider.displacement,
        slope,
        bend,
        inertia: inertia + c.actuator.mass * slope * slope,
        half_inertia_slope: half_slope + c.actuator.mass * slope * bend,
    }
}

/// Returns the force F of the actuator on the slider-crank (N), from the reconstructed Eqs. (1) and (2).
///
/// ```text
/// F = k_eff (γ (V − V_ref) − δ)
/// ```
#[inline(always)]
pub(super) fn force<R: Real>(c: &Actuator<R>, drive: &Wave<R>, displacement: R) -> R {
    c.stiffness * (c.deflection * (drive.value - c.rest_voltage) - displacement)
}

/// Returns the displacement δ_a of the actuator's tip (m): the sum of the displacements of slider-crank and
/// series spring. The paper does not contain the equation for δ_a.
///
/// ```text
/// δ_a = δ + F/k_sc
/// ```
#[inline(always)]
pub(super) fn tip<R: Real>(c: &Actuator<R>, displacement: R, force: R) -> R {
    displacement + force * c.series_compliance
}

/// Returns the current into the actuator (A). The current follows from the reciprocity of the actuator's
/// force and charge. The paper does not contain the equation for the current.
///
/// ```text
/// i = C_b V̇ + Γ δ̇_a     δ̇_a = δ′θ̇ + k_eff (γV̇ − δ′θ̇)/k_sc
/// ```
#[inline(always)]
pub(super) fn current<R: Real>(c: &Actuator<R>, drive: &Wave<R>, slider_rate: R) -> R {
    let force_rate = c.stiffness * (c.deflection * drive.rate - slider_rate);
    c.capacitance * drive.rate + c.coupling * tip(c, slider_rate, force_rate)
}

/// Returns the part of the [`current`] that charges the capacitances of the actuator (A). The mean power of
/// the charging current over a period is zero.
///
/// ```text
/// (C_b + Γ k_eff γ/k_sc) V̇
/// ```
#[inline(always)]
pub(super) fn charging_current<R: Real>(c: &Actuator<R>, drive: &Wave<R>) -> R {
    (c.capacitance + c.coupling * c.stiffness * c.deflection * c.series_compliance) * drive.rate
}

/// Returns the change of the actuator's [`force`] (N) if the voltage changes by `swing` (V): k_eff γ swing.
#[inline(always)]
pub(super) fn driving_force<R: Real>(c: &Actuator<R>, swing: R) -> R {
    c.stiffness * c.deflection * swing
}

/// Returns the mass matrix [M₁₁, M₁₂, M₂₂] (kg·m²), from Eq. (13).
///
/// ```text
/// M₁₁ = m R² + (m β² + J_yy) sin²φ + J_zz cos²φ + G     M₁₂ = P cos φ     M₂₂ = J_φ
/// ```
#[inline(always)]
pub(super) fn mass_matrix<R: Real>(c: &Constants<R>, inertia: R, sin: R, cos: R) -> [R; 3] {
    let wing = &c.wing;
    [
        wing.upright + wing.j_sin * sin * sin + wing.j_cos * cos * cos + inertia,
        wing.coupling * cos,
        wing.j_pitch,
    ]
}

/// Returns the mass matrix and the generalised forces of Lagrange's equations, Eqs. (14) and (15), without
/// the moment F δ′ of the actuator.
///
/// ```text
/// ⎡M₁₁ M₁₂⎤ ⎡θ̈⎤ = ⎡F δ′ + Q_θ − Dθ̇ + P sin φ φ̇² − J_d sin 2φ θ̇φ̇ − ½G′θ̇²⎤
/// ⎣M₁₂ M₂₂⎦ ⎣φ̈⎦   ⎣Q_φ − dφ̇ − k_rot φ + ½J_d sin 2φ θ̇²                  ⎦
/// ```
///
/// The damping of the stroke is D + γ k_eff δ′²/ω, where γ is the loss factor of actuator and series spring.
#[inline(always)]
pub(super) fn balance<R: Real>(c: &Constants<R>, links: &Transmission<R>, side: R, y: &[R; 4]) -> Balance<R> {
    let (sin, cos) = y[1].sin_cos();
    balance_in(c, links, &aerodynamics(c, false, side, y, sin, cos), y, [sin, cos])
}

/// Returns the mass matrix and the generalised forces for the given aerodynamic forces and moments.
#[inline(always)]
pub(super) fn balance_in<R: Real>(
    c: &Constants<R>,
    links: &Transmission<R>,
    air: &Aerodynamics<R>,
    y: &[R; 4],
    [sin, cos]: [R; 2],
) -> Balance<R> {
    let [_, phi, theta_dot, phi_dot] = *y;
    let wing = &c.wing;
    let gyroscopic = wing.j_difference * sin * cos * theta_dot;
    let [rotation_stroke, rotation_pitch] = air.rotation_moments(cos);
    let stroke_moment = air.stroke_moment + rotation_stroke - stroke_damping(wing, links) * theta_dot
        + wing.coupling * sin * phi_dot * phi_dot
        - gyroscopic * phi_dot * 2.0
        - links.half_inertia_slope * theta_dot * theta_dot;
    let pitch_moment =
        air.pitch_moment + rotation_pitch - wing.hinge_damping * phi_dot - wing.hinge_stiffness * phi
            + gyroscopic * theta_dot;
    Balance { mass: mass_matrix(c, links.inertia, sin, cos), stroke_moment, pitch_moment }
}

/// Returns the damping of the stroke (N·m·s). The damping is the sum of D and the damping that is equivalent
/// to the loss factor γ of actuator and series spring.
///
/// The paper does not contain the loss factor γ.
///
/// ```text
/// D + γ k_eff δ′²/ω
/// ```
#[inline(always)]
pub(super) fn stroke_damping<R: Real>(wing: &Wing<R>, links: &Transmission<R>) -> R {
    wing.stroke_damping + wing.spring_damping * links.slope * links.slope
}
