//! Aerodynamic forces and moments on the wing of the four-bar model.
//!
//! The equations are Eqs. (5)–(10) and (16)–(18) of Arabagi, Hines and Sitti 2013, with the corrections
//! listed in `docs/models/four-bar.md`. Lift is positive upwards. Q_θ is the moment about the stroke axis,
//! and Q_φ is the moment about the rotation axis.

use core::f64::consts::{FRAC_1_PI, FRAC_PI_2, FRAC_PI_4, PI};

use super::constants::{Air, Constants};
use crate::aero::NormalLoad;
use crate::model::Load;
use crate::num::Real;

/// Aerodynamic forces and moments on a wing that translates and rotates.
#[derive(Clone, Copy, Debug)]
pub(super) struct Aerodynamics<R> {
    /// Translational lift L_t (N), Eq. (5).
    pub(super) lift: R,
    /// Translational drag (N), Eq. (5). The drag is a horizontal force, and is positive if it acts against a
    /// motion with θ̇ > 0.
    pub(super) drag: R,
    /// Moment of the translational drag about the stroke axis (N·m), Eq. (16).
    pub(super) stroke_moment: R,
    /// Moment of the translational lift Σ r L_t (N·m). Neither the paper nor the equations of motion contain the moment
    /// of the lift.
    pub(super) lift_moment: R,
    /// Moment of translational lift and drag about the rotation axis (N·m), Eqs. (16) and (17).
    pub(super) pitch_moment: R,
    /// Rotational force: the force that the rotation of the wing about its rotation axis causes, Eqs. (6) and
    /// (18). The lift L_r of the rotational force is the force times sin φ. The moment Q_φ of the rotational
    /// force about the rotation axis is minus the span moment.
    pub(super) rotation: NormalLoad<R>,
}

impl<R: Real> Aerodynamics<R> {
    /// Returns the moments of the rotational force about the stroke axis and the rotation axis (N·m).
    #[inline(always)]
    pub(super) fn rotation_moments(&self, cos: R) -> [R; 2] {
        [self.rotation.chord_moment * cos, -self.rotation.span_moment]
    }
}

/// Returns the rotational force on the wing. The argument `rotation` is −|φ̇|φ̇ (rad²/s²).
#[inline(always)]
pub(super) fn rotational_force<R: Real>(air: &Air<R>, rotation: R) -> NormalLoad<R> {
    NormalLoad {
        force: air.rotation_force * rotation,
        chord_moment: air.rotation_stroke * rotation,
        span_moment: -(air.rotation_pitch * rotation),
    }
}

/// Angles of the wing on which the aerodynamic coefficients depend.
#[derive(Clone, Copy, Debug)]
struct Attitude<R> {
    /// Attack angle B of the wing, in the range [0, π/2].
    attack: R,
    /// Angle τ between the chord and the vertical, in [−π/2, π/2]: τ = arcsin sin φ.
    tilt: R,
}

/// Returns the attack angle B, in the range [0, π/2], and the inclination τ of the chord at the pitch `phi`.
/// `side` is σ = sign tan φ.
///
/// ```text
/// φ = φ_m + kπ     B = π/2 − σφ_m     τ = (−1)^k φ_m
/// ```
///
/// The whole number k is chosen so that the distance between φ_m and σπ/4 is at most π/2. As long as `side` does not
/// change, B and τ are smooth functions of φ, even if tan φ changes its sign.
#[inline(always)]
fn attitude<R: Real>(side: R, phi: R) -> Attitude<R> {
    let k = ((phi - side * FRAC_PI_4) * FRAC_1_PI).round_ties_even();
    let phi_m = k.mul_add(k.lit(-PI), phi);
    let odd = (k - (k * 0.5).round_ties_even() * 2.0).abs();
    Attitude { attack: -(side * phi_m) + FRAC_PI_2, tilt: (odd * -2.0 + 1.0) * phi_m }
}

/// Returns the lift coefficient, Eq. (9), and the drag coefficient, Eq. (10), at the attack angle B (rad).
///
/// ```text
/// C_l = 0.225 + 1.58 sin(2.13 B − 7.2°)     C_d = 1.92 − 1.55 cos(2.04 B − 9.82°)
/// ```
///
/// If `harmonics` is true, the lift and drag coefficients also contain the terms of `aero::Harmonics`.
#[inline(always)]
pub(super) fn coefficients<R: Real>(c: &Air<R>, harmonics: bool, attack: R) -> [R; 2] {
    let [lift_offset, lift_amplitude, lift_slope, lift_phase] = c.lift;
    let [drag_offset, drag_amplitude, drag_slope, drag_phase] = c.drag;
    let lift = lift_slope.mul_add(attack, -lift_phase).sin();
    let (_, drag) = drag_slope.mul_add(attack, -drag_phase).sin_cos();
    let [lift, drag] = [lift_amplitude.mul_add(lift, lift_offset), drag_offset - drag_amplitude * drag];
    if !harmonics {
        return [lift, drag];
    }
    let (sin, cos) = (attack * 2.0).sin_cos();
    [lift + sin * c.harmonics.lift(cos), drag + c.harmonics.drag(cos)]
}

/// Returns the aerodynamic forces and moments without the added mass, at a state on the given `side` of the switching
/// surface.
///
/// ```text
/// α = π/2 + sφ, s = sign U; attack folded to B ≤ π/2; σ = sign tan φ
/// L_t = −σ C_l Σ q s     Q_θ = −C_d Σ r q s     Q_φ = −(C_d cos φ + σ C_l sin φ) Σ (d_cp − χ₀) c q s
/// d_cp = (0.82/π)(π/2 + sτ) + 0.05     q = ½ρ U² c Δr
/// ```
///
/// The values of |α| for the two directions of flow add up to π. The coefficients C_l and C_d and the angle B
/// are therefore equal for all strips. The function inserts the formula of d_cp into Q_φ, which leads to the
/// sums Σ c q s and Σ c q. The sum Σ c q is a quadratic form of the stroke rate and the pitch rate. If
/// `harmonics` is true, C_l, C_d and d_cp also contain the terms of `aero::Harmonics`. The terms of
/// `aero::Harmonics` in d_cp are proportional to s.
#[inline(always)]
pub(super) fn aerodynamics<R: Real>(
    c: &Constants<R>,
    harmonics: bool,
    side: R,
    y: &[R; 4],
    sin: R,
    cos: R,
) -> Aerodynamics<R> {
    let [_, phi, theta_dot, phi_dot] = *y;
    let air = &c.air;
    let Attitude { attack, tilt } = attitude(side, phi);
    let [c_l, c_d] = coefficients(air, harmonics, attack);
    let c_l = side * c_l;

    let sweep = phi_dot * cos;
    let directed = c.strips.sums(theta_dot, sweep);
    let [chord_tt, chord_tw, chord_ww] = air.chord;
    let undirected = (chord_tt * theta_dot + chord_tw * sweep) * theta_dot + chord_ww * sweep * sweep;
    let mut pressure = air.pressure_upright * directed.chord + air.pressure_slope * tilt * undirected;
    if harmonics {
        pressure = pressure + air.harmonics.pressure(tilt * 2.0 + PI) * undirected;
    }

    let rotation = -(phi_dot.abs() * phi_dot);
    Aerodynamics {
        lift: -(c_l * directed.force),
        drag: c_d * directed.force,
        stroke_moment: -(c_d * directed.radius),
        lift_moment: -(c_l * directed.radius),
        pitch_moment: -((c_d * cos + c_l * sin) * pressure),
        rotation: rotational_force(air, rotation),
    }
}

/// Returns the switching function sin 2φ and its time derivative. The side of the switching surface is σ, the
/// sign of the switching function, which equals the sign of tan φ. The lift coefficient C_l changes its sign
/// when σ changes.
///
/// At φ = 0 the chord is vertical, and C_l jumps between −C_l(90°) and C_l(90°). At φ = 0, the lift therefore
/// jumps. The equations of motion do not jump at φ = 0, because they contain C_l only multiplied by sin φ. At
/// |φ| = 90°, C_l jumps between −C_l(0) and C_l(0), and the equations of motion jump too.
#[inline(always)]
pub(super) fn side_of<R: Real>(phi: R, phi_dot: R) -> [R; 2] {
    let (sin, cos) = (phi * 2.0).sin_cos();
    [sin, phi_dot * 2.0 * cos]
}

/// Returns the aerodynamic force and moment on the wing at the state `y` with the derivative `dy`, on the
/// given `side` of the switching surface.
///
/// Rotational force and added mass act along the wing's normal, which is (cos φ e_t + sin φ e_z). The normal
/// acceleration of a strip is r A + κc φ̈, with A = θ̈ cos φ − θ̇φ̇ sin φ:
///
/// ```text
/// N = L_r/sin φ − Σ m_a (r A + κc φ̈)     L = L_t + N sin φ     D = D_t − N cos φ     m_a = π/4 ρ c²Δr
/// ```
///
/// The moments of lift and drag are the sums for lift and drag, but each term is also multiplied by r. The
/// span moment M_s is −Q_φ, because a positive φ moves the trailing edge in the direction in which the stroke
/// angle increases. In M_s, each term in the sums of the added mass is also multiplied by κc. Here κc is the
/// distance c/2 − z_RA of Eq. (7). In the equations of motion, the added mass acts at the centre of mass of
/// the wing, Eq. (19).
#[inline(always)]
pub(super) fn load<R: Real>(c: &Constants<R>, side: R, y: &[R; 4], dy: &[R; 4]) -> Load<R> {
    let (sin, cos) = y[1].sin_cos();
    let air = aerodynamics(c, false, side, y, sin, cos);
    let normal = dy[2] * cos - dy[0] * dy[1] * sin;
    load_in(c, &air, y, [normal, dy[3]], [sin, cos])
}

/// Computes the same load as [`load`], given the aerodynamic forces and moments, and the accelerations [A,
/// φ̈].
#[inline(always)]
pub(super) fn load_in<R: Real>(
    c: &Constants<R>,
    air: &Aerodynamics<R>,
    y: &[R; 4],
    [normal, phi_ddot]: [R; 2],
    [sin, cos]: [R; 2],
) -> Load<R> {
    let Air { added_stroke, added_pitch, added_stroke_2, added_pitch_1, added_span, .. } = c.air;
    let force = air.rotation.force - (added_stroke * normal + added_pitch * phi_ddot);
    let moment = air.rotation.chord_moment - (added_stroke_2 * normal + added_pitch_1 * phi_ddot);
    let added_pitch_moment = -(added_pitch_1 * normal + added_span * phi_ddot);
    Load {
        stroke: y[0],
        lift: air.lift + force * sin,
        drag: air.drag - force * cos,
        lift_moment: air.lift_moment + moment * sin,
        drag_moment: -air.stroke_moment - moment * cos,
        span_moment: -(air.pitch_moment - air.rotation.span_moment + added_pitch_moment),
    }
}

/// Returns the lift L_a of the added mass (N), Eq. (7) with corrected sign. The argument `dy` contains the
/// accelerations.
///
/// ```text
/// L_a = −(AM₁ (θ̈ cos φ − θ̇φ̇ sin φ) + AM₂ φ̈) sin φ
/// ```
#[inline(always)]
pub(super) fn added_mass_lift<R: Real>(air: &Air<R>, sin: R, cos: R, dy: &[R; 4]) -> R {
    let [theta_dot, phi_dot, theta_ddot, phi_ddot] = *dy;
    let normal = theta_ddot * cos - theta_dot * phi_dot * sin;
    -((air.added_stroke * normal + air.added_pitch * phi_ddot) * sin)
}
