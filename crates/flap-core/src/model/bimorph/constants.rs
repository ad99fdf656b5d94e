//! Constants of the bimorph model, which flap computes once for each design point.
//!
//! Equation numbers refer to Jafferis, Graule and Wood (2016), with the corrections listed in
//! `docs/models/bimorph.md`. The module also computes products of constants, so that the equations of motion
//! need fewer multiplications.

use super::actuator::Actuator;
use super::params::{ActuatorStiffness, FieldTransition, Params};
use super::strips::{Moving, unsteady};
use crate::aero::{AddedMass, Circulation, Harmonics, RotationalForce};
use crate::drive::DriveConstants;
use crate::model::stroke_and_pitch::inertias_apart;
use crate::parameter::Invalid;
use crate::springs::{Stiffening, structural_damping};

crate::per_lane! {
    /// Constants of one design point, in SI units.
    pub struct Constants<R> {
        /// Drive of the plates. The constant part and the amplitude of the drive are each half of the
        /// peak-to-peak drive voltage. The voltages of the two plates contain the waveform with opposite
        /// signs.
        pub drive: DriveConstants<R>,
        /// Half of the constant voltage difference between the two plates (V). The equations add
        /// `half_offset` to the voltage of plate 1 and subtract it from the voltage of plate 2.
        pub half_offset: R,

        /// Electric field in a plate, divided by the voltage across the plate (1/m): 1/t_pzt.
        pub field_per_volt: R,
        /// Piezoelectric stress f_31,min per electric field at small fields (N/(V·m)), Eq. (6).
        pub f_min: R,
        /// Amount by which the piezoelectric stress per field rises from small to large fields, without the
        /// decline by a₄ (N/(V·m)): f_31,max − f_31,min. If flap uses Eq. (6) as printed, f_31,min is
        /// subtracted twice from f_31,max.
        pub f_rise: R,
        /// Rate a₄ f_31,max at which the piezoelectric stress per field declines with the electric field
        /// (N/V²), Eq. (6).
        pub f_decline: R,
        /// Electric field ℰ₀ in the middle of the stress transition (V/m), Eq. (6).
        pub field_0: R,
        /// Steepness a₃ of the stress transition with respect to the electric field (m/V), Eq. (6).
        pub a_3: R,
        /// Value of e^p for each plate, where p = a₃ (ℰ₀ − V/t_pzt) and V is the constant part of the plate's
        /// voltage.
        pub transition: [R; 2],
        /// Change of the exponent p if the waveform changes by 1: γ = a₃ A/t_pzt, where A is the amplitude of
        /// the drive voltage. The change has opposite signs in the two plates.
        pub transition_swing: R,
        /// Force F_pre of each plate at zero strain, divided by the piezoelectric stress in the plate (N/Pa),
        /// Eq. (6).
        pub force_per_stress: [R; 2],
        /// Relative change b = a₂ s_ε of a plate's force per displacement of the actuator's tip (1/m),
        /// Eqs. (5) and (6).
        pub b: R,
        /// Capacitance C_p of one plate (F).
        pub c_p: R,
        /// Conductance that represents the dielectric loss of one plate (S).
        pub conductance: R,
        /// Power that the power supply recovers, divided by the power that the actuator returns: from 0 to 1.
        pub charge_recovery: R,

        /// Contribution of the carbon-fibre layer to the stiffness at the actuator's tip (N/m), Eq. (3).
        pub k_shim: R,
        /// Contribution of the plates to the stiffness at the actuator's tip (N/m), Eq. (3), at zero electric
        /// field and without the stiffening by strain.
        pub k_plates: R,
        /// Elastic force due to the stiffening by strain at zero electric field, divided by the result L of
        /// `rhs::stiffening` (N), Eqs. (3) and (4).
        pub f_plates: R,
        /// Relative reduction of the Young's modulus of the plates per electric field (m/V).
        pub modulus_decline: R,
        /// Stiffness of the whole actuator at its tip, without the stiffening by strain (N/m), Eq. (3).
        pub k_soft: R,
        /// Elastic force due to the stiffening by strain, divided by the result L of `rhs::stiffening` (N),
        /// Eqs. (3) and (4).
        pub f_stiff: R,
        /// Steepness a₁ of the modulus transition, times the strain s_ε per displacement of the actuator's
        /// tip (1/m), Eq. (4).
        pub u_per_tip: R,
        /// Value σ(a₁ε₀), between 0 and 1, of the logistic function in the modulus transition at zero strain,
        /// Eq. (4).
        pub sigma_0: R,
        /// Stiffness K_t of the transmission at the actuator's tip (N/m).
        pub k_t: R,

        /// Inverse 1/m_e of the effective mass m_e = (I_zz + I_am) T² + m_a (1/kg).
        pub inverse_m_e: R,
        /// Inertia J of the stroke, as an equivalent mass at the actuator's tip: J T² (kg).
        pub stroke_mass: R,
        /// Mass of the actuator, as an equivalent mass at its tip: m_a (kg).
        pub tip_mass: R,
        /// Viscous damping at the actuator's tip that is equivalent to the loss factor of the stroke's springs (N·s/m).
        pub tip_damping: R,
        /// Viscous damping of the stroke as an equivalent damping at the actuator's tip (N·s/m): the damping
        /// about the stroke axis times T².
        pub stroke_damping: R,
        /// Constant part C_A of the drag force at the actuator's tip, divided by ẋ|ẋ| (kg/m), Eq. (8).
        pub c_a: R,
        /// Factor C_B of cos 2ψ in the drag force at the actuator's tip, divided by ẋ|ẋ| (kg/m), Eq. (8).
        pub c_b: R,

        /// Inverse of the moment of inertia of the wing about the hinge's axis, 1/I_xx (1/(kg·m²)).
        pub inverse_i_xx: R,
        /// Moment of inertia I_xx of the wing about the hinge's axis (kg·m²).
        pub i_xx: R,
        /// Product of inertia I_xz of the wing (kg·m²).
        pub i_xz: R,
        /// Inertial torque T I_xz about the hinge at ψ = 0, divided by the acceleration of the actuator's tip
        /// (kg·m), Eq. (2).
        pub coupling: R,
        /// Centrifugal torque about the hinge, divided by ẋ² sin 2ψ (kg): ½ I_xx T², Eq. (2).
        pub centrifugal: R,
        /// Rotational stiffness κ_wh of the wing hinge (N·m/rad).
        pub kappa_wh: R,
        /// Viscous damping of the hinge, including the damping that is equivalent to the hinge's loss factor
        /// (N·m·s).
        pub hinge_damping: R,
        /// Strain of the hinge's flexure per pitch angle (1/rad), or zero if the dimensions of the hinge are
        /// not set.
        pub hinge_strain: R,
        /// Coefficient C_C of the rotational drag, whose moment has the magnitude C_C ψ̇² (N·m·s²), Eq. (9).
        pub c_c: R,
        /// Aerodynamic torque about the hinge, divided by ẋ|ẋ|, the force coefficient and the centre of
        /// pressure in mean widths (kg), Eqs. (10) and (11).
        pub hinge_torque: R,
        /// Chordwise centre of pressure at a pitch of 90°, in mean wing widths, Eq. (11).
        pub p_min: R,
        /// Shift of the chordwise centre of pressure if the pitch changes from 90° to 0, in mean wing widths,
        /// Eq. (11).
        pub p_swing: R,

        /// Mean b₁ of the largest and the smallest drag coefficient.
        pub b_1: R,
        /// Half of the difference between the largest and the smallest drag coefficient, b₂.
        pub b_2: R,
        /// Amplitude b_L of the lift coefficient.
        pub b_l: R,
        /// Force on the wing, divided by the force coefficient and ẋ² (kg/m): ½ρA_w r̂₂²R²T².
        pub force: R,
        /// Distance R_cp of the centre of pressure from the stroke axis (m).
        pub pressure_radius: R,

        /// Transmission ratio T (rad/m).
        pub ratio: R,
        /// Relative growth of the transmission ratio, divided by the square of the tip's displacement: τ =
        /// T₃/T (1/m²).
        pub ratio_growth: R,
        /// Strain s_ε of a plate's mid-plane per displacement of the actuator's tip (1/m), Eq. (5).
        pub strain_per_tip: R,
        /// Strain of a plate's outer face, divided by the strain of its mid-plane.
        pub surface_strain_ratio: R,
        /// Mass of the vehicle (kg).
        pub vehicle_mass: R,
        /// Nonlinear terms of the springs of stroke and hinge.
        pub stiffening: Stiffening<R>,
        /// Terms that flap adds to the paper's formulas of the force coefficients and the centre of pressure.
        pub harmonics: Harmonics<R>,
        /// Rotational circulation of the wing's sections.
        pub circulation: Circulation<R>,
        /// Force of the rotational drag along the wing's normal.
        pub rotation: RotationalForce<R>,
        /// Added mass of the wing's sections, in addition to the added inertia I_am.
        pub added: AddedMass<R>,
        /// Motion of the body, and the strips of the wing that the equations need if the body moves.
        pub moving: Moving<R>,
    }
}

/// Largest allowed magnitude of an exponent in the equations. The exponents need a limit because the
/// exponential function for lanes does not check the range of its argument.
pub(super) const EXPONENT_MAX: f64 = 600.0;

/// Checks that the exponents in Eqs. (4) and (6) stay below the limit for plate voltages of up to
/// `voltage_max` (V).
///
/// # Errors
/// Returns an error if the transition of the modulus or of the piezoelectric stress is too steep.
pub(super) fn check_transitions(p: &Params, voltage_max: f64) -> Result<(), Invalid> {
    let stress = (p.stress_field.abs() + voltage_max / p.piezo_thickness) * p.stress_steepness;
    let modulus = p.modulus_steepness * p.modulus_strain;
    if stress.max(modulus.abs()) > EXPONENT_MAX {
        return Err(Invalid::new(
            "a transition is too steep: stress_steepness times field, or modulus_steepness times \
             modulus_strain, exceeds 600",
        ));
    }
    Ok(())
}

impl Constants<f64> {
    /// Returns the constants of a design point for a body at rest.
    ///
    /// # Errors
    /// Returns an error if the width of the actuator is zero at one end, or the plates have no stiffness.
    /// Returns an error if no shape of the wing has the radii `wing_radius_1` and `wing_radius_2`. Returns an
    /// error if the mass matrix is not positive definite at some pitch. Returns an error if a constant is not
    /// finite.
    pub fn derive(p: &Params) -> Result<Constants<f64>, Invalid> {
        let actuator = Actuator::new(p)?;
        // Exponent of the modulus transition (4) at zero strain.
        let z_0 = p.modulus_steepness * p.modulus_strain;
        let sigma_0 = 1.0 / (1.0 + libm::exp(-z_0));
        // E_e = E_min + ½ (E_max − E_min) L/u with L/u → σ₀ for u → 0.
        let half_range = 0.5 * (p.piezo_modulus_max - p.piezo_modulus_min);
        let u_per_tip = p.modulus_steepness * actuator.strain_per_tip;
        let stiffens = p.actuator_stiffness == ActuatorStiffness::StrainDependent;
        let soft_modulus =
            if stiffens { p.piezo_modulus_min } else { p.piezo_modulus_min + half_range * sigma_0 };

        let ratio = p.transmission_ratio;
        let r_2 = p.wing_radius_2 * p.wing_length;
        let w_2 = p.wing_width_2 * p.wing_width;
        let dynamic = 0.5 * p.air_density * p.wing_area;
        let force = dynamic * (r_2 * r_2) * (ratio * ratio);
        let b_1 = 0.5 * (p.drag_coefficient_max + p.drag_coefficient_min);
        let b_2 = 0.5 * (p.drag_coefficient_max - p.drag_coefficient_min);

        let drive = p.drive();
        let c_p = 0.25 * p.vehicle_capacitance;
        let stroke_inertia = p.wing_inertia_stroke + p.added_inertia_stroke;
        let (circulation, rotation, added) = unsteady(p)?;
        let mut constants = Constants {
            drive,
            half_offset: 0.5 * p.drive_offset,

            field_per_volt: 1.0 / p.piezo_thickness,
            f_min: p.piezo_stress_min,
            f_rise: p.piezo_stress_max
                - p.piezo_stress_min * (1.0 + f64::from(p.field_transition == FieldTransition::Printed)),
            f_decline: p.stress_decline * p.piezo_stress_max,
            field_0: p.stress_field,
            a_3: p.stress_steepness,
            // Set from the drive in `with_drive` below.
            transition: [f64::NAN; 2],
            transition_swing: f64::NAN,
            force_per_stress: [actuator.force_per_stress, actuator.force_per_stress * p.plate_ratio],
            b: p.force_strain_slope * actuator.strain_per_tip,
            c_p,
            conductance: p.electrical.conductance(c_p, drive.rate),
            charge_recovery: p.electrical.charge_recovery,

            k_shim: actuator.shim_stiffness,
            k_plates: actuator.stiffness_per_modulus * soft_modulus,
            f_plates: actuator.stiffness_per_modulus * half_range / u_per_tip * f64::from(stiffens),
            modulus_decline: p.modulus_decline,
            // Set from the drive in `with_drive` below.
            k_soft: f64::NAN,
            f_stiff: f64::NAN,
            u_per_tip,
            sigma_0,
            k_t: p.transmission_stiffness,

            inverse_m_e: 1.0 / (stroke_inertia * (ratio * ratio) + p.actuator_mass),
            stroke_mass: stroke_inertia * (ratio * ratio),
            tip_mass: p.actuator_mass,
            tip_damping: 0.0,
            stroke_damping: p.stroke_damping * (ratio * ratio),
            c_a: force * p.pressure_radius * ratio * b_1,
            c_b: force * p.pressure_radius * ratio * b_2,

            inverse_i_xx: 1.0 / p.wing_inertia_hinge,
            i_xx: p.wing_inertia_hinge,
            i_xz: p.wing_inertia_product,
            coupling: p.wing_inertia_product * ratio,
            centrifugal: 0.5 * p.wing_inertia_hinge * (ratio * ratio),
            kappa_wh: p.hinge_stiffness,
            hinge_damping: p.hinge_damping + p.hinge.damping(p.hinge_stiffness, drive.rate),
            hinge_strain: p.hinge.strain_per_angle(),
            c_c: dynamic * p.rotation_pressure_width * (w_2 * w_2) * p.drag_coefficient_max,
            hinge_torque: force * (p.wing_area / p.wing_length),
            p_min: p.pressure_min,
            p_swing: p.pressure_max - p.pressure_min,

            b_1,
            b_2,
            b_l: p.lift_coefficient_max,
            force,
            pressure_radius: p.pressure_radius,

            ratio,
            ratio_growth: p.transmission_growth / ratio,
            strain_per_tip: actuator.strain_per_tip,
            surface_strain_ratio: actuator.surface_strain_ratio,
            vehicle_mass: p.vehicle_mass,
            stiffening: Stiffening::of(p.stroke_stiffening, &p.hinge),
            harmonics: Harmonics::of(&p.harmonics),
            circulation,
            rotation,
            added,
            moving: Moving::REST,
        }
        .with_drive(drive);
        // L → σ₀ u for small u.
        let stiffening = constants.f_stiff * constants.sigma_0 * constants.u_per_tip;
        let stiffness = constants.k_soft + stiffening + constants.k_t;
        constants.tip_damping = structural_damping(p.stroke_loss_factor, stiffness, drive.rate);
        Invalid::unless_finite(constants)?.checked()
    }

    /// # Errors
    /// Returns an error if the plates have no stiffness, or the mass matrix is not positive definite at some
    /// pitch.
    fn checked(self) -> Result<Constants<f64>, Invalid> {
        if self.softening() <= 0.0 {
            return Err(Invalid::new(
                "the plates have no stiffness: modulus_decline times the mean field in the plates must be less than 1",
            ));
        }
        // The determinant is linear in cos²ψ: it is positive everywhere if it is positive at both ends.
        let AddedMass { a11, a12, a22, .. } = self.added;
        let square = self.ratio * self.ratio;
        let upright = (self.stroke_mass + self.tip_mass + a11 * square) * (self.i_xx + a22)
            - a12 * (a12 + self.i_xz) * square;
        if upright <= 0.0 {
            return Err(inertias_apart(&[
                "wing_inertia_product",
                "added_mass_factor",
                "wing_inertia_hinge",
                "wing_inertia_stroke",
            ]));
        }
        Ok(self)
    }

    /// Returns a copy of the constants with the given drive.
    ///
    /// The voltages of the plates vary in antiphase, so the mean of the electric fields in both plates is
    /// constant. The moduli of the plates are E (1 − a ℰ₁) and E (1 − a ℰ₂). The sum of the stiffnesses of
    /// both plates is therefore constant.
    #[must_use]
    pub(super) fn with_drive(&self, drive: DriveConstants<f64>) -> Constants<f64> {
        let DriveConstants { bias, amplitude, .. } = drive;
        let transition = [self.half_offset, -self.half_offset].map(|offset| {
            let field = (bias + offset) * self.field_per_volt;
            libm::exp(self.a_3 * (self.field_0 - field))
        });
        let transition_swing = self.a_3 * amplitude * self.field_per_volt;
        let driven = Constants { drive, transition, transition_swing, ..*self };
        let soft = driven.softening();
        Constants { k_soft: self.k_plates * soft + self.k_shim, f_stiff: self.f_plates * soft, ..driven }
    }

    /// Returns the modulus of the plates at the mean electric field, divided by the modulus at zero field.
    fn softening(&self) -> f64 {
        1.0 - self.modulus_decline * (self.drive.bias * self.field_per_volt)
    }
}
