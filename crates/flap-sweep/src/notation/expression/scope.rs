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
    /// A number. The variant contains the index in the values.
    Number(usize),
    /// A condition. The variant contains the index in the values, as returned by
    /// [`Expression::value`](super::Expression::value).
    Condition(usize),
    /// A choice. The variant contains the index in the values, and the options. The value is the index of an option.
    Choice(usize, &'a [&'a str]),
    /// Constant.
    Constant(f64),
    /// Number that depends on the choice with this index in the values: a number for each option.
    OfChoice(usize, Arc<[f64]>),
    /// Number of a parameter that is not set. The first text describes the parameters from which the number is
    /// computed. The second text names the designs without the number, such as "the device `long`", or is empty if all
    /// designs lack the number.
    Unset(&'static str, String),
}

/// Names that an expression may use.
pub trait Scope {
    /// Returns the meaning of `name`, if the name has a meaning.
    fn meaning(&self, name: &str) -> Option<Meaning<'_>>;

    /// Returns all names, for suggestions after a misspelling.
    fn names(&self) -> Vec<String>;

    /// Returns true if numbers may have units beside the name with which they are compared: `drive_frequency > 95 Hz`.
    fn has_units(&self) -> bool {
        false
    }

    /// Returns the unit of the values of `name`, to which a number with a unit is converted. The unit of pure numbers is
    /// empty. `None` for an unknown name.
    fn unit(&self, _name: &str) -> Option<String> {
        None
    }
}
