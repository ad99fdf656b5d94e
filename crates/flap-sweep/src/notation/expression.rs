//! Expressions of grid files: `1.52e-6 * (transmission_ratio / preset.transmission_ratio)^-1.47`.
//!
//! An expression is checked once, when the expression is read: names are looked up, and numbers are distinguished from
//! conditions. The result is a flat list of operations. Elementary functions come from `libm`, so values have the same
//! bits on every machine. See `docs/reference/grid.md` for the language of expressions.
//!
//! Operations on NaN give NaN. A comparison with NaN is unknown: neither true nor false. `and`, `or` and `not` of
//! unknown conditions are unknown, unless the other operand determines the result.

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
use parse::{Token, Tokens};
pub use scope::{Kind, Meaning, Scope};

/// Returns true if `name` is allowed for a new name in expressions.
pub fn is_free_name(name: &str) -> bool {
    let mut characters = name.chars();
    characters.next().is_some_and(|first| first.is_ascii_alphabetic() || first == '_')
        && characters.all(|character| character.is_ascii_alphanumeric() || character == '_')
        && !["and", "or", "not"].contains(&name)
        && evaluate::find(name).is_none()
        && name != evaluate::PI.0
}

/// Returns the positions of the bytes of the units after numbers in the expression `text`, up to the first mistake.
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
    /// Positions of the bytes of the comparisons of two numbers, in the order of the text.
    comparisons: Vec<Range<usize>>,
}

impl Expression {
    /// Checks the expression `text`, whose names must be in `scope`.
    ///
    /// # Errors
    /// All mistakes in names, or the first mistake of another kind. Spans are positions of bytes in `text`.
    pub fn parse(text: &str, scope: &dyn Scope) -> Result<Expression, Vec<ExpressionError>> {
        let (kind, operations, comparisons) = parse::parse(text, scope)?;
        Ok(Expression { kind, operations, comparisons })
    }

    /// Returns the type of the expression: a number or a condition.
    pub fn kind(&self) -> Kind {
        self.kind
    }

    /// Returns the indices of the values that the expression reads, in the order of the text.
    pub fn reads(&self) -> impl Iterator<Item = usize> + '_ {
        self.operations.iter().filter_map(|operation| match operation {
            Operation::Read(place) | Operation::ReadOf(place, _) => Some(*place),
            _ => None,
        })
    }

    /// Returns the value of the expression for the given `values` of names. The value is a number, 1 for true, 0 for
    /// false, or NaN if unknown.
    pub fn value(&self, values: &[f64]) -> f64 {
        evaluate::evaluate(&self.operations, values)
    }

    /// The comparisons that must all hold, each with the position of its bytes in the text. `None` if the expression is
    /// not made of comparisons by `<`, `<=`, `>` and `>=` that are joined with `and`.
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
    /// True if the two sides of the comparison must not be equal.
    pub(crate) is_strict: bool,
    /// True if the side that must be larger is on the right.
    pub(crate) is_rising: bool,
}

/// The comparisons in `operations`, see [`Expression::comparisons`].
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
