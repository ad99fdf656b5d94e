//! Names that an expression may use, and their types.

use std::sync::Arc;

/// The type of an expression: a number, or a condition.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// The value is a number.
    Number,
    /// The value is true or false.
    Condition,
}

/// Meaning of a name in an expression.
#[derive(Clone, Debug, PartialEq)]
pub enum Meaning<'a> {
    /// A number. The variant contains the index of the number in the argument `values` of
    /// [`Expression::value`](super::Expression::value).
    Number(usize),
    /// A condition. The variant contains the index of the condition in the argument `values` of
    /// [`Expression::value`](super::Expression::value). A condition is 1 for true, 0 for false, and NaN
    /// for unknown.
    Condition(usize),
    /// A choice. The variant contains the index of the choice in `values` of
    /// [`Expression::value`](super::Expression::value), and the names of the choice's options. The value
    /// of a choice is the index of the chosen option.
    Choice(usize, &'a [&'a str]),
    /// Constant.
    Constant(f64),
    /// A number that depends on a choice. The variant contains the index of the choice in `values` of
    /// [`Expression::value`](super::Expression::value), and one number for each option.
    OfChoice(usize, Arc<[f64]>),
    /// A parameter whose value is not set. The first field of the variant describes the parameters from which
    /// the model computes the value. The second field lists the designs in which the value is not set, such
    /// as "the device `long`". The second field is empty if no design sets the value.
    Unset(&'static str, String),
}

/// Names that an expression may use.
pub trait Scope {
    /// Returns the meaning of `name`, or `None` if the name is unknown.
    fn meaning(&self, name: &str) -> Option<Meaning<'_>>;

    /// Returns all known names. If a name in an expression is misspelled, the error message suggests a known
    /// name.
    fn names(&self) -> Vec<String>;

    /// Returns true if a number may have a unit when it is compared with a name, as in
    /// `drive_frequency > 95 Hz`.
    fn has_units(&self) -> bool {
        false
    }

    /// Returns the unit of the values of `name`. A number with a unit that is compared with `name` is
    /// converted to this unit. The unit of pure numbers is an empty text. Returns `None` if the name is
    /// unknown.
    fn unit(&self, _name: &str) -> Option<String> {
        None
    }
}
