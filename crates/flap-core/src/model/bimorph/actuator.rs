//! The actuator of the bimorph model as a beam. The module computes the factors of Eqs. (3), (5) and (6) that
//! depend on the shape and the layers of the actuator.

use super::params::{Params, WIDTH_RATIOS};
use crate::parameter::Invalid;

/// A beam that is clamped at its base: two piezoelectric plates on a carbon-fibre layer, with a tapered width
/// and a rigid extension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Actuator {
    /// Strain s_ε of a plate's mid-plane per displacement of the actuator's tip (1/m), Eq. (5).
    ///
    /// ```text
    /// s_ε = (t_pzt + t_cf)/(l_pzt² (1 + 2l_r))     ε₁ = −s_ε x     ε₂ = s_ε x
    /// ```
    pub(super) strain_per_tip: f64,
    /// Strain of a plate's outer face, divided by the strain of its mid-plane: (2t_pzt + t_cf)/(t_pzt + t_cf).
    pub(super) surface_strain_ratio: f64,
    /// Contribution of the plates to the stiffness at the actuator's tip (N/m), divided by the modulus E_e of
    /// the plates (Pa), Eq. (3).
    ///
    /// ```text
    /// K_pre D_E = p₄p₅ w_n G/(l_pzt³ (1 + 2l_r)) · t_pzt (1.5t_cf² + 3t_cf t_pzt + 2t_pzt²)
    /// ```
    pub(super) stiffness_per_modulus: f64,
    /// Contribution of the carbon-fibre layer to the stiffness at the actuator's tip (N/m), Eq. (3): K_pre
    /// E_cf t_cf³/4.
    pub(super) shim_stiffness: f64,
    /// Force of a plate at the actuator's tip (N), divided by the piezoelectric stress in the plate (Pa), at
    /// zero strain, Eq. (6).
    ///
    /// ```text
    /// F_pre = ¾ p₃ G w_n t_pzt (t_pzt + t_cf)/l_pzt
    /// ```
    pub(super) force_per_stress: f64,
}

impl Actuator {
    /// Returns the actuator with the dimensions and moduli in the parameters of a point.
    ///
    /// # Errors
    /// Returns an error if the width ratio is not between 0 and 2. At the ratios 0 and 2, the width of the
    /// actuator is zero at one end.
    pub(super) fn new(p: &Params) -> Result<Actuator, Invalid> {
        let gain = taper_gain(p.actuator_width_ratio, p.actuator_extension_ratio)?;
        let length = p.actuator_length;
        let (t_pzt, t_cf) = (p.piezo_thickness, p.shim_thickness);
        let lever = 1.0 + 2.0 * p.actuator_extension_ratio;
        let k_pre = p.stiffness_factor * p.deflection_factor * p.actuator_width * gain
            / (length * length * length * lever);
        Ok(Actuator {
            strain_per_tip: (t_pzt + t_cf) / (length * length * lever),
            surface_strain_ratio: (2.0 * t_pzt + t_cf) / (t_pzt + t_cf),
            stiffness_per_modulus: k_pre
                * t_pzt
                * (1.5 * t_cf * t_cf + 3.0 * t_cf * t_pzt + 2.0 * t_pzt * t_pzt),
            shim_stiffness: k_pre * p.shim_modulus * t_cf * t_cf * t_cf * 0.25,
            force_per_stress: 0.75 * p.force_factor * gain * p.actuator_width * t_pzt * (t_pzt + t_cf)
                / length,
        })
    }
}

/// Returns the gain G of a tapered cantilever with a rigid extension, Eqs. (3) and (6). The paper does not
/// derive the formula of G, but refers to its reference 9.
///
/// `width_ratio` is w_r, the width of the actuator at its base divided by its mean width. `extension_ratio`
/// is l_r, the length of the rigid extension divided by the length of the tapered part. With c = 1 + 2l_r and
/// δ = w_r − 1, the gain is:
///
/// ```text
/// G = c / (3 I)     I = ∫₀¹ (1 + l_r − s)²/(w_r + 2 (1 − w_r) s) ds = ⅛ ∫₋₁¹ (c − z)²/(1 − δz) dz
/// ```
///
/// If δ is small, the closed formula for the integral I has a rounding error proportional to 1/δ³. If |δ| <
/// ½, the function avoids the rounding error: it expands the integrand of I in powers of δz.
///
/// # Errors
/// Returns an error if the width ratio is not between 0 and 2. At the ratios 0 and 2, the width of the
/// actuator is zero at one end.
fn taper_gain(width_ratio: f64, extension_ratio: f64) -> Result<f64, Invalid> {
    Invalid::unless_within("actuator_width_ratio", width_ratio, WIDTH_RATIOS)?;
    let gain = if (width_ratio - 1.0).abs() < 0.5 {
        series_gain(width_ratio - 1.0, 1.0 + 2.0 * extension_ratio)
    } else {
        closed_gain(width_ratio, extension_ratio)
    };
    Ok(gain)
}

/// ```text
/// G = 8 (1 − w)³ (1 + 2l)/(−6 (w − 1)(−3 + 4l (w − 1) + 2w) + 3 (−2 + 2l (w − 1) + w)² ln((2 − w)/w))
/// ```
fn closed_gain(w: f64, l: f64) -> f64 {
    let taper = 1.0 - w;
    let polynomial = 6.0 * taper * (-3.0 - 4.0 * l * taper + 2.0 * w);
    let root = -2.0 - 2.0 * l * taper + w;
    let logarithm = 3.0 * root * root * libm::log((2.0 - w) / w);
    8.0 * taper * taper * taper * (1.0 + 2.0 * l) / (polynomial + logarithm)
}

/// ```text
/// I = ¼ Σ δ^2k (c²/(2k + 1) + (1 − 2cδ)/(2k + 3))
/// ```
fn series_gain(delta: f64, c: f64) -> f64 {
    let square = delta * delta;
    let mut power = 1.0;
    let mut sum = 0.0;
    // The first omitted term is below ½⁶⁰.
    for k in 0..30 {
        let odd = 2.0 * f64::from(k) + 1.0;
        sum += power * (c * c / odd + (1.0 - 2.0 * c * delta) / (odd + 2.0));
        power *= square;
    }
    c / (0.75 * sum)
}
