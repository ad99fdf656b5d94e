//! Equations of motion, forces and currents of the bimorph model.
//!
//! Equation numbers refer to Jafferis, Graule and Wood (2016), with the corrections listed in `docs/models/bimorph.md`.
//!
//! The state is `[x, ẋ, ψ, ψ̇]`: displacement of the actuator's tip (m) and pitch (rad), each with its rate.
//! The stroke angle is T x, with the transmission ratio T. The pitch ψ is zero if the chord of the wing is
//! perpendicular to the motion of the wing. If ẋ > 0 and the trailing edge lags behind the leading edge, the
//! pitch is positive. Lift is positive upwards. The equations describe one actuator and one wing.

use core::f64::consts::{FRAC_2_PI, PI};

use super::constants::{Constants, EXPONENT_MAX};
use super::params::CentreOfPressure;
use super::transmission::{Law, Transmission};
use crate::drive::{DriveConstants, Wave};
use crate::model::Load;
use crate::num::Real;

/// Voltage across a piezoelectric plate, the force g of the plate at zero strain, and the derivatives of g
/// with respect to the voltage.
#[derive(Clone, Copy, Debug)]
pub struct Plate<R> {
    /// Voltage across the plate (V), and the time derivative of the voltage (V/s).
    pub voltage: Wave<R>,
    /// Force g of the plate at zero strain (N), Eq. (6).
    pub force: R,
    /// dg/dV (N/V).
    pub force_per_volt: R,
    /// d²g/dV² (N/V²).
    pub force_bend: R,
}

/// Returns voltages and forces of the two plates for the value `wave` of the waveform. The voltages of the
/// plates are in antiphase, Eq. (7).
///
/// ```text
/// V₁ = ½V_pp (1 − wave)     V₂ = ½V_pp (1 + wave)
/// ```
///
/// Half of the parameter `drive_offset` is added to V₁, and half is subtracted from V₂. The plates can have
/// different forces at the same voltage, so `c` contains one force constant for each plate.
#[inline(always)]
pub fn plates<R: Real>(c: &Constants<R>, wave: &Wave<R>) -> [Plate<R>; 2] {
    let DriveConstants { bias, amplitude, .. } = c.drive;
    let (first, second) = (bias + c.half_offset, bias - c.half_offset);
    let [f_1, f_2] = c.force_per_stress;
    let [s_1, s_2] = transitions(c, wave.value);
    [plate(c, f_1, wave.scaled(first, -amplitude), s_1), plate(c, f_2, wave.scaled(second, amplitude), s_2)]
}

/// Returns the progress S = σ(a₃ (ℰ − ℰ₀)) of the stress transition in each plate, Eq. (6). S rises from 0 at
/// small fields to 1 at large fields.
///
/// The time-dependent parts of the two fields have opposite signs, so both plates together need only one exponential
/// and one division.
///
/// ```text
/// S₁ = 1/(1 + e^(p₁ + γ wave))     S₂ = 1/(1 + e^(p₂ − γ wave))
/// ```
///
/// `check_transitions` limits the exponents to `EXPONENT_MAX`. The product of the two denominators in S₁ and
/// S₂ therefore overflows only if both S₁ and S₂ are below 1e-47. If the product of the denominators
/// overflows, the function returns zero for S₁ and S₂.
#[inline(always)]
fn transitions<R: Real>(c: &Constants<R>, wave: R) -> [R; 2] {
    let [e_1, e_2] = c.transition;
    let power = (c.transition_swing * wave).exp_of_ordinary();
    let (first, second) = (e_1.mul_add(power, power.lit(1.0)), power + e_2);
    let both = power.lit(1.0) / (first * second);
    [second * both, first * power * both]
}

/// Returns the force of a plate at zero strain, Eq. (6), and the derivatives of this force. The current of
/// the plate depends on the derivatives of the force. `s` is the progress of the stress transition, from 0 to
/// 1.
///
/// ```text
/// g = F_pre ℰ f₃₁(ℰ)     f₃₁ = f_min + A S     A = f_max (1 − a₄ℰ) − f_min
/// ```
///
/// In the paper, the equation for A contains 2 f_min instead of f_min.
#[inline(always)]
fn plate<R: Real>(c: &Constants<R>, force_per_stress: R, voltage: Wave<R>, s: R) -> Plate<R> {
    let field = voltage.value * c.field_per_volt;
    let one = field.lit(1.0);
    let a = c.f_rise - c.f_decline * field;
    let f = c.f_min + a * s;

    // Derivatives with respect to the field.
    let s_1 = c.a_3 * s * (one - s);
    let s_2 = c.a_3 * s_1 * (one - s * 2.0);
    let f_1 = a * s_1 - c.f_decline * s;
    let f_2 = a * s_2 - c.f_decline * s_1 * 2.0;
    let per_volt = force_per_stress * c.field_per_volt;
    Plate {
        voltage,
        force: force_per_stress * field * f,
        force_per_volt: per_volt * (f + field * f_1),
        force_bend: per_volt * c.field_per_volt * (f_1 * 2.0 + field * f_2),
    }
}

/// Returns the forces F₁ and F₂ (N) of the two plates at the displacement `x` of the actuator's tip, Eqs. (5)
/// and (6).
///
/// ```text
/// F₁ = g(V₁) (1 − b x)     F₂ = g(V₂) (1 + b x)     b = a₂ s_ε
/// ```
#[inline(always)]
pub(super) fn plate_forces<R: Real>(c: &Constants<R>, plates: &[Plate<R>; 2], x: R) -> [R; 2] {
    let change = c.b * x;
    [plates[0].force - plates[0].force * change, plates[1].force + plates[1].force * change]
}

/// Returns the number L that describes the stiffening of the compressed plate, Eq. (4): L = ln((1 +
/// e^(z₀+u))/(1 + e^z₀)) with u = a₁ s_ε |x|.
///
/// ```text
/// L = ln(1 + σ₀ (eᵘ − 1))     σ₀ = σ(z₀)     z₀ = a₁ε₀
/// ```
///
/// For every u, the relative error of L is only a rounding error. L approaches σ₀ u for small u, and u + ln
/// σ₀ for large u.
#[inline(always)]
pub(super) fn stiffening<R: Real>(c: &Constants<R>, x: R) -> R {
    let u = c.u_per_tip * x.abs();
    let within = u.min(u.lit(EXPONENT_MAX));
    // Beyond the limit, L grows as u does.
    (c.sigma_0 * within.exp_m1_of_ordinary()).ln_1p_of_normal() + (u - within)
}

/// Returns the actuator's elastic force K_act(x) x (N), Eqs. (3) and (4).
///
/// K_act is a secant stiffness and contains the quotient L/u. The function computes the product K_act x
/// without a division by u, so the result is also valid at x = 0.
///
/// ```text
/// K_act = K_pre (E_e D_E + E_cf t_cf³/4)     E_e = E_min + ½ (E_max − E_min) L/u
/// ```
#[inline(always)]
pub(super) fn elastic_force<R: Real>(c: &Constants<R>, x: R) -> R {
    c.k_soft * x + c.f_stiff * stiffening(c, x).copysign(x)
}

/// Returns the actuator's secant stiffness K_act (N/m), Eq. (3). At x = 0, the result is the limit of K_act
/// for x → 0.
#[inline(always)]
pub fn secant_stiffness<R: Real>(c: &Constants<R>, x: R) -> R {
    let x = x.abs().max(x.lit(1e-100));
    elastic_force(c, x) / x
}

/// Returns two numbers: the lift coefficient of the wing divided by sin 2ψ, which is b_L, and the drag
/// coefficient b₁ + b₂ cos 2ψ.
///
/// If `harmonics` is true, the lift and drag coefficients also contain the terms of `aero::Harmonics` at the
/// attack angle 90° − ψ.
#[inline(always)]
fn coefficients<R: Real>(c: &Constants<R>, harmonics: bool, cos_2psi: R) -> [R; 2] {
    let (lift, drag) = (c.b_l, c.b_1 + c.b_2 * cos_2psi);
    if harmonics {
        [lift + c.harmonics.lift(-cos_2psi), drag + c.harmonics.drag(-cos_2psi)]
    } else {
        [lift, drag]
    }
}

/// Returns the drag force at the actuator's tip, divided by ẋ|ẋ| (kg/m), Eqs. (1) and (8): C_A + C_B cos 2ψ.
#[inline(always)]
pub(super) fn tip_drag<R: Real>(c: &Constants<R>, cos_2psi: R) -> R {
    c.c_a + c.c_b * cos_2psi
}

/// Returns the angle ψ̃ on which the centre of pressure depends, for the interpretation `reading` of
/// Eq. (11).
#[inline(always)]
pub(super) fn tilt<R: Real>(reading: CentreOfPressure, psi: R, x_dot: R) -> R {
    match reading {
        CentreOfPressure::Folded => psi.abs(),
        CentreOfPressure::Directional => psi * psi.lit(1.0).copysign(x_dot),
        CentreOfPressure::Literal => psi,
    }
}

/// Returns the number C_D (kg): the aerodynamic torque about the hinge, divided by ẋ|ẋ|, Eqs. (10) and (11).
/// The centre of pressure depends on the angle ψ̃, which the function [`tilt`] computes.
///
/// ```text
/// C_D = ½ρA_w r̂₂²T²R² W_cp2 ((b₁ + b₂ cos 2ψ) cos ψ + b_L sin 2ψ sin ψ)
/// W_cp2 = A_w/R (p_min + (p_max − p_min) |1 − 2/π ψ̃|)
/// ```
///
/// If `harmonics` is true, the force coefficients and W_cp2 also contain the terms of `aero::Harmonics`. The
/// terms of `aero::Harmonics` in W_cp2 depend on the attack angle |90° − ψ̃|.
#[inline(always)]
pub(super) fn hinge_drag<R: Real>(c: &Constants<R>, harmonics: bool, tilt: R, sin: R, cos: R) -> R {
    let (sin_2psi, cos_2psi) = double_angle(sin, cos);
    let quarters = (tilt * -FRAC_2_PI + 1.0).abs();
    let arm = c.p_min + c.p_swing * quarters;
    let arm = if harmonics { arm + c.harmonics.pressure(quarters * PI) } else { arm };
    let [lift, drag] = coefficients(c, harmonics, cos_2psi);
    c.hinge_torque * arm * (drag * cos + lift * sin_2psi * sin)
}

/// Returns sin 2ψ and cos 2ψ.
#[inline(always)]
pub(super) fn double_angle<R: Real>(sin: R, cos: R) -> (R, R) {
    (sin * cos * 2.0, cos * cos * 2.0 - 1.0)
}

/// Returns the time derivative `[ẋ, ẍ, ψ̇, ψ̈]` of the state, Eqs. (1) and (2).
///
/// ```text
/// m_e ẍ + (K_act(x) + K_t) x + (C_A + C_B cos 2ψ) |ẋ| ẋ = F₁ − F₂
/// I_xx ψ̈ + κ_wh ψ + C_C |ψ̇| ψ̇ = C_D ẋ|ẋ| + I_xz T ẍ cos ψ + ½ I_xx (Tẋ)² sin 2ψ
/// ```
///
/// The code contains two terms that the paper leaves out: damping of stroke and hinge, and a [`Transmission`]
/// ratio that grows with the displacement. By default, the damping is zero and the transmission ratio is
/// constant. If the transmission ratio grows, T ẋ stands for φ̇ in the equations of motion, and T ẍ stands
/// for φ̈.
#[inline(always)]
pub(super) fn derivative<R: Real>(
    c: &Constants<R>,
    law: Law,
    centre_of_pressure: CentreOfPressure,
    plates: &[Plate<R>; 2],
    y: &[R; 4],
) -> [R; 4] {
    let [x, x_dot, psi, psi_dot] = *y;
    let (sin, cos) = psi.sin_cos();
    let (sin_2psi, cos_2psi) = double_angle(sin, cos);
    let transmission = Transmission::at(c, law, x);
    let rate = transmission.times(x_dot);
    let flow = rate.abs() * rate;

    let [f_1, f_2] = plate_forces(c, plates, x);
    let restoring = elastic_force(c, x) + c.k_t * x;
    let drag = transmission.times(tip_drag(c, cos_2psi) * flow);
    let force = f_1 - f_2 - restoring - drag - stroke_damping(c, &transmission, x_dot, rate);
    let x_ddot = transmission.acceleration(c, force, x_dot);

    let psi_ddot = (hinge_drag(c, false, tilt(centre_of_pressure, psi, x_dot), sin, cos) * flow
        + c.coupling * transmission.stroke_acceleration(x_ddot, x_dot) * cos
        + c.centrifugal * rate * rate * sin_2psi
        - c.kappa_wh * psi
        - (c.c_c * psi_dot.abs() + c.hinge_damping) * psi_dot)
        * c.inverse_i_xx;
    [x_dot, x_ddot, psi_dot, psi_ddot]
}

/// Returns the damping force at the actuator's tip (N), from the loss factor of the springs and the damping about the
/// stroke axis.
#[inline(always)]
pub(super) fn stroke_damping<R: Real>(
    c: &Constants<R>,
    transmission: &Transmission<R>,
    x_dot: R,
    rate: R,
) -> R {
    c.tip_damping * x_dot + transmission.times(c.stroke_damping * rate)
}

/// Returns lift and drag of the wing (N). `rate` is φ̇/T, the stroke rate divided by the transmission ratio,
/// which the paper writes as ẋ.
///
/// The paper contains no equations for lift and drag. Eqs. (8) and (10) of the paper imply the following
/// equations for lift and drag:
///
/// ```text
/// L = ½ρA_w r̂₂²R²T² ẋ|ẋ| b_L sin 2ψ     D = ½ρA_w r̂₂²R²T² ẋ|ẋ| (b₁ + b₂ cos 2ψ)
/// ```
///
/// Drag opposes the stroke. The power of the drag, R_cp T ẋ D, is the power that the actuator loses to the
/// air. If `harmonics` is true, the lift and drag coefficients also contain the terms of `aero::Harmonics`.
#[inline(always)]
pub(super) fn lift_and_drag<R: Real>(
    c: &Constants<R>,
    harmonics: bool,
    rate: R,
    [sin_2psi, cos_2psi]: [R; 2],
) -> [R; 2] {
    let force = c.force * rate.abs() * rate;
    let [lift, drag] = coefficients(c, harmonics, cos_2psi);
    [force * lift * sin_2psi, force * drag]
}

/// Returns the aerodynamic force and moment on the wing at the stroke angle `stroke` (rad). Lift and drag act
/// at the distance R_cp from the stroke axis. The documentation of [`lift_and_drag`] defines `rate`.
///
/// ```text
/// M_L = R_cp L     M_D = R_cp D     M_s = C_D ẋ|ẋ| − C_C |ψ̇| ψ̇
/// ```
#[inline(always)]
pub(super) fn load<R: Real>(
    c: &Constants<R>,
    harmonics: bool,
    centre_of_pressure: CentreOfPressure,
    stroke: R,
    x_dot: R,
    rate: R,
    [psi, psi_dot]: [R; 2],
) -> Load<R> {
    let (sin, cos) = psi.sin_cos();
    let (sin_2psi, cos_2psi) = double_angle(sin, cos);
    let [lift, drag] = lift_and_drag(c, harmonics, rate, [sin_2psi, cos_2psi]);
    let tilt = tilt(centre_of_pressure, psi, x_dot);
    Load {
        stroke,
        lift,
        drag,
        lift_moment: c.pressure_radius * lift,
        drag_moment: c.pressure_radius * drag,
        span_moment: hinge_drag(c, harmonics, tilt, sin, cos) * rate.abs() * rate
            - c.c_c * psi_dot.abs() * psi_dot,
    }
}

/// Returns the power that charges the plates' capacitance (W): C_p (V₁V̇₁ + V₂V̇₂). The mean of the charging
/// power over a period is zero.
#[inline(always)]
pub(super) fn charging_power<R: Real>(c: &Constants<R>, plates: &[Plate<R>; 2]) -> R {
    let [v_1, v_2] = [plates[0].voltage, plates[1].voltage];
    c.c_p * (v_1.value * v_1.rate + v_2.value * v_2.rate)
}

/// Returns the currents into the two plates (A). The currents are the time derivatives of the charges q₁ and
/// q₂, which follow from the forces of Eq. (6) by reciprocity. The paper contains no equations for the
/// currents.
///
/// ```text
/// q₁ = C_p V₁ + g'(V₁) (x − ½ b x²)     q₂ = C_p V₂ − g'(V₂) (x + ½ b x²)
/// i₁ = C_p V̇₁ + g''(V₁) V̇₁ (x − ½ b x²) + g'(V₁) (1 − b x) ẋ
/// i₂ = C_p V̇₂ − g''(V₂) V̇₂ (x + ½ b x²) − g'(V₂) (1 + b x) ẋ
/// ```
///
/// The currents of the dielectric loss ([`leakage`]) are not included.
#[inline(always)]
pub(super) fn currents<R: Real>(c: &Constants<R>, plates: &[Plate<R>; 2], x: R, x_dot: R) -> [R; 2] {
    let [p_1, p_2] = plates;
    let change = c.b * x;
    let bend = change * x * 0.5;
    let moved = change * x_dot;
    [
        (c.c_p + p_1.force_bend * (x - bend)) * p_1.voltage.rate + p_1.force_per_volt * (x_dot - moved),
        (c.c_p - p_2.force_bend * (x + bend)) * p_2.voltage.rate - p_2.force_per_volt * (x_dot + moved),
    ]
}

/// Returns the currents of the dielectric loss in both plates (A): conductance times the difference between
/// the voltage and the mean voltage.
#[inline(always)]
pub(super) fn leakage<R: Real>(c: &Constants<R>, plates: &[Plate<R>; 2], means: [R; 2]) -> [R; 2] {
    let [v_1, v_2] = [plates[0].voltage.value, plates[1].voltage.value];
    [c.conductance * (v_1 - means[0]), c.conductance * (v_2 - means[1])]
}
