//! Motion of the body as a constant of the direct-drive model.

use super::params::{AddedMass, CentreOfPressure, FlowDirection, Params};
use crate::body::{BodyMotion, BodyTerms};
use crate::parameter::Invalid;

/// Returns the motion of the body of a point with these terms.
///
/// # Errors
/// If another reading of the paper is required.
pub(super) fn motion(p: &Params, terms: BodyTerms) -> Result<BodyMotion<f64>, Invalid> {
    if terms == BodyTerms::None {
        return Ok(BodyMotion::REST);
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
    Ok(p.body.motion())
}
