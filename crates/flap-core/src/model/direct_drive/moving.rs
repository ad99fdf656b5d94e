//! The wing of the direct-drive model on a moving body.
//!
//! Body motion requires the blade elements, each of which has its own direction of flow. At zero body motion, [`super::rhs`]
//! has the same forces, to rounding.

use super::constants::Constants;
use super::rhs::{AddedMassLoad, Aerodynamics, added_mass, balance_in};
use crate::aero::oblique_forces;
use crate::body::Shoulder;
use crate::model::stroke_and_pitch::Balance;
use crate::num::Real;

/// Forces of the air on a wing, and what the body's motion adds.
#[derive(Clone, Copy, Debug)]
pub(super) struct Air<R> {
    /// Translational and rotational aerodynamics.
    pub(super) forces: Aerodynamics<R>,
    /// Load of the added mass due to the motion of the body.
    pub(super) added: AddedMassLoad<R>,
    /// Inertial moment per rate g (N·m·s), see [`Shoulder::gyroscopic`].
    gyroscopic: R,
}

impl<R: Real> Air<R> {
    /// Returns the power lost to translational forces (W), with the power of the added mass due to the body's motion, whose
    /// mean is not zero.
    #[inline(always)]
    pub(super) fn translational_power(&self, [phi_dot, psi_dot]: [R; 2], cos: R) -> R {
        let Air { forces, added, .. } = self;
        -((forces.stroke_moment + added.chord_moment * cos) * phi_dot
            + (forces.pitch_moment + added.span_moment) * psi_dot)
    }

    /// Returns the load of the whole added mass at known accelerations.
    #[inline(always)]
    pub(super) fn whole_added_mass(
        &self,
        c: &Constants<R>,
        [sin, cos]: [R; 2],
        dy: &[R; 4],
    ) -> AddedMassLoad<R> {
        let at_rest = added_mass(c, sin, cos, dy);
        AddedMassLoad {
            force: at_rest.force + self.added.force,
            chord_moment: at_rest.chord_moment + self.added.chord_moment,
            span_moment: at_rest.span_moment + self.added.span_moment,
        }
    }
}

/// Returns the forces at a state, with the terms (21) to (27) of each blade element in oblique flow, and (32).
#[inline(always)]
pub(super) fn air<R: Real>(c: &Constants<R>, y: &[R; 4], pitch: [R; 2]) -> Air<R> {
    let [phi, _, phi_dot, psi_dot] = *y;
    let shoulder = c.moving.motion.along(phi);
    let [directional, _, _] = c.attack;
    let half = directional.lit(0.5);
    let forces = oblique_forces(
        c.blades.oblique(half),
        &shoulder.sections(phi_dot, psi_dot, pitch[1]),
        pitch,
        #[inline(always)]
        |_, flow| {
            let attack = R::select(half.lt(directional), flow.attack(), flow.folded_attack());
            let law = [c.drag_mean, c.drag_swing, c.k_lift];
            (flow.harmonic_forces(law), c.pressure_slope * attack + c.pressure_offset)
        },
    );
    let [lift, drag] = forces.lift_and_drag(pitch);
    let [lift_moment, drag_moment] = forces.moments(pitch);
    let rate = shoulder.pitch_rate(psi_dot);
    Air {
        forces: Aerodynamics {
            lift,
            drag,
            stroke_moment: -drag_moment,
            lift_moment,
            pitch_moment: forces.pitch_moment,
            rotation_moment: -(c.rotation * rate * rate.abs()),
        },
        added: added_by_motion(c, &shoulder, [phi_dot, psi_dot], pitch),
        gyroscopic: shoulder.gyroscopic(c.m_s, -c.m12, pitch),
    }
}

/// Returns the load of the added mass due to the motion of the body: (28) to (30) with the normal acceleration that
/// [`Shoulder::accelerations`] adds.
///
/// ```text
/// ΔF_am = −(f₁ e₁ + f₀ e₀ − f₂ e₂)     ΔM_am,y″ = −(a₁₁ e₁ + f₁ e₀ − a₁₂ e₂)     ΔM_am,x′ = a₁₂ e₁ + f₂ e₀ − a₂₂ e₂
/// ```
#[inline(always)]
fn added_by_motion<R: Real>(
    c: &Constants<R>,
    shoulder: &Shoulder<R>,
    rates: [R; 2],
    pitch: [R; 2],
) -> AddedMassLoad<R> {
    let [e_0, e_1, e_2] = shoulder.accelerations(rates, pitch);
    AddedMassLoad {
        force: c.f2 * e_2 - c.f1 * e_1 - c.moving.f0 * e_0,
        chord_moment: c.a12 * e_2 - c.a11 * e_1 - c.f1 * e_0,
        span_moment: c.a12 * e_1 + c.f2 * e_0 - c.a22 * e_2,
    }
}

/// Returns mass matrix and generalised forces on a moving body. The load of the added mass and the inertial moments −g φ̇ and
/// g ψ̇ are added to the moments of [`balance_in`].
#[inline(always)]
pub(super) fn balance<R: Real>(c: &Constants<R>, y: &[R; 4]) -> Balance<R> {
    let [_, psi, phi_dot, psi_dot] = *y;
    let (sin, cos) = psi.sin_cos();
    let Air { forces, added, gyroscopic } = air(c, y, [sin, cos]);
    let Balance { mass, stroke_moment, pitch_moment } = balance_in(c, &forces, y, [sin, cos]);
    Balance {
        mass,
        stroke_moment: stroke_moment + added.chord_moment * cos + gyroscopic * psi_dot,
        pitch_moment: pitch_moment + added.span_moment - gyroscopic * phi_dot,
    }
}
