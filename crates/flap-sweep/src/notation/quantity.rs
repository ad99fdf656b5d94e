//! Numbers with units in comparisons: `drive_frequency > 95 Hz`.

use std::fmt::Write as _;
use std::ops::Range;

use super::{UserError, units};

/// Words after a number that are not units.
const WORDS: [&str; 3] = ["and", "or", "not"];

/// A number with a unit in a comparison.
pub struct Quantity<'t> {
    /// Position of the bytes of the number in the text.
    pub number: Range<usize>,
    /// Position of the bytes of the unit in the text.
    pub unit: Range<usize>,
    /// The name with which the quantity is compared.
    pub with: Option<&'t str>,
}

/// The comparison `text` without units: each number is converted to the unit of the column with which the number is
/// compared. `unit_of` finds the unit of a column by its name.
///
/// # Errors
/// Returns the error from `refused` for a number whose unit is compared with no column, or with a column of another
/// dimension. The error of `unit_of` for an unknown name.
pub fn without_units<E>(
    text: &str,
    unit_of: impl Fn(&str) -> Result<String, E>,
    refused: impl Fn(UserError) -> E,
) -> Result<String, E> {
    let mut plain = String::new();
    let mut copied = 0;
    for Quantity { number, unit, with } in quantities(text) {
        let quantity = &text[number.start..unit.end];
        let name = with.ok_or_else(|| {
            let message = format!("`{quantity}` is not compared with a column");
            let help = "a number with a unit stands beside a column: drive_frequency > 95 Hz";
            refused(UserError { message, help: Some(help.to_owned()) })
        })?;
        let column_unit = unit_of(name)?;
        // The cells of a measure are in its own unit, such as mN, and not in SI units.
        let value = units::parse_in(quantity, &column_unit)
            .map_err(|error| refused(UserError { message: error.message(name), help: error.help() }))?;
        plain += &text[copied..number.start];
        let _ = write!(plain, "{value:?}");
        copied = unit.end;
    }
    Ok(plain + &text[copied..])
}

/// The numbers with units in `text`, from left to right.
pub fn quantities(text: &str) -> Vec<Quantity<'_>> {
    let mut found = Vec::new();
    let mut from = 0;
    while let Some(start) = text[from..].find(|letter: char| is_name(letter) || "'\"".contains(letter)) {
        let start = from + start;
        let rest = &text[start..];
        let first = rest.chars().next().unwrap_or_default();
        if first == '\'' || first == '"' {
            from = start + 1 + rest[1..].find(first).map_or(rest.len() - 1, |end| end + 1);
            continue;
        }
        let length = number(rest);
        if length == 0 {
            from = start + rest.find(|letter| !is_name(letter)).unwrap_or(rest.len());
            continue;
        }
        let number = start..start + length;
        let behind = &text[number.end..];
        let blanks = behind.len() - behind.trim_start().len();
        let unit = number.end + blanks..number.end + blanks + unit(behind.trim_start());
        from = unit.end.max(number.end);
        if !unit.is_empty() {
            found.push(Quantity { with: compared(text, number.start, unit.end), number, unit });
        }
    }
    found
}

/// Number of bytes of the number at the beginning of `text`; 0 if `text` begins with something else.
fn number(text: &str) -> usize {
    let (mantissa, end) = units::decimal(text);
    if text[..mantissa].contains(|letter: char| letter.is_ascii_digit()) { end } else { 0 }
}

/// Number of bytes of the unit at the beginning of `text`; 0 if `text` begins with something else.
fn unit(text: &str) -> usize {
    let word = text.find(|letter| !is_name(letter)).unwrap_or(text.len());
    let is_unit = text.starts_with(|letter: char| letter.is_alphabetic() || "°%".contains(letter));
    if !is_unit || WORDS.contains(&&text[..word]) {
        return 0;
    }
    let is_part = |letter: char| letter.is_alphanumeric() || "*/^·°%-".contains(letter);
    text.find(|letter| !is_part(letter)).unwrap_or(text.len())
}

/// The name with which the text from `start` to `end` is compared. The name is on the left or on the right of the
/// number.
fn compared(text: &str, start: usize, end: usize) -> Option<&str> {
    let is_sign = |letter: char| "<>=!".contains(letter);
    let left = text[..start].trim_end().trim_end_matches(['-', '+']).trim_end();
    let before = left.trim_end_matches(is_sign);
    let right = text[end..].trim_start();
    let behind = right.trim_start_matches(is_sign);
    let name = if before.len() < left.len() {
        let before = before.trim_end();
        &before[before.rfind(|letter| !is_name(letter)).map_or(0, |at| at + 1)..]
    } else if behind.len() < right.len() {
        let behind = behind.trim_start();
        &behind[..behind.find(|letter| !is_name(letter)).unwrap_or(behind.len())]
    } else {
        ""
    };
    name.starts_with(|letter: char| letter.is_alphabetic() || letter == '_').then_some(name)
}

/// True for the characters that names and numbers can contain.
fn is_name(letter: char) -> bool {
    letter.is_alphanumeric() || letter == '_' || letter == '.'
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plain(text: &str) -> Result<String, String> {
        let names = [("drive_frequency", "Hz"), ("hinge_stiffness", "N*m/rad"), ("x2", "")];
        let unit = |name: &str| {
            let found = names.iter().find(|(known, _)| *known == name);
            found.map(|(_, unit)| (*unit).to_owned()).ok_or_else(|| format!("there is no column `{name}`"))
        };
        without_units(text, unit, |error| error.message)
    }

    #[test]
    fn numbers_are_in_the_units_of_their_columns() {
        for (text, wanted) in [
            ("drive_frequency > 95 Hz", "drive_frequency > 95.0"),
            ("drive_frequency>0.1kHz", "drive_frequency>100.0"),
            ("95 Hz <= drive_frequency and x2 < 3", "95.0 <= drive_frequency and x2 < 3"),
            ("hinge_stiffness > 90 uN*m/rad or (x2 > 1)", "hinge_stiffness > 9e-5 or (x2 > 1)"),
            ("drive_frequency > -5 Hz", "drive_frequency > -5.0"),
            ("x2<0.08 %", "x2<0.0008"),
            ("x2 > 5% and x2 < 10 %", "x2 > 0.05 and x2 < 0.1"),
            ("x2 > 1e3 and not x2 == 7", "x2 > 1e3 and not x2 == 7"),
            ("arms == '95 Hz'", "arms == '95 Hz'"),
        ] {
            assert_eq!(plain(text).unwrap(), wanted);
        }
    }

    #[test]
    fn units_of_another_kind_are_refused() {
        for (text, wanted) in [
            ("drive_frequency > 95 V", "but drive_frequency is in Hz"),
            ("frequency > 95 Hz", "there is no column `frequency`"),
            ("(95 Hz) < drive_frequency", "is not compared with a column"),
        ] {
            let message = plain(text).unwrap_err();
            assert!(message.contains(wanted), "{message}");
        }
    }
}
