//! Numbers and options as text, the same in result files and on the terminal.

use flap_core::parameter::{Kind, Parameter};

/// The shortest decimal text that reads back as the same number.
///
/// Sizes from 1e-4 up to 1e9 are written out (`0.0012`, `100.0`), others with an exponent (`1.52e-6`, `1.43e10`).
/// There is always a point or an exponent, so that readers which guess column types from the first rows
/// guess a floating-point column. NaN is the empty text: an empty cell.
///
/// ```
/// assert_eq!(flap_sweep::text::float(120.0), "120.0");
/// assert_eq!(flap_sweep::text::float(1.52e-6), "1.52e-6");
/// assert_eq!(flap_sweep::text::float(f64::NAN), "");
/// ```
pub fn float(value: f64) -> String {
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

/// `true` for 1 and `false` for 0. NaN, what is unknown, is the empty text.
pub fn truth(value: f64) -> String {
    if value.is_nan() {
        return String::new();
    }
    (value != 0.0).to_string()
}

/// The value of a parameter: a number, or the name of the option it chooses.
pub fn value(parameter: &Parameter, value: f64) -> String {
    match option(parameter, value) {
        Some(name) => name.to_owned(),
        None => float(value),
    }
}

/// The option that `value` chooses, if the parameter is a choice.
pub fn option(parameter: &Parameter, value: f64) -> Option<&'static str> {
    let Kind::Choice(options) = parameter.kind else { return None };
    // A choice is the index of its option: comparing avoids a cast that could be out of range.
    (0_u32..).map(f64::from).zip(options).find(|(index, _)| *index == value).map(|(_, name)| *name)
}

#[cfg(test)]
mod tests {
    use super::*;

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
        let arms = Parameter {
            name: "arms",
            unit: "",
            symbol: "",
            kind: Kind::Choice(&["printed", "axis"]),
            doc: "",
        };
        assert_eq!(value(&arms, 1.0), "axis");
        let span = Parameter {
            name: "span",
            unit: "m",
            symbol: "",
            kind: Kind::Number(flap_core::parameter::Range::Positive),
            doc: "",
        };
        assert_eq!(value(&span, 1.0), "1.0");
    }
}
