//! Force coefficients and centre of pressure as further functions of the attack angle, for laws that no paper has.

use crate::num::Real;
use crate::parameter::Kind::Number;
use crate::parameter::Range::Any;

crate::parameters! {
    /// Further terms of the force coefficients and of the centre of pressure.
    pub struct HarmonicParameters {
        /// Coefficient d_0 of the drag coefficient, which contains sin(2a)^2 (d_0 + d_1 cos(2a)) at the attack angle a.
        /// The term is zero at 0 and at 90 deg, and equals d_0 at 45 deg. The paper of the model does not use this
        /// parameter.
        drag_term_0: f64 = ("", "d_0", Number(Any), default: 0.0),
        /// Coefficient d_1 of the drag coefficient, which contains sin(2a)^2 (d_0 + d_1 cos(2a)) at the attack angle a. The
        /// paper of the model does not use this parameter.
        drag_term_1: f64 = ("", "d_1", Number(Any), default: 0.0),
        /// Coefficient l_1 of the lift coefficient, which contains sin(2a) (l_1 cos(2a) + l_2 cos(2a)^2) at the attack angle
        /// a. The term is zero at 0, 45 and 90 deg. The paper of the model does not use this parameter.
        lift_term_1: f64 = ("", "l_1", Number(Any), default: 0.0),
        /// Coefficient l_2 of the lift coefficient, which contains sin(2a) (l_1 cos(2a) + l_2 cos(2a)^2) at the attack angle
        /// a. The paper of the model does not use this parameter.
        lift_term_2: f64 = ("", "l_2", Number(Any), default: 0.0),
        /// Coefficient p_c0 of the centre of pressure, which contains sin(2a) (p_c0 + p_c1 cos(2a)) at the attack angle a.
        /// The unit is the same as for the other parameters of the centre of pressure. The term is zero at 0 and 90 deg, and p_c0 at
        /// 45 deg.
        /// The paper of the model does not use this parameter.
        pressure_term_0: f64 = ("", "p_c0", Number(Any), default: 0.0),
        /// Coefficient p_c1 of the centre of pressure, which contains sin(2a) (p_c0 + p_c1 cos(2a)) at the attack angle a. The
        /// paper of the model does not use this parameter.
        pressure_term_1: f64 = ("", "p_c1", Number(Any), default: 0.0),
    }
}

impl HarmonicParameters {
    /// The laws of the papers.
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
    /// Terms of the force coefficients and of the centre of pressure that no paper has, at an attack angle α.
    ///
    /// Together with a law b₁ + b₂ cos 2α or b_L sin 2α, the terms are Fourier series with three harmonics. The terms have
    /// the symmetries of a flat plate in reversed flow. At π − α, the drag is the same. The lift and the shift of the centre
    /// of pressure from the mid-chord change their signs.
    pub struct Harmonics<R> {
        /// Terms of the drag coefficient: d₀, d₁.
        pub drag: [R; 2],
        /// Terms of the lift coefficient: l₁, l₂.
        pub lift: [R; 2],
        /// Terms of the centre of pressure: p₀, p₁.
        pub pressure: [R; 2],
    }
}

impl Harmonics<f64> {
    /// Returns the terms of a point.
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

    /// Returns the terms of the lift coefficient per sin 2α at cos 2α: l₁ cos 2α + l₂ cos² 2α.
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
