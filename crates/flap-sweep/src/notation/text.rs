//! Converts numbers and options to text, for result files and the terminal. This module also contains
//! functions that find similar names, and that find the line and column of a byte in a text.

use std::borrow::Cow;
use std::fmt::Write as _;

use flap_core::parameter::{Kind, Parameter};
use flap_core::simulate::{SettingKind, SolverSettings};
use xxhash_rust::xxh3::xxh3_64;

use super::units::prefixed;

/// Returns the shortest decimal text from which exactly the float `value` can be read.
///
/// Numbers from 1e-4 up to 1e9 are written in full (`0.0012`, `100.0`). All other numbers are written with an
/// exponent (`1.52e-6`, `1.43e10`). The text of a finite number always contains a decimal point or an
/// exponent. Programs that infer the type of a column from its first rows therefore infer a float. The text
/// of NaN is empty, so the cell of an unknown value is empty.
///
/// ```
/// assert_eq!(flap_sweep::notation::text::float(120.0), "120.0");
/// assert_eq!(flap_sweep::notation::text::float(1.52e-6), "1.52e-6");
/// assert_eq!(flap_sweep::notation::text::float(f64::NAN), "");
/// ```
pub fn float(value: f64) -> String {
    let mut text = String::new();
    push_float(&mut text, value);
    text
}

/// Appends `value` to `text` in the format of [`float`].
pub(crate) fn push_float(text: &mut String, value: f64) {
    let size = value.abs();
    // In other ranges, zmij's format differs: zeros instead of an exponent, or a plus sign in the exponent.
    let is_size_alike = size < 1e-5 || (1e-4..1e9).contains(&size);
    // Half-way between two shortest texts, zmij chooses the even digit and the standard library the upper one. Among
    // the numbers below 1e9, only numbers with at most 39 significant bits can lie there; the others end in fewer
    // zero bits.
    if is_size_alike && value.to_bits().trailing_zeros() < 14 {
        text.push_str(zmij::Buffer::new().format_finite(value));
    } else {
        text.push_str(&float_by_standard_library(value));
    }
}

/// Returns the same text as [`float`] for all numbers, but is several times slower than [`float`].
fn float_by_standard_library(value: f64) -> String {
    if value.is_nan() {
        return String::new();
    }
    let size = value.abs();
    if size != 0.0 && size.is_finite() && !(1e-4..1e9).contains(&size) {
        return format!("{value:e}");
    }
    let mut text = format!("{value}");
    if size.is_finite() && !text.contains('.') {
        text.push_str(".0");
    }
    text
}

/// Returns a number and a noun in the singular or the plural, such as `1 row` or `2 rows`.
///
/// ```
/// assert_eq!(flap_sweep::notation::text::count(1, "periodic row"), "1 periodic row");
/// assert_eq!(flap_sweep::notation::text::count(0, "point"), "0 points");
/// ```
pub fn count(number: u64, thing: &str) -> String {
    if number == 1 { format!("1 {thing}") } else { format!("{number} {thing}s") }
}

/// Largest number of names that a message lists.
const MOST_NAMES: usize = 20;

/// Returns a list of names for a message, such as `a, b and 3 more columns`. The list contains at most 20
/// names. If names are left out, the message contains their number and the noun `thing`.
pub fn listed<'n>(names: impl IntoIterator<Item = &'n str>, thing: &str) -> String {
    let mut names = names.into_iter();
    let first: Vec<&str> = names.by_ref().take(MOST_NAMES).collect();
    let list = first.join(", ");
    match names.count() {
        0 => list,
        more => format!("{list} and {}", count(more as u64, &format!("more {thing}"))),
    }
}

/// Returns `true` for 1, `false` for 0, and the empty text for NaN, which is an unknown value.
pub fn truth(value: f64) -> String {
    if value.is_nan() {
        return String::new();
    }
    (value != 0.0).to_string()
}

/// Words with more characters than this number are shortened in messages. Only few file paths have more
/// characters than this number.
const LONGEST_WORD: usize = 300;

/// Numbers of characters that are kept at the beginning and at the end of a shortened word.
const ENDS: [usize; 2] = [60, 20];

/// Returns a message whose longest words are shortened. Shortening is necessary because names in a user's
/// file may have any length.
pub fn shortened(message: &str) -> Cow<'_, str> {
    if message.split_whitespace().all(|word| word.len() <= LONGEST_WORD) {
        return Cow::Borrowed(message);
    }
    let mut text = String::new();
    for piece in message.split_inclusive(char::is_whitespace) {
        let length = piece.chars().count();
        if length <= LONGEST_WORD {
            text.push_str(piece);
        } else {
            text.extend(piece.chars().take(ENDS[0]));
            let _ = write!(text, "…({length} characters)…");
            text.extend(piece.chars().skip(length - ENDS[1]));
        }
    }
    Cow::Owned(text)
}

/// Returns a text in which escapes such as `\u{1b}` replace control characters, so that the text is safe for
/// XML and terminals.
pub fn printable(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for letter in text.chars() {
        if letter.is_control() {
            out.extend(letter.escape_default());
        } else {
            out.push(letter);
        }
    }
    out
}

/// Returns the value of a parameter as text: a number, or the name of an option.
pub fn value(parameter: &Parameter, value: f64) -> String {
    match option(parameter, value) {
        Some(name) => name.to_owned(),
        None => float(value),
    }
}

/// Returns the value of a parameter as text that is easy to read for the user. The text is a number with six
/// digits, a prefix and a unit, such as `1.52 uN*m/rad`, or the name of an option.
pub fn shown(parameter: &Parameter, value: f64) -> String {
    match option(parameter, value) {
        Some(name) => name.to_owned(),
        None => prefixed(value, parameter.unit),
    }
}

/// Returns the value of a solver setting as text: a number, `true` or `false`.
pub fn setting(kind: SettingKind, settings: &SolverSettings) -> String {
    match kind {
        SettingKind::Number { get, .. } => float(get(settings)),
        SettingKind::Count { get, .. } => get(settings).to_string(),
        SettingKind::Flag { get, .. } => get(settings).to_string(),
    }
}

/// Returns the reason why a parameter has no default value. Returns `None` if the value of the parameter is
/// computed from other parameters.
///
/// `follows` is the text of [`Kind::Following`].
pub(crate) fn no_default(follows: &str) -> Option<String> {
    let reason = follows.strip_prefix("nothing: ").map(|without| format!("it has no default ({without})"));
    reason.or_else(|| (follows == "not known").then(|| "it has no default".to_owned()))
}

/// Returns the name of the option with the index `value`, or `None` if the parameter is not a choice.
pub fn option<'p>(parameter: &Parameter<'p>, value: f64) -> Option<&'p str> {
    let Kind::Choice(options) = parameter.kind else { return None };
    // Comparing numbers avoids a cast that could be out of range.
    (0_u32..).map(f64::from).zip(options).find(|(index, _)| *index == value).map(|(_, name)| *name)
}

/// Returns the 64-bit XXH3 hash of a text, in hexadecimal digits.
pub(crate) fn hash(text: &str) -> String {
    digits(xxh3_64(text.as_bytes()))
}

/// Returns a 64-bit hash in hexadecimal digits.
pub(crate) fn digits(hash: u64) -> String {
    format!("{hash:016x}")
}

/// Names with more bytes than this number are not compared with other names.
const LONGEST_NAME: usize = 200;

/// Names with fewer bytes than this number are not searched for within other names, because a short text
/// occurs in too many names.
const SHORTEST_PART: usize = 4;

/// Returns the name in `names` that is most similar to `name`, or `None` if no name is similar.
///
/// The function prefers the mean of a measure (`lift_mean_mn` for `lift`), then the first name that begins
/// with `name`. If no name begins with `name`, the function chooses the first name that contains `name` as a
/// word. If no name contains `name` as a word, the function chooses the name with the closest spelling.
pub fn nearest<'n>(name: &str, names: impl IntoIterator<Item = &'n str>) -> Option<&'n str> {
    // The time of a comparison is proportional to the product of both lengths.
    if name.len() > LONGEST_NAME {
        return None;
    }
    let name = &*name.to_lowercase();
    let names = names.into_iter().filter(|candidate| candidate.len() <= LONGEST_NAME);
    let names: Vec<(String, &str)> = names.map(|candidate| (candidate.to_lowercase(), candidate)).collect();
    let is_word = |(candidate, _): &&(String, &str)| {
        let ends = |text: &str| !text.starts_with(char::is_alphanumeric);
        let begins = |text: &str| !text.ends_with(char::is_alphanumeric);
        let mut places = candidate.match_indices(name);
        places.any(|(at, part)| begins(&candidate[..at]) && ends(&candidate[at + part.len()..]))
    };
    if name.len() >= SHORTEST_PART {
        let begins = |begin: &str| names.iter().find(|(candidate, _)| candidate.starts_with(begin));
        let found = begins(&format!("{name}_mean_")).or_else(|| begins(name));
        if let Some((_, candidate)) = found.or_else(|| names.iter().find(is_word)) {
            return Some(candidate);
        }
    }
    names
        .iter()
        .map(|(lower, candidate)| (strsim::jaro_winkler(name, lower), *candidate))
        .filter(|(likeness, _)| *likeness > 0.8)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, candidate)| candidate)
}

/// Returns the line and the column of a byte of `text`. Lines and columns are counted from 1. Columns count
/// characters.
pub(crate) fn position(text: &str, byte: usize) -> (usize, usize) {
    let mut end = byte.min(text.len());
    while !text.is_char_boundary(end) {
        end -= 1;
    }
    let before = &text[..end];
    let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
    let line = 1 + before.matches('\n').count();
    // Editors do not show the byte order mark.
    let column = 1 + before[line_start..].chars().filter(|c| *c != '\u{feff}').count();
    (line, column)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// Generates numbers with random bits, numbers that are typical of rows, and numbers with few significant
    /// bits. Some of the numbers with few significant bits lie half-way between two decimal numbers.
    fn numbers() -> impl Strategy<Value = f64> {
        let few_bits = (any::<i64>(), 10..64_u32, -80..40_i32)
            .prop_map(|(bits, dropped, exponent)| (bits >> dropped) as f64 * f64::from(exponent).exp2());
        prop_oneof![
            any::<u64>().prop_map(f64::from_bits),
            (-1.0..1.0, -7..18_i32).prop_map(|(digits, exponent)| digits * 10_f64.powi(exponent)),
            few_bits,
        ]
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(100_000))]
        #[test]
        fn the_text_is_that_of_the_standard_library(value in numbers()) {
            prop_assert_eq!(float(value), float_by_standard_library(value));
        }
    }

    #[test]
    fn the_text_is_that_of_the_standard_library_where_sizes_and_bits_end() {
        let mut numbers =
            vec![0.0, f64::INFINITY, f64::NAN, 5.960_464_477_539_063e-8, 2_251_799_813_685_248.25];
        for border in [f64::MIN_POSITIVE, 1e-5, 1e-4, 1e9, 1e16, 1e17, f64::MAX] {
            numbers.extend([border.next_down(), border, border.next_up()]);
        }
        for exponent in 0..2047 {
            for bits in [0, 1, (1 << 52) - 1].into_iter().chain((0..52).map(|bit| 1 << bit)) {
                numbers.push(f64::from_bits((exponent << 52) | bits));
            }
        }
        for value in numbers {
            assert_eq!(float(value), float_by_standard_library(value));
            assert_eq!(float(-value), float_by_standard_library(-value));
        }
    }

    #[test]
    fn floats_read_back_as_the_same_bits() {
        for value in [
            0.0,
            -0.0,
            1.0,
            -2.5,
            60.300_000_000_000_004,
            1e-4,
            9.999_999_999_999_999e-5,
            1e-12,
            5e-324,
            1.234_567_890_123_456_7e15,
            1e16,
            f64::MAX,
            f64::MIN_POSITIVE,
            0.1 + 0.2,
        ] {
            let text = float(value);
            let back: f64 = text.parse().unwrap();
            assert_eq!(back.to_bits(), value.to_bits(), "{text}");
        }
    }

    #[test]
    fn floats_always_look_like_floats() {
        assert_eq!(float(0.0), "0.0");
        assert_eq!(float(-100.0), "-100.0");
        assert_eq!(float(0.000_12), "0.00012");
        assert_eq!(float(0.000_012), "1.2e-5");
        assert_eq!(float(999_999_999.0), "999999999.0");
        assert_eq!(float(1e9), "1e9");
        assert_eq!(float(14.3e9), "1.43e10");
        assert_eq!(float(f64::INFINITY), "inf");
    }

    #[test]
    fn a_choice_is_written_by_name() {
        let arms = Parameter::new("arms", "", "", Kind::Choice(&["printed", "axis"]), "");
        assert_eq!(value(&arms, 1.0), "axis");
        let positive = Kind::Number(flap_core::parameter::Range::Positive);
        let span = Parameter::new("span", "m", "", positive, "");
        assert_eq!(value(&span, 1.0), "1.0");
    }

    #[test]
    fn long_words_are_shortened_and_others_are_kept() {
        let long = "a".repeat(1_000_000);
        let text = shortened(&format!("no parameter `{long}` here")).into_owned();
        assert!(
            text.len() < 150 && text.starts_with("no parameter `aaa") && text.ends_with("aaa` here"),
            "{text}"
        );
        let ordinary = "a message\n  of two lines";
        assert_eq!(shortened(ordinary), ordinary);
        let wide = "µ".repeat(200);
        assert_eq!(shortened(&wide), wide, "characters count, not bytes");
    }

    #[test]
    fn control_characters_are_written_out() {
        assert_eq!(printable("a\u{1b}[31mb\0\n µ"), "a\\u{1b}[31mb\\u{0}\\n µ");
    }

    #[test]
    fn nearest_names() {
        let names = ["drive_voltage_pp", "drive_frequency", "wing_area"];
        assert_eq!(nearest("drive_voltage", names), Some("drive_voltage_pp"));
        assert_eq!(nearest("WING_AREA", names), Some("wing_area"));
        assert_eq!(nearest("temperature", names), None);
        assert_eq!(nearest(&"wing_area".repeat(30), names), None);
        let long = "wing_area".repeat(30);
        assert_eq!(nearest("wing_area", [&*long]), None);
    }

    #[test]
    fn parts_of_names_come_before_misspellings() {
        let names = ["point", "stroke_pp_deg", "lift_mean_mn", "lift_min_mn", "lift_max_mn", "mean_lift"];
        assert_eq!(nearest("lift", names), Some("lift_mean_mn"));
        assert_eq!(nearest("LIFT_MAX", names), Some("lift_max_mn"));
        assert_eq!(nearest("pp_deg", names), Some("stroke_pp_deg"));
        assert_eq!(nearest("lift", ["xxxxxliftxxxxx"]), None, "a part of a word is no word");
        assert_eq!(nearest("lift_mni_mn", names), Some("lift_min_mn"));
    }

    #[test]
    fn positions_count_characters_not_bytes() {
        let text = "a = 1\n\"µ\" = 2\n";
        assert_eq!(position(text, 0), (1, 1));
        assert_eq!(position(text, 4), (1, 5));
        assert_eq!(position(text, 6), (2, 1));
        assert_eq!(position(text, 11), (2, 5));
        assert_eq!(position(text, text.len()), (3, 1));
        assert_eq!(position("\u{feff}a", 3), (1, 1));
    }
}
