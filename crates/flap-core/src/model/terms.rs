//! Terms that the papers of the models leave out.

use crate::body::BodyTerms;

/// Terms of a model's equations that its paper leaves out: choices on which the equations branch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Terms {
    /// Terms of the body's motion.
    pub body: BodyTerms,
    /// True with further terms of the attack angle, or with forces of the wing's sections along the normal: circulation,
    /// rotational drag, added mass.
    pub air: bool,
    /// True with nonlinear springs.
    pub stiffening: bool,
}

impl Terms {
    /// No terms.
    pub const NONE: Terms = Terms { body: BodyTerms::None, air: false, stiffening: false };

    /// Returns the terms that either point has. If both bodies move, the result has the first body's terms.
    pub fn or(self, other: Terms) -> Terms {
        let body = if self.body == BodyTerms::None { other.body } else { self.body };
        Terms { body, air: self.air || other.air, stiffening: self.stiffening || other.stiffening }
    }

    /// Returns true if the equations of motion contain none of the terms.
    #[inline(always)]
    pub fn is_plain(&self) -> bool {
        self.body != BodyTerms::All && !self.air && !self.stiffening
    }
}
