//! Decimal numbers whose power of ten is shifted in the text.
//!
//! `51.1e-12` computed as `51.1 * 1e-12` is rounded twice and may differ from the literal in its last bit.
//! Shifting the exponent before the number is parsed rounds once.

use super::error::{Problem, UnitError};

/// A number as written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Number<'t> {
    /// All of it.
    text: &'t str,
    /// Sign, digits and point.
    mantissa: &'t str,
    exponent: i64,
}

/// Splits a number off the front of `text`. Returns it with its length in bytes.
///
/// # Errors
/// If `text` does not start with a number, or runs on as if the number went wrong (`1e-3e`, `1.2.3`, `1,5`).
pub(crate) fn scan(text: &str) -> Result<(Number<'_>, usize), UnitError> {
    let bytes = text.as_bytes();
    let digits = |from: usize| bytes[from..].iter().take_while(|byte| byte.is_ascii_digit()).count();

    let sign = usize::from(matches!(bytes.first(), Some(b'+' | b'-')));
    let word = text[sign..].split(|c: char| !c.is_alphabetic()).next().unwrap_or("");
    if ["nan", "inf", "infinity"].contains(&word.to_lowercase().as_str()) {
        let end = sign + word.len();
        return Err(UnitError { span: 0..end, problem: Problem::NotFinite(text[..end].to_owned()) });
    }

    let whole = digits(sign);
    let mut end = sign + whole;
    let mut fraction = 0;
    if bytes.get(end) == Some(&b'.') {
        fraction = digits(end + 1);
        end += 1 + fraction;
    }
    if whole + fraction == 0 {
        return Err(UnitError { span: 0..text.len(), problem: Problem::NoNumber });
    }
    let mantissa = &text[..end];

    let mut exponent = 0;
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
        let count = digits(end + 1 + sign);
        if count > 0 {
            exponent = read_exponent(&text[end + 1..end + 1 + sign + count]);
            end += 1 + sign + count;
        }
    }

    if text[end..].starts_with(|c: char| c.is_ascii_digit() || "eE.,_+-".contains(c)) {
        let run = text.find(char::is_whitespace).unwrap_or(text.len());
        return Err(UnitError { span: 0..run, problem: Problem::BadNumber(text[..run].to_owned()) });
    }
    Ok((Number { text: &text[..end], mantissa, exponent }, end))
}

/// An exponent with more digits than an `i64` holds is as good as any other that overflows a float.
fn read_exponent(text: &str) -> i64 {
    const BEYOND: i64 = 1_000_000_000_000;
    let limit = if text.starts_with('-') { -BEYOND } else { BEYOND };
    text.parse().map_or(limit, |exponent: i64| exponent.clamp(-BEYOND, BEYOND))
}

impl Number<'_> {
    /// The float nearest to this number times ten to the power `shift`.
    ///
    /// # Errors
    /// If it is too large for a float, or too small without being zero.
    pub(crate) fn shifted(self, shift: i32) -> Result<f64, Problem> {
        let text = format!("{}e{}", self.mantissa, self.exponent + i64::from(shift));
        let value: f64 = text.parse().map_err(|_| Problem::BadNumber(self.mantissa.to_owned()))?;
        if value.is_infinite() {
            Err(Problem::TooLarge(self.text.to_owned()))
        } else if value == 0.0 && self.mantissa.contains(|c: char| ('1'..='9').contains(&c)) {
            Err(Problem::TooSmall(self.text.to_owned()))
        } else {
            Ok(value)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The value and the length of the number at the front of `text`.
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
        let bad = |text: &str| Problem::BadNumber(text.to_owned());
        let cases = [
            ("1e-3e m", 0..5, bad("1e-3e")),
            ("1.2.3 V", 0..5, bad("1.2.3")),
            ("1,5 V", 0..3, bad("1,5")),
            ("1_000 V", 0..5, bad("1_000")),
            ("5e V", 0..2, bad("5e")),
            ("fast", 0..4, Problem::NoNumber),
            ("", 0..0, Problem::NoNumber),
            (".", 0..1, Problem::NoNumber),
            ("nan V", 0..3, Problem::NotFinite("nan".to_owned())),
            ("-Infinity", 0..9, Problem::NotFinite("-Infinity".to_owned())),
        ];
        for (text, span, problem) in cases {
            assert_eq!(scan(text), Err(UnitError { span, problem }), "{text}");
        }
    }

    #[test]
    fn ends_of_the_float_range() {
        let shifted = |text: &str, shift| scan(text).expect(text).0.shifted(shift);
        assert_eq!(shifted("1e400", 0), Err(Problem::TooLarge("1e400".to_owned())));
        assert_eq!(shifted("1e400", -100), Ok(1e300));
        assert_eq!(shifted("1e-400", 0), Err(Problem::TooSmall("1e-400".to_owned())));
        assert!(matches!(shifted("1e99999999999999999999", 0), Err(Problem::TooLarge(_))));
        assert_eq!(shifted("0.0e-400", 0), Ok(0.0));
    }
}
