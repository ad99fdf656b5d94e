//! Variants of the direct-drive model.

use super::params::FlowDirection;
use crate::drive::Drive;
use crate::model::Terms;

/// Variant of the direct-drive model: the choices on which its equations branch.
#[derive(Clone, Debug, PartialEq)]
pub struct DirectDrive {
    /// Drive voltage, or prescribed stroke.
    pub drive: Drive,
    /// Direction of the air's flow over the wing during reversal.
    pub flow: FlowDirection,
    /// Terms that the paper leaves out.
    pub terms: Terms,
}

impl DirectDrive {
    /// Sinusoidal drive and one direction of flow for the whole wing, with the body at rest.
    pub const SINE: DirectDrive =
        DirectDrive { drive: Drive::SINE, flow: FlowDirection::Uniform, terms: Terms::NONE };
}

impl Default for DirectDrive {
    fn default() -> DirectDrive {
        DirectDrive::SINE
    }
}
