//! What a model's parameters are called, what they mean and which values they take.
//!
//! A point of a design space is one `f64` per parameter, in the order of the model's table:
//! a number in SI units; the index of an option for a choice; NaN for a number that is not set
//! and follows others (see [`Kind::Following`]). User input never contains NaN, so it marks nothing else.

/// One row of a model's parameter table.
#[derive(Debug)]
pub struct Parameter {
    /// Name in grid files, on the command line and in Python.
    pub name: &'static str,
    /// SI unit as units are written in grid files (`"N*m/rad"`), empty for pure numbers and choices.
    pub unit: &'static str,
    /// Symbol in the model's paper, empty if the paper has none.
    pub symbol: &'static str,
    /// What values it takes.
    pub kind: Kind,
    /// One line of meaning, with its source.
    pub doc: &'static str,
}

/// What values a parameter takes.
#[derive(Debug)]
pub enum Kind {
    /// A number in SI units.
    Number(Range),
    /// A number that follows other parameters until it is set; the text says how (`"half of actuator_length"`).
    Following(Range, &'static str),
    /// One of a few named options: a reading of the paper, or a modelling choice.
    Choice(&'static [&'static str]),
}

/// The finite numbers a parameter accepts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Range {
    /// Any finite number.
    Any,
    /// Zero or more.
    NonNegative,
    /// More than zero.
    Positive,
}

impl Range {
    /// Whether `value` is finite and within the range.
    pub fn contains(self, value: f64) -> bool {
        value.is_finite()
            && match self {
                Range::Any => true,
                Range::NonNegative => value >= 0.0,
                Range::Positive => value > 0.0,
            }
    }

    /// The range in words, for messages: `"any number"`, `"zero or more"`, `"more than zero"`.
    pub fn describe(self) -> &'static str {
        match self {
            Range::Any => "any number",
            Range::NonNegative => "zero or more",
            Range::Positive => "more than zero",
        }
    }
}

/// A published parameter set.
#[derive(Debug)]
pub struct Preset {
    /// Name in grid files, such as `ozaki2018-large`.
    pub name: &'static str,
    /// One line: what it is and where the numbers come from.
    pub doc: &'static str,
    /// The values, one per parameter of the model's table.
    pub values: fn() -> Vec<f64>,
}
