//! Rows of a parameter table, and published parameter sets.

/// One row of the parameter table of a model or of a vehicle, which has the texts.
#[derive(Clone, Copy, Debug)]
pub struct Parameter<'a> {
    /// Name in grid files, on the command line and in Python.
    pub name: &'a str,
    /// SI unit as units are written in grid files (`"N*m/rad"`), empty for pure numbers and choices.
    pub unit: &'static str,
    /// Symbol in the model's paper, empty if the paper has none.
    pub symbol: &'static str,
    /// The values that it takes.
    pub kind: Kind,
    /// Meaning in one line, with its source.
    pub doc: &'a str,
    /// The part of the robot that it describes, such as `hinge`: a heading of lists of parameters.
    pub group: &'a str,
    /// Name in earlier versions, which is still understood; empty if it had none.
    pub former: &'static str,
    /// Value where no preset gives one; not a number if there is none.
    pub default: f64,
    /// True if the published value was fitted to measurements of one vehicle: it need not hold for another.
    pub is_fitted: bool,
}

impl<'a> Parameter<'a> {
    /// A parameter without a group, a former name and a default, whose value is not a fit.
    pub const fn new(
        name: &'a str,
        unit: &'static str,
        symbol: &'static str,
        kind: Kind,
        doc: &'a str,
    ) -> Parameter<'a> {
        Parameter {
            name,
            unit,
            symbol,
            kind,
            doc,
            group: "",
            former: "",
            default: f64::NAN,
            is_fitted: false,
        }
    }

    /// The note on a former name that is still understood.
    pub fn renamed(&self) -> String {
        format!("`{}` is called `{}` now; the former name still works", self.former, self.name)
    }

    /// The index of the parameter called `name`, now or in earlier versions, in a model's table.
    pub fn index(table: &[Parameter<'_>], name: &str) -> Option<usize> {
        let now = table.iter().position(|parameter| parameter.name == name);
        now.or_else(|| table.iter().position(|parameter| !name.is_empty() && parameter.former == name))
    }
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

/// The finite numbers that a parameter accepts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Range {
    /// Any finite number.
    Any,
    /// Zero or more.
    NonNegative,
    /// More than zero.
    Positive,
    /// Numbers between two others, both excluded.
    Between(f64, f64),
    /// Numbers from 0 to 1, both included.
    Share,
    /// Whole numbers from the first to the last, both included.
    Whole(u32, u32),
}

impl Range {
    /// True if `value` is finite and within the range.
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

    /// The range in words, for messages: `"more than zero"`, `"between 0 and 2"`, `"a whole number from 1 to 64"`.
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
