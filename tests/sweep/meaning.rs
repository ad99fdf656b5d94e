//! The plans of grid files without mistakes.

use std::path::PathBuf;

use flap_core::simulate::SolverSettings;
use flap_sweep::plan::axes::Values;
use flap_sweep::plan::{Output, Plan, Value};

use crate::fake::{FLY, index, plan};

/// The values of the one axis of a grid.
fn axis(text: &str) -> Vec<f64> {
    let plan = plan(&format!("preset = \"fly\"\n[axes]\n{text}\n"));
    let [axis] = plan.axes().as_slice() else { panic!("one axis") };
    let [(_, values)] = axis.parameters() else { panic!("one parameter") };
    (0..values.len()).map(|index| values.get(index)).collect()
}

/// Names of the varied parameters, in column order.
fn varied(plan: &Plan) -> Vec<&str> {
    plan.axes().varied().map(|parameter| plan.parameters()[parameter].name).collect()
}

#[test]
fn a_preset_alone_is_one_point() {
    let plan = plan("preset = \"fly\"");
    assert_eq!((plan.preset(), plan.len(), plan.simulator().name()), ("fly", 1, "flapper"));
    let values = plan.point(0).values;
    assert_eq!(values[..7], FLY[..7]);
    assert!(values[7].is_nan());
    assert_eq!(*plan.solver(), SolverSettings::default());
    assert_eq!(*plan.output(), Output::default());
    assert_eq!((plan.source().name.as_str(), plan.source().text.as_str()), ("grid.toml", "preset = \"fly\""));
}

#[test]
fn presets_choose_the_model() {
    let plan = plan("preset = \"flea\"\nparams.leg_length = \"2 mm\"");
    assert_eq!((plan.simulator().name(), plan.base()), ("hopper", &[Value::Given(2e-3)][..]));
}

#[test]
fn params_go_on_top_of_the_preset() {
    let plan = plan(
        r#"
        preset = "fly"
        [params]
        drive_voltage_pp = 200
        drive_frequency  = 1_20.5
        wing_area        = "54 mm²"
        hinge_stiffness  = '1.5 uN*m/rad'
        stroke_offset    = "-45 deg"
        hinge_position   = "5 %"
        arms             = "axis"
        plate_width      = 0x2
        "#,
    );
    let degrees = -45.0 * (std::f64::consts::PI / 180.0);
    assert_eq!(plan.base(), [200.0, 120.5, 54e-6, 1.5e-6, degrees, 0.05, 1.0, 2.0].map(Value::Given));
}

#[test]
fn axes_of_every_kind() {
    let cases: [(&str, &[f64]); 13] = [
        ("drive_frequency = [100, \"0.2 kHz\", 150.5]", &[100.0, 200.0, 150.5]),
        ("arms = [\"axis\", \"printed\"]", &[1.0, 0.0]),
        ("hinge_position = { from = 0, to = 1, n = 5 }", &[0.0, 0.25, 0.5, 0.75, 1.0]),
        ("hinge_position = { from = 1, to = 0, n = 3, scale = \"linear\" }", &[1.0, 0.5, 0.0]),
        (
            "drive_frequency = { from = \"1 Hz\", to = \"10 kHz\", n = 5, scale = \"log\" }",
            &[1.0, 10.0, 100.0, 1000.0, 10000.0],
        ),
        ("stroke_offset = { from = -1, to = -4, n = 3, scale = \"log\" }", &[-1.0, -2.0, -4.0]),
        // 0.3 * (0.7 / 0.3) is not 0.7.
        ("stroke_offset = { from = 0.3, to = 0.7, n = 2, scale = \"log\" }", &[0.3, 0.7]),
        // The end is included when it is hit, if only up to rounding.
        ("hinge_position = { from = 0, to = 0.3, step = 0.1 }", &[0.0, 0.1, 0.2, 0.3]),
        ("hinge_position = { from = 1, to = 2, step = 0.4 }", &[1.0, 1.4, 1.8]),
        ("hinge_position = { from = 1, to = -1, step = -1 }", &[1.0, 0.0, -1.0]),
        ("hinge_position = { from = 1, to = 2, step = 5 }", &[1.0]),
        ("hinge_position = { from = 2, to = 2, n = 1 }", &[2.0]),
        ("hinge_position = { from = 2, to = 2, step = 1 }", &[2.0]),
    ];
    for (text, expected) in cases {
        let values = axis(text);
        assert_eq!(values.len(), expected.len(), "{text}: {values:?}");
        for (value, expected) in values.iter().zip(expected) {
            assert!((value - expected).abs() <= 4e-16 * expected.abs(), "{text}: {values:?}");
        }
        // The first value is the one in the file, to the bit; so is the last, where it is in the file.
        assert_eq!(values.first(), expected.first(), "{text}");
        assert_eq!(values.last(), expected.last(), "{text}");
    }
}

#[test]
fn whole_and_decimal_steps_give_the_numbers_one_would_write() {
    let hertz = axis("drive_frequency = { from = \"60 Hz\", to = \"200 Hz\", step = \"1 Hz\" }");
    assert_eq!(hertz, (60..=200).map(f64::from).collect::<Vec<_>>());
    let whole = axis("hinge_position = { from = 0, to = 49, step = 1 }");
    assert_eq!(whole, (0..50).map(f64::from).collect::<Vec<_>>());
    let tenths = axis("hinge_position = { from = 0, to = 1, step = 0.1 }");
    assert_eq!(tenths, [0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0]);
}

#[test]
fn the_last_axis_varies_fastest() {
    let plan = plan("preset = \"fly\"\n[axes]\nwing_area = [1, 2]\ndrive_frequency = [10, 20, 30]");
    let points: Vec<[f64; 2]> =
        (0..plan.len()).map(|index| plan.point(index).values).map(|values| [values[2], values[1]]).collect();
    assert_eq!(points, [[1.0, 10.0], [1.0, 20.0], [1.0, 30.0], [2.0, 10.0], [2.0, 20.0], [2.0, 30.0]]);
    assert_eq!(varied(&plan), ["wing_area", "drive_frequency"]);
}

#[test]
fn zipped_parameters_move_together() {
    let plan = plan(
        "preset = \"fly\"\n[[zip]]\nwing_area = [1, 2, 3]\nstroke_offset = { from = 0, to = 1, n = 3 }\n\
         arms = [\"axis\", \"axis\", \"printed\"]",
    );
    let points: Vec<Vec<f64>> = (0..plan.len())
        .map(|point| plan.point(point).values)
        .map(|values| ["wing_area", "stroke_offset", "arms"].map(|name| values[index(name)]).to_vec())
        .collect();
    assert_eq!(points, [[1.0, 0.0, 1.0], [2.0, 0.5, 1.0], [3.0, 1.0, 0.0]]);
    assert_eq!(varied(&plan), ["wing_area", "stroke_offset", "arms"]);
}

#[test]
fn axes_keep_the_order_of_the_file() {
    // Neither sorted by name nor by kind.
    let cases = [
        "[axes]\nwing_area = [1]\narms = [\"axis\"]\n[[zip]]\nstroke_offset = [1]\nhinge_position = [1]",
        "axes.wing_area = [1]\naxes.arms = [\"axis\"]\n[[zip]]\nstroke_offset = [1]\nhinge_position = [1]",
        "[[zip]]\nwing_area = [1]\n[[zip]]\narms = [\"axis\"]\n[axes]\nstroke_offset = [1]\nhinge_position = [1]",
        "zip = [{ wing_area = [1], arms = [\"axis\"] }]\n[axes]\nstroke_offset = [1]\nhinge_position = [1]",
        "[axes]\nwing_area = [1]\narms = [\"axis\"]\n[axes.stroke_offset]\nfrom = 1\nto = 1\nn = 1\n\
         [axes.hinge_position]\nfrom = 1\nto = 1\nstep = 1",
    ];
    for text in cases {
        let plan = plan(&format!("preset = \"fly\"\n{text}"));
        assert_eq!(varied(&plan), ["wing_area", "arms", "stroke_offset", "hinge_position"], "{text}");
    }
}

#[test]
fn the_largest_plan() {
    let plan = plan(
        "preset = \"fly\"\n[axes]\nwing_area = { from = 1, to = 2, n = 0x4000_0000_0000_0000 }\n\
         arms = [\"printed\", \"axis\"]",
    );
    assert_eq!(plan.len(), 1 << 63);
    assert_eq!(plan.point(plan.len() - 1).values[2], 2.0);
}

#[test]
fn an_axis_of_a_billion_values_is_not_stored() {
    let plan = plan(
        "preset = \"fly\"\n[axes]\ndrive_frequency = { from = 1, to = 2, n = 1_000_000_000 }\n\
         hinge_position = { from = 0, to = 4e9, step = 1 }",
    );
    assert_eq!(plan.len(), 1_000_000_000 * 4_000_000_001);
    assert!(matches!(
        plan.axes().as_slice()[0].parameters()[0].1,
        Values::Linear { count: 1_000_000_000, .. }
    ));
    let last = plan.point(plan.len() - 1).values;
    assert_eq!((last[1], last[5]), (2.0, 4e9));
}

#[test]
fn solver_settings() {
    let solver = |text: &str| plan(&format!("preset = \"fly\"\n[solver]\n{text}")).solver().to_owned();
    let default = SolverSettings::default();
    assert_eq!(solver(""), default);
    assert_eq!(solver("rtol = 1e-6"), default);
    assert_eq!(solver("rtol = 1e-4"), SolverSettings { rtol: 1e-4, atol: 1e-6, accuracy: 0.1, ..default });
    assert_eq!(solver("rtol = 1e-8").accuracy, default.accuracy);
    assert_eq!(
        solver("settle_tol = 1e-9\nmax_steps = 7\nmax_cycles = 5\natol = 1\nrtol = 0.01\naccuracy = 0.02"),
        SolverSettings {
            rtol: 0.01,
            atol: 1.0,
            settle_tol: 1e-9,
            max_cycles: 5,
            max_steps: 7,
            accuracy: 0.02,
            newton: true,
            progressive: true,
            symmetry: true,
            loads: false,
        }
    );
}

#[test]
fn output() {
    let plan = plan(
        "preset = \"fly\"\n[output]\npath = \"out/sweep.csv\"\ncolumns = [\"stroke_pp_deg\", \"lift_mean_mn\"]",
    );
    let expected = Output { path: Some(PathBuf::from("out/sweep.csv")), columns: Some(vec![2, 0]) };
    assert_eq!(*plan.output(), expected);
}

#[test]
fn windows_line_ends_and_a_byte_order_mark_change_nothing() {
    let plan = plan("\u{feff}preset = \"fly\"\r\n[axes]\r\nwing_area = [1,\r\n2]\r\n");
    assert_eq!(plan.len(), 2);
}
