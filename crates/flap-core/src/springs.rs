//! Springs of the stroke and of the wing hinge: losses, stiffening, and the stop of the hinge.

use core::f64::consts::FRAC_PI_3;

use crate::num::Real;
use crate::parameter::Kind::{Following, Number};
use crate::parameter::Range::{Any, NonNegative, Positive};

/// Returns the viscous damping γ k/ω that causes the same loss as the loss factor γ of a spring.
///
/// Here k is the `stiffness` of the spring, and ω is the angular frequency `rate` (rad/s). The damping and
/// the loss factor cause equal losses for the first harmonic of a periodic motion. Lynch, Gau, Sponberg and
/// Gravish (2021) measured loss factors of insect thoraxes and robot hinges.
pub(crate) fn structural_damping(loss_factor: f64, stiffness: f64, rate: f64) -> f64 {
    loss_factor * stiffness / rate
}

crate::parameters! {
    /// Parameters of the wing hinge: loss factor, cubic stiffness, stop and dimensions.
    pub struct HingeParameters {
        /// Loss factor of the wing hinge. The loss factor adds a viscous damping: the loss factor times the
        /// stiffness, divided by the angular drive frequency.
        hinge_loss_factor: f64 = ("", "gamma_h", Number(NonNegative), default: 0.0),
        /// Cubic stiffness of the wing hinge. The hinge exerts an additional moment against the pitch:
        /// hinge_stiffening times the third power of the pitch.
        hinge_stiffening: f64 = ("N*m/rad^3", "", Number(Any), default: 0.0),
        /// Magnitude of the pitch at which the stop of the wing hinge begins to act. The stop acts in both
        /// directions of the pitch.
        hinge_stop_angle: f64 = ("rad", "", Number(NonNegative), default: FRAC_PI_3),
        /// Stiffness of the stop of the hinge. Beyond hinge_stop_angle, the stop adds hinge_stop_stiffness to the
        /// stiffness of the hinge.
        hinge_stop_stiffness: f64 = ("N*m/rad", "", Number(NonNegative), default: 0.0),
        /// Thickness of the flexure of the wing hinge. The thickness affects only the column hinge_strain_max.
        hinge_thickness: Option<f64> = ("m", "t_h", Following(Positive, "nothing: hinge_strain_max is empty")),
        /// Length of the flexure of the wing hinge, between the rigid parts. The length affects only the column
        /// hinge_strain_max.
        hinge_length: Option<f64> = ("m", "l_h", Following(Positive, "nothing: hinge_strain_max is empty")),
    }
}

/// Exponents of thickness t and length l in the stiffness E w t^3 / (12 l) of a bending flexure.
pub(crate) const FLEXURE: &[(&str, f64)] = &[("hinge_thickness", 3.0), ("hinge_length", -1.0)];

impl HingeParameters {
    /// A hinge with a linear spring, without loss and without known dimensions.
    pub(crate) const NONE: HingeParameters = HingeParameters {
        hinge_loss_factor: 0.0,
        hinge_stiffening: 0.0,
        hinge_stop_angle: FRAC_PI_3,
        hinge_stop_stiffness: 0.0,
        hinge_thickness: None,
        hinge_length: None,
    };

    /// Returns the viscous damping that causes the same loss as the loss factor of the hinge (N·m·s).
    /// `stiffness` is the stiffness of the hinge (N·m/rad), and `rate` is the angular frequency (rad/s).
    pub(crate) fn damping(&self, stiffness: f64, rate: f64) -> f64 {
        structural_damping(self.hinge_loss_factor, stiffness, rate)
    }

    /// Returns the strain at the surface of the hinge's flexure per pitch angle (1/rad): the thickness
    /// divided by twice the length.
    ///
    /// The flexure is assumed to bend to an arc of a circle. The strain is zero if the dimensions of the flexure are
    /// not set.
    pub(crate) fn strain_per_angle(&self) -> f64 {
        match (self.hinge_thickness, self.hinge_length) {
            (Some(thickness), Some(length)) => 0.5 * thickness / length,
            _ => 0.0,
        }
    }
}

crate::per_lane! {
    /// Nonlinear parts of the springs of the stroke and of the wing hinge. The papers of the models contain
    /// only linear springs.
    pub struct Stiffening<R> {
        /// Cubic stiffness of the stroke k₃ (N·m/rad³).
        pub stroke: R,
        /// Cubic stiffness of the hinge κ₃ (N·m/rad³).
        pub hinge: R,
        /// Pitch ψ_s at which the stop of the hinge begins to act (rad).
        pub stop_angle: R,
        /// Stiffness of the stop κ_s (N·m/rad).
        pub stop_stiffness: R,
    }
}

impl Stiffening<f64> {
    /// Returns the nonlinear parts of the springs, given the cubic stiffness of the stroke (N·m/rad³) and the
    /// parameters of the hinge.
    pub(crate) fn of(stroke: f64, hinge: &HingeParameters) -> Stiffening<f64> {
        Stiffening {
            stroke,
            hinge: hinge.hinge_stiffening,
            stop_angle: hinge.hinge_stop_angle,
            stop_stiffness: hinge.hinge_stop_stiffness,
        }
    }

    /// Returns true if the springs are linear.
    pub(crate) fn is_zero(&self) -> bool {
        self.stroke == 0.0 && self.hinge == 0.0 && self.stop_stiffness == 0.0
    }
}

impl<R: Real> Stiffening<R> {
    /// Returns the nonlinear moment k₃ φ³ of the stroke's spring about the stroke axis (N·m). The moment acts
    /// against the stroke φ (rad).
    #[inline(always)]
    pub(crate) fn stroke_moment(&self, stroke: R) -> R {
        self.stroke * stroke * (stroke * stroke)
    }

    /// Returns the nonlinear moment of the hinge's spring about the axis of the hinge (N·m). The moment acts
    /// against the pitch ψ (rad):
    ///
    /// ```text
    /// κ₃ ψ³ + κ_s max(|ψ| − ψ_s, 0) sign ψ
    /// ```
    #[inline(always)]
    pub(crate) fn hinge_moment(&self, pitch: R) -> R {
        let beyond = (pitch.abs() - self.stop_angle).max(pitch.lit(0.0));
        self.hinge * pitch * (pitch * pitch) + self.stop_stiffness * beyond.copysign(pitch)
    }
}
