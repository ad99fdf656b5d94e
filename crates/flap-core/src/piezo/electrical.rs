//! Losses of the actuator's dielectric, and the supply that drives it.

use crate::parameter::Kind::Number;
use crate::parameter::Range::{NonNegative, Share};

crate::parameters! {
    /// Dielectric loss, and what the supply recovers.
    pub struct ElectricalParameters {
        /// Dielectric loss of the actuator, tan delta: takes the current G (V - mean of V) with G = w C tan delta. Measured impedances of such plates give 0.13 to 0.16 at large signals.
        dielectric_loss: f64 = ("", "tan delta", Number(NonNegative), default 0.0),
        /// Share of the power returned by the actuator that the supply recovers. Acts on power_supply_mw alone. Ozaki and Ohta 2020 measured 0.58 on a capacitive load.
        charge_recovery: f64 = ("", "r", Number(Share), default 0.0),
    }
}

impl ElectricalParameters {
    /// No loss and no recovery.
    pub const NONE: ElectricalParameters =
        ElectricalParameters { dielectric_loss: 0.0, charge_recovery: 0.0 };

    /// Conductance (S) of a `capacitance` (F) at the angular frequency `rate` (rad/s).
    pub fn conductance(&self, capacitance: f64, rate: f64) -> f64 {
        rate * capacitance * self.dielectric_loss
    }
}

/// Mean power (W) that a supply delivers: of the positive part, less a share of what it takes back. `mean` is the mean of
/// both.
///
/// ```
/// use flap_core::piezo::supplied;
/// // It delivers 3 W on the mean and takes 2 W back, of which it recovers none, half, all.
/// assert_eq!([0.0, 0.5, 1.0].map(|recovery| supplied(3.0, 1.0, recovery)), [3.0, 2.0, 1.0]);
/// ```
pub fn supplied(positive_mean: f64, mean: f64, recovery: f64) -> f64 {
    positive_mean - recovery * (positive_mean - mean)
}
