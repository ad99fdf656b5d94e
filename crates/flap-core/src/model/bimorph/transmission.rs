//! The transmission of the bimorph model. The transmission ratio is constant, or grows with the square of the
//! displacement of the actuator's tip.
//!
//! ```text
//! φ = T x + T₃ x³/3     φ̇ = T(x) ẋ     T(x) = T + T₃ x²
//! ```
//!
//! In the paper the transmission ratio is constant. Lagrange's equation for x with a moment M_φ about the stroke axis
//! is:
//!
//! ```text
//! (m_a + J T(x)²) ẍ + J T(x) T′(x) ẋ² = F(x) + T(x) M_φ     T′(x) = 2 T₃ x
//! ```

use super::constants::Constants;
use crate::num::Real;

/// Dependence of the transmission ratio on the displacement of the actuator's tip.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Law {
    /// T(x) = T.
    Constant,
    /// T(x) = T + T₃ x².
    Square,
}

/// Transmission ratio at one displacement of the actuator's tip, divided by the transmission ratio T at rest.
#[derive(Clone, Copy, Debug)]
pub(super) enum Transmission<R> {
    /// T(x) = T.
    Constant,
    /// T(x) = T t with t = 1 + τ x², τ = T₃/T.
    Square {
        /// t.
        ratio: R,
        /// t′ = 2 τ x (1/m).
        slope: R,
    },
}

impl<R: Real> Transmission<R> {
    /// Returns the transmission at the displacement `x` (m).
    #[inline(always)]
    pub(super) fn at(c: &Constants<R>, law: Law, x: R) -> Transmission<R> {
        match law {
            Law::Constant => Transmission::Constant,
            Law::Square => {
                let half_slope = c.ratio_growth * x;
                Transmission::Square { ratio: half_slope.mul_add(x, x.lit(1.0)), slope: half_slope * 2.0 }
            }
        }
    }

    /// Returns `number` times the relative transmission ratio t. If `number` is ẋ, the result is φ̇/T (m/s).
    /// If `number` is T times a moment about the stroke axis, the result is the equivalent force at the
    /// actuator's tip (N).
    #[inline(always)]
    pub(super) fn times(&self, number: R) -> R {
        match *self {
            Transmission::Constant => number,
            Transmission::Square { ratio, .. } => ratio * number,
        }
    }

    /// Returns the acceleration of the actuator's tip (m/s²) for a `force` (N) on the tip: `ẍ = (F − J T T′ ẋ²)/(m_a +
    /// J T²)`.
    #[inline(always)]
    pub(super) fn acceleration(&self, c: &Constants<R>, force: R, x_dot: R) -> R {
        match *self {
            Transmission::Constant => force * c.inverse_m_e,
            Transmission::Square { ratio, slope } => {
                let inertia = c.stroke_mass * ratio;
                (force - inertia * slope * x_dot * x_dot) / (inertia * ratio + c.tip_mass)
            }
        }
    }

    /// Returns φ̈/T, the acceleration of the stroke divided by the transmission ratio at rest (m/s²): `t ẍ +
    /// t′ ẋ²`.
    #[inline(always)]
    pub(super) fn stroke_acceleration(&self, x_ddot: R, x_dot: R) -> R {
        match *self {
            Transmission::Constant => x_ddot,
            Transmission::Square { ratio, slope } => ratio * x_ddot + slope * x_dot * x_dot,
        }
    }
}

/// Returns the stroke φ (rad) at the displacement `x` (m) of the actuator's tip.
#[inline(always)]
pub(super) fn stroke<R: Real>(c: &Constants<R>, law: Law, x: R) -> R {
    match law {
        Law::Constant => c.ratio * x,
        Law::Square => c.ratio * x * (c.ratio_growth * x * x * (1.0 / 3.0) + 1.0),
    }
}

impl Constants<f64> {
    /// Returns the displacement (m) of the actuator's tip at a stroke angle (rad).
    ///
    /// The function inverts [`stroke`]. If the transmission ratio is zero at some displacements, the result
    /// lies between these displacements.
    pub(super) fn tip(&self, stroke: f64) -> f64 {
        let tau = self.ratio_growth;
        let linear = stroke / self.ratio;
        if tau == 0.0 {
            return linear;
        }
        // Newton's iteration on x + τ x³/3. It starts below the root if the function is convex, above it if concave.
        let limit = if tau < 0.0 { (-1.0 / tau).sqrt() } else { f64::INFINITY };
        let mut x = linear.clamp(-limit, limit);
        for _ in 0..60 {
            let step = (x + tau * x * x * x / 3.0 - linear) / (1.0 + tau * x * x);
            if !step.is_finite() || step.abs() <= f64::EPSILON * x.abs() {
                break;
            }
            x = (x - step).clamp(-limit, limit);
        }
        x
    }
}
