//! Parses quantities with units in grid files, such as `"200 V"`, `"1.52 uN*m/rad"` or `"45 °"`.
//!
//! A quantity is a number followed by a unit. A unit consists of symbols that are joined by `*`, `·` and `/`.
//! A symbol may have an SI prefix, and a power such as `^2` or `²`. SI prefixes change the exponent in the
//! text of the number, before the number is rounded to a float. For example, `"135 um"` is exactly the float
//! `135e-6`.

mod number;
mod prefixed;
mod unit;

use std::ops::Range;

pub use number::{UnitError, UnitProblem};
pub(crate) use number::{decimal, scan};
pub use prefixed::{exact, meant, prefixed};
use unit::Unit;

/// Returns the value of the quantity `text` in SI units. The unit in `text` must have the same dimension as
/// `si_unit`.
///
/// If `si_unit` is empty, the quantity is a pure number. Only a pure number may be written without a unit.
///
/// If flap does not know the unit `si_unit`, such as `rpm` in a model of another program, the unit in `text`
/// must be exactly `si_unit`.
///
/// # Errors
/// Returns an error if `text` has no number, if its unit is unknown, malformed or wrong, or if its value is
/// not a finite float. The field `span` of the error is the byte range of the mistake in `text`.
pub fn parse_as(text: &str, si_unit: &str) -> Result<f64, UnitError> {
    let start = text.len() - text.trim_start().len();
    parse_trimmed(text.trim(), si_unit).map_err(|error| offset(error, start))
}

fn parse_trimmed(text: &str, si_unit: &str) -> Result<f64, UnitError> {
    let (number, length) = scan(text)?;
    let unit_text = text[length..].trim_start();
    let unit_start = text.len() - unit_text.len();
    let unit_span = unit_start..text.len();
    if unit_text.is_empty() && !si_unit.is_empty() {
        number.shifted(0)?;
        let problem = UnitProblem::NoUnit { wanted: si_unit.to_owned(), usual: unit::usual(si_unit) };
        return Err(UnitError { span: 0..length, problem });
    }
    let Ok(wanted) = unit::parse(si_unit) else {
        if unit_text == si_unit {
            return number.shifted(0);
        }
        let (unit, wanted) = (unit_text.to_owned(), si_unit.to_owned());
        return Err(UnitError { span: unit_span, problem: UnitProblem::NotConverted { unit, wanted } });
    };
    let unit = unit::parse(unit_text)
        .map_err(|error| offset(with_suggestion(error, unit_text, si_unit, wanted), unit_start))?;
    if !unit.dimension.fits(wanted.dimension) {
        let problem = UnitProblem::Mismatch {
            unit: unit_text.to_owned(),
            measures: unit.dimension.to_string(),
            wanted: si_unit.to_owned(),
            usual: unit::usual(si_unit),
        };
        return Err(UnitError { span: unit_span, problem });
    }

    // Multiplication and division by 1 are exact, so decimal units stay exact.
    let value = number.shifted(unit.shift)? * unit.above / unit.below;
    if value.is_finite() {
        Ok(value)
    } else {
        Err(UnitError { span: 0..length, problem: UnitProblem::TooLarge(text.to_owned()) })
    }
}

/// Returns the exponents of the SI base units and of the radian in an SI unit, such as `m/s^2`.
///
/// Returns `None` for units that flap does not know, and for units with a factor, such as `mm`.
pub(crate) fn si_powers(unit: &str) -> Option<[(&'static str, i32); 5]> {
    let unit = unit::parse(unit).ok()?;
    (unit.shift == 0 && unit.above == unit.below).then(|| unit.dimension.powers())
}

/// Returns the value of the quantity `text` in the unit `unit`. `unit` need not be an SI unit without a
/// prefix: for example, `mN` and `deg` are allowed.
///
/// # Errors
/// Returns the errors of [`parse_as`].
///
/// ```
/// use flap_sweep::notation::units::parse_in;
/// assert_eq!((parse_in("2 N", "mN").unwrap(), parse_in("2 N", "N").unwrap()), (2000.0, 2.0));
/// ```
pub fn parse_in(text: &str, unit: &str) -> Result<f64, UnitError> {
    Ok(parse_as(text, unit)? / parse_as(&format!("1 {unit}"), unit).unwrap_or(1.0))
}

/// Returns the value of the quantity `text` in SI units. If `text` contains no unit, the number in `text` is
/// already in SI units.
///
/// # Errors
/// Returns the errors of [`parse_as`], except the error about a missing unit.
///
/// ```
/// use flap_sweep::notation::units::parse_or_si;
/// assert_eq!((parse_or_si("2 kV", "V").unwrap(), parse_or_si("2", "V").unwrap()), (2000.0, 2.0));
/// assert!(parse_or_si("110%", "V").is_err() && parse_or_si("45 deg", "Hz").is_err());
/// assert_eq!((parse_or_si("5%", "").unwrap(), parse_or_si("50 mrad", "rad").unwrap()), (0.05, 0.05));
/// ```
pub fn parse_or_si(text: &str, si_unit: &str) -> Result<f64, UnitError> {
    parse_as(text, if has_unit(text) { si_unit } else { "" })
}

/// Returns true if a text is a number with a unit or `%`.
///
/// ```
/// use flap_sweep::notation::units::has_unit;
/// assert!(has_unit("17 mm") && has_unit("5%"));
/// assert!(!has_unit("17") && !has_unit("on"));
/// ```
pub fn has_unit(text: &str) -> bool {
    let text = text.trim();
    scan(text).is_ok_and(|(_, length)| !text[length..].trim().is_empty())
}

/// Shifts the position of an error by `start` bytes.
fn offset(error: UnitError, start: usize) -> UnitError {
    let Range { start: from, end } = error.span;
    UnitError { span: from + start..end + start, ..error }
}

/// Adds suggestions to the error about an unknown unit in `text`.
///
/// If a suggestion gives the whole unit the dimension of `si_unit`, the function prefers this suggestion.
fn with_suggestion(mut error: UnitError, text: &str, si_unit: &str, wanted: Unit) -> UnitError {
    let span = error.span.clone();
    if let UnitProblem::UnknownUnit { unit, nearest, usual } = &mut error.problem {
        *usual = unit::usual(si_unit);
        if nearest.is_none() {
            let guesses = unit::suggestions(unit);
            let fits = |guess: &&String| {
                let repaired = format!("{}{guess}{}", &text[..span.start], &text[span.end..]);
                unit::parse(&repaired).is_ok_and(|unit| unit.dimension.fits(wanted.dimension))
            };
            *nearest = guesses.iter().find(fits).or(guesses.first()).cloned();
        }
    }
    error
}

#[cfg(test)]
mod tests;
