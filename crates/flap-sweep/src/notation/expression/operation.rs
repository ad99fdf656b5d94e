//! Operations on a stack of numbers, of which a checked expression consists.

/// One operation. Conditions are 1 for true, 0 for false and NaN for unknown.
#[derive(Clone, Copy, Debug)]
pub(super) enum Operation {
    /// Puts a number on the stack.
    Push(f64),
    /// Puts one of the values on the stack.
    Read(usize),
    /// Replaces the topmost number.
    Unary(Unary),
    /// Replaces the two topmost numbers.
    Binary(Binary),
    /// Replaces the topmost number by a function of it.
    Apply(fn(f64) -> f64),
    /// Replaces the two topmost numbers by a function of them.
    Apply2(fn(f64, f64) -> f64),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Unary {
    Negate,
    Not,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Binary {
    Add,
    Subtract,
    Multiply,
    Divide,
    Power,
    Less,
    LessOrEqual,
    Greater,
    GreaterOrEqual,
    Equal,
    NotEqual,
    And,
    Or,
}
