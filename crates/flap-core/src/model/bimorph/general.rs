//! The equations of the bimorph model with the terms that the paper leaves out.
//!
//! The additional terms are motion of the body, higher harmonics of the attack angle, forces along the wing's
//! normal, and nonlinear springs. If all additional terms are zero, [`super::rhs`] computes the same
//! derivatives as this module, apart from rounding errors.
//!
//! In the paper, the aerodynamic forces depend only on integrals over the whole wing. On a moving body, the
//! direction of the flow varies along the span. If the body moves, the model therefore divides the wing into
//! four strips ([`super::strips`]).
//!
//! The functions of this module are not inlined into the code for the equations of the paper. If the terms
//! that the paper leaves out are all zero, the module needs no computing time.

use core::f64::consts::FRAC_2_PI;

use super::constants::Constants;
use super::params::CentreOfPressure;
use super::rhs::{self, Plate, elastic_force, plate_forces, stroke_damping};
use super::strips::Moving;
use super::transmission::{Transmission, stroke};
use super::variant::Bimorph;
use crate::aero::oblique_forces;
use crate::body::{BodyTerms, Shoulder};
use crate::model::{Instant, Load};
use crate::num::Real;

/// Motion of the wing at one state of the model.
struct Motion<R> {
    transmission: Transmission<R>,
    /// φ and φ̇.
    stroke: [R; 2],
    /// Stroke rate divided by the transmission ratio: φ̇/T, which the paper writes as ẋ.
    rate: R,
    /// ψ and ψ̇.
    pitch: [R; 2],
    /// Sine and cosine of ψ.
    turned: [R; 2],
    /// Motion of the shoulder.
    shoulder: Shoulder<R>,
}

impl<R: Real> Motion<R> {
    #[inline(always)]
    fn at(c: &Constants<R>, model: &Bimorph, body_moves: bool, y: &[R; 4]) -> Motion<R> {
        let [x, x_dot, psi, psi_dot] = *y;
        let transmission = Transmission::at(c, model.law, x);
        let rate = transmission.times(x_dot);
        let phi = stroke(c, model.law, x);
        let (sin, cos) = psi.sin_cos();
        let shoulder = if body_moves { c.moving.motion.along(phi) } else { Shoulder::rest(x) };
        Motion {
            transmission,
            stroke: [phi, c.ratio * rate],
            rate,
            pitch: [psi, psi_dot],
            turned: [sin, cos],
            shoulder,
        }
    }
}

/// Aerodynamic force and moment on a wing.
#[derive(Clone, Copy, Debug)]
pub(super) struct Air<R> {
    /// Load of the air.
    pub(super) load: Load<R>,
    /// Moment of the rotational drag about the span axis (N·m), Eq. (9).
    pub(super) rotation_moment: R,
}

/// Returns the aerodynamic force and moment on the wing, without the contribution of the added mass.
#[inline(always)]
fn air<R: Real>(c: &Constants<R>, model: &Bimorph, body_moves: bool, motion: &Motion<R>, x_dot: R) -> Air<R> {
    let Motion { stroke: [phi, phi_dot], rate, pitch, turned, shoulder, .. } = motion;
    let pitch_rate = shoulder.pitch_rate(pitch[1]);
    let rotation_moment = -(c.c_c * pitch_rate.abs() * pitch_rate);
    let sections = shoulder.sections(*phi_dot, pitch[1], turned[1]);
    let load = if body_moves {
        let Moving { strips, .. } = &c.moving;
        let forces = oblique_forces(
            strips.iter().copied(),
            &sections,
            *turned,
            #[inline(always)]
            |_, flow| {
                let attack = match model.centre_of_pressure {
                    CentreOfPressure::Directional => flow.attack(),
                    CentreOfPressure::Folded | CentreOfPressure::Literal => flow.folded_attack(),
                };
                let pressure =
                    c.p_min + c.p_swing * (attack * FRAC_2_PI) + c.harmonics.pressure(attack * 2.0);
                (flow.harmonic_forces([c.b_1, c.b_2, c.b_l], &c.harmonics), pressure)
            },
        );
        let [lift, drag] = forces.lift_and_drag(*turned);
        let [lift_moment, drag_moment] = forces.moments(*turned);
        let span_moment = forces.pitch_moment + rotation_moment;
        Load { stroke: *phi, lift, drag, lift_moment, drag_moment, span_moment }
    } else {
        rhs::load(c, true, model.centre_of_pressure, *phi, x_dot, *rate, *pitch)
    };
    let load = if model.terms.air {
        let circulation = c.circulation.load(&sections, pitch_rate, *turned);
        load.with_normal(&circulation.plus(&c.rotation.load(pitch_rate)), *turned)
    } else {
        load
    };
    Air { load, rotation_moment }
}

/// Returns the aerodynamic force and moment on the wing at one instant, including the contribution of the
/// added mass.
#[inline(always)]
pub(super) fn air_at<R: Real>(
    c: &Constants<R>,
    model: &Bimorph,
    body_moves: bool,
    at: Instant<'_, R, [Plate<R>; 2], 4>,
) -> Air<R> {
    at.side.outlined(
        #[inline(always)]
        || air_with_added_mass(c, model, body_moves, at),
    )
}

#[inline(always)]
fn air_with_added_mass<R: Real>(
    c: &Constants<R>,
    model: &Bimorph,
    body_moves: bool,
    Instant { input: plates, y, dy, .. }: Instant<'_, R, [Plate<R>; 2], 4>,
) -> Air<R> {
    let motion = Motion::at(c, model, body_moves, y);
    let found = air(c, model, body_moves, &motion, y[1]);
    if !model.terms.air {
        return found;
    }
    // Between the stages of a step the derivative is unknown.
    let computed = derivative(c, model, plates, y);
    let known = dy[1].abs().lt(y[0].lit(f64::INFINITY));
    let [x_ddot, psi_ddot] = [1, 3].map(|i: usize| R::select(known, dy[i], computed[i]));
    let phi_ddot = c.ratio * motion.transmission.stroke_acceleration(x_ddot, y[1]);
    let [e_0, e_1, e_2] = accelerations(&motion);
    let added = c.added.load([e_0, phi_ddot * motion.turned[1] + e_1, psi_ddot + e_2]);
    Air { load: found.load.with_normal(&added, motion.turned), ..found }
}

/// Returns the parts of the normal acceleration of the wing's sections that do not depend on φ̈ and ψ̈ (see
/// [`Shoulder::accelerations`]).
#[inline(always)]
fn accelerations<R: Real>(motion: &Motion<R>) -> [R; 3] {
    let (rates, turned) = ([motion.stroke[1], motion.pitch[1]], motion.turned);
    let [e_0, e_1, e_2] = motion.shoulder.accelerations(rates, turned);
    [e_0, e_1 - rates[0] * rates[1] * turned[0], e_2]
}

/// Returns the time derivative of the state, from Eqs. (1) and (2). M_D and M_s are the aerodynamic moments
/// about the stroke axis and the span axis.
///
/// In the equations, N is the load of the added mass. The dots in the equations stand for the stop and the
/// damping of the hinge. The equations do not show the damping of the stroke. The rotation of the body adds
/// the inertial moment −g φ̇ about the hinge, see [`Shoulder::gyroscopic`].
///
/// ```text
/// m_e ẍ + (K_act(x) + K_t) x + T (M_D − N_c cos ψ + k₃ φ³) = F₁ − F₂
/// I_xx ψ̈ + κ_wh ψ + κ₃ ψ³ + … = M_s + N_s + I_xz T ẍ cos ψ + ½ I_xx (Tẋ)² sin 2ψ − g φ̇
/// ```
///
/// Eq. (1) contains neither the moment that the hinge exerts on the stroke nor an inertial moment due to body
/// rotation. Because N depends on φ̈ and ψ̈, the function solves both equations of motion as one linear
/// system.
#[inline(always)]
pub(super) fn derivative<R: Real>(
    c: &Constants<R>,
    model: &Bimorph,
    plates: &[Plate<R>; 2],
    y: &[R; 4],
) -> [R; 4] {
    y[0].outlined(
        #[inline(always)]
        || coupled_derivative(c, model, plates, y),
    )
}

#[inline(always)]
fn coupled_derivative<R: Real>(
    c: &Constants<R>,
    model: &Bimorph,
    plates: &[Plate<R>; 2],
    y: &[R; 4],
) -> [R; 4] {
    let [x, x_dot, psi, psi_dot] = *y;
    let body_moves = model.terms.body == BodyTerms::All;
    let motion = Motion::at(c, model, body_moves, y);
    let Motion { transmission, stroke: [phi, phi_dot], rate, turned: [sin, cos], shoulder, .. } = &motion;
    let Air { load, .. } = air(c, model, body_moves, &motion, x_dot);

    let [f_1, f_2] = plate_forces(c, plates, x);
    let restoring = elastic_force(c, x) + c.k_t * x;
    let stroke_moment = load.drag_moment + c.stiffening.stroke_moment(*phi);
    let force = f_1
        - f_2
        - restoring
        - transmission.times(c.ratio * stroke_moment)
        - stroke_damping(c, transmission, x_dot, *rate);
    let moment = load.span_moment + c.centrifugal * *rate * *rate * (*sin * *cos * 2.0)
        - c.kappa_wh * psi
        - c.stiffening.hinge_moment(psi)
        - c.hinge_damping * psi_dot
        - shoulder.gyroscopic(c.i_xx, c.i_xz, [*sin, *cos]) * *phi_dot;

    // φ̈ = T t ẍ + s, with s = T t′ ẋ².
    let lever = transmission.times(c.ratio);
    let curved = transmission.stroke_acceleration(x.lit(0.0), x_dot);
    let s = c.ratio * curved;
    let [e_0, e_1, e_2] = accelerations(&motion);
    let known = c.added.load([e_0, s * *cos + e_1, e_2]);
    let inertia = transmission.times(transmission.times(c.stroke_mass));
    let stroke_mass = inertia + c.tip_mass + lever * lever * c.added.a11 * *cos * *cos;
    let coupling = lever * *cos;
    let force = force - transmission.times(c.stroke_mass) * curved + coupling * known.chord_moment;
    let moment = moment + known.span_moment + c.i_xz * s * *cos;
    // ⎡stroke_mass   −a₁₂ coupling⎤ ⎡ẍ⎤ = ⎡force ⎤
    // ⎣−k coupling    I_xx + a₂₂  ⎦ ⎣ψ̈⎦   ⎣moment⎦     k = I_xz + a₁₂
    let (above, below) = (c.added.a12 * coupling, (c.i_xz + c.added.a12) * coupling);
    let pitch_inertia = c.i_xx + c.added.a22;
    let determinant = stroke_mass * pitch_inertia - above * below;
    let x_ddot = (force * pitch_inertia + above * moment) / determinant;
    let psi_ddot = (moment * stroke_mass + below * force) / determinant;
    [x_dot, x_ddot, psi_dot, psi_ddot]
}
