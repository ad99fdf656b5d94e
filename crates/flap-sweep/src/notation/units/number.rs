//! Parses decimal numbers, multiplies them by powers of ten, and describes mistakes in quantities.
//!
//! The product `51.1 * 1e-12` is rounded twice, and may differ from the float `51.1e-12` in the last bit.
//! This module changes the exponent in the text of a number, so that the number is rounded only once.

use std::fmt;
use std::ops::Range;

/// A mistake in a quantity, with its position in the text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnitError {
    /// Byte range of the mistake in the text.
    pub span: Range<usize>,
    /// Mistake.
    pub problem: UnitProblem,
}

/// A mistake in a quantity.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum UnitProblem {
    /// The text does not start with a number.
    NoNumber,
    /// Text that begins like a number but is not a number, such as `1e-3e`.
    BadNumber(String),
    /// The number is `inf`, `nan` or a similar word.
    NotFinite(String),
    /// The magnitude of the number in the text is above the largest 64-bit float.
    TooLarge(String),
    /// The number in the text is not zero but too small for a 64-bit float.
    TooSmall(String),
    /// The unit is missing.
    NoUnit {
        /// Expected SI unit.
        wanted: String,
        /// Usual units of the expected quantity.
        usual: Vec<String>,
    },
    /// The unit is unknown.
    UnknownUnit {
        /// Unit in the text of the quantity.
        unit: String,
        /// Most similar known unit.
        nearest: Option<String>,
        /// Usual units of the expected quantity; empty for a pure number.
        usual: Vec<String>,
    },
    /// The unit is malformed.
    BadUnit(&'static str),
    /// flap does not know the expected unit, and the text contains a different unit.
    NotConverted {
        /// Unit in the text of the quantity.
        unit: String,
        /// Expected unit.
        wanted: String,
    },
    /// The unit in the text has a different dimension from the expected unit.
    Mismatch {
        /// Unit in the text of the quantity.
        unit: String,
        /// Name of the quantity that the unit in the text measures, such as `a time`.
        measures: String,
        /// Expected SI unit; empty for a pure number.
        wanted: String,
        /// Usual units of the expected quantity; empty for a pure number.
        usual: Vec<String>,
    },
}

impl UnitError {
    /// Returns the message. `what` is the name of the value in the message.
    pub fn message(&self, what: &str) -> String {
        match &self.problem {
            UnitProblem::NoNumber => format!("{what} must start with a number"),
            UnitProblem::BadNumber(text) => format!("`{text}` is not a number"),
            UnitProblem::NotFinite(text) => format!("{what} cannot be `{text}`: values must be finite"),
            UnitProblem::TooLarge(text) => {
                format!("`{text}` is too large for {what} (largest about 1.8e308)")
            }
            UnitProblem::TooSmall(text) => {
                format!("`{text}` is too small for {what} (smallest above zero about 4.9e-324)")
            }
            UnitProblem::NoUnit { .. } => format!("{what} needs a unit"),
            UnitProblem::UnknownUnit { unit, .. } => format!("unknown unit `{unit}`"),
            UnitProblem::BadUnit(expected) => format!("malformed unit: expected {expected}"),
            UnitProblem::NotConverted { unit, wanted } => {
                format!("`{unit}` cannot be converted into `{wanted}`, the unit of {what} in its model")
            }
            UnitProblem::Mismatch { unit, measures, wanted, .. } => {
                let wanted =
                    if wanted.is_empty() { "a pure number".to_owned() } else { format!("in {wanted}") };
                format!("`{unit}` is {measures}, but {what} is {wanted}")
            }
        }
    }

    /// Returns advice for the user, if there is advice for this mistake.
    pub fn help(&self) -> Option<String> {
        match &self.problem {
            UnitProblem::NoNumber => {
                Some("write a bare number, or a number with its unit such as \"200 V\"".to_owned())
            }
            UnitProblem::BadNumber(_) => {
                Some("numbers look like 12, 0.5 or 1.5e-6, with a space before the unit".to_owned())
            }
            UnitProblem::NoUnit { wanted, usual } => {
                Some(format!("add a unit: {}; or write a bare number in {wanted}", usual.join(", ")))
            }
            UnitProblem::UnknownUnit { nearest: Some(nearest), .. } => {
                Some(format!("did you mean `{nearest}`?"))
            }
            UnitProblem::NotConverted { wanted, .. } => Some(format!("write the number in {wanted}")),
            UnitProblem::BadUnit(_) => Some("units look like V, N*m/rad, mm^2 or kg/(m*s)".to_owned()),
            UnitProblem::UnknownUnit { usual, .. } | UnitProblem::Mismatch { usual, .. }
                if usual.is_empty() =>
            {
                Some("write a bare number, or use %".to_owned())
            }
            UnitProblem::UnknownUnit { usual, .. } | UnitProblem::Mismatch { usual, .. } => {
                Some(format!("use {}", usual.join(", ")))
            }
            UnitProblem::NotFinite(_) | UnitProblem::TooLarge(_) | UnitProblem::TooSmall(_) => None,
        }
    }
}

impl fmt::Display for UnitError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message("the value"))?;
        self.help().map_or(Ok(()), |help| write!(f, "; {help}"))
    }
}

impl std::error::Error for UnitError {}

/// A number in a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Number<'t> {
    /// Whole text of the number.
    text: &'t str,
    /// Sign, digits and decimal point of the number.
    mantissa: &'t str,
    exponent: i64,
}

/// Finds the decimal number without a sign at the beginning of `text`. Returns the length of the number in
/// bytes, first without the exponent, then with the exponent. The number may have no characters, or may
/// consist of a decimal point without digits.
pub(crate) fn decimal(text: &str) -> (usize, usize) {
    let bytes = text.as_bytes();
    let digits = |from: usize| bytes[from..].iter().take_while(|byte| byte.is_ascii_digit()).count();
    let mut mantissa = digits(0);
    if bytes.get(mantissa) == Some(&b'.') {
        mantissa += 1 + digits(mantissa + 1);
    }
    let mut end = mantissa;
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
        let count = digits(end + 1 + sign);
        if count > 0 {
            end += 1 + sign + count;
        }
    }
    (mantissa, end)
}

/// Returns the number at the beginning of `text`, and its length in bytes.
///
/// # Errors
/// Returns an error if `text` does not start with a number, or if the number is malformed, such as `1e-3e`,
/// `1.2.3` or `1,5`.
pub(crate) fn scan(text: &str) -> Result<(Number<'_>, usize), UnitError> {
    let sign = usize::from(text.starts_with(['+', '-']));
    let word = text[sign..].split(|c: char| !c.is_alphabetic()).next().unwrap_or("");
    if ["nan", "inf", "infinity"].contains(&word.to_lowercase().as_str()) {
        let end = sign + word.len();
        return Err(UnitError { span: 0..end, problem: UnitProblem::NotFinite(text[..end].to_owned()) });
    }

    let (mantissa, end) = decimal(&text[sign..]);
    let (mantissa, end) = (&text[..sign + mantissa], sign + end);
    if !mantissa.contains(|c: char| c.is_ascii_digit()) {
        return Err(UnitError { span: 0..text.len(), problem: UnitProblem::NoNumber });
    }
    let exponent = text[mantissa.len()..end].get(1..).map_or(0, read_exponent);
    if text[end..].starts_with(|c: char| c.is_ascii_digit() || "eE.,_+-".contains(c)) {
        let run = text.find(char::is_whitespace).unwrap_or(text.len());
        return Err(UnitError { span: 0..run, problem: UnitProblem::BadNumber(text[..run].to_owned()) });
    }
    Ok((Number { text: &text[..end], mantissa, exponent }, end))
}

/// Returns the exponent. The magnitude of the result is at most 1e12, because an exponent of this size
/// already exceeds the range of a float.
fn read_exponent(text: &str) -> i64 {
    const BEYOND: i64 = 1_000_000_000_000;
    let limit = if text.starts_with('-') { -BEYOND } else { BEYOND };
    text.parse().map_or(limit, |exponent: i64| exponent.clamp(-BEYOND, BEYOND))
}

impl Number<'_> {
    /// Multiplies the decimal number by ten to the power `shift`, and returns the nearest float.
    ///
    /// # Errors
    /// Returns an error if the result is too large for a float, or if the result is not zero but too small
    /// for a float. The field `span` of the error is the byte range of the whole number.
    pub(crate) fn shifted(self, shift: i32) -> Result<f64, UnitError> {
        let refused = |problem| Err(UnitError { span: 0..self.text.len(), problem });
        let text = format!("{}e{}", self.mantissa, self.exponent + i64::from(shift));
        match text.parse::<f64>() {
            Err(_) => refused(UnitProblem::BadNumber(self.mantissa.to_owned())),
            Ok(value) if value.is_infinite() => refused(UnitProblem::TooLarge(self.text.to_owned())),
            Ok(0.0) if self.mantissa.contains(|c: char| ('1'..='9').contains(&c)) => {
                refused(UnitProblem::TooSmall(self.text.to_owned()))
            }
            Ok(value) => Ok(value),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the value and the length of the number at the beginning of `text`.
    fn value(text: &str) -> (f64, usize) {
        let (number, length) = scan(text).expect(text);
        (number.shifted(0).expect(text), length)
    }

    #[test]
    fn numbers() {
        let cases = [
            ("200 V", 200.0, 3),
            ("-1.5e-6", -1.5e-6, 7),
            ("+.5m", 0.5, 2 + 1),
            ("5.m", 5.0, 2),
            ("1E3", 1000.0, 3),
            ("0e999999999999999999999", 0.0, 23),
        ];
        for (text, expected, length) in cases {
            assert_eq!(value(text), (expected, length), "{text}");
        }
    }

    #[test]
    fn malformed() {
        let bad = |text: &str| UnitProblem::BadNumber(text.to_owned());
        let cases = [
            ("1e-3e m", 0..5, bad("1e-3e")),
            ("1.2.3 V", 0..5, bad("1.2.3")),
            ("1,5 V", 0..3, bad("1,5")),
            ("1_000 V", 0..5, bad("1_000")),
            ("5e V", 0..2, bad("5e")),
            ("fast", 0..4, UnitProblem::NoNumber),
            ("", 0..0, UnitProblem::NoNumber),
            (".", 0..1, UnitProblem::NoNumber),
            ("nan V", 0..3, UnitProblem::NotFinite("nan".to_owned())),
            ("-Infinity", 0..9, UnitProblem::NotFinite("-Infinity".to_owned())),
        ];
        for (text, span, problem) in cases {
            assert_eq!(scan(text), Err(UnitError { span, problem }), "{text}");
        }
    }

    #[test]
    fn ends_of_the_float_range() {
        let shifted =
            |text: &str, shift| scan(text).expect(text).0.shifted(shift).map_err(|error| error.problem);
        assert_eq!(shifted("1e400", 0), Err(UnitProblem::TooLarge("1e400".to_owned())));
        assert_eq!(shifted("1e400", -100), Ok(1e300));
        assert_eq!(shifted("1e-400", 0), Err(UnitProblem::TooSmall("1e-400".to_owned())));
        assert!(matches!(shifted("1e99999999999999999999", 0), Err(UnitProblem::TooLarge(_))));
        assert_eq!(shifted("0.0e-400", 0), Ok(0.0));
    }
}
