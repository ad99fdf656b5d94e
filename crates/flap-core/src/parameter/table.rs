//! Rows of a parameter table, and published parameter sets.

/// One row of the parameter table of a model or a vehicle.
#[derive(Clone, Copy, Debug)]
pub struct Parameter<'a> {
    /// Name in grid files, on the command line and in Python.
    pub name: &'a str,
    /// SI unit as units are written in grid files (`"N*m/rad"`), empty for pure numbers and choices.
    pub unit: &'static str,
    /// Symbol in the model's paper, empty if the paper has none.
    pub symbol: &'static str,
    /// Allowed values.
    pub kind: Kind<'a>,
    /// Description in one line, with its source.
    pub doc: &'a str,
    /// Part of the robot, such as `hinge`. It is a heading in lists of parameters.
    pub group: &'a str,
    /// Value if no preset sets the parameter; NaN if there is none.
    pub default: f64,
    /// True if the published value was fitted to measurements of one vehicle. It need not be valid for another.
    pub is_fitted: bool,
    /// Parameters whose change usually changes this one too, with the exponent. A wing's inertia grows with the fourth
    /// power of its length if the wing keeps its shape and thickness. Models do not apply these powers: `flap check`
    /// reports them.
    pub scales_with: &'static [(&'static str, f64)],
}

impl<'a> Parameter<'a> {
    /// Returns a parameter without group and default, whose value is not fitted.
    pub const fn new(
        name: &'a str,
        unit: &'static str,
        symbol: &'static str,
        kind: Kind<'a>,
        doc: &'a str,
    ) -> Parameter<'a> {
        Parameter {
            name,
            unit,
            symbol,
            kind,
            doc,
            group: "",
            default: f64::NAN,
            is_fitted: false,
            scales_with: &[],
        }
    }

    /// Returns the index in `table` of the parameter with this name.
    pub fn index(table: &[Parameter<'_>], name: &str) -> Option<usize> {
        table.iter().position(|parameter| parameter.name == name)
    }
}

/// Allowed values of a parameter.
#[derive(Clone, Copy, Debug)]
pub enum Kind<'a> {
    /// A number in SI units.
    Number(Range),
    /// A number that follows other parameters until it is set. The text is the value that it then has (`"half of
    /// actuator_length"`).
    Following(Range, &'static str),
    /// One of several named options: a reading of the paper, or a modelling choice.
    Choice(&'a [&'a str]),
}

/// A published parameter set.
#[derive(Debug)]
pub struct Preset {
    /// Name in grid files, such as `ozaki2018-large`.
    pub name: &'static str,
    /// Description in one line: the set and the source of its numbers.
    pub doc: &'static str,
    /// Returns the values, one per parameter of the model's table.
    pub values: fn() -> Vec<f64>,
}

/// Range of finite numbers that a parameter accepts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Range {
    /// Any finite number.
    Any,
    /// Zero or more.
    NonNegative,
    /// More than zero.
    Positive,
    /// Numbers between two limits, which are excluded.
    Between(f64, f64),
    /// Numbers from 0 to 1, both included.
    Share,
    /// Whole numbers from the first to the last, both included.
    Whole(u32, u32),
}

impl Range {
    /// Returns true if `value` is finite and within the range.
    pub fn contains(self, value: f64) -> bool {
        value.is_finite()
            && match self {
                Range::Any => true,
                Range::NonNegative => value >= 0.0,
                Range::Positive => value > 0.0,
                Range::Between(low, high) => low < value && value < high,
                Range::Share => (0.0..=1.0).contains(&value),
                Range::Whole(first, last) => {
                    value.fract() == 0.0 && (f64::from(first)..=f64::from(last)).contains(&value)
                }
            }
    }

    /// Returns the range in words, for messages: `"more than zero"`, `"between 0 and 2"`, `"a whole number from 1 to
    /// 64"`.
    pub fn describe(self) -> String {
        match self {
            Range::Any => "any number".to_owned(),
            Range::NonNegative => "zero or more".to_owned(),
            Range::Positive => "more than zero".to_owned(),
            Range::Between(low, high) => format!("between {low} and {high}"),
            Range::Share => "from 0 to 1".to_owned(),
            Range::Whole(first, last) => format!("a whole number from {first} to {last}"),
        }
    }
}
