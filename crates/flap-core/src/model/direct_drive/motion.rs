//! Motion of the body as constants of the direct-drive model.

use core::f64::consts::FRAC_PI_4;

use super::chord::elements;
use super::constants::Constants;
use super::params::{self, CentreOfPressure, FlowDirection, Params};
use crate::aero::{AddedMass, sum};
use crate::body::BodyTerms;
use crate::parameter::Invalid;

/// Returns the constants of a point, if the equations contain the given `terms` of body motion.
///
/// # Errors
/// Returns an error if `flow_direction` is "uniform", `centre_of_pressure` is "literal" or `added_mass` is
/// "lagrangian".
pub(super) fn with_motion(
    constants: &Constants<f64>,
    p: &Params,
    terms: BodyTerms,
) -> Result<Constants<f64>, Invalid> {
    if terms == BodyTerms::None {
        return Ok(*constants);
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
    if p.added_mass == params::AddedMass::Lagrangian {
        return Err(Invalid::together(
            &["added_mass", "body_velocity_forward"],
            "added_mass = \"lagrangian\" has no equations for a moving body: set it to \"paper\"",
        ));
    }
    let f0 = FRAC_PI_4 * p.air_density * sum(&elements(p), |_, c| c * c);
    let added = AddedMass { f0, ..constants.added };
    Invalid::unless_finite(Constants { moving: p.body.motion(), added, ..*constants })
}
