//! Parameter tables: their order, their ranges, and the values of a point.

use flap_core::parameter::Range::{Any, Between, NonNegative, Positive, Whole};
use flap_core::parameter::{Invalid, Kind};
use flap_core::simulate::all;

/// Parameters that several models share have fixed positions in the table of each model.
#[test]
fn shared_rows_stand_between_those_of_the_model() {
    let shape = [
        "drive_frequency",
        "drive_shape",
        "drive_second_harmonic",
        "drive_second_phase",
        "drive_third_harmonic",
        "drive_third_phase",
        "drive_rise",
    ];
    let stroke = ["stroke_mode", "stroke_amplitude"];
    let voltage = ["drive_voltage_pp", "drive_bias"];
    for model in all() {
        let names: Vec<&str> = model.parameters().iter().map(|parameter| parameter.name).collect();
        let first = match model.name() {
            "bimorph" => [&voltage[..1], &shape, &["drive_offset"]].concat(),
            "direct-drive" => [&voltage[..], &shape, &stroke, &["wing_length"]].concat(),
            "four-bar" => [&voltage[..], &shape, &stroke, &["rest_voltage"]].concat(),
            other => panic!("no table of {other}"),
        };
        assert_eq!(names[..first.len()], first, "{}", model.name());
        for preset in model.presets() {
            assert_eq!((preset.values)().len(), names.len(), "{}", preset.name);
        }
    }
}

#[test]
fn presets_are_within_their_ranges() {
    for model in all() {
        for preset in model.presets() {
            for (parameter, value) in model.parameters().iter().zip((preset.values)()) {
                let allowed = match parameter.kind {
                    Kind::Number(range) => range.contains(value),
                    Kind::Following(range, _) => value.is_nan() || range.contains(value),
                    Kind::Choice(options) => (0..options.len()).any(|option| option as f64 == value),
                };
                assert!(allowed, "{}: {} is {value}", preset.name, parameter.name);
            }
        }
    }
}

#[test]
fn ranges_contain_what_they_say() {
    let cases = [
        (Any, "any number", vec![-1e300, 0.0, 2.5], vec![f64::NAN, f64::INFINITY]),
        (NonNegative, "zero or more", vec![0.0, 1e-300], vec![-1e-300, f64::INFINITY]),
        (Positive, "more than zero", vec![1e-300], vec![0.0, -0.0, f64::NAN]),
        (Between(0.0, 2.0), "between 0 and 2", vec![1e-300, 1.999], vec![0.0, 2.0, -1.0, f64::NAN]),
        (
            Whole(1, 64),
            "a whole number from 1 to 64",
            vec![1.0, 7.0, 64.0],
            vec![0.0, 0.5, 7.5, 65.0, -1.0, f64::NAN, f64::INFINITY],
        ),
    ];
    for (range, words, inside, outside) in cases {
        assert_eq!(range.describe(), words);
        for value in inside {
            assert!(range.contains(value), "{value}: {words}");
            assert_eq!(Invalid::unless_within("strips", value, range), Ok(()));
        }
        for value in outside {
            assert!(!range.contains(value), "{value}: {words}");
            let error = Invalid::unless_within("strips", value, range).unwrap_err();
            assert_eq!(error.to_string(), format!("strips is {value}, but must be {words}"));
        }
    }
}
