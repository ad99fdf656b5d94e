//! Variants of the four-bar model.

use crate::drive::Drive;
use crate::model::Terms;

/// Variant of the four-bar model: the choices on which its equations branch.
#[derive(Clone, Debug, PartialEq)]
pub struct FourBar {
    /// Drive voltage, or prescribed stroke.
    pub drive: Drive,
    /// Terms that the paper leaves out.
    pub terms: Terms,
}

impl FourBar {
    /// Sinusoidal drive, with the body at rest.
    pub const SINE: FourBar = FourBar { drive: Drive::SINE, terms: Terms::NONE };
}

impl Default for FourBar {
    fn default() -> FourBar {
        FourBar::SINE
    }
}
