//! Variants of the four-bar model.

use crate::body::BodyTerms;
use crate::drive::Drive;

/// Variant of the four-bar model: the choices on which its equations branch.
#[derive(Clone, Debug, PartialEq)]
pub struct FourBar {
    /// Drive voltage, or prescribed stroke.
    pub drive: Drive,
    /// Terms of the body's motion.
    pub body: BodyTerms,
    /// True with further terms of the attack angle, or rotational circulation.
    pub has_air_terms: bool,
    /// True with nonlinear springs.
    pub stiffens: bool,
    /// True without any of these terms in the equations of motion. It follows from them, and is stored because each step reads it
    /// many times.
    pub is_plain: bool,
}

impl FourBar {
    /// Sinusoidal drive, with the body at rest.
    pub const SINE: FourBar = FourBar {
        drive: Drive::SINE,
        body: BodyTerms::None,
        has_air_terms: false,
        stiffens: false,
        is_plain: true,
    };

    /// Returns the variant with the right `is_plain`.
    pub(super) fn classified(self) -> FourBar {
        let is_plain = self.body != BodyTerms::All && !self.has_air_terms && !self.stiffens;
        FourBar { is_plain, ..self }
    }
}

impl Default for FourBar {
    fn default() -> FourBar {
        FourBar::SINE
    }
}
