//! Variants of the direct-drive model.

use super::params::FlowDirection;
use crate::drive::Drive;
use crate::model::Terms;

/// Variant of the direct-drive model: the choices that select the form of the equations.
#[derive(Clone, Debug, PartialEq)]
pub struct DirectDrive {
    /// Drive of the wing: a voltage, or a prescribed stroke.
    pub drive: Drive,
    /// Direction of the air flow over the wing while the wing reverses.
    pub flow: FlowDirection,
    /// Terms that the paper leaves out.
    pub terms: Terms,
}

impl DirectDrive {
    /// Variant with sinusoidal drive, one direction of flow for the whole wing, and the body at rest.
    pub const SINE: DirectDrive =
        DirectDrive { drive: Drive::SINE, flow: FlowDirection::Uniform, terms: Terms::NONE };
}
