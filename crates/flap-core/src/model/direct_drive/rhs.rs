//! Equations of motion, forces and currents of the direct-drive model.
//!
//! Equation numbers refer to Ozaki and Hamaguchi (2018), with the corrections listed in `docs/models/direct-drive.md`.
//!
//! The state is `[φ, ψ, φ̇, ψ̇]`: stroke and pitch (rad), and their rates (rad/s). The pitch ψ is zero if the
//! plane of the wing contains the stroke axis. If φ̇ > 0 and the trailing edge lags behind the leading edge,
//! the pitch is positive. Lift is positive upwards, which is the direction from the trailing edge to the
//! leading edge at ψ = 0.

use core::f64::consts::FRAC_PI_2;

use super::constants::Constants;
use super::params::FlowDirection;
use crate::aero::NormalLoad;
use crate::drive::Wave;
use crate::model::Load;
use crate::model::stroke_and_pitch::Balance;
use crate::num::Real;

/// Translational and rotational aerodynamic forces and moments at one state.
#[derive(Clone, Copy, Debug)]
pub(super) struct Aerodynamics<R> {
    /// Translational lift F_tr,Lift (N), Eq. (21).
    pub(super) lift: R,
    /// Translational drag F_tr,Drag along the wing's motion (N), Eq. (19).
    pub(super) drag: R,
    /// Moment M_tr,y of the translational forces about the stroke axis (N·m), Eq. (25).
    pub(super) stroke_moment: R,
    /// Moment of the lift ∫ X dF_tr,Lift (N·m). Neither the paper nor the equations of motion contain the moment of the
    /// lift.
    pub(super) lift_moment: R,
    /// Moment M_tr,x′ of the translational forces about the span axis (N·m), Eq. (23) with corrected sign.
    pub(super) pitch_moment: R,
    /// Moment M_rot of the rotational drag about the span axis (N·m), Eq. (32).
    pub(super) rotation_moment: R,
}

/// Returns the aerodynamic forces and moments without the added mass, Eqs. (19)–(26) and (32).
///
/// ```text
/// w = ψ̇ cos ψ     C_L = K_L sin 2ψ     C_N = C_L sin ψ + C_D cos ψ
/// C_D = ½(C_Dmax + C_Dmin) + ½(C_Dmax − C_Dmin) cos 2ψ
/// F_Lift = C_L ∫ q dr     M_y = −C_D ∫ q X dr     M_x′ = C_N ∫ q c d_cp dr     q = ½ρ c u|u|
/// ```
///
/// `flow` selects the direction of the flow in u|u| and d_cp: one direction for the whole wing, or one for
/// each blade element. `side` is σ, the sign of the wing's [`mean_velocity`]. If `harmonics` is true, C_L,
/// C_D and d_cp also contain the terms of `aero::Harmonics`.
#[inline(always)]
pub(super) fn aerodynamics<R: Real>(
    c: &Constants<R>,
    harmonics: bool,
    flow: FlowDirection,
    side: R,
    y: &[R; 4],
    sin: R,
    cos: R,
) -> Aerodynamics<R> {
    let [_, psi, phi_dot, psi_dot] = *y;
    let w = psi_dot * cos;

    let sin_2psi = sin * cos * 2.0;
    let cos_2psi = cos * cos * 2.0 - 1.0;
    let mut k_lift = c.k_lift;
    let mut c_drag = c.drag_mean + c.drag_swing * cos_2psi;
    if harmonics {
        k_lift = k_lift + c.harmonics.lift(-cos_2psi);
        c_drag = c_drag + c.harmonics.drag(-cos_2psi);
    }
    let c_lift = k_lift * sin_2psi;
    let c_normal = c_lift * sin + c_drag * cos;

    let pressure = match flow {
        FlowDirection::Uniform => uniform_flow(c, harmonics, side, psi, [phi_dot, w]),
        FlowDirection::Blade => blade_flow(c, harmonics, psi, [phi_dot, w]),
    };
    Aerodynamics {
        lift: c_lift * pressure.force,
        drag: c_drag * pressure.force,
        stroke_moment: -(c_drag * pressure.stroke),
        lift_moment: c_lift * pressure.stroke,
        pitch_moment: c_normal * pressure.pitch,
        rotation_moment: -(c.rotation * psi_dot * psi_dot.abs()),
    }
}

/// Integrals along the span of q = ½ρ c u|u|, which is the dynamic pressure times the chord c.
struct Pressure<R> {
    /// Integral ∫ q dr, to which the force is proportional (N).
    force: R,
    /// Integral ∫ q X dr, to which the moment about the stroke axis is proportional (N·m).
    stroke: R,
    /// Integral ∫ q c d_cp dr, to which the moment about the span axis is proportional (N·m).
    pitch: R,
}

/// Returns the integrals of the pressure with one direction of flow σ for the whole wing, as in the paper.
///
/// ```text
/// ∫ q dr = ½ρA_w B_L σ     ∫ q X dr = ½ρA_w R B_Y σ     ∫ q c d_cp dr = ½ρA_w c̄ d_cp(σ) B_X σ
/// B_L, B_Y, B_X: quadratic forms in φ̇ and w
/// ```
#[inline(always)]
fn uniform_flow<R: Real>(
    c: &Constants<R>,
    harmonics: bool,
    side: R,
    psi: R,
    [phi_dot, w]: [R; 2],
) -> Pressure<R> {
    let products = [phi_dot * phi_dot * side, phi_dot * w * side, w * w * side];
    Pressure {
        force: form(c.lift, products),
        stroke: form(c.stroke, products),
        pitch: centre_of_pressure(c, harmonics, psi, side) * form(c.pitch, products),
    }
}

/// Returns a quadratic form of two variables: the sum of three `factors` times the `products` of the
/// variables.
#[inline(always)]
fn form<R: Real>(factors: [R; 3], products: [R; 3]) -> R {
    factors[0] * products[0] + factors[1] * products[1] + factors[2] * products[2]
}

/// Returns the integrals of the pressure with a separate direction of flow for each blade element.
///
/// ```text
/// u = X φ̇ − ½ c w
/// ∫ q c d_cp dr = ½ (d_cp(+) + d_cp(−)) ∫ q c dr + ½ (d_cp(+) − d_cp(−)) ∫ |q| c dr     ∫ |q| c dr = ½ρA_w c̄ B_X
/// ```
///
/// When the flow past an element changes its direction, the velocity of the element is zero. The integrals of
/// the pressure are therefore continuous: they have equal values on the two sides of a switching surface.
#[inline(always)]
fn blade_flow<R: Real>(c: &Constants<R>, harmonics: bool, psi: R, [phi_dot, w]: [R; 2]) -> Pressure<R> {
    let sums = c.blades.sums(phi_dot, w);
    let [pitch_pp, pitch_pw, pitch_ww] = c.pitch;
    let undirected = (pitch_pp * phi_dot + pitch_pw * w) * phi_dot + pitch_ww * w * w;
    let one = psi.lit(1.0);
    let forth = centre_of_pressure(c, harmonics, psi, one);
    let back = centre_of_pressure(c, harmonics, psi, -one);
    Pressure {
        force: sums.force,
        stroke: sums.radius,
        pitch: ((forth + back) * sums.chord + (forth - back) * undirected) * 0.5,
    }
}

/// Returns the mean velocity ū of the wing (m/s) and the time derivative of ū (m/s²). The sign of ū
/// determines the direction of the aerodynamic forces.
///
/// ```text
/// ū = (R/2 + x_r) φ̇ − ½ c(R/2) ψ̇ cos ψ
/// ```
#[inline(always)]
pub(super) fn mean_velocity<R: Real>(c: &Constants<R>, y: &[R; 4], dy: &[R; 4]) -> [R; 2] {
    let [_, psi, phi_dot, psi_dot] = *y;
    let [_, _, phi_ddot, psi_ddot] = *dy;
    let (sin, cos) = psi.sin_cos();
    let velocity = c.mid_radius * phi_dot - c.mid_half_chord * psi_dot * cos;
    let rate = c.mid_radius * phi_ddot - c.mid_half_chord * (psi_ddot * cos - psi_dot * psi_dot * sin);
    [velocity, rate]
}

/// Returns the centre of pressure d_cp (chords) if the flow has the direction `side`, which is +1 or −1,
/// Eq. (24). The constants `c` select the definition of the attack angle.
///
/// ```text
/// d_cp = (0.82/π) α_d + 0.05
/// ```
#[inline(always)]
fn centre_of_pressure<R: Real>(c: &Constants<R>, harmonics: bool, psi: R, side: R) -> R {
    let [directional, folded, literal] = c.attack;
    let tilt = directional * side * psi + folded * psi.abs() + literal * psi;
    let attack = -tilt + FRAC_PI_2;
    // The magnitude |α|, except in the folded reading, which is signed.
    let attack = R::select(folded.lt(attack.lit(0.5)), attack.abs(), attack);
    let place = c.pressure_slope * attack + c.pressure_offset;
    if harmonics { place + c.harmonics.pressure(attack * 2.0) } else { place }
}

/// Returns the mass matrix and the generalised forces of Lagrange's equations, Eqs. (3)–(18), without the
/// torque ΓV of the voltage.
///
/// The added mass of Eqs. (28)–(30) is part of the mass matrix. The aerodynamic moments of Eq. (34) are part of the
/// generalised forces.
///
/// ```text
/// ⎡m₁₁ + m_s s² + a₁₁ c²   (m₁₂ − a₁₂) c⎤ ⎡φ̈⎤ = ⎡Q₁ + ΓV⎤     s = sin ψ, c = cos ψ
/// ⎣(m₁₂ − a₁₂) c              m₂₂ + a₂₂⎦ ⎣ψ̈⎦   ⎣Q₂     ⎦
///
/// Q₁ = −k_φ φ − 2m_s φ̇ψ̇ s c + m₁₂ ψ̇² s + a₁₁ φ̇ψ̇ s c + M_tr,y
/// Q₂ = −k_w ψ + m_s φ̇² s c − a₁₂ φ̇ψ̇ s + M_tr,x′ + M_rot
/// ```
///
/// The paper contains no viscous damping. The function subtracts a moment proportional to φ̇ from Q₁, and a
/// moment proportional to ψ̇ from Q₂.
///
/// The Lagrangian form of the added mass adds ψ̇ e to Q₁ and −φ̇ e to Q₂, with e = (a₁₁ φ̇ c − a₁₂ ψ̇) s.
#[inline(always)]
pub(super) fn balance<R: Real>(c: &Constants<R>, flow: FlowDirection, side: R, y: &[R; 4]) -> Balance<R> {
    let (sin, cos) = y[1].sin_cos();
    balance_in(c, &aerodynamics(c, false, flow, side, y, sin, cos), y, [sin, cos])
}

/// Returns the mass matrix and the generalised forces of [`balance`] for the given aerodynamic forces and moments.
#[inline(always)]
pub(super) fn balance_in<R: Real>(
    c: &Constants<R>,
    air: &Aerodynamics<R>,
    y: &[R; 4],
    [sin, cos]: [R; 2],
) -> Balance<R> {
    let [phi, psi, phi_dot, psi_dot] = *y;
    let both = phi_dot * psi_dot;
    let gyroscopic = gyroscopic(c, &[phi_dot, psi_dot], sin, cos);
    let q1 =
        (c.added.a11 - c.m_s * 2.0) * both * sin * cos + c.m12 * psi_dot * psi_dot * sin + air.stroke_moment
            - c.k_phi * phi
            + psi_dot * gyroscopic
            - c.stroke_damping * phi_dot;
    let q2 = c.m_s * phi_dot * phi_dot * sin * cos - c.k_w * psi - c.added.a12 * both * sin
        + air.pitch_moment
        + air.rotation_moment
        - phi_dot * gyroscopic
        - c.hinge_damping * psi_dot;

    let m11 = c.m11 + c.m_s * sin * sin + c.added.a11 * cos * cos;
    let m12 = (c.m12 - c.added.a12) * cos;
    let m22 = c.m22 + c.added.a22;
    Balance { mass: [m11, m12, m22], stroke_moment: q1, pitch_moment: q2 }
}

/// Returns e, the gyroscopic moment of the added mass per stroke rate or pitch rate (N·m·s).
///
/// The Lagrangian form of the added mass adds e times the pitch rate to the moment of the stroke. The Lagrangian form
/// subtracts e times the stroke rate from the moment of the pitch.
#[inline(always)]
fn gyroscopic<R: Real>(c: &Constants<R>, [phi_dot, psi_dot]: &[R; 2], sin: R, cos: R) -> R {
    c.gyroscopic * (c.added.a11 * *phi_dot * cos - c.added.a12 * *psi_dot) * sin
}

/// Returns the force and the moments of the added mass, Eqs. (28)–(30). The argument `dy` contains the
/// accelerations. M_am,y″ is the moment about the chord's axis, and M_am,x′ is the moment about the span
/// axis.
///
/// ```text
/// A = φ̈ cos ψ − φ̇ψ̇ sin ψ
/// F_am = −f₁ A + f₂ ψ̈     M_am,y″ = −a₁₁ A + a₁₂ ψ̈     M_am,x′ = a₁₂ A − a₂₂ ψ̈
/// ```
#[inline(always)]
pub(super) fn added_mass<R: Real>(c: &Constants<R>, sin: R, cos: R, dy: &[R; 4]) -> NormalLoad<R> {
    let [phi_dot, psi_dot, phi_ddot, psi_ddot] = *dy;
    let a = phi_ddot * cos - phi_dot * psi_dot * sin;
    NormalLoad {
        force: c.added.f2 * psi_ddot - c.added.f1 * a,
        chord_moment: c.added.a12 * psi_ddot - c.added.a11 * a,
        span_moment: c.added.a12 * a - c.added.a22 * psi_ddot,
    }
}

/// Returns the lift (N), positive upwards, Eq. (35). With the corrected sign, the lift is F_tr,Lift − F_am
/// sin ψ.
#[inline(always)]
pub(super) fn lift<R: Real>(c: &Constants<R>, air: &Aerodynamics<R>, added: &NormalLoad<R>, sin: R) -> R {
    air.lift - c.lift_sign * added.force * sin
}

/// Returns the aerodynamic force and moment on the wing.
///
/// The force of the added mass acts along the wing's normal, which is (cos ψ e_t − sin ψ e_z):
///
/// ```text
/// L = F_tr,Lift − F_am sin ψ     D = F_tr,Drag − F_am cos ψ     M_s = M_tr,x′ + M_rot + M_am,x′
/// M_L = ∫ X dF_tr,Lift − M_am,y″ sin ψ     M_D = −M_tr,y − M_am,y″ cos ψ
/// ```
///
/// The Lagrangian form of the added mass adds −ψ̇ e to M_D and −φ̇ e to M_s, see [`balance`].
#[inline(always)]
pub(super) fn load<R: Real>(
    c: &Constants<R>,
    air: &Aerodynamics<R>,
    added: &NormalLoad<R>,
    y: &[R; 4],
    [sin, cos]: [R; 2],
) -> Load<R> {
    let [phi, _, phi_dot, psi_dot] = *y;
    let gyroscopic = gyroscopic(c, &[phi_dot, psi_dot], sin, cos);
    Load {
        stroke: phi,
        lift: lift(c, air, added, sin),
        drag: air.drag - added.force * cos,
        lift_moment: air.lift_moment - c.lift_sign * added.chord_moment * sin,
        drag_moment: -air.stroke_moment - added.chord_moment * cos - psi_dot * gyroscopic,
        span_moment: air.pitch_moment + air.rotation_moment + added.span_moment - phi_dot * gyroscopic,
    }
}

/// Returns the current j_A = C_p V̇ + Γ φ̇ into the actuator (A), Eq. (39). By reciprocity, the charge per
/// stroke angle Γ is also the torque per voltage. The current of the dielectric loss is not included.
#[inline(always)]
pub(super) fn current<R: Real>(c: &Constants<R>, drive: &Wave<R>, phi_dot: R) -> R {
    c.c_p * drive.rate + c.gamma * phi_dot
}
