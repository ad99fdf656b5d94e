//! Strips of the lumped wing of the bimorph model, on which the motion of the body acts.

use super::params::{CentreOfPressure, Params};
use crate::aero::ObliqueStrip;
use crate::body::{BodyMotion, BodyTerms};
use crate::parameter::Invalid;
use crate::quadrature::gauss_beta;

/// Number of strips. Four are exact for the forces at zero body motion, and for the first derivatives with respect to it.
const STRIPS: usize = 4;

crate::per_lane! {
    /// Motion of the body, and the parts of the wing on which it acts.
    pub struct Moving<R> {
        /// Motion of the shoulder.
        pub motion: BodyMotion<R>,
        /// Strips of the wing. Their chord is the mean chord, to which the centre of pressure (11) refers.
        pub strips: [ObliqueStrip<R>; STRIPS],
        /// Moment of inertia about the hinge's axis I_xx (kg·m²).
        pub inertia: R,
        /// Product of inertia I_xz (kg·m²).
        pub product: R,
    }
}

impl Moving<f64> {
    /// A body at rest.
    pub(super) const REST: Moving<f64> =
        Moving { motion: BodyMotion::REST, strips: [ObliqueStrip::NONE; STRIPS], inertia: 0.0, product: 0.0 };

    /// Returns the constants of a point with these terms.
    ///
    /// # Errors
    /// If another reading of the paper or another shape of the wing is required.
    pub(super) fn of(p: &Params, terms: BodyTerms) -> Result<Moving<f64>, Invalid> {
        if terms == BodyTerms::None {
            return Ok(Moving::REST);
        }
        if p.centre_of_pressure == CentreOfPressure::Literal {
            return Err(Invalid::together(
                &["centre_of_pressure", "body_velocity_forward"],
                "centre_of_pressure = \"literal\" has no meaning on a moving body: set it to \"folded\" or \"directional\"",
            ));
        }
        let (inertia, product) = (p.wing_inertia_hinge, p.wing_inertia_product);
        Invalid::unless_finite(Moving { motion: p.body.motion(), strips: strips(p)?, inertia, product })
    }
}

/// Returns the strips of the wing: the nodes of the Gauss rule for a chord with a beta distribution (Ellington 1984).
///
/// ```text
/// c ∝ r̂^(P−1) (1 − r̂)^(Q−1)     P = r̂₁ K     Q = (1 − r̂₁) K     K = r̂₁ (1 − r̂₁)/(r̂₂² − r̂₁²) − 1
/// ```
///
/// Moments about the stroke axis have the levers λ r, so that lift and drag act at R_cp at zero body motion:
///
/// ```text
/// λ = R_cp r̂₂²/(R r̂₃³)     r̂₃³ = P (P + 1) (P + 2)/((P + Q) (P + Q + 1) (P + Q + 2))
/// ```
fn strips(p: &Params) -> Result<[ObliqueStrip<f64>; STRIPS], Invalid> {
    let second = p.wing_radius_2;
    let first = p.wing_radius_1.unwrap_or_else(|| libm::pow(second / 0.929, 1.0 / 0.732));
    if !(second * second < first && first < second) {
        return Err(Invalid::together(
            &["wing_radius_1", "wing_radius_2"],
            format!(
                "no wing has wing_radius_1 = {first} and wing_radius_2 = {second}: wing_radius_1 must lie between \
                 wing_radius_2^2 and wing_radius_2"
            ),
        ));
    }
    let k = first * (1.0 - first) / (second * second - first * first) - 1.0;
    let (a, b) = (first * k, (1.0 - first) * k);
    let third = a * (a + 1.0) * (a + 2.0) / (k * (k + 1.0) * (k + 2.0));
    let lever = p.pressure_radius * second * second / (p.wing_length * third);
    let dynamic = 0.5 * p.air_density * p.wing_area;
    let nodes = gauss_beta(STRIPS, a, b);
    Ok(core::array::from_fn(|i| {
        let radius = p.wing_length * nodes[i].x;
        ObliqueStrip {
            weight: dynamic * nodes[i].weight,
            radius,
            lever: lever * radius,
            behind: 0.0,
            chord: p.wing_area / p.wing_length,
        }
    }))
}
