//! Constants of the direct-drive model, which flap computes once for each design point.
//!
//! Equation numbers refer to Ozaki and Hamaguchi (2018). The module also computes products of constants, so
//! that the equations of motion need fewer multiplications.

use core::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use super::chord::{BLADES, blades, elements};
use super::params::{self, CentreOfPressure, FlowDirection, LiftSign, Params};
use crate::aero::{AddedMass, Circulation, Harmonics, RotationalForce, Strips, sum};
use crate::body::{BodyMotion, BodyTerms};
use crate::drive::DriveConstants;
use crate::model::stroke_and_pitch::inertias_apart;
use crate::parameter::Invalid;
use crate::piezo::{Laminate, Layer};
use crate::springs::{Stiffening, structural_damping};

crate::per_lane! {
    /// Constants of one design point, in SI units.
    pub struct Constants<R> {
        /// Constants of the drive, which is a voltage or a prescribed stroke.
        pub drive: DriveConstants<R>,

        /// Rotational stiffness k_φ of the actuator about the stroke axis (N·m/rad), Eq. (11).
        pub k_phi: R,
        /// Hinge stiffness k_w (N·m/rad).
        pub k_w: R,
        /// Viscous damping of the stroke, including the damping that is equivalent to the loss factor of the
        /// actuator (N·m·s).
        pub stroke_damping: R,
        /// Viscous damping of the hinge, including the damping that is equivalent to the hinge's loss factor
        /// (N·m·s).
        pub hinge_damping: R,
        /// Strain of the hinge's flexure per pitch angle (1/rad), or zero if the dimensions of the hinge are
        /// not set.
        pub hinge_strain: R,
        /// Coupling Γ of the actuator: torque per voltage, and charge per stroke angle (N·m/V = C/rad),
        /// Eqs. (11) and (38).
        pub gamma: R,
        /// Capacitance C_p of the actuator (F), Eq. (37).
        pub c_p: R,
        /// Conductance that represents the dielectric loss of the actuator (S).
        pub conductance: R,
        /// Power that the power supply recovers, divided by the power that the actuator returns: from 0 to 1.
        pub charge_recovery: R,

        /// Moment of inertia m₁₁ of actuator, leading edge and wing about the stroke axis (kg·m²).
        pub m11: R,
        /// Moment of inertia m_s of the wing about the span axis (kg·m²). If the pitch is not zero, m_s
        /// increases the inertia of the stroke.
        pub m_s: R,
        /// Inertial coupling m₁₂ of stroke and pitch (kg·m²).
        pub m12: R,
        /// Pitch inertia m₂₂ (kg·m²).
        pub m22: R,

        /// Added mass of Eqs. (28)–(30), without the added inertia of a rotation about the mid-chord.
        pub added: AddedMass<R>,
        /// Rotational circulation of the blade elements.
        pub circulation: Circulation<R>,
        /// Force of the rotational drag along the wing's normal.
        pub rotational_force: RotationalForce<R>,
        /// Factor that multiplies the gyroscopic terms of the added mass: 1 if `added_mass` is "lagrangian",
        /// and 0 if `added_mass` is "paper".
        pub gyroscopic: R,

        /// Factor of the stroke rate in the mean velocity of the wing: R/2 + x_r (m).
        pub mid_radius: R,
        /// Factor of the pitch rate in the mean velocity of the wing: half of the midspan chord, c(R/2)/2 (m).
        pub mid_half_chord: R,

        /// Amplitude K_L of the lift coefficient, Eq. (26).
        pub k_lift: R,
        /// Mean of the largest and the smallest drag coefficient, Eq. (26).
        pub drag_mean: R,
        /// Half of the difference between the largest and the smallest drag coefficient, Eq. (26).
        pub drag_swing: R,

        /// Terms that flap adds to the paper's formulas of the force coefficients and the centre of pressure.
        pub harmonics: Harmonics<R>,

        /// Factors of φ̇², φ̇ψ̇cosψ and (ψ̇cosψ)² in the lift (kg), Eq. (21): ½ρA_w [R² I₂₁, −R c̄ I₁₂, c̄² I₀₃/4].
        pub lift: [R; 3],
        /// Factors of φ̇², φ̇ψ̇cosψ and (ψ̇cosψ)² in the stroke moment of the drag (kg·m), Eq. (25): ½ρA_w R [R² I₃₁,
        /// −R c̄ I₂₂, c̄² I₁₃/4].
        pub stroke: [R; 3],
        /// Factors of φ̇², φ̇ψ̇cosψ and (ψ̇cosψ)² in the pitch moment (kg·m), Eq. (23): ½ρA_w c̄ [R² I₂₂, −R c̄ I₁₃,
        /// c̄² I₀₄/4].
        pub pitch: [R; 3],
        /// Magnitude of the moment of the rotational drag, divided by ψ̇² (kg·m²), Eq. (32): ½ρC_rd R I_rd.
        pub rotation: R,
        /// Blade elements of the wing. If `flow_direction` is not "blade", the list is empty.
        pub blades: Strips<R, BLADES>,

        /// Shift of the centre of pressure per radian of attack angle, in chords, Eq. (24).
        pub pressure_slope: R,
        /// Centre of pressure at an attack angle of zero, in chords, Eq. (24).
        pub pressure_offset: R,
        /// Factors that select one of three definitions of the attack angle: π/2 − σψ (relative to the
        /// motion), π/2 − |ψ|, and π/2 − ψ. The factor of the selected definition of the attack angle is 1,
        /// and the two other factors are 0.
        pub attack: [R; 3],

        /// Sign of the added mass in the lift. If the sign is +1, F_am sin ψ is subtracted from the lift. If
        /// the sign is −1, F_am sin ψ is added, as printed in Eq. (35).
        pub lift_sign: R,

        /// Thickness t₀ of the piezoelectric layer (m).
        pub piezo_thickness: R,
        /// Strain of the piezoelectric layer's outer face per radian of stroke (1/rad): z_c / L_A.
        pub strain_per_stroke: R,
        /// Nonlinear terms of the springs of stroke and hinge.
        pub stiffening: Stiffening<R>,
        /// Motion of the body.
        pub moving: BodyMotion<R>,
    }
}

/// Returns the layers of the actuator as a laminate.
fn laminate(p: &Params) -> Laminate<3> {
    let layer = |[thickness, modulus, density]: [f64; 3]| Layer { thickness, modulus, density };
    Laminate::of([
        layer([p.piezo_thickness, p.piezo_modulus, p.piezo_density]),
        layer([p.adhesive_thickness, p.adhesive_modulus, p.adhesive_density]),
        layer([p.shim_thickness, p.shim_modulus, p.shim_density]),
    ])
}

/// # Errors
/// Returns an error if all chords of the table are zero, or if `lift_sign` is "printed" and `circulation_factor` or
/// `rotation_force_factor` is not zero.
fn check(p: &Params) -> Result<(), Invalid> {
    p.chords.check()?;
    if p.lift_sign == LiftSign::Printed && (p.circulation_factor != 0.0 || p.rotation_force_factor != 0.0) {
        return Err(Invalid::new(
            "lift_sign = \"printed\" has no meaning with circulation_factor or rotation_force_factor: set it to \
             \"corrected\"",
        ));
    }
    Ok(())
}

impl Constants<f64> {
    /// Returns the constants of a design point for a body at rest.
    ///
    /// # Errors
    /// Returns an error if the chord is negative somewhere, the mass matrix is not positive definite at some
    /// pitch, or a constant is not finite. Returns an error if `lift_sign` is "printed" and
    /// `circulation_factor` or `rotation_force_factor` is not zero.
    pub fn derive(p: &Params) -> Result<Constants<f64>, Invalid> {
        check(p)?;
        let p = &if p.chords.is_on() || p.flow_direction == FlowDirection::Blade {
            p.clone().with_chord_moments()
        } else {
            p.clone()
        };
        let laminate = laminate(p);
        let l_a = p.actuator_length;
        let z_c = laminate.neutral_axis;
        let z_0 = laminate.mid_planes[0];
        let s_a = laminate.bending_stiffness;
        let mu = laminate.areal_density;
        let widths = p.actuator_root_width + p.actuator_tip_width;
        let j_a = mu * (p.actuator_root_width + 5.0 * p.actuator_tip_width) * (l_a * l_a * l_a) / 120.0;

        let r = p.wing_length;
        let c = p.mean_chord;
        let area = c * r;
        let x_r = p.root_radius();
        let x_g = p.mass_centre_span + x_r;
        let y_g = p.mass_centre_chord;
        let m_s = p.wing_inertia_span + p.wing_mass * y_g * y_g;

        let rho = p.air_density;
        let dynamic = 0.5 * rho * area;
        let aspect = 0.5 * r / c;
        let k_lift = FRAC_PI_2 * (r / c) / (1.0 + (aspect * aspect + 1.0).sqrt());

        // The shape moments determine all integrals of the chord but ∫ c² dr.
        let chords = |n: i32, m: i32| match (n, m) {
            (2, 1) => (c * c) * (r * r) * p.shape_moment_12,
            (2, 2) => (c * c) * (r * r * r) * p.shape_moment_22,
            (3, 0) => (c * c * c) * r * p.shape_moment_03,
            (3, 1) => (c * c * c) * (r * r) * p.shape_moment_13,
            (n, m) => sum(&elements(p), |r, c| c.powi(n) * r.powi(m)),
        };

        let drive = p.drive();
        let k_phi = 0.5 * s_a * widths / l_a;
        let c_p = p.piezo_permittivity * widths * l_a / (2.0 * p.piezo_thickness);
        let constants = Constants {
            drive,

            k_phi,
            k_w: p.hinge_stiffness,
            stroke_damping: p.stroke_damping + structural_damping(p.stroke_loss_factor, k_phi, drive.rate),
            hinge_damping: p.hinge_damping + p.hinge.damping(p.hinge_stiffness, drive.rate),
            hinge_strain: p.hinge.strain_per_angle(),
            gamma: 0.5 * p.piezo_modulus * p.piezo_coefficient * (z_0 - z_c) * widths,
            c_p,
            conductance: p.electrical.conductance(c_p, drive.rate),
            charge_recovery: p.electrical.charge_recovery,

            m11: j_a + p.leading_edge_inertia + p.wing_mass * x_g * x_g + p.wing_inertia_chord,
            m_s,
            m12: p.wing_mass * x_g * y_g + p.wing_inertia_product,
            m22: m_s,

            added: AddedMass {
                // Set on a moving body.
                f0: 0.0,
                f1: FRAC_PI_4 * rho * (c * c) * (r * r) * p.shape_moment_12,
                f2: 0.5 * FRAC_PI_4 * rho * (c * c * c) * r * p.shape_moment_03,
                a11: FRAC_PI_4 * rho * (c * c) * (r * r * r) * p.shape_moment_22,
                a12: 0.5 * FRAC_PI_4 * rho * (c * c * c) * (r * r) * p.shape_moment_13,
                a22: 0.25 * FRAC_PI_4 * rho * (c * c * c * c) * r * p.shape_moment_04,
            },
            circulation: Circulation::of(p.circulation_factor, rho, 0.0, &chords),
            rotational_force: RotationalForce::of(
                p.rotation_force_factor * p.rotation_drag,
                rho,
                0.0,
                &chords,
            ),
            gyroscopic: f64::from(p.added_mass == params::AddedMass::Lagrangian),

            mid_radius: 0.5 * r + x_r,
            mid_half_chord: 0.5 * p.midspan_chord.unwrap_or(c),

            k_lift: p.lift_coefficient_max.unwrap_or(k_lift),
            drag_mean: 0.5 * (p.drag_coefficient_max + p.drag_coefficient_min),
            drag_swing: 0.5 * (p.drag_coefficient_max - p.drag_coefficient_min),
            harmonics: Harmonics::of(&p.harmonics),

            lift: [
                dynamic * r * r * p.shape_moment_21,
                -dynamic * r * c * p.shape_moment_12,
                dynamic * c * c * p.shape_moment_03 * 0.25,
            ],
            stroke: [
                dynamic * r * r * r * p.shape_moment_31,
                -dynamic * r * r * c * p.shape_moment_22,
                dynamic * r * c * c * p.shape_moment_13 * 0.25,
            ],
            pitch: [
                dynamic * c * r * r * p.shape_moment_22,
                -dynamic * c * r * c * p.shape_moment_13,
                dynamic * c * c * c * p.shape_moment_04 * 0.25,
            ],
            rotation: 0.5 * rho * p.rotation_drag * r * p.rotation_moment,
            blades: blades(p)?,

            pressure_slope: p.pressure_slope,
            pressure_offset: p.pressure_offset,
            attack: [CentreOfPressure::Directional, CentreOfPressure::Folded, CentreOfPressure::Literal]
                .map(|reading| f64::from(p.centre_of_pressure == reading)),

            lift_sign: if p.lift_sign == LiftSign::Corrected { 1.0 } else { -1.0 },

            piezo_thickness: p.piezo_thickness,
            strain_per_stroke: z_c / l_a,
            stiffening: Stiffening::of(p.stroke_stiffening, &p.hinge),
            moving: BodyMotion::REST,
        };
        Invalid::unless_finite(constants)?.checked()
    }

    /// Returns a copy of the constants that also contains the motion of the body. If `terms` is
    /// `BodyTerms::None`, the body remains at rest.
    ///
    /// # Errors
    /// A moving body causes an error if `flow_direction` is "uniform", `centre_of_pressure` is "literal" or
    /// `added_mass` is "lagrangian".
    pub(super) fn with_motion(&self, p: &Params, terms: BodyTerms) -> Result<Constants<f64>, Invalid> {
        if terms == BodyTerms::None {
            return Ok(*self);
        }
        if p.flow_direction == FlowDirection::Uniform {
            return Err(Invalid::new(
                "flow_direction = \"uniform\" has no meaning on a moving body: set it to \"blade\"",
            ));
        }
        if p.centre_of_pressure == CentreOfPressure::Literal {
            return Err(Invalid::new(
                "centre_of_pressure = \"literal\" has no meaning on a moving body: set it to \"folded\" or \"directional\"",
            ));
        }
        if p.added_mass == params::AddedMass::Lagrangian {
            return Err(Invalid::new(
                "added_mass = \"lagrangian\" has no equations for a moving body: set it to \"paper\"",
            ));
        }
        let f0 = FRAC_PI_4 * p.air_density * sum(&elements(p), |_, c| c * c);
        let added = AddedMass { f0, ..self.added };
        Invalid::unless_finite(Constants { moving: p.body.motion(), added, ..*self })
    }

    fn checked(self) -> Result<Constants<f64>, Invalid> {
        // The determinant is linear in cos²ψ: it is positive everywhere if it is positive at both ends.
        let pitch = self.m22 + self.added.a22;
        let coupling = self.m12 - self.added.a12;
        let upright = (self.m11 + self.added.a11) * pitch - coupling * coupling;
        let flat = (self.m11 + self.m_s) * pitch;
        if upright > 0.0 && flat > 0.0 {
            Ok(self)
        } else {
            Err(inertias_apart(&[
                "mass_centre_chord",
                "wing_inertia_product",
                "wing_inertia_span",
                "wing_mass",
            ]))
        }
    }
}
