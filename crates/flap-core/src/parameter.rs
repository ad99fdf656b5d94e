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

/// Parameters that are impossible together, with the reason.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{reason}")]
pub struct Invalid {
    /// What is impossible and why.
    pub reason: String,
}

impl Invalid {
    /// An error with this reason.
    pub fn new(reason: impl Into<String>) -> Invalid {
        Invalid { reason: reason.into() }
    }
}

/// A field of a parameter struct, as one `f64` of a design point.
pub trait Slot {
    /// The field from a point's value.
    fn from_value(value: f64) -> Self;

    /// The point's value from the field.
    fn to_value(&self) -> f64;
}

impl Slot for f64 {
    fn from_value(value: f64) -> f64 {
        value
    }

    fn to_value(&self) -> f64 {
        *self
    }
}

impl Slot for Option<f64> {
    fn from_value(value: f64) -> Option<f64> {
        (!value.is_nan()).then_some(value)
    }

    fn to_value(&self) -> f64 {
        self.unwrap_or(f64::NAN)
    }
}

/// Declares a model's parameter struct and, from the same lines, its table.
///
/// Each line gives the field's documentation, name and type (`f64`; `Option<f64>` for a number that follows
/// others until it is set; an enum that implements [`Slot`] for a choice), then SI unit, symbol and [`Kind`].
/// The struct gets `TABLE`, `from_values` and `to_values`; the table's order is that of the fields.
#[macro_export]
macro_rules! parameters {
    ($(#[$meta:meta])* pub struct $Name:ident {
        $($(#[doc = $doc:literal])+ $field:ident: $type:ty = ($unit:literal, $symbol:literal, $kind:expr),)*
    }) => {
        $(#[$meta])*
        #[derive(Clone, Debug, PartialEq)]
        pub struct $Name {
            $($(#[doc = $doc])+ pub $field: $type,)*
        }

        impl $Name {
            /// The parameter table, in the order of the fields.
            pub const TABLE: &'static [$crate::parameter::Parameter] = &[
                $($crate::parameter::Parameter {
                    name: stringify!($field),
                    unit: $unit,
                    symbol: $symbol,
                    kind: $kind,
                    doc: concat!($($doc),+).trim_ascii_start(),
                },)*
            ];

            /// The parameters of a point, given one value per table entry.
            pub fn from_values(values: &[f64]) -> $Name {
                let mut values = values.iter().copied();
                $Name {
                    $($field: $crate::parameter::Slot::from_value(values.next().unwrap_or(f64::NAN)),)*
                }
            }

            /// One value per table entry.
            pub fn to_values(&self) -> Vec<f64> {
                vec![$($crate::parameter::Slot::to_value(&self.$field),)*]
            }
        }
    };
}
