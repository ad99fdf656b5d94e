//! Variants of the bimorph model.

use super::params::CentreOfPressure;
use super::transmission::Law;
use crate::body::BodyTerms;
use crate::drive::Drive;

/// Variant of the bimorph model: the choices on which its equations branch.
#[derive(Clone, Debug, PartialEq)]
pub struct Bimorph {
    /// Drive voltage.
    pub drive: Drive,
    /// Law of the transmission ratio.
    pub law: Law,
    /// Attack angle on which the centre of pressure depends.
    pub centre_of_pressure: CentreOfPressure,
    /// Terms of the body's motion.
    pub body: BodyTerms,
    /// True with further terms of the attack angle, or forces of the wing's sections along the normal: circulation, rotational
    /// drag, added mass.
    pub has_air_terms: bool,
    /// True with nonlinear springs.
    pub stiffens: bool,
    /// True without any of these terms in the equations of motion. It follows from them, and is stored because each step reads it
    /// many times.
    pub is_plain: bool,
}

impl Bimorph {
    /// Sinusoidal drive, constant transmission ratio, and (11) with the folded attack angle.
    pub const SINE: Bimorph = Bimorph {
        drive: Drive::SINE,
        law: Law::Constant,
        centre_of_pressure: CentreOfPressure::Folded,
        body: BodyTerms::None,
        has_air_terms: false,
        stiffens: false,
        is_plain: true,
    };

    /// Returns the variant with the right `is_plain`.
    pub(super) fn classified(self) -> Bimorph {
        let is_plain = self.body != BodyTerms::All && !self.has_air_terms && !self.stiffens;
        Bimorph { is_plain, ..self }
    }
}

impl Default for Bimorph {
    fn default() -> Bimorph {
        Bimorph::SINE
    }
}
