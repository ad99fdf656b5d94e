//! Motion of the body as constants of the direct-drive model.

use core::f64::consts::FRAC_PI_4;

use super::chord::elements;
use super::params::{AddedMass, CentreOfPressure, FlowDirection, Params};
use crate::aero::sum;
use crate::body::{BodyMotion, BodyTerms};
use crate::parameter::Invalid;

crate::per_lane! {
    /// Motion of the body, and the added mass on which it acts.
    pub struct Moving<R> {
        /// Motion of the shoulder.
        pub motion: BodyMotion<R>,
        /// Added mass f₀ = π/4 ρ ∫ c² dr (kg).
        pub f0: R,
    }
}

impl Moving<f64> {
    /// A body at rest.
    pub(super) const REST: Moving<f64> = Moving { motion: BodyMotion::REST, f0: 0.0 };

    /// Returns the constants of a point with these terms.
    ///
    /// # Errors
    /// If another reading of the paper is required.
    pub(super) fn of(p: &Params, terms: BodyTerms) -> Result<Moving<f64>, Invalid> {
        if terms == BodyTerms::None {
            return Ok(Moving::REST);
        }
        if p.flow_direction == FlowDirection::Uniform {
            return Err(Invalid::together(
                &["flow_direction", "body_velocity_forward"],
                "flow_direction = \"uniform\" has no meaning on a moving body: set it to \"blade\"",
            ));
        }
        if p.centre_of_pressure == CentreOfPressure::Literal {
            return Err(Invalid::together(
                &["centre_of_pressure", "body_velocity_forward"],
                "centre_of_pressure = \"literal\" has no meaning on a moving body: set it to \"folded\" or \"directional\"",
            ));
        }
        if p.added_mass == AddedMass::Lagrangian {
            return Err(Invalid::together(
                &["added_mass", "body_velocity_forward"],
                "added_mass = \"lagrangian\" has no equations for a moving body: set it to \"paper\"",
            ));
        }
        let f0 = FRAC_PI_4 * p.air_density * sum(&elements(p), |_, c| c * c);
        Invalid::unless_finite(Moving { motion: p.body.motion(), f0 })
    }
}
