//! Losses of springs, and the size of a wing hinge.

use crate::parameter::Kind::{Following, Number};
use crate::parameter::Range::{NonNegative, Positive};

/// Damping that stands for the loss factor γ of a spring of `stiffness` k, at the angular frequency `rate` ω (rad/s): γ k/ω.
///
/// That is exact for the first harmonic of a periodic motion. Lynch, Gau, Sponberg and Gravish 2021 measured such losses in
/// insects' thoraxes and in robots' hinges.
pub(crate) fn structural_damping(loss_factor: f64, stiffness: f64, rate: f64) -> f64 {
    loss_factor * stiffness / rate
}

crate::parameters! {
    /// Loss factor and size of the wing hinge.
    pub struct HingeParameters {
        /// Loss factor of the wing hinge: a damping of loss factor times stiffness over the drive's angular frequency.
        hinge_loss_factor: f64 = ("", "gamma_h", Number(NonNegative), default 0.0),
        /// Thickness of the hinge's flexure. For hinge_strain_max alone.
        hinge_thickness: Option<f64> = ("m", "t_h", Following(Positive, "nothing: hinge_strain_max is empty without it")),
        /// Length of the hinge's flexure from one rigid part to the other. For hinge_strain_max alone.
        hinge_length: Option<f64> = ("m", "l_h", Following(Positive, "nothing: hinge_strain_max is empty without it")),
    }
}

impl HingeParameters {
    /// No loss, and no size.
    pub(crate) const NONE: HingeParameters =
        HingeParameters { hinge_loss_factor: 0.0, hinge_thickness: None, hinge_length: None };

    /// The damping (N·m·s) that stands for the loss factor of a hinge of this `stiffness` (N·m/rad) at the angular frequency
    /// `rate` (rad/s).
    pub(crate) fn damping(&self, stiffness: f64, rate: f64) -> f64 {
        structural_damping(self.hinge_loss_factor, stiffness, rate)
    }

    /// Strain of the flexure's faces per hinge angle (1/rad), bent to an arc of a circle: thickness over twice the length.
    /// Zero if the size is not known.
    pub(crate) fn strain_per_angle(&self) -> f64 {
        match (self.hinge_thickness, self.hinge_length) {
            (Some(thickness), Some(length)) => 0.5 * thickness / length,
            _ => 0.0,
        }
    }
}
