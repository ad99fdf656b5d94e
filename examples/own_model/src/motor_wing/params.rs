//! Parameters of the motor-driven wing and their published values.

use flap_core::parameter::Kind::{Following, Number};
use flap_core::parameter::Preset;
use flap_core::parameter::Range::{NonNegative, Positive};

flap_core::parameters! {
    /// Parameters of the motor-driven wing, in SI units.
    pub struct Params {
        /// Amplitude of the drive voltage.
        drive_voltage: f64 = ("V", "V", Number(NonNegative)),
        /// Drive frequency.
        drive_frequency: f64 = ("Hz", "f", Number(Positive)),

        /// Resistance of the motor's winding.
        resistance: f64 = ("Ohm", "R_a", Number(Positive)),
        /// Inductance of the motor's winding.
        inductance: f64 = ("H", "L_a", Number(Positive)),
        /// Torque per current.
        torque_constant: f64 = ("N*m/A", "K_t", Number(NonNegative)),
        /// Back-EMF voltage of the motor per angular rate of the shaft.
        back_emf_constant: Option<f64> = ("V*s/rad", "K_b", Following(NonNegative, "torque_constant")),
        /// Inertia of the motor's rotor.
        rotor_inertia: f64 = ("kg*m^2", "J_m", Number(NonNegative)),
        /// Damping torque of the bearing per rate of the shaft.
        bearing_damping: f64 = ("N*m*s/rad", "b_m", Number(NonNegative)),
        /// Stiffness of the spring between wing and frame.
        spring_stiffness: Option<f64> = ("N*m/rad", "K", Following(NonNegative, "inertia x (2 pi drive_frequency)^2: the wing is in resonance")),

        /// Length of the wing beyond its base.
        wing_length: f64 = ("m", "L_e", Number(Positive)),
        /// Chord at the root; the chord decreases to zero at the tip as a quarter of an ellipse.
        root_chord: Option<f64> = ("m", "L_c", Following(Positive, "a third of wing_length")),
        /// Length of the base between the two sides of the wing. The shaft is at the middle of the base.
        base_length: f64 = ("m", "L_b", Number(NonNegative)),
        /// Width of the base.
        base_width: f64 = ("m", "w_b", Number(NonNegative)),
        /// Height of the base.
        base_height: f64 = ("m", "h_b", Number(NonNegative)),
        /// Cross-section of the spars.
        spar_section: f64 = ("m^2", "A", Number(NonNegative)),
        /// Density of base and spars.
        spar_density: f64 = ("kg/m^3", "rho_c", Number(NonNegative)),
        /// Density of the membrane.
        membrane_density: f64 = ("kg/m^3", "rho_m", Number(NonNegative)),
        /// Thickness of the membrane.
        membrane_thickness: f64 = ("m", "t_m", Number(NonNegative)),
        /// Density of the air.
        air_density: f64 = ("kg/m^3", "rho", Number(NonNegative)),
        /// Decrease of the attack angle per flap rate; the attack angle is at least 45°.
        attack_slope: f64 = ("s", "C_alpha", Number(NonNegative)),
    }
}

impl Params {
    /// The published operating points.
    pub(super) const PRESETS: &'static [Preset] = &[
        Preset {
            name: "park2024-5v",
            doc: "operating point at 5 V and 23.89 Hz (Park and Abolfathi 2024)",
            values: || Params::park2024(5.0, 23.89, 68.46e-3).to_values(),
        },
        Preset {
            name: "park2024-3v",
            doc: "operating point at 3 V and 35.67 Hz (Park and Abolfathi 2024)",
            values: || Params::park2024(3.0, 35.67, 60.49e-3).to_values(),
        },
    ];

    /// Returns parameters with the published motor and materials, and with the given voltage (V), frequency
    /// (Hz) and wing length (m).
    pub(crate) fn park2024(drive_voltage: f64, drive_frequency: f64, wing_length: f64) -> Params {
        Params {
            drive_voltage,
            drive_frequency,
            resistance: 9.0,
            inductance: 29e-3,
            torque_constant: 0.010,
            back_emf_constant: None,
            rotor_inertia: 1.5e-7,
            bearing_damping: 3.6e-6,
            spring_stiffness: None,
            wing_length,
            root_chord: None,
            base_length: 10e-3,
            base_width: 5e-3,
            base_height: 1e-3,
            spar_section: 1e-6,
            spar_density: 1900.0,
            membrane_density: 1100.0,
            membrane_thickness: 25e-6,
            air_density: 1.225,
            attack_slope: 5e-3,
        }
    }
}
