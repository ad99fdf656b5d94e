//! The equations of the direct-drive model with the terms that the paper leaves out.
//!
//! The additional terms are motion of the body, higher harmonics of the attack angle, rotational circulation,
//! rotational drag along the wing's normal, and nonlinear springs. If all additional terms are zero,
//! [`super::rhs`] computes the same derivatives as this module, apart from rounding errors.
//!
//! Body motion requires blade elements, because on a moving body each blade element has its own direction of
//! flow. The aerodynamic functions of this module are not inlined into the code for the equations of the
//! paper. If the terms that the paper leaves out are all zero, the module needs no computing time.

use super::constants::Constants;
use super::rhs::{Aerodynamics, added_mass, aerodynamics, balance_in};
use super::variant::DirectDrive;
use crate::aero::{NormalLoad, oblique_forces};
use crate::body::{BodyTerms, Shoulder};
use crate::model::stroke_and_pitch::Balance;
use crate::num::Real;

/// Aerodynamic forces on a wing, and the inertial moment due to the rotation of the body.
#[derive(Clone, Copy, Debug)]
pub(super) struct Air<R> {
    /// Translational and rotational aerodynamic forces.
    pub(super) forces: Aerodynamics<R>,
    /// Force along the wing's normal, and the moments of this force. The force is the sum of the circulation
    /// force, the rotational drag, and the part of the added-mass force that body motion causes.
    pub(super) normal: NormalLoad<R>,
    /// Inertial moment g per stroke rate or pitch rate (N·m·s), see [`Shoulder::gyroscopic`].
    gyroscopic: R,
}

impl<R: Real> Air<R> {
    /// Returns the power that the wing loses to the translational aerodynamic forces and to the load `normal`
    /// (W).
    #[inline(always)]
    pub(super) fn translational_power(&self, [phi_dot, psi_dot]: [R; 2], cos: R) -> R {
        let Air { forces, normal, .. } = self;
        -((forces.stroke_moment + normal.chord_moment * cos) * phi_dot
            + (forces.pitch_moment + normal.span_moment) * psi_dot)
    }

    /// Returns the sum of the load `normal` and the load of the added mass. The argument `dy` contains the
    /// accelerations of the wing.
    #[inline(always)]
    pub(super) fn with_added_mass(&self, c: &Constants<R>, [sin, cos]: [R; 2], dy: &[R; 4]) -> NormalLoad<R> {
        added_mass(c, sin, cos, dy).plus(&self.normal)
    }
}

/// Returns the aerodynamic forces on the wing at the state `y`. On a moving body, the function evaluates
/// Eqs. (19) to (26) for each blade element, with the direction of the flow past the element. The rotational
/// drag is computed from Eq. (32).
#[inline(always)]
pub(super) fn air<R: Real>(
    c: &Constants<R>,
    model: &DirectDrive,
    body_moves: bool,
    side: R,
    y: &[R; 4],
    pitch: [R; 2],
) -> Air<R> {
    side.outlined(
        #[inline(always)]
        || air_inlined(c, model, body_moves, side, y, pitch),
    )
}

#[inline(always)]
fn air_inlined<R: Real>(
    c: &Constants<R>,
    model: &DirectDrive,
    body_moves: bool,
    side: R,
    y: &[R; 4],
    pitch: [R; 2],
) -> Air<R> {
    let [phi, _, phi_dot, psi_dot] = *y;
    let shoulder = if body_moves { c.moving.along(phi) } else { Shoulder::rest(phi) };
    let sections = shoulder.sections(phi_dot, psi_dot, pitch[1]);
    let rate = shoulder.pitch_rate(psi_dot);
    let normal = c.circulation.load(&sections, rate, pitch).plus(&c.rotational_force.load(rate));
    if !body_moves {
        let forces = aerodynamics(c, true, model.flow, side, y, pitch[0], pitch[1]);
        return Air { forces, normal, gyroscopic: phi.lit(0.0) };
    }
    let [directional, _, _] = c.attack;
    let half = directional.lit(0.5);
    let forces = oblique_forces(
        c.blades.oblique(half),
        &sections,
        pitch,
        #[inline(always)]
        |_, flow| {
            let attack = R::select(half.lt(directional), flow.attack(), flow.folded_attack());
            let law = [c.drag_mean, c.drag_swing, c.k_lift];
            let place = c.pressure_slope * attack + c.pressure_offset + c.harmonics.pressure(attack * 2.0);
            (flow.harmonic_forces(law, &c.harmonics), place)
        },
    );
    let [lift, drag] = forces.lift_and_drag(pitch);
    let [lift_moment, drag_moment] = forces.moments(pitch);
    Air {
        forces: Aerodynamics {
            lift,
            drag,
            stroke_moment: -drag_moment,
            lift_moment,
            pitch_moment: forces.pitch_moment,
            rotation_moment: -(c.rotation * rate * rate.abs()),
        },
        normal: c.added.load(shoulder.accelerations([phi_dot, psi_dot], pitch)).plus(&normal),
        gyroscopic: shoulder.gyroscopic(c.m_s, -c.m12, pitch),
    }
}

/// Returns the mass matrix and the generalised forces of the equations of motion. To the forces of
/// [`balance_in`], the function adds the aerodynamic load along the wing's normal and the nonlinear moments
/// of the springs. The function also adds the inertial moments g ψ̇ about the stroke axis and −g φ̇ about the
/// pitch axis.
#[inline(always)]
pub(super) fn balance<R: Real>(c: &Constants<R>, model: &DirectDrive, side: R, y: &[R; 4]) -> Balance<R> {
    let [phi, psi, phi_dot, psi_dot] = *y;
    let (sin, cos) = psi.sin_cos();
    let body_moves = model.terms.body == BodyTerms::All;
    let Air { forces, normal, gyroscopic } = air(c, model, body_moves, side, y, [sin, cos]);
    let Balance { mass, stroke_moment, pitch_moment } = balance_in(c, &forces, y, [sin, cos]);
    Balance {
        mass,
        stroke_moment: stroke_moment + normal.chord_moment * cos + gyroscopic * psi_dot
            - c.stiffening.stroke_moment(phi),
        pitch_moment: pitch_moment + normal.span_moment
            - gyroscopic * phi_dot
            - c.stiffening.hinge_moment(psi),
    }
}
