//! Parameters of the four-bar model, and presets for the two prototypes of the paper.
//!
//! The paper gives voltages, frequencies, the link lengths of one four-bar, and the stiffness and damping of
//! the hinges. The paper also gives the series stiffness, the coefficient C_rot of the rotational drag, and
//! the position of the rotation axis. All values that the paper does not give are assumed, as the
//! descriptions of the parameters state.

use crate::aero::{ChordTable, HarmonicParameters};
use crate::body::BodyParameters;
use crate::drive::{DriveConstants, StrokeParameters, WaveformParameters};
use crate::parameter::Kind::{Choice, Following, Number};
use crate::parameter::Range::{Any, NonNegative, Positive};
use crate::parameter::{Preset, Range};
use crate::piezo::{EPSILON_0, ElectricalParameters};
use crate::springs::{FLEXURE, HingeParameters};

crate::parameters! {
    /// Parameters of the four-bar model, in SI units. If Arabagi, Hines and Sitti (2013) use a symbol for a
    /// parameter, the table contains this symbol.
    pub struct Params {
        ["drive"]
        /// Peak-to-peak drive voltage. If drive_shape is "harmonics", drive_voltage_pp is the peak-to-peak
        /// voltage of the fundamental alone.
        drive_voltage_pp: f64 = ("V", "V_pp", Number(NonNegative)) 150.0,
        /// Constant part of the drive voltage.
        drive_bias: f64 = ("V", "V_dc", Number(Any)) 50.0,
        /// Drive frequency.
        drive_frequency: f64 = ("Hz", "f", Number(Positive)) 75.0,
        /// Parameters of the waveform.
        waveform: WaveformParameters = (flatten) WaveformParameters::SINE,
        /// Parameters of a prescribed stroke.
        stroke: StrokeParameters = (flatten) StrokeParameters::FREE,
        /// Voltage at which the actuator exerts no force at zero stroke. The value of rest_voltage is
        /// assumed, because Arabagi et al. (2013) do not give a rest voltage.
        rest_voltage: Option<f64> = ("V", "V_ref", Following(Any, "drive_bias")) None,

        ["actuator"]
        /// Length of the actuator, on which the force of the actuator depends. The value of actuator_length
        /// is assumed.
        actuator_length: f64 = ("m", "L", Number(Positive)) 16e-3,
        /// Width of the actuator, on which the force of the actuator depends. The width is constant along the
        /// actuator. The value of actuator_width is assumed.
        actuator_width: f64 = ("m", "w", Number(Positive)) 18e-3,
        /// Thickness of the piezoelectric layer. The value of piezo_thickness is assumed: the thickness of a commercial
        /// sheet.
        piezo_thickness: f64 = ("m", "h_p", Number(Positive)) 127e-6,
        /// Thickness of the shim. The value of shim_thickness is assumed.
        shim_thickness: f64 = ("m", "h_s", Number(NonNegative)) 76e-6,
        /// Young's modulus of the piezoelectric layer. The value of piezo_modulus is assumed: the modulus of PZT-5H.
        piezo_modulus: f64 = ("Pa", "E_p", Number(Positive)) 62e9,
        /// Young's modulus of the shim. The value of shim_modulus is assumed: the modulus of steel.
        shim_modulus: f64 = ("Pa", "E_s", Number(NonNegative)) 193e9,
        /// Density of the piezoelectric layer. The value of piezo_density is assumed: the density of PZT-5H.
        piezo_density: f64 = ("kg/m^3", "rho_p", Number(NonNegative)) 7800.0,
        /// Density of the shim. The value of shim_density is assumed: the density of steel.
        shim_density: f64 = ("kg/m^3", "rho_s", Number(NonNegative)) 7900.0,
        /// Magnitude of the piezoelectric coefficient. The value of piezo_coefficient is assumed: the coefficient of
        /// PZT-5H.
        piezo_coefficient: f64 = ("m/V", "d_31", Number(Any)) 320e-12,
        /// Permittivity of the unstressed piezoelectric layer. The value of piezo_permittivity is assumed:
        /// the permittivity of PZT-5H. The permittivity affects only the current and the electrical power.
        piezo_permittivity: f64 = ("F/m", "eps_T", Number(NonNegative)) 3800.0 * EPSILON_0,
        /// Dielectric loss and charge recovery.
        electrical: ElectricalParameters = (flatten) ElectricalParameters::NONE,
        /// Motion of the body.
        body: BodyParameters = (flatten) BodyParameters::REST,

        ["transmission"]
        /// Stiffness of the spring between the actuator's tip and the slider-crank.
        series_stiffness: f64 = ("N/m", "k_sc", Number(Positive)) 1400.0,

        /// Radius of the crank of the slider-crank, which is part of the input link. The value of
        /// crank_radius is assumed: the radius is chosen so that the first resonance agrees with the paper.
        crank_radius: f64 = ("m", "L_c", Number(Positive)) 3.285e-3,
        /// Length of the connecting rod of the slider-crank. The value of connecting_rod is assumed.
        connecting_rod: f64 = ("m", "L_s", Number(Positive)) 5e-3,
        /// Length of the ground link: distance between the fixed pivots of the four-bar.
        ground_link: f64 = ("m", "L_0", Number(Positive)) 13.5e-3,
        /// Length of the input link of the four-bar. The slider-crank drives the input link.
        input_link: f64 = ("m", "L_1", Number(Positive)) 12.1e-3,
        /// Length of the coupler link of the four-bar.
        coupler_link: f64 = ("m", "L_2", Number(Positive)) 10e-3,
        /// Length of the output link of the four-bar. The output link carries the wing.
        output_link: f64 = ("m", "L_3", Number(Positive)) 5e-3,
        /// Angle between the output link and the ground link at zero stroke. The value of neutral_angle is assumed: the
        /// angle of the largest transmission ratio.
        neutral_angle: Option<f64> = ("rad", "psi_n", Following(Any, "the angle between 30 and 80 deg at which the transmission is stationary")) None,
        /// Mass of the input link. The value of input_link_mass is assumed: the mass of a carbon-fibre link.
        input_link_mass: f64 = ("kg", "m_L1", Number(NonNegative)) 11.616e-6,
        /// Mass of the coupler link. The value of coupler_link_mass is assumed: the mass of a carbon-fibre link.
        coupler_link_mass: f64 = ("kg", "m_L2", Number(NonNegative)) 9.6e-6,
        /// Mass of the output link. The value of output_link_mass is assumed: the mass of a carbon-fibre link.
        output_link_mass: f64 = ("kg", "m_L3", Number(NonNegative)) 4.8e-6,
        /// Moment of inertia of the input link about its centre. The value of input_link_inertia is assumed: the
        /// inertia of a uniform rod.
        input_link_inertia: Option<f64> = ("kg*m^2", "J_L1", Following(NonNegative, "input_link_mass * input_link^2 / 12")) None,
        /// Moment of inertia of the coupler link about its centre. The value of coupler_link_inertia is assumed: the
        /// inertia of a uniform rod.
        coupler_link_inertia: Option<f64> = ("kg*m^2", "J_L2", Following(NonNegative, "coupler_link_mass * coupler_link^2 / 12")) None,
        /// Moment of inertia of the output link about its centre. The value of output_link_inertia is assumed: the
        /// inertia of a uniform rod.
        output_link_inertia: Option<f64> = ("kg*m^2", "J_L3", Following(NonNegative, "output_link_mass * output_link^2 / 12")) None,
        /// Cubic stiffness of the stroke. The transmission exerts an additional moment against the stroke:
        /// stroke_stiffening times the third power of the stroke angle. Arabagi et al. (2013) do not use
        /// stroke_stiffening.
        stroke_stiffening: f64 = ("N*m/rad^3", "", Number(Any), default: 0.0) 0.0,
        /// Viscous damping of the stroke by the flexures of the transmission. The value of stroke_damping is assumed:
        /// this damping gives modal damping ratios of 4 to 9 percent.
        stroke_damping: f64 = ("N*m*s", "D", Number(NonNegative)) 2e-7,
        /// Loss factor of the springs that act on the stroke: the actuator and the series spring together. The loss
        /// factor adds a viscous damping: loss factor times stiffness, divided by the angular drive frequency.
        stroke_loss_factor: f64 = ("", "gamma_s", Number(NonNegative), default: 0.0) 0.0,

        ["hinge"]
        /// Rotational stiffness of the wing hinge.
        hinge_stiffness: f64 = ("N*m/rad", "k_rot", Number(Positive), scales_with: FLEXURE) 50e-6,
        /// Viscous damping of the wing hinge.
        hinge_damping: f64 = ("N*m*s", "d", Number(NonNegative)) 5e-9,
        /// Loss factor, stiffening, stop and dimensions of the hinge.
        hinge: HingeParameters = (flatten) HingeParameters::NONE,

        ["wing"]
        /// Distance from the stroke axis to the root of the wing. The value of wing_offset is assumed.
        wing_offset: f64 = ("m", "r_0", Number(NonNegative)) 4e-3,
        /// Wing length, from the root of the wing to the tip. The value of wing_length is assumed.
        wing_length: f64 = ("m", "L_w", Number(Positive)) 24e-3,
        /// Chord of the wing at its root. The value of root_chord is assumed. The chord is root_chord times a
        /// polynomial in x, where x is 0 at the root and 1 at the tip.
        root_chord: f64 = ("m", "c_0", Number(Positive), scales_with: &[("wing_length", 1.0)]) 8.3e-3,
        /// Constant term of the chord polynomial. The value of chord_term_0 is assumed.
        chord_term_0: f64 = ("", "p_0", Number(Any)) 1.0,
        /// Coefficient of x in the chord polynomial, where x is 0 at the root of the wing and 1 at its tip. The value
        /// of chord_term_1 is assumed.
        chord_term_1: f64 = ("", "p_1", Number(Any)) 1.0,
        /// Coefficient of x^2 in the chord polynomial, where x is 0 at the root of the wing and 1 at its tip. The value
        /// of chord_term_2 is assumed.
        chord_term_2: f64 = ("", "p_2", Number(Any)) 0.0,
        /// Coefficient of x^3 in the chord polynomial, where x is 0 at the root of the wing and 1 at its tip. The value
        /// of chord_term_3 is assumed.
        chord_term_3: f64 = ("", "p_3", Number(Any)) 0.0,
        /// Coefficient of x^4 in the chord polynomial, where x is 0 at the root of the wing and 1 at its tip. The value
        /// of chord_term_4 is assumed, so that the chord is zero at the tip.
        chord_term_4: f64 = ("", "p_4", Number(Any)) -2.0,
        /// Table of the chord.
        chords: ChordTable = (flatten) ChordTable::off(),
        /// Distance of the rotation axis from the leading edge, in chords.
        axis_position: f64 = ("", "z_RA/c", Number(Any)) 0.25,
        /// Mass of the wing: spar, veins and membrane. The value of wing_mass is assumed, so that the second resonance
        /// of the 75 Hz system agrees with the paper.
        wing_mass: f64 = ("kg", "m_w", Number(Positive), scales_with: &[("wing_length", 2.0)]) 9.577e-6,
        /// Distance of the wing's centre of mass from the stroke axis. The value of mass_centre_radius is assumed.
        mass_centre_radius: f64 = ("m", "R_CG", Number(Any), scales_with: &[("wing_length", 1.0)]) 15.22e-3,
        /// Distance of the wing's centre of mass from the rotation axis, positive towards the trailing edge. The value
        /// of mass_centre_depth is assumed.
        mass_centre_depth: f64 = ("m", "beta_CG", Number(Any), scales_with: &[("wing_length", 1.0)]) 1.569e-3,
        /// Moment of inertia of the wing about the spanwise axis through its centre of mass. The value of
        /// wing_inertia_span is assumed.
        wing_inertia_span: f64 = ("kg*m^2", "J_xx", Number(NonNegative), scales_with: &[("wing_length", 4.0)]) 8.333e-11,
        /// Moment of inertia of the wing about the normal of its surface through its centre of mass. The value of
        /// wing_inertia_normal is assumed.
        wing_inertia_normal: f64 = ("kg*m^2", "J_yy", Number(NonNegative), scales_with: &[("wing_length", 4.0)]) 4.269e-10,
        /// Moment of inertia of the wing about the chordwise axis through its centre of mass. The value of
        /// wing_inertia_chord is assumed.
        wing_inertia_chord: f64 = ("kg*m^2", "J_zz", Number(NonNegative), scales_with: &[("wing_length", 4.0)]) 3.436e-10,
        /// Product of inertia of the wing about its centre of mass. The product is positive if the mass near
        /// the tip is farther behind the rotation axis than the mass near the root. The value of
        /// wing_inertia_product is assumed.
        wing_inertia_product: f64 = ("kg*m^2", "J_xz", Number(Any), scales_with: &[("wing_length", 4.0)]) -8.38e-12,

        ["air"]
        /// Density of the air. The value of air_density is assumed.
        air_density: f64 = ("kg/m^3", "rho", Number(NonNegative)) 1.2,
        /// Constant term of the lift coefficient, Eq. (9).
        lift_offset: f64 = ("", "0.225", Number(Any)) 0.225,
        /// Amplitude of the sine in the lift coefficient, Eq. (9).
        lift_amplitude: f64 = ("", "1.58", Number(Any)) 1.58,
        /// Factor that multiplies the attack angle in the lift coefficient, Eq. (9).
        lift_slope: f64 = ("", "2.13", Number(Any)) 2.13,
        /// Angle that is subtracted in the sine of the lift coefficient, Eq. (9).
        lift_phase: f64 = ("rad", "7.2 deg", Number(Any)) LIFT_PHASE,
        /// Constant term of the drag coefficient, Eq. (10).
        drag_offset: f64 = ("", "1.92", Number(Any)) 1.92,
        /// Amplitude of the cosine in the drag coefficient, Eq. (10).
        drag_amplitude: f64 = ("", "1.55", Number(Any)) 1.55,
        /// Factor that multiplies the attack angle in the drag coefficient, Eq. (10).
        drag_slope: f64 = ("", "2.04", Number(Any)) 2.04,
        /// Angle that is subtracted in the cosine of the drag coefficient, Eq. (10).
        drag_phase: f64 = ("rad", "9.82 deg", Number(Any)) DRAG_PHASE,
        /// Coefficient of the rotational drag, Eq. (6).
        rotation_drag: f64 = ("", "C_rot", Number(NonNegative)) 2.0,
        /// Shift of the centre of pressure in chords, per radian of attack angle, Eq. (17).
        pressure_slope: f64 = ("", "0.82/pi", Number(Any)) 0.82 / core::f64::consts::PI,
        /// Position of the centre of pressure at an attack angle of 0, in chords, Eq. (17).
        pressure_offset: f64 = ("", "0.05", Number(Any)) 0.05,
        /// Terms that flap adds to the paper's formulas of the force coefficients and the centre of pressure.
        harmonics: HarmonicParameters = (flatten) HarmonicParameters::NONE,
        /// Factor that multiplies the rotational circulation of potential flow. With circulation_factor = 1,
        /// the circulation follows the theory of Kramer (1932) and Sane and Dickinson (2002). Arabagi et
        /// al. (2013) do not use circulation_factor.
        circulation_factor: f64 = ("", "", Number(NonNegative), default: 0.0) 0.0,

        ["readings of the paper"]
        /// Chordwise lever arms of Eqs. (8) and (17): as printed ("printed"), or measured from the rotation
        /// axis ("axis"). The printed lever arms are correct only if the rotation axis is the leading edge.
        arms: Arms = ("", "", Choice(Arms::NAMES)) Arms::Printed,
        /// Sign of the term with the pitch acceleration in the lift of the added mass, Eq. (7): corrected
        /// ("corrected"), or as printed ("printed").
        am_sign: AddedMassSign = ("", "", Choice(AddedMassSign::NAMES)) AddedMassSign::Corrected,
        ["strips of the wing"]
        /// Division of the wing into strips: strips at the nodes of the Gauss-Legendre rule ("gauss"), or
        /// strips of equal width ("midpoint").
        quadrature: Quadrature = ("", "", Choice(Quadrature::NAMES)) Quadrature::Gauss,
        /// Number of strips of the wing: a whole number from 1 to 64.
        strips: f64 = ("", "N", Number(STRIPS)) 16.0,
    }

    /// Returns the parameters of the 75 Hz system of the paper, with the voltages and the hinge of the 70 Hz prototype
    /// in Figs. 13 to 15.
    pub fn arabagi2013_75hz() -> Params;
}

crate::choice! {
    /// Definitions of the chordwise lever arms in Eqs. (8) and (17).
    pub enum Arms {
        /// The distances from the rotation axis are c/2 (mid-chord) and d_cp c (centre of pressure), as
        /// printed.
        Printed = "printed",
        /// The distances from the leading edge are c/2 (mid-chord), d_cp c (centre of pressure) and χc
        /// (rotation axis).
        Axis = "axis",
    }
}

crate::choice! {
    /// Forms of the second term of Eq. (7), the lift of the added mass.
    pub enum AddedMassSign {
        /// φ̈ (c/2 − z_RA): the term that follows from the acceleration of the mid-chord.
        Corrected = "corrected",
        /// φ̈ (z_RA − c/2): the term as printed in the paper.
        Printed = "printed",
    }
}

crate::choice! {
    /// Rules for cutting the wing into strips.
    pub enum Quadrature {
        /// Strips at the nodes of the Gauss-Legendre rule. With 8 strips at the Gauss-Legendre nodes, the
        /// result is more accurate than with 256 strips of equal width.
        Gauss = "gauss",
        /// Strips of equal width.
        Midpoint = "midpoint",
    }
}

/// Allowed range of the number of strips.
pub(super) const STRIPS: Range = Range::Whole(1, MOST_STRIPS);

const MOST_STRIPS: u32 = 64;

/// Largest number of strips.
pub(super) const MAX_STRIPS: usize = MOST_STRIPS as usize;

/// Angles that Eqs. (9) and (10) subtract, 7.2° and 9.82°, in radians.
const LIFT_PHASE: f64 = 7.2 / 180.0 * core::f64::consts::PI;
const DRAG_PHASE: f64 = 9.82 / 180.0 * core::f64::consts::PI;

impl Params {
    /// Presets for the paper's prototypes.
    pub(super) const PRESETS: &'static [Preset] = &[
        Preset {
            name: "arabagi2013-75hz",
            doc: "75 Hz prototype, 150 V peak to peak with 50 V bias (Arabagi, Hines and Sitti 2013); wing and actuator are assumed",
            values: || Params::arabagi2013_75hz().to_values(),
        },
        Preset {
            name: "arabagi2013-30hz",
            doc: "30 Hz prototype, 180 V peak to peak with 30 V bias (Arabagi, Hines and Sitti 2013); wing and actuator are assumed",
            values: || Params::arabagi2013_30hz().to_values(),
        },
    ];

    /// Returns the parameters of the 30 Hz system in Figs. 7 to 9 of the paper, with the links of the 75 Hz system.
    pub fn arabagi2013_30hz() -> Params {
        Params {
            drive_voltage_pp: 180.0,
            drive_bias: 30.0,
            drive_frequency: 30.0,
            actuator_length: 18e-3,
            crank_radius: 2.1e-3,
            hinge_stiffness: 20e-6,
            hinge_damping: 10e-9,
            wing_offset: 5e-3,
            wing_length: 32e-3,
            root_chord: 10e-3,
            wing_mass: 1.2803e-5,
            mass_centre_radius: 19.96e-3,
            mass_centre_depth: 1.533e-3,
            wing_inertia_span: 1.911e-10,
            wing_inertia_normal: 1.0273e-9,
            wing_inertia_chord: 8.362e-10,
            wing_inertia_product: -1.682e-11,
            // Materials, links and air are the same as in the 75 Hz system.
            ..Params::arabagi2013_75hz()
        }
    }

    /// Returns the chord (m) at the relative position `x`, which is 0 at the wing's root and 1 at the wing's
    /// tip. The chord comes from the table or from the polynomial.
    pub fn chord(&self, x: f64) -> f64 {
        if let Some(chord) = self.chords.chord(x) {
            return chord;
        }
        let terms =
            [self.chord_term_4, self.chord_term_3, self.chord_term_2, self.chord_term_1, self.chord_term_0];
        self.root_chord * terms.iter().fold(0.0, |sum, term| sum * x + term)
    }

    /// Returns the drive.
    pub(super) fn drive(&self) -> DriveConstants<f64> {
        let levels = self.stroke.levels([self.drive_bias, 0.5 * self.drive_voltage_pp]);
        DriveConstants::new(self.drive_frequency, &self.waveform, levels)
    }
}
