//! Variants of the direct-drive model.

use super::params::FlowDirection;
use crate::drive::Drive;
use crate::model::Terms;

/// Variant of the direct-drive model: the options that select the form of the equations.
#[derive(Clone, Debug, PartialEq)]
pub struct DirectDrive {
    /// Drive of the wing: a voltage, or a prescribed stroke.
    pub drive: Drive,
    /// One direction of the air flow for the whole wing, or one direction for each blade element.
    pub flow: FlowDirection,
    /// Terms of the equations that the paper leaves out.
    pub terms: Terms,
}

impl DirectDrive {
    /// Variant with sinusoidal drive, one direction of flow for the whole wing, and the body at rest.
    pub const SINE: DirectDrive =
        DirectDrive { drive: Drive::SINE, flow: FlowDirection::Uniform, terms: Terms::NONE };
}
