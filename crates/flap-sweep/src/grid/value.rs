//! Reads single values of parameters and settings.

use std::collections::HashMap;
use std::ops::Range;

use flap_core::parameter::{Kind, Parameter};
use toml::Spanned;
use toml::de::{DeInteger, DeValue};

use super::diagnostic::Problems;
use super::table::{self, Entry};
use crate::notation::units::{self, UnitError, UnitProblem};
use crate::notation::value::{self, UnitOf, ValueError};

type Value<'t> = Spanned<DeValue<'t>>;

/// Returns the value of `parameter`, which is a number in SI units, or the index of an option of a choice.
pub(super) fn of_parameter(parameter: &Parameter, value: &Value<'_>, problems: &mut Problems) -> Option<f64> {
    let found = match (&parameter.kind, value.get_ref()) {
        (_, DeValue::String(text)) => value::of_text(parameter, text, UnitOf::Text),
        (Kind::Choice(options), _) => {
            report_no_text(parameter.name, options, value, problems);
            return None;
        }
        (Kind::Number(_) | Kind::Following(..), _) => {
            value::of_number(parameter, quantity(parameter.name, parameter.unit, value, problems)?)
        }
    };
    found.map_err(|error| report(parameter, &error, value, problems)).ok()
}

/// Reports a value that `parameter` does not accept.
fn report(parameter: &Parameter, error: &ValueError, value: &Value<'_>, problems: &mut Problems) {
    let name = parameter.name;
    let text = value.get_ref().as_str().unwrap_or_default();
    match error {
        ValueError::NoOption { options, .. } => {
            let options: Vec<&str> = options.iter().map(String::as_str).collect();
            report_no_option(name, &options, text, value, problems);
        }
        ValueError::NoQuantity(error) => {
            let span = inside(problems.text(), value.span(), text, &error.span);
            report_unit_error(name, span, error, problems);
        }
        ValueError::OutOfRange { value: number, .. } => {
            let shown = format!("{} {}", shown(*number), parameter.unit);
            problems.report(value.span(), error.message(name, &shown));
        }
    }
}

/// Keys whose values are numbers, in three kinds of tables: a value with a standard error, a range, and a
/// distribution.
const NUMBERS: [&str; 4] = ["value", "from", "to", "mean"];

/// Returns true if all numbers in a value, list, range or distribution have units. If there are no numbers,
/// returns `None`.
pub(super) fn has_units(value: &Value<'_>) -> Option<bool> {
    match value.get_ref() {
        DeValue::String(text) => Some(units::has_unit(text)),
        DeValue::Integer(_) | DeValue::Float(_) => Some(false),
        DeValue::Array(list) => list.iter().filter_map(has_units).reduce(|all, this| all && this),
        DeValue::Table(table) => {
            let numbers = NUMBERS.iter().filter_map(|key| table.get(*key));
            numbers.filter_map(has_units).reduce(|all, this| all && this)
        }
        _ => None,
    }
}

/// Returns the index of the option that `value` names.
pub(super) fn option(
    name: &str,
    options: &[&str],
    value: &Value<'_>,
    problems: &mut Problems,
) -> Option<usize> {
    let Some(text) = value.get_ref().as_str() else {
        report_no_text(name, options, value, problems);
        return None;
    };
    let index = options.iter().position(|option| *option == text);
    if index.is_none() {
        report_no_option(name, options, text, value, problems);
    }
    index
}

/// Reports that the value of a choice is not text.
fn report_no_text(name: &str, options: &[&str], value: &Value<'_>, problems: &mut Problems) {
    let message = format!("`{name}` is a choice between options, not {}", table::kind(value.get_ref()));
    problems.report(value.span(), message).note(listed(options));
}

/// Reports that a text is not the name of an option of a choice.
fn report_no_option(name: &str, options: &[&str], text: &str, value: &Value<'_>, problems: &mut Problems) {
    problems
        .report(value.span(), format!("`{name}` has no option `{text}`"))
        .label("unknown option")
        .note(listed(options))
        .did_you_mean(text, options.iter().copied());
}

/// Returns text that lists the options of a choice in quotes.
fn listed(options: &[&str]) -> String {
    let quoted: Vec<String> = options.iter().map(|option| format!("\"{option}\"")).collect();
    format!("options: {}", quoted.join(", "))
}

/// Converts a value, which is a bare number or text with a unit, to a number in the SI unit `unit`.
pub(super) fn quantity(name: &str, unit: &str, value: &Value<'_>, problems: &mut Problems) -> Option<f64> {
    let DeValue::String(text) = value.get_ref() else {
        if let DeValue::Integer(_) | DeValue::Float(_) = value.get_ref() {
            return number(name, value, problems);
        }
        let what = if unit.is_empty() { "a number" } else { "a number or text with a unit" };
        let message = format!("`{name}` must be {what}, not {}", table::kind(value.get_ref()));
        let diagnostic = problems.report(value.span(), message);
        match value.get_ref() {
            DeValue::Array(_) | DeValue::Table(_) => {
                diagnostic.help("only an axis under [axes] or [[zip]] takes more than one value")
            }
            _ if unit.is_empty() => diagnostic.help("write a bare number"),
            _ => diagnostic.help(format!("write \"1 {unit}\", or a bare number in {unit}")),
        };
        return None;
    };
    match units::parse_as(text, unit) {
        Ok(number) => Some(number),
        Err(error) => {
            let span = inside(problems.text(), value.span(), text, &error.span);
            report_unit_error(name, span, &error, problems);
            None
        }
    }
}

/// Returns the number in `value`, which must not be in quotes. The function is for settings without a unit.
pub(super) fn number(name: &str, value: &Value<'_>, problems: &mut Problems) -> Option<f64> {
    let number = match value.get_ref() {
        DeValue::Integer(integer) => integer_as_float(integer),
        DeValue::Float(float) => decimal(float.as_str()),
        other => {
            let message = format!("`{name}` must be a number, not {}", table::kind(other));
            problems.report(value.span(), message).help("write a bare number, such as 1e-6, without quotes");
            return None;
        }
    };
    number.map_err(|error| report_unit_error(name, value.span(), &error, problems)).ok()
}

/// Returns the value of a key that must be `true` or `false`.
pub(super) fn boolean(name: &str, value: &Value<'_>, problems: &mut Problems) -> Option<bool> {
    let found = value.get_ref().as_bool();
    if found.is_none() {
        let message = format!("`{name}` must be true or false, not {}", table::kind(value.get_ref()));
        problems.report(value.span(), message);
    }
    found
}

/// Returns the whole number in `value`, which must be from 1 to `most`.
pub(super) fn count(name: &str, most: u64, value: &Value<'_>, problems: &mut Problems) -> Option<u64> {
    let found = match value.get_ref() {
        DeValue::Integer(integer) if integer_as_float(integer).is_ok_and(|number| number >= 1.0) => {
            let count = u64::from_str_radix(integer.as_str(), integer.radix()).ok();
            let count = count.filter(|count| *count <= most);
            if count.is_none() {
                problems.report(value.span(), format!("`{name}` must be at most {most}, not {integer}"));
            }
            return count;
        }
        DeValue::Integer(integer) => integer.to_string(),
        DeValue::Float(float) => float.to_string(),
        other => table::kind(other).to_owned(),
    };
    problems.report(value.span(), format!("`{name}` must be a whole number of 1 or more, not {found}"));
    None
}

/// Formats a number for messages, with `5` in place of `5.0`.
pub(super) fn shown(number: f64) -> String {
    let text = format!("{number:?}");
    text.strip_suffix(".0").unwrap_or(&text).to_owned()
}

/// Returns the text in `value`, which must not be empty.
pub(super) fn text<'t>(name: &str, value: &'t Value<'_>, problems: &mut Problems) -> Option<&'t str> {
    match value.get_ref().as_str() {
        Some("") => {
            problems.report(value.span(), format!("`{name}` is empty"));
            None
        }
        Some(text) => Some(text),
        None => {
            let message = format!("`{name}` must be text in quotes, not {}", table::kind(value.get_ref()));
            problems.report(value.span(), message);
            None
        }
    }
}

/// Returns the names in a list, each with its position in the file, and reports names that occur twice.
/// `wanted` is the end of the message "`key` must be …". `help` is advice for this message, or an empty text.
pub(super) fn names<'t>(
    entry: &Entry<'t>,
    wanted: &str,
    help: &str,
    problems: &mut Problems,
) -> Vec<(&'t str, Range<usize>)> {
    let list = entry.value.get_ref().as_array().filter(|list| !list.is_empty());
    let Some(list) = list else {
        let diagnostic = problems.report(entry.value.span(), format!("`{}` must be {wanted}", entry.key));
        if !help.is_empty() {
            diagnostic.help(help);
        }
        return Vec::new();
    };
    let mut places: HashMap<&str, Range<usize>> = HashMap::new();
    let mut found = Vec::new();
    for item in list {
        let Some(name) = text(entry.key, item, problems) else { continue };
        let first = places.entry(name).or_insert_with(|| item.span());
        if *first != item.span() {
            problems
                .report(item.span(), format!("`{name}` is listed twice"))
                .label("again here")
                .related(first.clone(), "first here")
                .help("keep one of them");
        }
        found.push((name, item.span()));
    }
    found
}

fn report_unit_error(name: &str, span: Range<usize>, error: &UnitError, problems: &mut Problems) {
    let diagnostic = problems.report(span, error.message(&format!("`{name}`")));
    if let Some(help) = error.help() {
        diagnostic.help(help);
    }
}

/// Returns the float nearest to a TOML integer of any size.
fn integer_as_float(integer: &DeInteger<'_>) -> Result<f64, UnitError> {
    if integer.radix() == 10 {
        return decimal(integer.as_str());
    }
    i128::from_str_radix(integer.as_str(), integer.radix()).map(|whole| whole as f64).map_err(|_| {
        let prefix = match integer.radix() {
            16 => "0x",
            8 => "0o",
            _ => "0b",
        };
        let problem = UnitProblem::TooLarge(format!("{prefix}{}", integer.as_str()));
        UnitError { span: 0..0, problem }
    })
}

fn decimal(text: &str) -> Result<f64, UnitError> {
    let (number, _) = units::scan(text)?;
    number.shifted(0)
}

/// Returns the position in the file of a part of a TOML string. `span` is the position of the whole string,
/// and `part` is the range of bytes in its text.
///
/// If the string in the file contains escape sequences such as `\n`, returns the position of the whole
/// string.
pub(super) fn inside(file: &str, span: Range<usize>, text: &str, part: &Range<usize>) -> Range<usize> {
    let raw = file.get(span.clone()).unwrap_or_default();
    let quotes = ["\"\"\"", "'''", "\"", "'"].into_iter().find(|quotes| raw.starts_with(quotes));
    let length = quotes.map_or(0, str::len);
    let body = raw.get(length..raw.len().saturating_sub(length));
    if body == Some(text) {
        let start = span.start + length;
        start + part.start..start + part.end
    } else {
        span
    }
}

/// If a parameter is a choice, reports that its value cannot be a range or a distribution, and returns true.
/// `shape` is the word for the wrong value in the message, for example "ranges".
pub(super) fn report_choice(
    parameter: &Parameter,
    entry: &Entry<'_>,
    shape: &str,
    help: &str,
    problems: &mut Problems,
) -> bool {
    let Kind::Choice(options) = &parameter.kind else { return false };
    problems
        .report(entry.value.span(), format!("`{}` is a choice and has no {shape}", parameter.name))
        .help(format!("{help}, such as {options:?}"));
    true
}
