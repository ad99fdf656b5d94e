//! Variants of the four-bar model.

use crate::drive::Drive;
use crate::model::Terms;

/// Variant of the four-bar model: the options that select the form of the equations.
#[derive(Clone, Debug, PartialEq)]
pub struct FourBar {
    /// Drive of the wing: a voltage, or a prescribed stroke.
    pub drive: Drive,
    /// Terms of the equations that the paper leaves out.
    pub terms: Terms,
}

impl FourBar {
    /// Variant with sinusoidal drive and the body at rest.
    pub const SINE: FourBar = FourBar { drive: Drive::SINE, terms: Terms::NONE };
}
