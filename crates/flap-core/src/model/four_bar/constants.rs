//! Constants of the four-bar model, which flap computes once for each design point.
//!
//! Equation numbers refer to Arabagi, Hines and Sitti (2013). Equations in brackets are missing from the printed paper
//! and were reconstructed (see `docs/models/four-bar.md`).

use core::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use super::params::{AddedMassSign, MAX_STRIPS, Params};
use super::strips::{Moving, arms, strips};
use crate::aero::{Circulation, Cut, Harmonics, Strips, sum};
use crate::drive::DriveConstants;
use crate::linkage::{FourBarLinkage, LinkInertias, SliderCrank};
use crate::model::stroke_and_pitch::inertias_apart;
use crate::parameter::Invalid;
use crate::piezo::{Laminate, Layer};
use crate::springs::{Stiffening, structural_damping};

crate::per_lane! {
    /// Constants of the actuator and of the spring that is in series with the actuator.
    pub struct Actuator<R> {
        /// Stiffness k_eff of the series connection of actuator and spring (N/m).
        pub stiffness: R,
        /// Deflection γ of the actuator's tip without load, per voltage (m/V).
        pub deflection: R,
        /// Voltage V_ref at which the actuator exerts no force at zero stroke (V).
        pub rest_voltage: R,
        /// 1/k_sc (m/N).
        pub series_compliance: R,
        /// Charge Γ of the actuator per deflection of its tip (C/m).
        pub coupling: R,
        /// Capacitance C_b of the actuator with a blocked tip (F).
        pub capacitance: R,
        /// Conductance that represents the dielectric loss of the actuator (S).
        pub conductance: R,
        /// Power that the power supply recovers, divided by the power that the actuator returns: from 0 to 1.
        pub charge_recovery: R,
        /// Equivalent mass m_eff of the actuator at its tip (kg).
        pub mass: R,
        /// Thickness h_p of the piezoelectric layer (m).
        pub piezo_thickness: R,
    }
}

crate::per_lane! {
    /// Inertia of the wing including the added mass of Eq. (19), and the damping and stiffness of its joints.
    pub struct Wing<R> {
        /// Moment of inertia m R² about the stroke axis, where R is the distance of the centre of mass from
        /// this axis (kg·m²).
        pub upright: R,
        /// Part of the stroke's moment of inertia that is multiplied by sin²φ: m β² + J_yy (kg·m²).
        pub j_sin: R,
        /// Part of the stroke's moment of inertia that is multiplied by cos²φ: J_zz (kg·m²).
        pub j_cos: R,
        /// Inertial coupling P = m R β + J_xz of stroke and pitch (kg·m²).
        pub coupling: R,
        /// Moment of inertia J_φ = m β² + J_xx of the pitch (kg·m²).
        pub j_pitch: R,
        /// Difference of two moments of inertia, J_d = m β² + J_yy − J_zz (kg·m²).
        pub j_difference: R,
        /// Viscous damping D of the stroke (N·m·s).
        pub stroke_damping: R,
        /// Viscous damping at the slider-crank, equivalent to the loss factor of actuator and series spring
        /// (N·s/m).
        pub spring_damping: R,
        /// Viscous damping d of the hinge (N·m·s).
        pub hinge_damping: R,
        /// Strain of the hinge's flexure per pitch angle (1/rad), or zero if the dimensions of the hinge are
        /// not set.
        pub hinge_strain: R,
        /// Rotational stiffness k_rot of the hinge (N·m/rad).
        pub hinge_stiffness: R,
    }
}

crate::per_lane! {
    /// Aerodynamic coefficients of the wing, and integrals over the shape of the wing.
    pub struct Air<R> {
        /// Constants of the lift coefficient, Eq. (9): constant term, amplitude of the sine, factor of the
        /// attack angle, and angle that is subtracted in the sine (rad).
        pub lift: [R; 4],
        /// Constants of the drag coefficient, Eq. (10): constant term, amplitude of the cosine, factor of the
        /// attack angle, and angle that is subtracted in the cosine (rad).
        pub drag: [R; 4],
        /// Lever arm of the centre of pressure about the rotation axis at an attack angle of 90°, in chords,
        /// Eq. (17).
        pub pressure_upright: R,
        /// Shift of the centre of pressure per radian of attack angle, in chords, Eq. (17).
        pub pressure_slope: R,
        /// Terms that flap adds to the paper's formulas of the force coefficients and the centre of pressure.
        pub harmonics: Harmonics<R>,
        /// Factors of θ̇², θ̇φ̇cosφ and (φ̇cosφ)² in the sum Σ c ½ρU²cΔr (kg·m²).
        pub chord: [R; 3],

        /// Rotational force, divided by −|φ̇|φ̇ (kg·m), Eq. (6): ½C_rotρ I₁ Σ c³Δr.
        pub rotation_force: R,
        /// Moment of the rotational force about the stroke axis at φ = 0, divided by −|φ̇|φ̇ (kg·m²): ½C_rotρ
        /// I₁ Σ rc³Δr.
        pub rotation_stroke: R,
        /// Moment of the rotational force about the rotation axis, divided by −|φ̇|φ̇ (kg·m²), Eq. (18):
        /// ½C_rotρ I₂ Σ c⁴Δr.
        pub rotation_pitch: R,

        /// Force of the added mass against the stroke acceleration, divided by this acceleration (kg·m),
        /// Eq. (7).
        pub added_stroke: R,
        /// Force of the added mass against the pitch acceleration, divided by this acceleration (kg·m),
        /// Eq. (7).
        pub added_pitch: R,
        /// Moment of the added mass about the shoulder, divided by the stroke acceleration (kg·m²): π/4 ρ Σ
        /// r²c²Δr.
        pub added_stroke_2: R,
        /// Moment of the added mass about the shoulder, divided by the pitch acceleration (kg·m²): π/4 ρ Σ r
        /// κc³Δr. In the sum over the strips, κc is the distance c/2 − z_RA of Eq. (7).
        pub added_pitch_1: R,
        /// Moment of the added mass about the rotation axis, divided by the pitch acceleration (kg·m²): π/4 ρ
        /// Σ κ²c⁴Δr. In the sum over the strips, κc is the distance c/2 − z_RA of Eq. (7).
        pub added_span: R,
    }
}

crate::per_lane! {
    /// Constants of one design point, in SI units.
    pub struct Constants<R> {
        /// Constants of the drive, which is a voltage or a prescribed stroke.
        pub drive: DriveConstants<R>,
        /// Actuator and series spring.
        pub actuator: Actuator<R>,
        /// Slider-crank, which connects the actuator's tip to the input link of the four-bar.
        pub(crate) slider_crank: SliderCrank<R>,
        /// Four-bar linkage, which connects the input link to the wing.
        pub four_bar: FourBarLinkage<R>,
        /// Inertias of the links.
        pub links: LinkInertias<R>,
        /// Inertia of the wing, and the damping and stiffness of its joints.
        pub wing: Wing<R>,
        /// Aerodynamic constants of the whole wing.
        pub air: Air<R>,
        /// Strips of the wing.
        pub strips: Strips<R, MAX_STRIPS>,
        /// Rotational circulation of the strips.
        pub circulation: Circulation<R>,
        /// Nonlinear terms of the springs of stroke and hinge.
        pub stiffening: Stiffening<R>,
        /// Motion of the body.
        pub moving: Moving<R>,
    }
}

impl Constants<f64> {
    /// Returns the constants of a design point for a body at rest.
    ///
    /// # Errors
    /// - The four-bar has no neutral position, or cannot be assembled in its neutral position.
    /// - The chord is negative somewhere.
    /// - The number of strips is not a whole number from 1 to 64.
    /// - The mass matrix is not positive definite at some position of the wing.
    /// - A constant is not finite.
    pub fn derive(p: &Params) -> Result<Constants<f64>, Invalid> {
        let cuts = strips(p)?;
        let drive = p.drive();
        let actuator = actuator(p, drive.rate);
        let constants = Constants {
            drive,
            actuator,
            slider_crank: SliderCrank { crank: p.crank_radius, rod: p.connecting_rod },
            four_bar: four_bar(p)?,
            links: link_inertias(p),
            wing: wing(p, &cuts, actuator.stiffness, drive.rate),
            air: air(p, &cuts),
            strips: Strips::new(&cuts, p.air_density, arms(p)[0]),
            circulation: Circulation::of(p.circulation_factor, p.air_density, p.axis_position, &|n, m| {
                sum(&cuts, |r, c| c.powi(n) * r.powi(m))
            }),
            stiffening: Stiffening::of(p.stroke_stiffening, &p.hinge),
            moving: Moving::REST,
        };
        Invalid::unless_finite(constants)?.checked()
    }

    fn checked(self) -> Result<Constants<f64>, Invalid> {
        // Linear in cos²φ: positive everywhere if positive at both ends. The links add at least the inertia of link
        // 3.
        let Wing { upright, j_sin, j_cos, coupling, j_pitch, .. } = self.wing;
        let least = upright + self.links.output;
        if (least + j_cos) * j_pitch > coupling * coupling && (least + j_sin) * j_pitch > 0.0 {
            Ok(self)
        } else {
            Err(inertias_apart(&[
                "wing_inertia_product",
                "mass_centre_depth",
                "wing_inertia_span",
                "wing_mass",
            ]))
        }
    }
}

/// Returns the constants of actuator and series spring at the angular drive frequency `rate` (rad/s), from
/// the reconstructed Eqs. (1) and (2).
///
/// The deflection δ of the unimorph's tip is δ = γV − F/k_a (Smits and Choi 1991). The factor 33/140 of the
/// effective mass is the result of Rayleigh's method for a cantilever with a force at its tip.
///
/// ```text
/// k_a = 3 S w / L³     γ = E_p d₃₁ (z_p − z_c) L² / (2S)     Γ = k_a γ     m_eff = 33/140 w L Σ ρᵢ hᵢ
/// C_b = w L [(ε − d₃₁² E_p)/h_p + d₃₁² E_p²/(E_p h_p + E_s h_s)] + d₃₁² E_p² (z_p − z_c)² w L / (4S)
/// ```
fn actuator(p: &Params, rate: f64) -> Actuator<f64> {
    let laminate = Laminate::of([
        Layer { thickness: p.shim_thickness, modulus: p.shim_modulus, density: p.shim_density },
        Layer { thickness: p.piezo_thickness, modulus: p.piezo_modulus, density: p.piezo_density },
    ]);
    let (l, w, s) = (p.actuator_length, p.actuator_width, laminate.bending_stiffness);
    let arm = laminate.mid_planes[1] - laminate.neutral_axis;
    // Piezoelectric stress per field in the clamped layer (N/(V·m)).
    let e = p.piezo_modulus * p.piezo_coefficient;
    let membrane = p.piezo_modulus * p.piezo_thickness + p.shim_modulus * p.shim_thickness;
    let clamped = (p.piezo_permittivity - e * p.piezo_coefficient) / p.piezo_thickness + e * e / membrane;
    let capacitance = w * l * (clamped + e * e * (arm * arm) / (4.0 * s));
    let stiffness = 3.0 * s * w / (l * l * l);
    let deflection = e * arm * (l * l) / (2.0 * s);
    Actuator {
        stiffness: stiffness * p.series_stiffness / (stiffness + p.series_stiffness),
        deflection,
        rest_voltage: p.rest_voltage.unwrap_or(p.drive_bias),
        series_compliance: 1.0 / p.series_stiffness,
        coupling: stiffness * deflection,
        capacitance,
        conductance: p.electrical.conductance(capacitance, rate),
        charge_recovery: p.electrical.charge_recovery,
        mass: 33.0 / 140.0 * w * l * laminate.areal_density,
        piezo_thickness: p.piezo_thickness,
    }
}

/// Returns the four-bar linkage in its neutral position.
fn four_bar(p: &Params) -> Result<FourBarLinkage<f64>, Invalid> {
    let lengths = [p.ground_link, p.input_link, p.coupler_link, p.output_link];
    let Some(neutral) = p.neutral_angle.or_else(|| FourBarLinkage::stationary_angle(lengths)) else {
        return Err(Invalid::new(
            "the transmission of the four-bar has no maximum for output links between 30 and 80 deg: set neutral_angle",
        ));
    };
    Invalid::unless_finite(FourBarLinkage::new(lengths, neutral)).map_err(|_| {
        Invalid::new(format!(
            "the four-bar cannot be assembled with its output link at {neutral} rad: \
             ground_link, input_link, coupler_link and output_link do not fit together"
        ))
    })
}

/// Returns the moments of inertia of the links. Links whose inertia is not set are uniform rods. The moments
/// of inertia of the input link and the output link are about the fixed pivots of these links. The moment of
/// inertia of the coupler is about the centre of the coupler.
fn link_inertias(p: &Params) -> LinkInertias<f64> {
    let about_centre =
        |given: Option<f64>, mass: f64, length: f64| given.unwrap_or(mass * length * length / 12.0);
    let about_pivot = |given: Option<f64>, mass: f64, length: f64| {
        0.25 * mass * length * length + about_centre(given, mass, length)
    };
    LinkInertias {
        input: about_pivot(p.input_link_inertia, p.input_link_mass, p.input_link),
        quarter_coupler_mass: 0.25 * p.coupler_link_mass,
        coupler: about_centre(p.coupler_link_inertia, p.coupler_link_mass, p.coupler_link),
        output: about_pivot(p.output_link_inertia, p.output_link_mass, p.output_link),
    }
}

/// Returns the inertia of the wing with the added mass at the centre of mass, Eqs. (13) and (19). The
/// function also sets the damping and stiffness of the wing's joints.
///
/// `rate` is the angular frequency of the drive (rad/s), and `spring` is the stiffness of actuator and series spring at
/// the slider-crank (N/m).
fn wing(p: &Params, cuts: &[Cut], spring: f64, rate: f64) -> Wing<f64> {
    let m = p.wing_mass + FRAC_PI_4 * p.air_density * sum(cuts, |_, c| c * c);
    let (r, beta) = (p.mass_centre_radius, p.mass_centre_depth);
    Wing {
        upright: m * r * r,
        j_sin: m * beta * beta + p.wing_inertia_normal,
        j_cos: p.wing_inertia_chord,
        coupling: m * r * beta + p.wing_inertia_product,
        j_pitch: m * beta * beta + p.wing_inertia_span,
        j_difference: m * beta * beta + p.wing_inertia_normal - p.wing_inertia_chord,
        stroke_damping: p.stroke_damping,
        spring_damping: structural_damping(p.stroke_loss_factor, spring, rate),
        hinge_damping: p.hinge_damping + p.hinge.damping(p.hinge_stiffness, rate),
        hinge_strain: p.hinge.strain_per_angle(),
        hinge_stiffness: p.hinge_stiffness,
    }
}

/// Returns the aerodynamic constants of the whole wing.
fn air(p: &Params, cuts: &[Cut]) -> Air<f64> {
    let [kappa, origin] = arms(p);
    let dynamic = 0.5 * p.air_density;
    // ∫ z|z| dz and ∫ |z|³ dz over a chord of 1. z is the distance behind the rotation axis, which may lie outside
    // the wing.
    let (before, behind) = (p.axis_position, 1.0 - p.axis_position);
    let cube = |z: f64| z.abs() * z.abs() * z.abs();
    let i_1 = (cube(behind) - cube(before)) / 3.0;
    let i_2 = (behind * cube(behind) + before * cube(before)) / 4.0;
    let drag = dynamic * p.rotation_drag;
    let added = FRAC_PI_4 * p.air_density;
    // Distance of the mid-chord behind the rotation axis, in chords.
    let behind_axis = match p.am_sign {
        AddedMassSign::Corrected => 0.5 - p.axis_position,
        AddedMassSign::Printed => p.axis_position - 0.5,
    };
    Air {
        lift: [p.lift_offset, p.lift_amplitude, p.lift_slope, p.lift_phase],
        drag: [p.drag_offset, p.drag_amplitude, p.drag_slope, p.drag_phase],
        pressure_upright: FRAC_PI_2 * p.pressure_slope + p.pressure_offset - origin,
        pressure_slope: p.pressure_slope,
        harmonics: Harmonics::of(&p.harmonics),
        chord: [
            dynamic * sum(cuts, |r, c| r * r * c * c),
            dynamic * 2.0 * kappa * sum(cuts, |r, c| r * c * c * c),
            dynamic * kappa * kappa * sum(cuts, |_, c| c * c * c * c),
        ],
        rotation_force: drag * i_1 * sum(cuts, |_, c| c * c * c),
        rotation_stroke: drag * i_1 * sum(cuts, |r, c| r * c * c * c),
        rotation_pitch: drag * i_2 * sum(cuts, |_, c| c * c * c * c),
        added_stroke: added * sum(cuts, |r, c| r * c * c),
        added_pitch: behind_axis * added * sum(cuts, |_, c| c * c * c),
        added_stroke_2: added * sum(cuts, |r, c| r * r * c * c),
        added_pitch_1: behind_axis * added * sum(cuts, |r, c| r * c * c * c),
        added_span: behind_axis * behind_axis * added * sum(cuts, |_, c| c * c * c * c),
    }
}
