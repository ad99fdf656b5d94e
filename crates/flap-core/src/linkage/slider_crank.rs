//! A slider-crank: from the angle of a crank to the displacement of a slider.

use crate::num::Real;

crate::per_lane! {
    /// A crank at right angles to the slider's line at rest, and a rod along that line.
    pub struct SliderCrank<R> {
        /// Radius of the crank L_c (m).
        pub crank: R,
        /// Length of the connecting rod L_s (m).
        pub rod: R,
    }
}

/// The slider's displacement from rest δ (m) and its derivatives with respect to the crank's angle (m).
#[derive(Clone, Copy, Debug)]
pub(crate) struct SliderMotion<R> {
    /// δ.
    pub(crate) displacement: R,
    /// δ_η.
    pub(crate) slope: R,
    /// δ_ηη.
    pub(crate) bend: R,
}

impl<R: Real> SliderCrank<R> {
    /// The slider when the crank has turned by η, given sine and cosine.
    ///
    /// ```text
    /// e = L_c (1 − cos η)     g = √(L_s² − e²)     δ = L_c sin η + L_s − g
    /// g_η = −e e_η / g     g_ηη = −(e_η² + e e_ηη + g_η²) / g
    /// ```
    #[inline(always)]
    pub(crate) fn motion(&self, sin: R, cos: R) -> SliderMotion<R> {
        let along = self.crank * sin;
        let across = self.crank * cos;
        let e = self.crank - across;
        let g = self.rod.mul_add(self.rod, -(e * e)).sqrt();
        let inverse_g = sin.lit(1.0) / g;
        // e_η = L_c sin η, e_ηη = L_c cos η.
        let g_slope = -(e * along * inverse_g);
        let g_bend = -((along * along + e * across + g_slope * g_slope) * inverse_g);
        SliderMotion { displacement: along + self.rod - g, slope: across - g_slope, bend: -along - g_bend }
    }
}
