//! Conditions of a problem as limits. A limit has one number that must be smaller than another number.

use std::ops::Range;

use crate::notation::expression::{Comparison, Expression};

/// A limit: one number must be smaller than another number.
#[derive(Clone, Debug)]
pub(super) struct Limit {
    /// The comparison as the user wrote it, or the name of a condition of the grid.
    pub(super) text: String,
    pub(super) comparison: Comparison,
    /// The number on one side of the comparison, if this side is a constant.
    constant: Option<f64>,
}

impl Limit {
    /// The limits of a condition; `None` if the condition does not consist of comparisons that must all hold. `text`
    /// returns the text of a comparison from the position of the comparison in the condition.
    pub(super) fn of_condition(
        condition: &Expression,
        text: impl Fn(Range<usize>) -> String,
    ) -> Option<Vec<Limit>> {
        let limits = condition.comparisons()?.into_iter().map(|(span, comparison)| {
            let Comparison { less, more, .. } = &comparison;
            let constant = [more, less].into_iter().find(|side| side.reads().next().is_none());
            Limit { text: text(span), constant: constant.map(|side| side.value(&[])), comparison }
        });
        Some(limits.collect())
    }

    /// True if the side that must be larger is the limit of the other side. In this case, the larger side is a constant
    /// or is on the right.
    pub(super) fn is_upper(&self) -> bool {
        let is_constant = |side: &Expression| side.reads().next().is_none();
        match [&self.comparison.more, &self.comparison.less].map(is_constant) {
            [true, false] => true,
            [false, true] => false,
            _ => self.comparison.is_rising,
        }
    }

    /// True if the sides satisfy the comparison.
    pub(super) fn holds(&self, [less, more]: [f64; 2]) -> bool {
        if self.comparison.is_strict { less < more } else { less <= more }
    }

    /// The size by which the distance from the limit is divided: the constant side, or the larger side if no side is
    /// constant.
    pub(super) fn scale(&self, [less, more]: [f64; 2]) -> f64 {
        let sides = less.abs().max(more.abs());
        let sizes = [self.constant.map_or(0.0, f64::abs), sides];
        sizes.into_iter().find(|size| *size > 0.0 && size.is_finite()).unwrap_or(1.0)
    }
}
