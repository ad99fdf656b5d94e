//! Parameters of the bimorph model and their published values.

use crate::aero::HarmonicParameters;
use crate::body::BodyParameters;
use crate::drive::{DriveConstants, WaveformParameters};
use crate::parameter::Kind::{Choice, Following, Number};
use crate::parameter::Range::{Any, NonNegative, Positive};
use crate::parameter::{Preset, Range};
use crate::piezo::ElectricalParameters;
use crate::springs::{FLEXURE, HingeParameters};

crate::parameters! {
    /// Parameters of the bimorph model, in SI units. The symbols are taken from Table I of Jafferis, Graule
    /// and Wood (2016).
    pub struct Params {
        ["drive"]
        /// Peak-to-peak drive voltage. If drive_offset is 0, the voltages of the two plates vary in antiphase
        /// between 0 and drive_voltage_pp, Eq. (7). If drive_shape is "harmonics", drive_voltage_pp is the
        /// peak-to-peak voltage of the fundamental alone.
        drive_voltage_pp: f64 = ("V", "V_pp", Number(NonNegative)) 200.0,
        /// Drive frequency. In the experiments of Jafferis et al. (2016), the drive frequency changes at a
        /// rate of 15 Hz/s.
        drive_frequency: f64 = ("Hz", "f", Number(Positive)) 120.0,
        /// Parameters of the waveform.
        waveform: WaveformParameters = (flatten) WaveformParameters::SINE,
        /// Constant voltage difference between the two plates. Half of drive_offset is added to the voltage of plate 1,
        /// and half is subtracted from the voltage of plate 2. Jafferis et al. (2016) do not use drive_offset.
        drive_offset: f64 = ("V", "", Number(Any), default: 0.0) 0.0,

        ["transmission"]
        /// Transmission ratio: stroke angle per displacement of the actuator's tip.
        transmission_ratio: f64 = ("rad/m", "T", Number(Positive)) 3333.0,
        /// Stiffness T^2 kappa_t of the transmission at the actuator's tip, where T is the transmission ratio
        /// and kappa_t is the rotational stiffness.
        transmission_stiffness: f64 = ("N/m", "K_t", Number(NonNegative), is_fitted: true, scales_with: &[("transmission_ratio", 2.0)]) 197.7,
        /// Coefficient T_3 of the transmission ratio T + T_3 x^2, where x is the displacement of the actuator's tip.
        /// Jafferis et al. (2016) do not use transmission_growth.
        transmission_growth: f64 = ("rad/m^3", "T_3", Number(Any), default: 0.0) 0.0,
        /// Cubic stiffness of the stroke. The transmission exerts an additional moment against the stroke:
        /// stroke_stiffening times the third power of the stroke angle. Jafferis et al. (2016) do not use
        /// stroke_stiffening.
        stroke_stiffening: f64 = ("N*m/rad^3", "", Number(Any), default: 0.0) 0.0,
        /// Viscous damping of the stroke about the stroke axis. Jafferis et al. (2016) do not use stroke_damping.
        stroke_damping: f64 = ("N*m*s", "", Number(NonNegative), default: 0.0) 0.0,
        /// Loss factor of the springs that act on the stroke: the actuator and the transmission together. The loss
        /// factor adds a viscous damping: loss factor times stiffness, divided by the angular drive frequency.
        stroke_loss_factor: f64 = ("", "gamma_s", Number(NonNegative), default: 0.0) 0.0,

        ["wing"]
        /// Distance from the transmission's flexure to the wing's tip.
        wing_length: f64 = ("m", "R", Number(Positive)) 17e-3,
        /// Area of one wing.
        wing_area: f64 = ("m^2", "A_w", Number(Positive), scales_with: &[("wing_length", 2.0)]) 54.59e-6,
        /// Radius of the second moment of the wing area about the stroke axis, divided by wing_length.
        wing_radius_2: f64 = ("", "r_2", Number(Positive)) 0.564,
        /// Radius of the first moment of the wing area about the stroke axis, divided by wing_length. From
        /// wing_radius_1, flap computes how the chord varies along the span. Only body motion,
        /// circulation_factor, rotation_force_factor and added_mass_factor need the chord along the span.
        /// Jafferis et al. (2016) do not use wing_radius_1.
        wing_radius_1: Option<f64> = ("", "r_1", Following(Positive, "(wing_radius_2 / 0.929)^(1 / 0.732), from Ellington (1984)")) None,
        /// Wing width: largest distance between the hinge's axis and a point of the wing.
        wing_width: f64 = ("m", "W", Number(Positive), scales_with: &[("wing_length", 1.0)]) 4.5e-3,
        /// Radius of the second moment of the wing area about the hinge's axis, divided by wing_width.
        wing_width_2: f64 = ("", "w_2", Number(Positive)) 0.43,
        /// Moment of inertia of the wing about the stroke axis.
        wing_inertia_stroke: f64 = ("kg*m^2", "I_zz", Number(Positive), scales_with: &[("wing_length", 4.0)]) 51.1e-12,
        /// Added inertia about the stroke axis: moment of inertia of the air that moves with the wing.
        added_inertia_stroke: f64 = ("kg*m^2", "I_am", Number(NonNegative), scales_with: &[("wing_length", 5.0), ("air_density", 1.0)]) 10.22e-12,
        /// Moment of inertia of the wing about the hinge's axis.
        wing_inertia_hinge: f64 = ("kg*m^2", "I_xx", Number(Positive), is_fitted: true, scales_with: &[("wing_length", 4.0)]) 0.95 * 1.29e-12,
        /// Product of inertia of the wing, which couples stroke and pitch.
        wing_inertia_product: f64 = ("kg*m^2", "I_xz", Number(Any), is_fitted: true, scales_with: &[("wing_length", 4.0)]) 0.29 * 2.8e-12,

        ["hinge"]
        /// Rotational stiffness of the wing hinge.
        hinge_stiffness: f64 = ("N*m/rad", "kappa_wh", Number(Positive), is_fitted: true, scales_with: FLEXURE) 0.985 * 1.52e-6,
        /// Viscous damping of the wing hinge. Jafferis et al. (2016) do not use hinge_damping.
        hinge_damping: f64 = ("N*m*s", "", Number(NonNegative), default: 0.0) 0.0,
        /// Loss factor, stiffening, stop and dimensions of the hinge.
        hinge: HingeParameters = (flatten) HingeParameters::NONE,

        ["air"]
        /// Density of the air. The value of air_density is assumed, because Jafferis et al. (2016) do not give the
        /// density.
        air_density: f64 = ("kg/m^3", "rho", Number(NonNegative)) 1.2,
        /// Drag coefficient of the wing at an attack angle of 90 deg (pitch 0).
        drag_coefficient_max: f64 = ("", "b_max", Number(NonNegative), is_fitted: true) 1.25 * 3.4,
        /// Drag coefficient of the wing at an attack angle of 0 (pitch 90 deg).
        drag_coefficient_min: f64 = ("", "b_min", Number(NonNegative), is_fitted: true) 0.39 * 0.4,
        /// Lift coefficient of the wing at an attack angle of 45 deg.
        lift_coefficient_max: f64 = ("", "b_L", Number(NonNegative), is_fitted: true) 1.8,
        /// Lever arm of the drag about the stroke axis (radial centre of pressure).
        pressure_radius: f64 = ("m", "R_cp", Number(Positive), is_fitted: true, scales_with: &[("wing_length", 1.0)]) 1.42 * 9.56e-3,
        /// Lever arm of the rotational drag about the hinge's axis.
        rotation_pressure_width: f64 = ("m", "W_cp1", Number(NonNegative), is_fitted: true, scales_with: &[("wing_length", 1.0)]) 0.39 * 1.93e-3,
        /// Chordwise centre of pressure at an attack angle of 0, as a fraction of the mean wing width A_w/R, Eq. (11).
        pressure_min: f64 = ("", "p_min", Number(Any), is_fitted: true) 0.132,
        /// Chordwise centre of pressure at an attack angle of 90 deg, as a fraction of the mean wing width
        /// A_w/R, Eq. (11).
        pressure_max: f64 = ("", "p_max", Number(Any), is_fitted: true) 0.151,
        /// Terms that flap adds to the paper's formulas of the force coefficients and the centre of pressure.
        harmonics: HarmonicParameters = (flatten) HarmonicParameters::NONE,
        /// Factor that multiplies the rotational circulation of potential flow. With circulation_factor = 1,
        /// the circulation follows the theory of Kramer (1932) and Sane and Dickinson (2002). Jafferis et
        /// al. (2016) do not use circulation_factor.
        circulation_factor: f64 = ("", "", Number(NonNegative), default: 0.0) 0.0,
        /// Factor that multiplies the force of the rotational drag along the wing's normal. With
        /// rotation_force_factor = 1, the force along the normal is consistent with the moment of the
        /// rotational drag in Eq. (9). Jafferis et al. (2016) do not use rotation_force_factor.
        rotation_force_factor: f64 = ("", "", Number(NonNegative), default: 0.0) 0.0,
        /// Factor that multiplies the added mass of the wing's sections. The added mass of the sections acts
        /// on stroke and pitch. With added_mass_factor = 1, each section has the added mass of a flat plate
        /// in potential flow. Jafferis et al. (2016) do not use added_mass_factor, only added_inertia_stroke.
        added_mass_factor: f64 = ("", "", Number(NonNegative), default: 0.0) 0.0,
        /// Distance of the hinge's axis from the leading edge, in chords. If circulation_factor,
        /// rotation_force_factor and added_mass_factor are all zero, axis_position has no effect.
        axis_position: f64 = ("", "x_0", Number(Any), default: 0.0) 0.0,

        ["actuator"]
        /// Length of the active part of the actuator.
        actuator_length: f64 = ("m", "l_pzt", Number(Positive)) 9e-3,
        /// Mean width of the actuator.
        actuator_width: f64 = ("m", "w_n", Number(Positive)) 1.125e-3,
        /// Width of the actuator at the base, divided by the mean width. The ratio lies between 0 and 2.
        actuator_width_ratio: f64 = ("", "w_r", Number(WIDTH_RATIOS)) 1.556,
        /// Length of the actuator's rigid extension, divided by actuator_length.
        actuator_extension_ratio: f64 = ("", "l_r", Number(NonNegative)) 0.25,
        /// Mass of the actuator, as a point mass at the actuator's tip. The equations of Jafferis et
        /// al. (2016) leave out the mass of the actuator, which is about 7 mg.
        actuator_mass: f64 = ("kg", "", Number(NonNegative)) 0.0,
        /// Thickness of each piezoelectric plate.
        piezo_thickness: f64 = ("m", "t_pzt", Number(Positive)) 135e-6,
        /// Thickness of the carbon-fibre layer between the two piezoelectric plates.
        shim_thickness: f64 = ("m", "t_cf", Number(NonNegative)) 50e-6,
        /// Young's modulus of the carbon-fibre layer.
        shim_modulus: f64 = ("Pa", "E_cf", Number(NonNegative)) 340e9,
        /// Young's modulus of the piezoelectric plates without compression, Eq. (4).
        piezo_modulus_min: f64 = ("Pa", "E_min", Number(Positive)) 38.5e9,
        /// Young's modulus of the piezoelectric plates under large compression, Eq. (4).
        piezo_modulus_max: f64 = ("Pa", "E_max", Number(Positive)) 81e9,
        /// Relative reduction of the Young's modulus of the piezoelectric plates per electric field. The
        /// reduction is proportional to the mean of the electric fields in the two plates. The mean of the
        /// fields in both plates is constant over a period. Jafferis et al. (2016) do not use
        /// modulus_decline.
        modulus_decline: f64 = ("m/V", "", Number(Any), default: 0.0) 0.0,
        /// Strain in the middle of the transition between piezo_modulus_min and piezo_modulus_max, Eq. (4). A strain is
        /// negative in compression.
        modulus_strain: f64 = ("", "eps_0", Number(Any)) -0.047e-2,
        /// Steepness, with respect to strain, of the transition between piezo_modulus_min and
        /// piezo_modulus_max, Eq. (4).
        modulus_steepness: f64 = ("", "a_1", Number(Positive)) 8000.0,
        /// Piezoelectric stress per electric field at small fields, Eq. (6).
        piezo_stress_min: f64 = ("N/(V*m)", "f_31,min", Number(NonNegative)) 14.0,
        /// Piezoelectric stress per electric field at large fields, without the reduction by stress_decline, Eq. (6).
        piezo_stress_max: f64 = ("N/(V*m)", "f_31,max", Number(NonNegative)) 29.0,
        /// Electric field in the middle of the transition between piezo_stress_min and piezo_stress_max, Eq. (6).
        stress_field: f64 = ("V/m", "E_0", Number(Any)) 0.4e6,
        /// Steepness, with respect to the electric field, of the transition between piezo_stress_min and
        /// piezo_stress_max, Eq. (6).
        stress_steepness: f64 = ("m/V", "a_3", Number(NonNegative)) 10e-6,
        /// Relative reduction of piezo_stress_max per electric field, Eq. (6).
        stress_decline: f64 = ("m/V", "a_4", Number(Any)) 69e-9,
        /// Relative change of the force of a piezoelectric plate per strain, Eq. (6).
        force_strain_slope: f64 = ("", "a_2", Number(Any)) -230.0,
        /// Factor that multiplies the force of the piezoelectric plates. The factor describes the force that
        /// is lost where the actuator is attached. A factor of 1 means no loss.
        force_factor: f64 = ("", "p_3", Number(Positive), is_fitted: true) 0.7,
        /// Factor that multiplies the stiffness of the actuator. The factor describes the stiffness that is
        /// lost where the actuator is attached. A factor of 1 means no loss.
        stiffness_factor: f64 = ("", "p_4", Number(Positive), is_fitted: true) 0.79,
        /// Second factor that multiplies the stiffness of the actuator. The factor adjusts the computed free
        /// deflection of the actuator to the measured free deflection. A factor of 1 means no correction.
        deflection_factor: f64 = ("", "p_5", Number(Positive), is_fitted: true) 0.8,
        /// Force of plate 2, divided by the force of plate 1 at the same voltage. Jafferis et al. (2016) do not use
        /// plate_ratio.
        plate_ratio: f64 = ("", "", Number(NonNegative), default: 1.0) 1.0,
        /// Dielectric loss and charge recovery.
        electrical: ElectricalParameters = (flatten) ElectricalParameters::NONE,
        /// Motion of the body.
        body: BodyParameters = (flatten) BodyParameters::REST,

        ["vehicle"]
        /// Total capacitance of the four plates in the two actuators of a vehicle.
        vehicle_capacitance: f64 = ("F", "C_act", Number(NonNegative)) 10.1e-9,
        /// Mass of the vehicle with its two actuators and two wings, Table II. To compute the column
        /// payload_mg, flap subtracts vehicle_mass from 80 % of the vehicle's lift.
        vehicle_mass: f64 = ("kg", "M_f", Number(NonNegative)) 80e-6,

        ["readings of the paper"]
        /// Form of Eq. (6), in which the piezoelectric stress depends on the electric field: corrected
        /// ("corrected"), or as printed ("printed"). With "printed", the force of the plates at large fields
        /// is about half of the force with "corrected".
        field_transition: FieldTransition = ("", "", Choice(FieldTransition::NAMES)) FieldTransition::Corrected,
        /// Attack angle that determines the chordwise centre of pressure, Eq. (11): at most 90 deg
        /// ("folded"), relative to the motion ("directional"), or as printed ("literal"). With Eq. (11) as
        /// printed, the two half strokes are not mirror images of each other.
        centre_of_pressure: CentreOfPressure = ("", "", Choice(CentreOfPressure::NAMES)) CentreOfPressure::Folded,
        /// Stiffness of the actuator: dependent on the strain, Eq. (4) ("strain-dependent"), or constant ("constant").
        /// The constant stiffness is the stiffness at zero strain.
        actuator_stiffness: ActuatorStiffness = ("", "", Choice(ActuatorStiffness::NAMES)) ActuatorStiffness::StrainDependent,
    }

    /// Returns the parameters in Table I of the paper, at 200 V and at the frequency of the largest stroke.
    /// Table I of the paper prints each fitted value as a product of two factors.
    pub fn jafferis2016() -> Params;
}

crate::choice! {
    /// Interpretations of Eq. (6), which gives the piezoelectric stress per electric field.
    pub enum FieldTransition {
        /// The stress per field is f_min + (f_max (1 − a₄ℰ) − f_min) σ. As the electric field increases, the
        /// stress per field rises from f_min towards f_max, as the text of the paper describes.
        Corrected = "corrected",
        /// The stress per field is (f_min + (f_max (1 − a₄ℰ) − f_min) eᶻ)/(1 + eᶻ), as printed. The printed
        /// formula never approaches f_max.
        Printed = "printed",
    }
}

crate::choice! {
    /// Interpretations of Eq. (11), which differ in the angle on which the centre of pressure depends.
    pub enum CentreOfPressure {
        /// |ψ|: the attack angle is never above 90°.
        Folded = "folded",
        /// ψ sign(ẋ): the attack angle is measured from the direction of motion.
        Directional = "directional",
        /// ψ: the angle as printed in the paper. With the angle ψ, the two half strokes are not mirror images
        /// of each other.
        Literal = "literal",
    }
}

crate::choice! {
    /// Dependence of the stiffness of the actuator on strain.
    pub enum ActuatorStiffness {
        /// Eq. (3) with the strain-dependent modulus of Eq. (4).
        StrainDependent = "strain-dependent",
        /// Eq. (3) with the modulus of Eq. (4) at zero strain.
        Constant = "constant",
    }
}

/// Range of `actuator_width_ratio` in which the actuator has a positive width at both ends.
pub(super) const WIDTH_RATIOS: Range = Range::Between(0.0, 2.0);

impl Params {
    /// Returns true if the equations contain additional forces along the wing's normal: rotational
    /// circulation, rotational drag or added mass.
    pub(super) fn has_sections(&self) -> bool {
        [self.circulation_factor, self.rotation_force_factor, self.added_mass_factor]
            .iter()
            .any(|factor| *factor != 0.0)
    }

    /// The published presets.
    pub(super) const PRESETS: &'static [Preset] = &[
        Preset {
            name: "jafferis2016",
            doc: "test vehicle with improved actuators, 200 V at 120 Hz (Jafferis, Graule and Wood 2016, Table I)",
            values: || Params::jafferis2016().to_values(),
        },
        Preset {
            name: "jafferis2016-improved",
            doc: "redesigned vehicle, 200 V at 155 Hz (Jafferis, Graule and Wood 2016, III-B and Table II)",
            values: || Params::jafferis2016_improved().to_values(),
        },
    ];

    /// Returns the parameters of the redesigned vehicle in section III-B of the paper. Drive frequency,
    /// transmission, hinge and vehicle mass differ from Table I.
    pub fn jafferis2016_improved() -> Params {
        Params {
            drive_frequency: 155.0,
            transmission_ratio: 2666.0,
            transmission_stiffness: 215.0,
            hinge_stiffness: 2.29e-6,
            vehicle_mass: 87e-6,
            ..Params::jafferis2016()
        }
    }

    /// Returns the drive.
    pub(super) fn drive(&self) -> DriveConstants<f64> {
        let half = 0.5 * self.drive_voltage_pp;
        DriveConstants::new(self.drive_frequency, &self.waveform, [half, half])
    }

    /// Returns the parameters with the transmission ratio multiplied by `ratio`.
    ///
    /// The stiffnesses of transmission and hinge are scaled as in section III-A of the paper, so that the response
    /// curves stay similar.
    ///
    /// ```text
    /// T ∝ r     κ_t ∝ r^−2.14, so K_t = T² κ_t ∝ r^−0.14     κ_wh ∝ r^−1.47
    /// ```
    ///
    /// Figure 5 of the paper shows response curves for the ratios 0.8 (named T₂) and 0.6 (named T₃).
    #[must_use]
    pub fn with_transmission_scaled(self, ratio: f64) -> Params {
        Params {
            transmission_ratio: self.transmission_ratio * ratio,
            transmission_stiffness: self.transmission_stiffness * libm::pow(ratio, 2.0 - 2.14),
            hinge_stiffness: self.hinge_stiffness * libm::pow(ratio, -1.47),
            ..self
        }
    }
}
