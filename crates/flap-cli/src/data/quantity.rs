//! Numbers with units in comparisons: `drive_frequency > 95 Hz`.

use std::fmt::Write as _;
use std::ops::Range;

use flap_sweep::notation::units;
#[cfg(feature = "plots")]
use flap_sweep::table::labels;

use super::columns;
use crate::failure::Failure;

/// Words after a number that are not units.
const WORDS: [&str; 3] = ["and", "or", "not"];

/// A number with a unit in a comparison.
struct Quantity<'t> {
    /// Byte range of the number and its unit.
    number: Range<usize>,
    unit: Range<usize>,
    /// The name that the number is compared with.
    with: Option<&'t str>,
}

/// Returns the comparison `text` without units: its numbers are converted to the units of the columns that they are compared with.
///
/// # Errors
/// `Usage` for a number with a unit that is compared with no column, or with a column of another kind.
pub(super) fn without_units(
    text: &str,
    names: &[String],
    unit_of: impl Fn(usize) -> String,
) -> Result<String, Failure> {
    let mut plain = String::new();
    let mut copied = 0;
    for Quantity { number, unit, with } in quantities(text) {
        let Some(name) = with else {
            let quantity = &text[number.start..unit.end];
            let message = format!("--where {text}: `{quantity}` is not compared with a column");
            return Err(Failure::usage(message)
                .help("compare a number with a unit with a column: drive_frequency > 95 Hz"));
        };
        let column = columns::find(names.iter().map(String::as_str), name)?;
        let column_unit = unit_of(column);
        let value = units::parse_as(&text[number.start..unit.end], &column_unit).map_err(|error| {
            let failure = Failure::usage(format!("--where {text}: {}", error.message(name)));
            error.help().into_iter().fold(failure, Failure::help)
        })?;
        // Cells of a measure are in the measure's unit, such as mN, instead of the SI unit.
        let value = value / units::parse_as(&format!("1 {column_unit}"), &column_unit).unwrap_or(1.0);
        plain += &text[copied..number.start];
        let _ = write!(plain, "{value:?}");
        copied = unit.end;
    }
    Ok(plain + &text[copied..])
}

/// Returns the comparison `text` with its units as they are printed: `µN·m/rad`.
#[cfg(feature = "plots")]
pub(crate) fn printed(text: &str) -> String {
    let mut shown = String::new();
    let mut copied = 0;
    for Quantity { number, unit, .. } in quantities(text) {
        shown += &text[copied..number.end];
        shown += " ";
        shown += &labels::printed(&text[unit.clone()]);
        copied = unit.end;
    }
    shown + &text[copied..]
}

/// Returns the numbers with units in `text`, from left to right.
fn quantities(text: &str) -> Vec<Quantity<'_>> {
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

/// Returns the number of bytes of the number at the start of `text`; 0 if there is none.
fn number(text: &str) -> usize {
    let digits = |from: usize| text[from..].bytes().take_while(u8::is_ascii_digit).count();
    let mut end = digits(0);
    let mut count = end;
    if text[end..].starts_with('.') {
        count += digits(end + 1);
        end += 1 + digits(end + 1);
    }
    if count == 0 {
        return 0;
    }
    if text[end..].starts_with(['e', 'E']) {
        let sign = usize::from(text[end + 1..].starts_with(['+', '-']));
        let exponent = digits(end + 1 + sign);
        if exponent > 0 {
            end += 1 + sign + exponent;
        }
    }
    end
}

/// Returns the number of bytes of the unit at the start of `text`; 0 if there is none.
fn unit(text: &str) -> usize {
    let word = text.find(|letter| !is_name(letter)).unwrap_or(text.len());
    let is_unit = text.starts_with(|letter: char| letter.is_alphabetic() || "°%".contains(letter));
    if !is_unit || WORDS.contains(&&text[..word]) {
        return 0;
    }
    let is_part = |letter: char| letter.is_alphanumeric() || "*/^·°%-".contains(letter);
    text.find(|letter| !is_part(letter)).unwrap_or(text.len())
}

/// Returns the name that the text from `start` to `end` is compared with, on its left or right.
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

/// Returns true for characters of names and numbers.
fn is_name(letter: char) -> bool {
    letter.is_alphanumeric() || letter == '_' || letter == '.'
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plain(text: &str) -> Result<String, Failure> {
        let names = ["drive_frequency", "hinge_stiffness", "x2"].map(str::to_owned);
        without_units(text, &names, |column| ["Hz", "N*m/rad", ""][column].to_owned())
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
            let Err(Failure::Usage(message, _)) = plain(text) else { panic!("{text}") };
            assert!(message.contains(wanted), "{message}");
        }
    }

    #[test]
    #[cfg(feature = "plots")]
    fn units_are_printed_as_in_books() {
        assert_eq!(printed("hinge_stiffness > 90 uN*m/rad"), "hinge_stiffness > 90 µN·m/rad");
        assert_eq!(printed("x2 > 1"), "x2 > 1");
    }
}
