//! Parses and evaluates expressions in grid files, such as
//! `1.52e-6 * (transmission_ratio / preset.transmission_ratio)^-1.47`.
//!
//! flap checks an expression once, when it reads the grid file. The check finds unknown names, and conditions
//! at positions where a number is required. A parsed expression is a flat list of operations. Functions such
//! as `sin` come from `libm`, so the values of expressions have the same bits on every machine. See
//! `docs/reference/grid.md` for the language of expressions.
//!
//! Operations on NaN give NaN. A comparison with NaN is unknown: neither true nor false. If an operand of
//! `and`, `or` or `not` is unknown, the result is unknown, unless the known operand alone determines the
//! result.

mod error;
mod evaluate;
mod parse;
mod scope;
#[cfg(test)]
mod tests;

use std::ops::Range;

use super::units;
pub use error::{ExpressionError, Mistake};
use evaluate::Operation;
pub(crate) use evaluate::of_choice;
use parse::{Token, Tokens, WORDS};
pub use scope::{Kind, Meaning, Scope};

/// Returns true if a grid file may define a new name `name` for use in expressions.
pub fn is_free_name(name: &str) -> bool {
    let mut characters = name.chars();
    characters.next().is_some_and(|first| first.is_ascii_alphabetic() || first == '_')
        && characters.all(|character| character.is_ascii_alphanumeric() || character == '_')
        && !WORDS.contains(&name)
        && evaluate::find(name).is_none()
        && name != evaluate::PI.0
}

/// Finds the units after numbers in the expression `text`, such as `Hz` in `95 Hz`. Returns the byte ranges
/// of the units before the first mistake.
pub fn units_in(text: &str) -> Vec<Range<usize>> {
    let mut tokens = Tokens::new(text, true);
    let mut found = Vec::new();
    while let Ok((token, span)) = tokens.next()
        && token != Token::End
    {
        if let Token::Quantity(quantity) = token {
            let (_, number) = units::decimal(quantity);
            found.push(span.end - quantity[number..].trim_start().len()..span.end);
        }
    }
    found
}

/// An expression without mistakes.
#[derive(Clone, Debug)]
pub struct Expression {
    kind: Kind,
    operations: Vec<Operation>,
    /// Byte ranges of all comparisons of two numbers, in the order of the text.
    comparisons: Vec<Range<usize>>,
}

impl Expression {
    /// Parses and checks the expression `text`. `scope` must contain all names in `text`.
    ///
    /// # Errors
    /// Returns all mistakes up to the first mistake in the syntax. The position of each mistake is a byte
    /// range in `text`.
    pub fn parse(text: &str, scope: &dyn Scope) -> Result<Expression, Vec<ExpressionError>> {
        let (kind, operations, comparisons) = parse::parse(text, scope)?;
        Ok(Expression { kind, operations, comparisons })
    }

    /// Returns the type of the expression: a number or a condition.
    pub fn kind(&self) -> Kind {
        self.kind
    }

    /// Returns the indices of the values that the expression uses, in the order of the text. The same index
    /// may occur several times.
    pub fn reads(&self) -> impl Iterator<Item = usize> + '_ {
        self.operations.iter().filter_map(|operation| match operation {
            Operation::Read(place) | Operation::ReadOf(place, _) => Some(*place),
            _ => None,
        })
    }

    /// Returns the value of the expression. `values` contains the values of the names. The value of a
    /// condition is 1 for true, 0 for false, and NaN for unknown.
    pub fn value(&self, values: &[f64]) -> f64 {
        evaluate::evaluate(&self.operations, values)
    }

    /// Splits a condition such as `1 < x and x <= 2` into its comparisons, each with its byte range in the
    /// text. Returns `None` if the condition contains operators such as `or` or `==`, so that it is not a
    /// list of inequalities.
    pub(crate) fn comparisons(&self) -> Option<Vec<(Range<usize>, Comparison)>> {
        let comparisons = comparisons(&self.operations)?;
        Some(self.comparisons.iter().cloned().zip(comparisons).collect())
    }
}

/// A comparison of two numbers.
#[derive(Clone, Debug)]
pub(crate) struct Comparison {
    /// The side of the comparison that must be smaller.
    pub(crate) less: Expression,
    /// The side of the comparison that must be larger.
    pub(crate) more: Expression,
    /// True for `<` and `>`, which do not allow equal sides; false for `<=` and `>=`.
    pub(crate) is_strict: bool,
    /// True for `<` and `<=`, whose larger side is on the right; false for `>` and `>=`.
    pub(crate) is_rising: bool,
}

/// Returns the comparisons in `operations` without their byte ranges: see [`Expression::comparisons`].
fn comparisons(operations: &[Operation]) -> Option<Vec<Comparison>> {
    let (Operation::Binary(operator), rest) = operations.split_last()? else { return None };
    let (left, right) = evaluate::operands(rest)?;
    let (is_strict, is_rising) = match operator.sign {
        "and" => return Some([comparisons(left)?, comparisons(right)?].concat()),
        "<" => (true, true),
        "<=" => (false, true),
        ">" => (true, false),
        ">=" => (false, false),
        _ => return None,
    };
    let [left, right] = [left.to_vec(), right.to_vec()].map(|operations| Expression {
        kind: Kind::Number,
        operations,
        comparisons: Vec::new(),
    });
    let (less, more) = if is_rising { (left, right) } else { (right, left) };
    Some(vec![Comparison { less, more, is_strict, is_rising }])
}
