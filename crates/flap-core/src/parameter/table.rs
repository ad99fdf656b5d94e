//! Rows of a parameter table, and published parameter sets.

use super::range::Range;

/// One row of a model's parameter table.
#[derive(Clone, Copy, Debug)]
pub struct Parameter {
    /// Name in grid files, on the command line and in Python.
    pub name: &'static str,
    /// SI unit as units are written in grid files (`"N*m/rad"`), empty for pure numbers and choices.
    pub unit: &'static str,
    /// Symbol in the model's paper, empty if the paper has none.
    pub symbol: &'static str,
    /// The values that it takes.
    pub kind: Kind,
    /// Meaning in one line, with its source.
    pub doc: &'static str,
}

/// The values that a parameter takes.
#[derive(Clone, Copy, Debug)]
pub enum Kind {
    /// A number in SI units.
    Number(Range),
    /// A number that follows other parameters until it is set; the text says how (`"half of actuator_length"`).
    Following(Range, &'static str),
    /// One of a few named options: a reading of the paper, or a modelling choice.
    Choice(&'static [&'static str]),
}

/// A published parameter set.
#[derive(Debug)]
pub struct Preset {
    /// Name in grid files, such as `ozaki2018-large`.
    pub name: &'static str,
    /// One line: the set and the source of its numbers.
    pub doc: &'static str,
    /// The values, one per parameter of the model's table.
    pub values: fn() -> Vec<f64>,
}
