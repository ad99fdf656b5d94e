//! Rows of a parameter table, and published parameter sets.

/// One row of the parameter table of a model or a vehicle.
#[derive(Clone, Copy, Debug)]
pub struct Parameter<'a> {
    /// Name of the parameter in grid files, on the command line and in Python.
    pub name: &'a str,
    /// SI unit in the notation of grid files, such as `"N*m/rad"`. The text is empty for numbers without a
    /// unit and for choices.
    pub unit: &'static str,
    /// Symbol of the parameter in the paper of the model. The text is empty if the paper has no symbol for
    /// the parameter.
    pub symbol: &'static str,
    /// Allowed values.
    pub kind: Kind<'a>,
    /// Description of the parameter in one line, with the source of the value.
    pub doc: &'a str,
    /// Name of the parameter's group, which is a part of the robot, such as `hinge`. In lists of parameters,
    /// the name of the group is a heading.
    pub group: &'a str,
    /// Value of the parameter if no preset sets the parameter. The value is NaN if the parameter has no
    /// default.
    pub default: f64,
    /// True if the published value was fitted to measurements of one vehicle. The fitted value need not be valid for
    /// another vehicle.
    pub is_fitted: bool,
    /// Names of the parameters with which this parameter usually grows, each with the exponent of the growth.
    /// For example, the inertia of a wing grows with the fourth power of the wing length if shape and
    /// thickness stay the same. Models do not use the exponents, but `flap check` reports parameters that
    /// should change together.
    pub scales_with: &'static [(&'static str, f64)],
}

impl<'a> Parameter<'a> {
    /// Returns a parameter that has no group and no default, and whose published value was not fitted.
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

    /// Returns the index in `table` of the parameter with the given name.
    pub fn index(table: &[Parameter<'_>], name: &str) -> Option<usize> {
        table.iter().position(|parameter| parameter.name == name)
    }
}

/// Allowed values of a parameter.
#[derive(Clone, Copy, Debug)]
pub enum Kind<'a> {
    /// A number in SI units.
    Number(Range),
    /// A number that flap computes from other parameters if the parameter is not set. The text describes the
    /// computed value, for example `"half of actuator_length"`.
    Following(Range, &'static str),
    /// One of several named options. The options are different interpretations of a paper, or different
    /// modelling choices.
    Choice(&'a [&'a str]),
}

impl Kind<'_> {
    /// Returns the allowed values as text: the words of [`Range::describe`], or the names of the options.
    pub fn describe(&self) -> String {
        match self {
            Kind::Number(range) => range.describe(),
            Kind::Following(range, follows) => format!("{}; if not set, {follows}", range.describe()),
            Kind::Choice(options) => options.join(" | "),
        }
    }
}

/// A published parameter set.
#[derive(Debug)]
pub struct Preset {
    /// Name of the preset in grid files, such as `ozaki2018-large`.
    pub name: &'static str,
    /// Description of the preset in one line, with the source of the values.
    pub doc: &'static str,
    /// Returns the values of the preset, one for each parameter of the model's table.
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
    /// Numbers between two limits. The limits themselves are not allowed.
    Between(f64, f64),
    /// Numbers from 0 to 1, including 0 and 1.
    Share,
    /// Whole numbers from the first limit to the second limit, including both limits.
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

    /// Returns the words that describe the range in messages, such as `"more than zero"`, `"between 0 and 2"`
    /// or `"a whole number from 1 to 64"`.
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
