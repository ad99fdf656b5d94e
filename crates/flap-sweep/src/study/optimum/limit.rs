//! Conditions of a problem as limits. A limit has one number that must be smaller than another number.

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
    /// The limits of a condition; `None` if the condition does not consist of comparisons that must all hold.
    pub(super) fn of_condition(text: &str, condition: &Expression) -> Option<Vec<Limit>> {
        let comparisons = condition.comparisons()?;
        let pieces = pieces(text);
        let has_pieces = pieces.len() == comparisons.len();
        let piece = |number: usize| if has_pieces { pieces[number].to_owned() } else { text.to_owned() };
        let limits = comparisons.into_iter().enumerate().map(|(number, comparison)| {
            let Comparison { less, more, .. } = &comparison;
            let constant = [more, less].into_iter().find(|side| side.reads().next().is_none());
            Limit { text: piece(number), constant: constant.map(|side| side.value(&[])), comparison }
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

/// The parts of a text that are separated by `and` outside of parentheses.
fn pieces(text: &str) -> Vec<&str> {
    let mut pieces = Vec::new();
    let (mut depth, mut begin) = (0_i32, 0);
    for (place, letter) in text.char_indices() {
        match letter {
            '(' => depth += 1,
            ')' => depth -= 1,
            'a' if depth == 0 && place > 0 && text[place..].starts_with("and") => {
                let is_name = |letter: char| letter.is_alphanumeric() || letter == '_';
                let before = text[..place].chars().next_back();
                let behind = text[place + 3..].chars().next();
                if !before.is_some_and(is_name) && !behind.is_some_and(is_name) {
                    pieces.push(text[begin..place].trim());
                    begin = place + 3;
                }
            }
            _ => {}
        }
    }
    pieces.push(text[begin..].trim());
    pieces
}

#[cfg(test)]
mod tests {
    use super::pieces;

    #[test]
    fn pieces_stand_between_words() {
        assert_eq!(pieces("a_mn < 1 and 2 < band"), ["a_mn < 1", "2 < band"]);
        assert_eq!(pieces("(a < 1 and b > 2)and c<3"), ["(a < 1 and b > 2)", "c<3"]);
        assert_eq!(pieces("strand < 1"), ["strand < 1"]);
    }
}
