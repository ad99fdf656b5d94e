//! Variants of the direct-drive model.

use super::params::FlowDirection;
use crate::body::BodyTerms;
use crate::drive::Drive;

/// Variant of the direct-drive model: the choices on which its equations branch.
#[derive(Clone, Debug, PartialEq)]
pub struct DirectDrive {
    /// Drive voltage, or prescribed stroke.
    pub drive: Drive,
    /// Direction of the air's flow over the wing during reversal.
    pub flow: FlowDirection,
    /// Terms of the body's motion.
    pub body: BodyTerms,
    /// True with further terms of the attack angle, rotational circulation, or a normal force of the rotational drag.
    pub has_air_terms: bool,
    /// True with nonlinear springs.
    pub stiffens: bool,
    /// True without any of these terms in the equations of motion. It follows from them, and is stored because each step reads it
    /// many times.
    pub is_plain: bool,
}

impl DirectDrive {
    /// Sinusoidal drive and one direction of flow for the whole wing, with the body at rest.
    pub const SINE: DirectDrive = DirectDrive {
        drive: Drive::SINE,
        flow: FlowDirection::Uniform,
        body: BodyTerms::None,
        has_air_terms: false,
        stiffens: false,
        is_plain: true,
    };

    /// Returns the variant with the right `is_plain`.
    pub(super) fn classified(self) -> DirectDrive {
        let is_plain = self.body != BodyTerms::All && !self.has_air_terms && !self.stiffens;
        DirectDrive { is_plain, ..self }
    }
}

impl Default for DirectDrive {
    fn default() -> DirectDrive {
        DirectDrive::SINE
    }
}
