//! The names that an expression may use, and their types.

/// The type of an expression: a number, or a condition.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// It has a number for a value.
    Number,
    /// It is true or false.
    Condition,
}

/// The meaning of a name in an expression.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Meaning {
    /// The number at this place of the values.
    Number(usize),
    /// The condition at this place of the values, as [`Expression::value`](super::Expression::value) gives it.
    Condition(usize),
    /// The choice at this place of the values, as the index of one of these options.
    Choice(usize, &'static [&'static str]),
    /// A number that never changes.
    Constant(f64),
    /// A number that is not set and follows others, as the text says.
    Unset(&'static str),
}

/// The names that an expression may use.
pub trait Scope {
    /// The meaning of `name`, if it has one.
    fn meaning(&self, name: &str) -> Option<Meaning>;

    /// All names, from which to guess what a misspelt one was meant to be.
    fn names(&self) -> Vec<String>;
}
