//! Variants of the bimorph model.

use super::params::CentreOfPressure;
use super::transmission::Law;
use crate::drive::Drive;
use crate::model::Terms;

/// Variant of the bimorph model: the options that select the form of the equations.
#[derive(Clone, Debug, PartialEq)]
pub struct Bimorph {
    /// Drive voltage.
    pub drive: Drive,
    /// Dependence of the transmission ratio on the displacement.
    pub law: Law,
    /// Attack angle on which the centre of pressure depends.
    pub centre_of_pressure: CentreOfPressure,
    /// Terms of the equations that the paper leaves out.
    pub terms: Terms,
}

impl Bimorph {
    /// Variant with sinusoidal drive, constant transmission ratio, and Eq. (11) with the folded attack angle.
    pub const SINE: Bimorph = Bimorph {
        drive: Drive::SINE,
        law: Law::Constant,
        centre_of_pressure: CentreOfPressure::Folded,
        terms: Terms::NONE,
    };
}
