//! The numbers that a parameter accepts.

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
