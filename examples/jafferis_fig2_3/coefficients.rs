//! Lift and drag coefficients of a wing as functions of the pitch (Fig. 3).

use flap_core::num::Real;

/// Quasi-steady lift and drag coefficients as functions of the pitch ψ. The pitch ψ is 90° minus the attack
/// angle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Coefficients {
    /// Amplitude of the lift coefficient.
    pub(crate) lift: f64,
    /// Mean of the drag coefficient.
    pub(crate) drag_mean: f64,
    /// Half of the difference between the largest and the smallest drag coefficient.
    pub(crate) drag_swing: f64,
}

/// The coefficients of Fig. 3: lift 1.8 sin 2ψ, and drag 1.9 + 1.5 cos 2ψ.
pub(crate) const FIG_3: Coefficients = Coefficients { lift: 1.8, drag_mean: 1.9, drag_swing: 1.5 };

impl Coefficients {
    /// Returns the lift coefficient for a value of sin 2ψ.
    #[inline(always)]
    pub(crate) fn lift<R: Real>(&self, sin_2psi: R) -> R {
        sin_2psi * self.lift
    }

    /// Returns the drag coefficient for a value of cos 2ψ.
    #[inline(always)]
    pub(crate) fn drag<R: Real>(&self, cos_2psi: R) -> R {
        cos_2psi * self.drag_swing + self.drag_mean
    }

    /// Returns the coefficient of the force that is perpendicular to the wing and rotates the wing about the
    /// hinge. The coefficient is the expression in brackets in Eq. (10).
    #[inline(always)]
    pub(crate) fn normal<R: Real>(&self, sin: R, cos: R) -> R {
        self.drag(cos * cos * 2.0 - 1.0) * cos + self.lift(sin * cos * 2.0) * sin
    }

    /// Returns the lift-to-drag ratio at the pitch `degrees`.
    pub(crate) fn lift_to_drag(&self, degrees: f64) -> f64 {
        let (sin_2psi, cos_2psi) = (2.0 * degrees).to_radians().sin_cos();
        self.lift(sin_2psi) / self.drag(cos_2psi)
    }

    /// Returns the mean lift coefficient of a wing in sinusoidal flapping, weighted with the square of the
    /// speed.
    ///
    /// The largest pitch is `degrees`, in the middle of each half stroke, where the wing is fastest.
    pub(crate) fn mean_lift(&self, degrees: f64) -> f64 {
        let instants = 400;
        let weighted: f64 = (0..instants)
            .map(|i| {
                let phase = (f64::from(i) + 0.5) / f64::from(instants) * std::f64::consts::PI;
                let speed = phase.sin();
                speed * speed * self.lift((2.0 * degrees.to_radians() * speed).sin())
            })
            .sum();
        2.0 * weighted / f64::from(instants)
    }
}

/// Returns the pitch (deg, in steps of 0.01) at which a curve is highest, and the value of the curve at this
/// pitch.
pub(crate) fn highest(curve: impl Fn(f64) -> f64) -> (f64, f64) {
    (0..9000)
        .map(|i| 0.01 * f64::from(i))
        .map(|degrees| (degrees, curve(degrees)))
        .fold((0.0, f64::NEG_INFINITY), |best, next| if next.1 > best.1 { next } else { best })
}
