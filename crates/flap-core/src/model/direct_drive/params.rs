//! Parameters of the direct-drive model and their published values.

use crate::aero::{ChordTable, HarmonicParameters};
use crate::body::BodyParameters;
use crate::drive::{DriveConstants, StrokeParameters, WaveformParameters};
use crate::parameter::Kind::{Choice, Following, Number};
use crate::parameter::Preset;
use crate::parameter::Range::{Any, NonNegative, Positive};
use crate::piezo::{EPSILON_0, ElectricalParameters};
use crate::springs::HingeParameters;

crate::parameters! {
    /// Parameters of the direct-drive model, in SI units. The symbols are taken from Table A1 of Ozaki and
    /// Hamaguchi (2018).
    pub struct Params {
        ["drive"]
        /// Peak-to-peak drive voltage: twice V_0 of Ozaki and Hamaguchi (2018). If drive_shape is
        /// "harmonics", drive_voltage_pp is the peak-to-peak voltage of the fundamental alone.
        drive_voltage_pp: f64 = ("V", "2 V_0", Number(NonNegative)) 60.0,
        /// Constant part of the drive voltage. The drive voltage of Ozaki and Hamaguchi (2018) is V_0 sin(w t) + V_0.
        drive_bias: Option<f64> = ("V", "V_0", Following(Any, "half of drive_voltage_pp")) None,
        /// Drive frequency.
        drive_frequency: f64 = ("Hz", "f", Number(Positive)) 209.0,
        /// Parameters of the waveform.
        waveform: WaveformParameters = (flatten) WaveformParameters::SINE,
        /// Parameters of a prescribed stroke.
        stroke: StrokeParameters = (flatten) StrokeParameters::FREE,

        ["wing"]
        /// Wing length, from the root of the wing to the tip.
        wing_length: f64 = ("m", "R", Number(Positive)) 17.0e-3,
        /// Mean chord of the wing.
        mean_chord: f64 = ("m", "c", Number(Positive), scales_with: &[("wing_length", 1.0)]) 6.51e-3,
        /// Distance from the stroke axis to the root of the wing. Ozaki and Hamaguchi (2018) do not give the
        /// value of wing_offset.
        wing_offset: Option<f64> = ("m", "x_r", Following(Any, "half of actuator_length: the stroke axis is at mid-actuator")) None,
        /// Chord of the wing at half of the wing length, for flow_direction = "uniform". Ozaki and Hamaguchi
        /// (2018) do not give the value of midspan_chord.
        midspan_chord: Option<f64> = ("m", "c(R/2)", Following(Positive, "mean_chord")) None,
        /// Mass of the wing.
        wing_mass: f64 = ("kg", "M_w", Number(Positive), scales_with: &[("wing_length", 2.0)]) 2.31e-6,
        /// Distance of the wing's centre of mass from the root of the wing, along the span.
        mass_centre_span: f64 = ("m", "r_g", Number(Any), scales_with: &[("wing_length", 1.0)]) 9.42e-3,
        /// Chordwise position of the wing's centre of mass, positive towards the leading edge. The centre of
        /// mass of a real wing is behind the leading edge, so mass_centre_chord is negative. Ozaki and
        /// Hamaguchi (2018) print mass_centre_chord without the minus sign.
        mass_centre_chord: f64 = ("m", "y_g", Number(Any), scales_with: &[("wing_length", 1.0)]) -2.48e-3,
        /// Moment of inertia of the wing about the spanwise axis through its centre of mass.
        wing_inertia_span: f64 = ("kg*m^2", "J_wx", Number(NonNegative), scales_with: &[("wing_length", 4.0)]) 4.81e-12,
        /// Moment of inertia of the wing about the chordwise axis through its centre of mass.
        wing_inertia_chord: f64 = ("kg*m^2", "J_wy", Number(NonNegative), scales_with: &[("wing_length", 4.0)]) 5.07e-11,
        /// Product of inertia of the wing about its centre of mass, with the sign of Eq. (17).
        wing_inertia_product: f64 = ("kg*m^2", "J_wxy", Number(Any), scales_with: &[("wing_length", 4.0)]) 3.62e-13,
        /// Moment of inertia of the leading-edge part about the stroke axis.
        leading_edge_inertia: f64 = ("kg*m^2", "J_B", Number(NonNegative)) 3.89e-9,

        ["hinge"]
        /// Rotational stiffness of the wing hinge.
        hinge_stiffness: f64 = ("N*m/rad", "k_w", Number(Positive)) 1.48e-4,
        /// Viscous damping of the wing hinge. Ozaki and Hamaguchi (2018) do not use hinge_damping.
        hinge_damping: f64 = ("N*m*s", "", Number(NonNegative), default: 0.0) 0.0,
        /// Loss factor, stiffening, stop and dimensions of the hinge.
        hinge: HingeParameters = (flatten) HingeParameters::NONE,

        ["wing shape"]
        /// Direction of the flow in the translational forces: one direction for the whole wing ("uniform"),
        /// or one direction for each blade element ("blade"). With "uniform", the direction is computed from
        /// the mean velocity of the wing, as in Ozaki and Hamaguchi (2018). With "blade", the direction of
        /// the flow past each blade element is computed from the velocity of this element. With "blade", flap
        /// computes the shape moments, rotation_moment and midspan_chord from the chord shape, and ignores
        /// the values that you set for these parameters.
        flow_direction: FlowDirection = ("", "", Choice(FlowDirection::NAMES)) FlowDirection::Uniform,
        /// Chord shape for flow_direction = "blade": coefficient of the Legendre polynomial P_1(2r/R - 1) in
        /// chord / mean_chord. The constant term of the series of Legendre polynomials is 1. Ozaki and
        /// Hamaguchi (2018) give no chord shape, so the coefficients were fitted to the published shape
        /// moments.
        chord_legendre_1: f64 = ("", "a_1", Number(Any)) 0.0562,
        /// Chord shape for flow_direction = "blade": coefficient of the Legendre polynomial P_2(2r/R - 1) in chord /
        /// mean_chord. The coefficient was fitted to the shape moments of Ozaki and Hamaguchi (2018).
        chord_legendre_2: f64 = ("", "a_2", Number(Any)) -0.0913,
        /// Chord shape for flow_direction = "blade": coefficient of the Legendre polynomial P_3(2r/R - 1) in chord /
        /// mean_chord. The coefficient was fitted to the shape moments of Ozaki and Hamaguchi (2018).
        chord_legendre_3: f64 = ("", "a_3", Number(Any)) 0.176,
        /// Table of the chord. If chord_table is "on", flap computes mean_chord, midspan_chord, the shape
        /// moments and rotation_moment from the table, for every flow_direction.
        chords: ChordTable = (flatten) ChordTable::off(),
        /// Wing shape moment: normalised integral of chord^3 along the span, Eq. (22), for flow_direction = "uniform".
        shape_moment_03: f64 = ("", "I_w0,3", Number(Positive)) 1.02,
        /// Wing shape moment: normalised integral of chord^4 along the span, for flow_direction = "uniform".
        shape_moment_04: f64 = ("", "I_w0,4", Number(Positive)) 1.04,
        /// Wing shape moment: normalised integral of radius * chord^2 along the span, for flow_direction = "uniform".
        shape_moment_12: f64 = ("", "I_w1,2", Number(Positive)) 0.88,
        /// Wing shape moment: normalised integral of radius * chord^3 along the span, for flow_direction = "uniform".
        shape_moment_13: f64 = ("", "I_w1,3", Number(Positive)) 0.89,
        /// Wing shape moment: normalised integral of radius^2 * chord along the span, for flow_direction = "uniform".
        shape_moment_21: f64 = ("", "I_w2,1", Number(Positive)) 0.82,
        /// Wing shape moment: normalised integral of radius^2 * chord^2 along the span, for flow_direction = "uniform".
        shape_moment_22: f64 = ("", "I_w2,2", Number(Positive)) 0.84,
        /// Wing shape moment: normalised integral of radius^3 * chord along the span, for flow_direction = "uniform".
        shape_moment_31: f64 = ("", "I_w3,1", Number(Positive)) 0.85,
        /// Shape moment of the rotational drag, Eq. (33): integral of |y|^3 over the chord, averaged along
        /// the span, for flow_direction = "uniform".
        rotation_moment: f64 = ("m^4", "I_rd", Number(NonNegative), scales_with: &[("wing_length", 4.0)]) 4.68e-10,

        ["actuator"]
        /// Length of the actuator.
        actuator_length: f64 = ("m", "L_A", Number(Positive)) 10.5e-3,
        /// Width of the actuator at its root.
        actuator_root_width: f64 = ("m", "w_r", Number(Positive)) 6.0e-3,
        /// Width of the actuator at its tip.
        actuator_tip_width: f64 = ("m", "w_t", Number(NonNegative)) 2.4e-3,
        /// Thickness of the piezoelectric layer.
        piezo_thickness: f64 = ("m", "t_0", Number(Positive)) 100e-6,
        /// Thickness of the adhesive layer.
        adhesive_thickness: f64 = ("m", "t_1", Number(NonNegative)) 10e-6,
        /// Thickness of the shim.
        shim_thickness: f64 = ("m", "t_2", Number(NonNegative)) 100e-6,
        /// Young's modulus of the piezoelectric layer.
        piezo_modulus: f64 = ("Pa", "E_0", Number(Positive)) 14.3e9,
        /// Young's modulus of the adhesive layer.
        adhesive_modulus: f64 = ("Pa", "E_1", Number(NonNegative)) 5.0e9,
        /// Young's modulus of the shim. The value of shim_modulus is already halved because of the slits in the shim.
        shim_modulus: f64 = ("Pa", "E_2", Number(NonNegative)) 50.3e9,
        /// Density of the piezoelectric layer.
        piezo_density: f64 = ("kg/m^3", "rho_0", Number(NonNegative)) 8000.0,
        /// Density of the adhesive layer.
        adhesive_density: f64 = ("kg/m^3", "rho_1", Number(NonNegative)) 1500.0,
        /// Density of the shim. The value of shim_density is already halved because of the slits in the shim.
        shim_density: f64 = ("kg/m^3", "rho_2", Number(NonNegative)) 2250.0,
        /// Piezoelectric coefficient. If you change the sign of piezo_coefficient, the motion becomes its
        /// mirror image.
        piezo_coefficient: f64 = ("m/V", "d_pz", Number(Any)) 950e-12,
        /// Permittivity of the piezoelectric layer. Ozaki and Hamaguchi (2018) do not state if the permittivity is for
        /// a free or a clamped layer.
        piezo_permittivity: f64 = ("F/m", "eps_pz", Number(NonNegative)) 2920.0 * EPSILON_0,
        /// Cubic stiffness of the stroke. The actuator exerts an additional moment against the stroke:
        /// stroke_stiffening times the third power of the stroke angle. Ozaki and Hamaguchi (2018) do not use
        /// stroke_stiffening.
        stroke_stiffening: f64 = ("N*m/rad^3", "", Number(Any), default: 0.0) 0.0,
        /// Viscous damping of the stroke about the stroke axis. Ozaki and Hamaguchi (2018) do not use stroke_damping.
        stroke_damping: f64 = ("N*m*s", "", Number(NonNegative), default: 0.0) 0.0,
        /// Loss factor of the actuator, which is the spring of the stroke. The loss factor adds a viscous damping: loss
        /// factor times stiffness, divided by the angular drive frequency.
        stroke_loss_factor: f64 = ("", "gamma_s", Number(NonNegative), default: 0.0) 0.0,
        /// Dielectric loss and charge recovery.
        electrical: ElectricalParameters = (flatten) ElectricalParameters::NONE,
        /// Motion of the body.
        body: BodyParameters = (flatten) BodyParameters::REST,

        ["air"]
        /// Density of the air.
        air_density: f64 = ("kg/m^3", "rho_Air", Number(NonNegative)) 1.29,
        /// Lift coefficient of the wing at an attack angle of 45 deg. In the formula of the default value,
        /// the aspect ratio A is wing_length divided by mean_chord.
        lift_coefficient_max: Option<f64> = ("", "K_L", Following(NonNegative, "pi * A / (2 + sqrt(A^2 + 4)), Eq. (26)")) None,
        /// Drag coefficient of the wing at an attack angle of 90 deg.
        drag_coefficient_max: f64 = ("", "C_Dmax", Number(NonNegative)) 5.0,
        /// Drag coefficient of the wing at an attack angle of 0.
        drag_coefficient_min: f64 = ("", "C_Dmin", Number(NonNegative)) 0.4,
        /// Coefficient of the rotational drag, Eq. (32).
        rotation_drag: f64 = ("", "C_rd", Number(NonNegative)) 3.5,
        /// Shift of the centre of pressure in chords, per radian of attack angle, Eq. (24).
        pressure_slope: f64 = ("", "0.82/pi", Number(Any)) 0.82 / core::f64::consts::PI,
        /// Distance of the centre of pressure from the leading edge at an attack angle of 0, in chords, Eq. (24).
        pressure_offset: f64 = ("", "0.05", Number(Any)) 0.05,
        /// Terms that flap adds to the paper's formulas of the force coefficients and the centre of pressure.
        harmonics: HarmonicParameters = (flatten) HarmonicParameters::NONE,
        /// Factor that multiplies the rotational circulation of potential flow. With circulation_factor = 1,
        /// the circulation follows the theory of Kramer (1932) and Sane and Dickinson (2002). Ozaki and
        /// Hamaguchi (2018) do not use circulation_factor.
        circulation_factor: f64 = ("", "", Number(NonNegative), default: 0.0) 0.0,
        /// Factor that multiplies the force of the rotational drag along the wing's normal. With
        /// rotation_force_factor = 1, the force along the normal is consistent with the moment of the
        /// rotational drag in Eq. (32). Ozaki and Hamaguchi (2018) do not use rotation_force_factor.
        rotation_force_factor: f64 = ("", "", Number(NonNegative), default: 0.0) 0.0,

        ["readings of the paper"]
        /// Attack angle that determines the centre of pressure, Eq. (24): relative to the motion
        /// ("directional"), at most 90 deg ("folded"), or as printed ("literal"). With Eq. (24) as printed,
        /// the two half strokes are not mirror images of each other.
        centre_of_pressure: CentreOfPressure = ("", "", Choice(CentreOfPressure::NAMES)) CentreOfPressure::Directional,
        /// Moments of the added mass, Eqs. (28) to (30). With "paper", flap uses the moments of Ozaki and
        /// Hamaguchi (2018). With "lagrangian", flap adds the gyroscopic terms of a Lagrangian derivation.
        added_mass: AddedMass = ("", "", Choice(AddedMass::NAMES)) AddedMass::Paper,
        /// Sign of the added-mass term in the lift, Eq. (35): corrected ("corrected"), or as printed ("printed"). The
        /// option "printed" requires that circulation_factor and rotation_force_factor are zero.
        lift_sign: LiftSign = ("", "", Choice(LiftSign::NAMES)) LiftSign::Corrected,
    }

    /// Returns the parameters of the small robot in Table A1 of the paper, at the largest voltage and the frequency of
    /// Fig. 13.
    pub fn ozaki2018_small() -> Params;
}

crate::choice! {
    /// Choice between one direction of the air flow for the whole wing and one direction for each blade
    /// element.
    pub enum FlowDirection {
        /// One direction of the flow for the whole wing, computed from the mean velocity of the wing as in
        /// the paper.
        Uniform = "uniform",
        /// One direction of the flow for each blade element, computed from the velocity of this element.
        Blade = "blade",
    }
}

crate::choice! {
    /// Interpretations of Eq. (24), which differ in the attack angle on which the centre of pressure depends.
    pub enum CentreOfPressure {
        /// |π/2 − σψ| with σ the sign of the wing's velocity: the attack angle relative to the motion.
        Directional = "directional",
        /// π/2 − |ψ|: the attack angle is never above 90°.
        Folded = "folded",
        /// |π/2 − ψ|: the attack angle as printed, which breaks the mirror symmetry of the two half strokes.
        Literal = "literal",
    }
}

crate::choice! {
    /// Forms of the moments of the added mass, Eqs. (28)–(30).
    pub enum AddedMass {
        /// The moments that the paper gives.
        Paper = "paper",
        /// The moments with the gyroscopic terms of a Lagrangian derivation. The gyroscopic terms do no work.
        Lagrangian = "lagrangian",
    }
}

crate::choice! {
    /// Interpretations of Eq. (35), which differ in the sign of the added-mass term F_am sin ψ.
    pub enum LiftSign {
        /// The lift is F_tr − F_am sin ψ.
        Corrected = "corrected",
        /// The lift is F_tr + F_am sin ψ.
        Printed = "printed",
    }
}

impl Params {
    /// Published presets, and presets that test if the paper swaps the hinge stiffnesses of the two robots.
    pub(super) const PRESETS: &'static [Preset] = &[
        Preset {
            name: "ozaki2018-small",
            doc: "17.0 mm wing on a 10.5 mm actuator, 60 V peak to peak with 30 V bias at 209 Hz (Ozaki and Hamaguchi 2018, Table A1)",
            values: || Params::ozaki2018_small().to_values(),
        },
        Preset {
            name: "ozaki2018-large",
            doc: "32.4 mm wing on a 21.0 mm actuator, 100 V peak to peak with 50 V bias at 109 Hz (Ozaki and Hamaguchi 2018, Table A1)",
            values: || Params::ozaki2018_large().to_values(),
        },
        Preset {
            name: "ozaki2018-small-kw-swapped",
            doc: "HYPOTHESIS: ozaki2018-small with the k_w of the large type, as if the columns of k_w in Table A1 were swapped",
            values: || Params::ozaki2018_small().with_hinge_of(&Params::ozaki2018_large()).to_values(),
        },
        Preset {
            name: "ozaki2018-large-kw-swapped",
            doc: "HYPOTHESIS: ozaki2018-large with the k_w of the small type, as if the columns of k_w in Table A1 were swapped",
            values: || Params::ozaki2018_large().with_hinge_of(&Params::ozaki2018_small()).to_values(),
        },
    ];

    /// Returns the parameters of the large robot in Table A1 of the paper, at the largest voltage and the frequency of
    /// Fig. 14.
    pub fn ozaki2018_large() -> Params {
        Params {
            drive_voltage_pp: 100.0,
            drive_frequency: 109.0,
            wing_length: 32.4e-3,
            mean_chord: 8.34e-3,
            wing_mass: 4.09e-6,
            mass_centre_span: 15.6e-3,
            mass_centre_chord: -2.57e-3,
            wing_inertia_span: 1.03e-11,
            wing_inertia_chord: 2.70e-10,
            wing_inertia_product: 7.12e-12,
            leading_edge_inertia: 1.47e-8,
            hinge_stiffness: 8.64e-5,
            chord_legendre_1: -0.212,
            chord_legendre_2: -0.3696,
            chord_legendre_3: 0.0482,
            shape_moment_03: 1.12,
            shape_moment_04: 1.23,
            shape_moment_12: 0.84,
            shape_moment_13: 0.88,
            shape_moment_21: 0.75,
            shape_moment_22: 0.73,
            shape_moment_31: 0.74,
            rotation_moment: 1.49e-9,
            actuator_length: 21.0e-3,
            actuator_root_width: 10.4e-3,
            actuator_tip_width: 4.4e-3,
            shim_thickness: 130e-6,
            // Materials and air are the same as for the small type.
            ..Params::ozaki2018_small()
        }
    }

    /// Returns the distance x_r (m) from the stroke axis to the wing's root.
    pub(super) fn root_radius(&self) -> f64 {
        self.wing_offset.unwrap_or(0.5 * self.actuator_length)
    }

    /// Returns a copy of the parameters with the hinge stiffness of `other`.
    ///
    /// Presets with the hinge stiffness of the other robot test the hypothesis that Table A1 of the paper
    /// swaps the two values of k_w. The text of the paper neither proves nor disproves the swap of the two
    /// values.
    fn with_hinge_of(self, other: &Params) -> Params {
        Params { hinge_stiffness: other.hinge_stiffness, ..self }
    }

    /// Returns the drive.
    pub(super) fn drive(&self) -> DriveConstants<f64> {
        let half = 0.5 * self.drive_voltage_pp;
        let levels = self.stroke.levels([self.drive_bias.unwrap_or(half), half]);
        DriveConstants::new(self.drive_frequency, &self.waveform, levels)
    }
}
