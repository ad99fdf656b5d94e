//! Terms of the equations that the papers of the models leave out.

use crate::body::BodyTerms;

/// Terms of a model's equations that the paper of the model leaves out. The fields determine which of the
/// terms the equations contain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Terms {
    /// Terms that describe the motion of the body.
    pub body: BodyTerms,
    /// True if the equations contain higher harmonics of the attack angle, or additional forces along the
    /// wing's normal. The additional forces are rotational circulation, rotational drag and added mass.
    pub air: bool,
    /// True if the equations contain nonlinear springs.
    pub stiffening: bool,
}

impl Terms {
    /// No terms.
    pub const NONE: Terms = Terms { body: BodyTerms::None, air: false, stiffening: false };

    /// Returns all terms that `self` or `other` contains. If `self` and `other` both contain terms of the
    /// body's motion, the result contains only the terms of `self` for the body's motion.
    pub fn or(self, other: Terms) -> Terms {
        let body = if self.body == BodyTerms::None { other.body } else { self.body };
        Terms { body, air: self.air || other.air, stiffening: self.stiffening || other.stiffening }
    }

    /// Returns true if the equations of motion contain none of the terms that the paper leaves out.
    #[inline(always)]
    pub fn is_plain(&self) -> bool {
        self.body != BodyTerms::All && !self.air && !self.stiffening
    }
}
