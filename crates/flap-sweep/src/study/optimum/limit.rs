//! Converts the conditions of an optimisation into limits. In each limit, one expression must have a smaller
//! value than a second expression.

use std::ops::Range;

use crate::notation::expression::{Comparison, Expression};

/// A limit of an optimisation: the value of one expression must be smaller than the value of a second
/// expression.
#[derive(Clone, Debug)]
pub(super) struct Limit {
    /// The comparison as the user wrote it, or the name of a condition of the grid.
    pub(super) text: String,
    pub(super) comparison: Comparison,
    /// The value of the constant side of the comparison, if one side is constant.
    constant: Option<f64>,
}

impl Limit {
    /// Returns one limit for each comparison in a condition. Returns `None` if the condition contains `or`,
    /// `not`, `==` or `!=`. The function `text` must return the part of the condition's text at the given
    /// positions.
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

    /// True for an upper limit such as `stroke < 90`, and false for a lower limit such as `90 < stroke`. If
    /// only one side of the comparison is constant, the constant side is the limit. If both sides or no side
    /// is constant, the side on the right is the limit.
    pub(super) fn is_upper(&self) -> bool {
        let is_constant = |side: &Expression| side.reads().next().is_none();
        match [&self.comparison.more, &self.comparison.less].map(is_constant) {
            [true, false] => true,
            [false, true] => false,
            _ => self.comparison.is_rising,
        }
    }

    /// True if the comparison holds for the two values.
    pub(super) fn holds(&self, [less, more]: [f64; 2]) -> bool {
        if self.comparison.is_strict { less < more } else { less <= more }
    }

    /// The size of the limit, by which distances from the limit are divided. The size is the magnitude of the
    /// constant side. If no side is constant, or the constant is zero, the size is the larger magnitude of
    /// the two sides.
    pub(super) fn scale(&self, [less, more]: [f64; 2]) -> f64 {
        let sides = less.abs().max(more.abs());
        let sizes = [self.constant.map_or(0.0, f64::abs), sides];
        sizes.into_iter().find(|size| *size > 0.0 && size.is_finite()).unwrap_or(1.0)
    }
}
