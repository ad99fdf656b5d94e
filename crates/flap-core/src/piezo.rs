//! Components of piezoelectric actuators: laminates and electrical losses.

use crate::parameter::Kind::Number;
use crate::parameter::Range::{NonNegative, Share};

/// Permittivity of free space (F/m). The permittivities in the presets are multiples of `EPSILON_0`.
pub(crate) const EPSILON_0: f64 = 8.854_187_812_8e-12;

/// One layer of a laminate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layer {
    /// Thickness (m).
    pub thickness: f64,
    /// Young's modulus along the beam (Pa).
    pub modulus: f64,
    /// Density (kg/m³).
    pub density: f64,
}

/// A beam of bonded layers. The lower face of the lowest layer is at the height z = 0. Equation numbers refer
/// to Ozaki and Hamaguchi (2018).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Laminate<const L: usize> {
    /// Heights of the layers' mid-planes (m): `z_i = Σ_{j≤i} t_j − t_i/2`.
    pub mid_planes: [f64; L],
    /// Height of the neutral axis (m), Eq. (8): z_c = Σ Eᵢ tᵢ zᵢ / Σ Eᵢ tᵢ.
    pub neutral_axis: f64,
    /// Bending stiffness per width (N·m), Eq. (10): S = Σ Eᵢ (tᵢ³/12 + tᵢ (zᵢ − z_c)²).
    pub bending_stiffness: f64,
    /// Mass per area (kg/m²): Σ ρᵢ tᵢ.
    pub areal_density: f64,
}

impl<const L: usize> Laminate<L> {
    /// Returns the laminate with the given layers, in order from the lowest to the highest layer.
    pub fn of(layers: [Layer; L]) -> Laminate<L> {
        let mut top = 0.0;
        let mid_planes = layers.map(|layer| {
            top += layer.thickness;
            top - 0.5 * layer.thickness
        });
        let (mut moment, mut membrane) = (0.0, 0.0);
        for (layer, z) in layers.iter().zip(mid_planes) {
            moment += layer.modulus * layer.thickness * z;
            membrane += layer.modulus * layer.thickness;
        }
        let neutral_axis = moment / membrane;
        let mut bending_stiffness = 0.0;
        for (layer, z) in layers.iter().zip(mid_planes) {
            let (t, arm) = (layer.thickness, z - neutral_axis);
            bending_stiffness += layer.modulus * (t * t * t / 12.0 + t * arm * arm);
        }
        let areal_density = layers.iter().map(|layer| layer.density * layer.thickness).sum();
        Laminate { mid_planes, neutral_axis, bending_stiffness, areal_density }
    }
}

crate::parameters! {
    /// Parameters for the dielectric loss of the actuator and for the charge recovery of the power supply.
    pub struct ElectricalParameters {
        /// Dielectric loss factor tan delta of the actuator. The loss adds the current G (V - mean of V) to
        /// the actuator's current, with the conductance G = w C tan delta. Here w is the angular drive
        /// frequency, C is the capacitance, and V is the voltage. Measured impedances of piezoelectric
        /// actuators correspond to a tan delta between 0.13 and 0.16 at large voltages.
        dielectric_loss: f64 = ("", "tan delta", Number(NonNegative), default: 0.0),
        /// Power that the power supply recovers, divided by the power that the actuator returns: from 0 to 1.
        /// The returned power flows from the actuator back to the power supply. The value of charge_recovery
        /// affects only the column power_supply_mw. In the circuit of Ozaki and Ohta (2020), the supply power
        /// with charge recovery was 58 % of the supply power without charge recovery. For a capacitive load,
        /// 58 % corresponds to a recovered fraction of 0.42.
        charge_recovery: f64 = ("", "r", Number(Share), default: 0.0),
    }
}

impl ElectricalParameters {
    /// No dielectric loss and no charge recovery.
    pub(crate) const NONE: ElectricalParameters =
        ElectricalParameters { dielectric_loss: 0.0, charge_recovery: 0.0 };

    /// Returns the conductance (S) equivalent to the dielectric loss of a `capacitance` (F) at the angular frequency
    /// `rate` (rad/s).
    pub(crate) fn conductance(&self, capacitance: f64, rate: f64) -> f64 {
        rate * capacitance * self.dielectric_loss
    }
}

/// Returns the mean power (W) that the supply delivers. The delivered power is the mean of the positive part
/// of the actuator's power, minus the recovered part of the returned power.
///
/// `mean` is the mean of the actuator's power, including negative values.
pub(crate) fn supplied(positive_mean: f64, mean: f64, recovery: f64) -> f64 {
    positive_mean - recovery * (positive_mean - mean)
}
