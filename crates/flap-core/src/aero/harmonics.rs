//! Terms that flap can add to a model's force coefficients and centre of pressure, as functions of the attack
//! angle. The papers of the models do not contain the additional terms.

use crate::num::Real;
use crate::parameter::Kind::Number;
use crate::parameter::Range::Any;

crate::parameters! {
    /// Coefficients of terms that flap adds to the force coefficients and the centre of pressure of a model.
    pub struct HarmonicParameters {
        /// Coefficient d_0 of the terms sin(2a)^2 (d_0 + d_1 cos(2a)), which flap adds to the drag
        /// coefficient. Here a is the attack angle. The term with d_0 is zero at attack angles of 0 and 90
        /// deg, and equals d_0 at 45 deg. The paper of the model does not use drag_term_0.
        drag_term_0: f64 = ("", "d_0", Number(Any), default: 0.0),
        /// Coefficient d_1 of the terms sin(2a)^2 (d_0 + d_1 cos(2a)), which flap adds to the drag
        /// coefficient. Here a is the attack angle. The paper of the model does not use drag_term_1.
        drag_term_1: f64 = ("", "d_1", Number(Any), default: 0.0),
        /// Coefficient l_1 of the terms sin(2a) (l_1 cos(2a) + l_2 cos(2a)^2), which flap adds to the lift
        /// coefficient. Here a is the attack angle. The term with l_1 is zero at attack angles of 0, 45 and
        /// 90 deg. The paper of the model does not use lift_term_1.
        lift_term_1: f64 = ("", "l_1", Number(Any), default: 0.0),
        /// Coefficient l_2 of the terms sin(2a) (l_1 cos(2a) + l_2 cos(2a)^2), which flap adds to the lift
        /// coefficient. Here a is the attack angle. The paper of the model does not use lift_term_2.
        lift_term_2: f64 = ("", "l_2", Number(Any), default: 0.0),
        /// Coefficient p_c0 of the terms sin(2a) (p_c0 + p_c1 cos(2a)), which flap adds to the position of
        /// the centre of pressure. Here a is the attack angle. The unit of p_c0 is the unit of the model's
        /// other parameters for the position of the centre of pressure. The term with p_c0 is zero at attack
        /// angles of 0 and 90 deg, and equals p_c0 at 45 deg. The paper of the model does not use
        /// pressure_term_0.
        pressure_term_0: f64 = ("", "p_c0", Number(Any), default: 0.0),
        /// Coefficient p_c1 of the terms sin(2a) (p_c0 + p_c1 cos(2a)), which flap adds to the position of
        /// the centre of pressure. Here a is the attack angle. The paper of the model does not use
        /// pressure_term_1.
        pressure_term_1: f64 = ("", "p_c1", Number(Any), default: 0.0),
    }
}

impl HarmonicParameters {
    /// All coefficients are zero, as in the papers of the models.
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
    /// Coefficients of the terms that flap adds to the force coefficients and the centre of pressure at the
    /// attack angle α.
    ///
    /// With the additional terms, the drag coefficient and the lift coefficient are Fourier series in 2α with
    /// three harmonics. If the flow along the chord of a flat plate reverses, the attack angle changes from α
    /// to π − α. The drag is equal at the attack angles α and π − α. The lift, and the shift of the centre of
    /// pressure from the mid-chord, have opposite signs at the attack angles α and π − α.
    pub struct Harmonics<R> {
        /// Coefficients d₀ and d₁ of the terms that are added to the drag coefficient.
        pub drag: [R; 2],
        /// Coefficients l₁ and l₂ of the terms that are added to the lift coefficient.
        pub lift: [R; 2],
        /// Coefficients p₀ and p₁ of the terms that are added to the position of the centre of pressure.
        pub pressure: [R; 2],
    }
}

impl Harmonics<f64> {
    /// Returns the coefficients for the parameters of a point.
    pub(crate) fn of(p: &HarmonicParameters) -> Harmonics<f64> {
        Harmonics {
            drag: [p.drag_term_0, p.drag_term_1],
            lift: [p.lift_term_1, p.lift_term_2],
            pressure: [p.pressure_term_0, p.pressure_term_1],
        }
    }
}

impl<R: Real> Harmonics<R> {
    /// Returns the terms that are added to the drag coefficient: sin² 2α (d₀ + d₁ cos 2α). The argument `cos`
    /// is cos 2α.
    #[inline(always)]
    pub(crate) fn drag(&self, cos: R) -> R {
        let [d_0, d_1] = self.drag;
        (cos.lit(1.0) - cos * cos) * (d_0 + d_1 * cos)
    }

    /// Returns the terms that are added to the lift coefficient, divided by sin 2α: l₁ cos 2α + l₂ cos² 2α.
    /// The argument `cos` is cos 2α.
    #[inline(always)]
    pub(crate) fn lift(&self, cos: R) -> R {
        let [l_1, l_2] = self.lift;
        (l_1 + l_2 * cos) * cos
    }

    /// Returns the terms that are added to the position of the centre of pressure: sin 2α (p₀ + p₁ cos 2α).
    /// The argument `twice` is 2α (rad).
    #[inline(always)]
    pub(crate) fn pressure(&self, twice: R) -> R {
        let [p_0, p_1] = self.pressure;
        let (sin, cos) = twice.sin_cos();
        sin * (p_0 + p_1 * cos)
    }
}
