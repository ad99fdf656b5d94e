use std::f64::consts::PI;

use proptest::prelude::*;

use super::*;

#[test]
fn decimal_units_are_exact() {
    let cases = [
        ("200 V", "V", 200.0),
        ("135 um", "m", 135e-6),
        ("51.1 mg*mm^2", "kg*m^2", 51.1e-12),
        ("1.5 uN*m/rad", "N*m/rad", 1.5e-6),
        ("1.52 \u{b5}N·m/rad", "N*m/rad", 1.52e-6),
        ("1.52 \u{3bc}N·m/rad", "N*m", 1.52e-6),
        ("1.52 uN*m", "N*m/rad", 1.52e-6),
        ("9.81 m/s²", "m/s^2", 9.81),
        ("3 Ohm", "Ohm", 3.0),
        ("4.7 k\u{3a9}", "Ohm", 4.7e3),
        ("15 Hz/s", "Hz/s", 15.0),
        ("15 Hz/s", "1/s^2", 15.0),
        ("2 ms", "s", 2e-3),
        ("14.3 GPa", "Pa", 14.3e9),
        ("950 pm/V", "m/V", 950e-12),
        ("11.4 nF/m", "F/m", 11.4e-9),
        ("5 %", "", 5e-2),
        ("0.3", "", 0.3),
        ("1.2 kg/m^3", "kg/m^3", 1.2),
        ("7.8 g/cm^3", "kg/m^3", 7.8e3),
        ("54 mm^2", "m^2", 54e-6),
        ("3.333 rad/mm", "1/m", 3.333e3),
        ("-0.1e-3mm", "m", -0.1e-6),
        ("  90.7 mg ", "kg", 90.7e-6),
    ];
    for (text, si_unit, expected) in cases {
        assert_eq!(parse_as(text, si_unit), Ok(expected), "{text}");
    }
}

#[test]
fn other_factors_are_applied_once() {
    let cases = [
        ("45 deg", "rad", 45.0 * (PI / 180.0)),
        ("45 °", "rad", 45.0 * (PI / 180.0)),
        ("45°", "rad", 45.0 * (PI / 180.0)),
        ("1 gf", "N", 9.806_65e-3),
        ("2 min", "s", 120.0),
        ("3 1/min", "1/s", 3.0 / 60.0),
        ("2 uN*m/deg", "N*m/rad", 2e-6 / (PI / 180.0)),
    ];
    for (text, si_unit, expected) in cases {
        assert_eq!(parse_as(text, si_unit), Ok(expected), "{text}");
    }
}

/// Each case contains a text, the expected unit, the wrong part of the text, and the complete message.
#[test]
fn mistakes_say_what_and_where() {
    let cases = [
        ("135 umm", "m", "umm", "unknown unit `umm`; did you mean `um`?"),
        ("1.5 uNm/rad", "N*m/rad", "uNm", "unknown unit `uNm`; did you mean `uN*m`?"),
        ("60 hz", "Hz", "hz", "unknown unit `hz`; did you mean `Hz`?"),
        ("54 mm2", "m^2", "mm2", "unknown unit `mm2`; did you mean `mm^2`?"),
        ("3 parsec", "m", "parsec", "unknown unit `parsec`; use m, mm, um"),
        ("2 s", "V", "s", "`s` is a time, but the value is in V; use V, mV, kV"),
        ("2 A*m^4", "V", "A*m^4", "`A*m^4` is m^4*A, but the value is in V; use V, mV, kV"),
        ("200 rad/s", "Hz", "rad/s", "`rad/s` is an angular rate, but the value is in Hz; use Hz, kHz"),
        ("2 V", "", "V", "`V` is a voltage, but the value is a pure number; write a bare number, or use %"),
        ("200", "V", "200", "the value needs a unit; add a unit: V, mV, kV; or write a bare number in V"),
        (
            "1e-3e m",
            "m",
            "1e-3e",
            "`1e-3e` is not a number; numbers look like 12, 0.5 or 1.5e-6, with a space before the unit",
        ),
        (
            "fast",
            "V",
            "fast",
            "the value must start with a number; write a bare number, or a number with its unit such as \"200 V\"",
        ),
        ("nan V", "V", "nan", "the value cannot be `nan`: values must be finite"),
        ("1e400 V", "V", "1e400", "`1e400` is too large for the value (largest about 1.8e308)"),
        (
            "1e-330 V",
            "V",
            "1e-330",
            "`1e-330` is too small for the value (smallest above zero about 4.9e-324)",
        ),
        (
            "2 N m",
            "N*m",
            "m",
            "malformed unit: expected `*` or `/`; units look like V, N*m/rad, mm^2 or kg/(m*s)",
        ),
    ];
    for (text, si_unit, fault, message) in cases {
        let error = parse_as(text, si_unit).expect_err(text);
        assert_eq!((&text[error.span.clone()], error.to_string().as_str()), (fault, message), "{text}");
    }
}

/// Numbers in a unit that flap does not know, such as `rpm` in a model, are not converted.
#[test]
fn units_that_are_not_of_flap_are_not_converted() {
    assert_eq!(parse_as("3000 rpm", "rpm"), Ok(3000.0));
    assert_eq!(
        parse_as("50 Hz", "rpm").expect_err("another unit").to_string(),
        "`Hz` cannot be converted into `rpm`, the unit of the value in its model; write the number in rpm"
    );
    assert_eq!(
        parse_as("3000", "rpm").expect_err("no unit").to_string(),
        "the value needs a unit; add a unit: rpm; or write a bare number in rpm"
    );
}

#[test]
fn spans_survive_leading_spaces() {
    assert_eq!(parse_as("  2 umm", "m").map_err(|error| error.span), Err(4..7));
    assert_eq!(parse_as("  x", "m").map_err(|error| error.span), Err(2..3));
}

proptest! {
    /// A number with a prefix, such as `135 um`, has the same bits as the float in SI units, `135e-6`.
    #[test]
    fn prefixes_round_trip(digits in -999_999_999_i64..1_000_000_000, exponent in -20..20_i32, choice in 0..8_usize) {
        let (prefix, power) =
            [("T", 12), ("G", 9), ("k", 3), ("", 0), ("c", -2), ("m", -3), ("\u{b5}", -6), ("p", -12)][choice];
        let literal: f64 = format!("{digits}e{}", exponent + power).parse().expect("a float");
        let value = parse_as(&format!("{digits}e{exponent} {prefix}V"), "V").expect("a voltage");
        prop_assert_eq!(value.to_bits(), literal.to_bits());
    }

    /// From the text that Rust prints for a float, the parser reads a float with the same bits.
    #[test]
    fn floats_round_trip(value in proptest::num::f64::NORMAL) {
        prop_assert_eq!(parse_as(&format!("{value:?} V"), "V"), Ok(value));
    }

    /// Parsing of random text never panics, and the positions of mistakes are always within the text.
    #[test]
    fn any_text_is_handled(text in "[0-9eE.+-]{0,4} ?[a-zA-Zµ°²⁻%*/^()· 0-9]{0,8}", other in "\\PC{0,12}") {
        for text in [text, other] {
            if let Err(error) = parse_as(&text, "N*m/rad") {
                prop_assert!(text.get(error.span).is_some());
            }
        }
    }
}
