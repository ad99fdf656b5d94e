//! Further terms of the force coefficients and of the centre of pressure, as functions of the attack angle. The papers
//! of the models do not contain these terms.

use crate::num::Real;
use crate::parameter::Kind::Number;
use crate::parameter::Range::Any;

crate::parameters! {
    /// Further terms of the force coefficients and of the centre of pressure.
    pub struct HarmonicParameters {
        /// Coefficient d_0 of the drag coefficient, which contains sin(2a)^2 (d_0 + d_1 cos(2a)) at the attack angle a.
        /// The term with d_0 is zero at attack angles of 0 and 90 deg, and equals d_0 at 45 deg. The paper of the model
        /// does not use drag_term_0.
        drag_term_0: f64 = ("", "d_0", Number(Any), default: 0.0),
        /// Coefficient d_1 of the drag coefficient, which contains sin(2a)^2 (d_0 + d_1 cos(2a)) at the attack angle a.
        /// The paper of the model does not use drag_term_1.
        drag_term_1: f64 = ("", "d_1", Number(Any), default: 0.0),
        /// Coefficient l_1 of the lift coefficient, which contains sin(2a) (l_1 cos(2a) + l_2 cos(2a)^2) at the attack
        /// angle a. The term with l_1 is zero at attack angles of 0, 45 and 90 deg. The paper of the model does not use
        /// lift_term_1.
        lift_term_1: f64 = ("", "l_1", Number(Any), default: 0.0),
        /// Coefficient l_2 of the lift coefficient, which contains sin(2a) (l_1 cos(2a) + l_2 cos(2a)^2) at the attack
        /// angle a. The paper of the model does not use lift_term_2.
        lift_term_2: f64 = ("", "l_2", Number(Any), default: 0.0),
        /// Coefficient p_c0 of the centre of pressure, which contains sin(2a) (p_c0 + p_c1 cos(2a)) at the attack angle
        /// a. The unit of p_c0 is the unit of the other parameters of the centre of pressure. The term with p_c0 is
        /// zero at attack angles of 0 and 90 deg, and equals p_c0 at 45 deg. The paper of the model does not use
        /// pressure_term_0.
        pressure_term_0: f64 = ("", "p_c0", Number(Any), default: 0.0),
        /// Coefficient p_c1 of the centre of pressure, which contains sin(2a) (p_c0 + p_c1 cos(2a)) at the attack angle
        /// a. The paper of the model does not use pressure_term_1.
        pressure_term_1: f64 = ("", "p_c1", Number(Any), default: 0.0),
    }
}

impl HarmonicParameters {
    /// No further terms, as in the papers of the models.
    pub(crate) const NONE: HarmonicParameters = HarmonicParameters {
        drag_term_0: 0.0,
        drag_term_1: 0.0,
        lift_term_1: 0.0,
        lift_term_2: 0.0,
        pressure_term_0: 0.0,
        pressure_term_1: 0.0,
    };
}

crate::per_lane! {
    /// Further terms of the force coefficients and of the centre of pressure, as functions of the attack angle α.
    ///
    /// The sum of the terms and the law b₁ + b₂ cos 2α or b_L sin 2α is a Fourier series with three harmonics. The
    /// terms have the symmetries of a flat plate in reversed flow. The drag is equal at the attack angles α and π − α.
    /// The lift, and the shift of the centre of pressure from the mid-chord, have opposite signs at α and π − α.
    pub struct Harmonics<R> {
        /// Coefficients d₀ and d₁ of the terms of the drag coefficient.
        pub drag: [R; 2],
        /// Coefficients l₁ and l₂ of the terms of the lift coefficient.
        pub lift: [R; 2],
        /// Coefficients p₀ and p₁ of the terms of the centre of pressure.
        pub pressure: [R; 2],
    }
}

impl Harmonics<f64> {
    /// Returns the terms for the parameters of a point.
    pub(crate) fn of(p: &HarmonicParameters) -> Harmonics<f64> {
        Harmonics {
            drag: [p.drag_term_0, p.drag_term_1],
            lift: [p.lift_term_1, p.lift_term_2],
            pressure: [p.pressure_term_0, p.pressure_term_1],
        }
    }
}

impl<R: Real> Harmonics<R> {
    /// Returns the terms of the drag coefficient at cos 2α: sin² 2α (d₀ + d₁ cos 2α).
    #[inline(always)]
    pub(crate) fn drag(&self, cos: R) -> R {
        let [d_0, d_1] = self.drag;
        (cos.lit(1.0) - cos * cos) * (d_0 + d_1 * cos)
    }

    /// Returns the terms of the lift coefficient, divided by sin 2α, at cos 2α: l₁ cos 2α + l₂ cos² 2α.
    #[inline(always)]
    pub(crate) fn lift(&self, cos: R) -> R {
        let [l_1, l_2] = self.lift;
        (l_1 + l_2 * cos) * cos
    }

    /// Returns the terms of the centre of pressure at the angle 2α (rad): sin 2α (p₀ + p₁ cos 2α).
    #[inline(always)]
    pub(crate) fn pressure(&self, twice: R) -> R {
        let [p_0, p_1] = self.pressure;
        let (sin, cos) = twice.sin_cos();
        sin * (p_0 + p_1 * cos)
    }
}
