//! Changes of plans: a rejected change leaves the plan unchanged.

use flap_core::parameter::Parameter;
use flap_core::simulate::{SolverSettings, all};
use flap_sweep::grid;
use flap_sweep::notation::value::ValueError;
use flap_sweep::plan::gradient::{Gradient, NoDerivative};
use flap_sweep::plan::{ChangeError, Plan, Value, with_rtol};

use crate::fake::{index, plan};

const GRID: &str = "preset = \"fly\"\n[axes]\nwing_area = [5e-5, 6e-5]\nhinge_position = [0, 0.1, 0.2]\n\
                    [derived]\nhinge_stiffness = \"1e-6 * drive_frequency\"\n";

/// The error of a change.
fn refused(changed: Result<Plan, ChangeError>) -> ChangeError {
    changed.err().expect("the change is refused")
}

#[test]
fn a_parameter_is_set_in_one_place_and_within_its_range() {
    let set = |name: &str, value: f64| plan(GRID).with_parameter(index(name), value);
    let changed = set("drive_frequency", 150.0).unwrap();
    assert_eq!(changed.base()[index("drive_frequency")], Value::Given(150.0));
    let values = changed.point(5).values;
    assert_eq!((values[index("drive_frequency")], values[index("hinge_stiffness")]), (150.0, 1e-6 * 150.0));
    assert_eq!(set("plate_width", 2.0).unwrap().base()[index("plate_width")], Value::Given(2.0));
    assert_eq!(refused(set("wing_area", 1.0)), ChangeError::Varied("wing_area".to_owned()));
    assert_eq!(refused(set("hinge_stiffness", 1.0)), ChangeError::Derived("hinge_stiffness".to_owned()));
    for (name, value) in
        [("drive_frequency", -1.0), ("drive_frequency", f64::NAN), ("arms", 2.0), ("arms", 0.5)]
    {
        let error = refused(set(name, value));
        assert!(matches!(&error, ChangeError::Value { parameter, .. } if parameter == name), "{error:?}");
    }
    let ChangeError::Value { error, .. } = refused(set("drive_frequency", -1.0)) else {
        panic!("the value is refused")
    };
    assert!(matches!(*error, ValueError::OutOfRange { value, .. } if value == -1.0), "{error:?}");
}

#[test]
fn rows_of_a_program_are_an_axis_before_all_others() {
    let rows = |name: &str, list: &[f64]| vec![(index(name), list.to_vec())];
    let crossed = plan(GRID).crossed_with(rows("drive_frequency", &[100.0, f64::NAN])).unwrap();
    assert_eq!(crossed.len(), 12);
    assert_eq!(crossed.differing().next(), Some(index("drive_frequency")));
    assert!(crossed.point(6).values[index("drive_frequency")].is_nan());
    assert_eq!(plan(GRID).crossed_with(rows("drive_frequency", &[])).unwrap().len(), 0);
    let crossed = |rows| refused(plan(GRID).crossed_with(rows));
    assert_eq!(crossed(rows("hinge_position", &[1.0])), ChangeError::Varied("hinge_position".to_owned()));
    assert_eq!(crossed(rows("hinge_stiffness", &[1.0])), ChangeError::Derived("hinge_stiffness".to_owned()));
    let twice = [rows("arms", &[0.0]), rows("arms", &[1.0])].concat();
    assert_eq!(crossed(twice), ChangeError::Varied("arms".to_owned()));
    let huge = "preset = \"fly\"\n[axes]\nwing_area = { from = 1, to = 2, n = 5_000_000_000_000_000_000 }\n";
    let error = refused(plan(huge).crossed_with(rows("drive_frequency", &[1.0, 2.0])));
    assert!(matches!(error, ChangeError::TooManyPoints(_)), "{error:?}");
    let hover = vehicle("total_mass = \"69 mg\"\ntrim = \"hover\"\n");
    let voltage = place(&hover, "drive_voltage_pp");
    let error = refused(hover.crossed_with(vec![(voltage, vec![100.0, 140.0])]));
    assert_eq!(error, ChangeError::Input("drive_voltage_pp".to_owned()));
}

/// A vehicle with two wings, with these further keys in `[vehicle]`.
fn vehicle(keys: &str) -> Plan {
    let wings = "[[vehicle.wings]]\nname = \"left\"\n[[vehicle.wings]]\nname = \"right\"\nmirrored = true\n";
    let text = format!("preset = \"jafferis2016\"\n[vehicle]\n{keys}{wings}");
    grid::parse("grid.toml", &text, all()).unwrap_or_else(|mistakes| panic!("{mistakes:?}"))
}

fn place(plan: &Plan, name: &str) -> usize {
    Parameter::index(plan.parameters(), name).expect("a parameter of the model")
}

/// An unset parameter of one wing has the value of all wings, which a formula may give.
#[test]
fn derivatives_by_one_wing_need_a_value_of_all_wings() {
    let slopes = |rest: &str| {
        let plan = vehicle(rest);
        let left = place(&plan, "left_hinge_thickness");
        plan.with_slopes(vec![left]).map(|plan| plan.gradient().map_or(0, Gradient::len) > 0)
    };
    assert!(matches!(slopes(""), Err(ChangeError::NoDerivative(_, NoDerivative::Unset(_)))));
    assert_eq!(slopes("[derived]\nhinge_thickness = \"10 * hinge_stiffness\"\n"), Ok(true));
}

#[test]
fn an_axis_is_taken_out_with_its_values() {
    let (rest, values) = plan(GRID).without_axis(index("hinge_position"));
    let values = values.expect("the axis of one parameter");
    assert_eq!((rest.len(), values.len(), values.get(2)), (2, 3, 0.2));
    let (rest, values) = rest.without_axis(index("arms"));
    assert_eq!((rest.len(), values), (2, None));
}

#[test]
fn points_that_are_run_are_points_of_the_plan() {
    let run = |list: &[u64]| plan(GRID).with_points(list.to_vec());
    let listed = run(&[0, 3, 5]).unwrap();
    assert_eq!((listed.selected(), listed.selected_point(1).index), (3, 3));
    assert_eq!(listed.with_shard("2/4".parse().unwrap()).selected_point(1).index, 5);
    for (list, wrong) in [(&[6][..], 6), (&[0, 2, 2], 2), (&[3, 1], 1)] {
        assert_eq!(refused(run(list)), ChangeError::NoPoint(wrong), "{list:?}");
    }
}

#[test]
fn a_plan_without_its_preset_needs_all_that_follows_nothing() {
    let missing = refused(plan("preset = \"fly\"").without_preset(&[0, 1, 2, 3, 4]));
    assert_eq!(missing, ChangeError::Missing(vec!["hinge_position".to_owned(), "arms".to_owned()]));
    let alone =
        plan("preset = \"fly\"\nparams.plate_width = 2").without_preset(&[0, 1, 2, 3, 4, 5, 6]).unwrap();
    assert_eq!(alone.preset(), "");
    assert!(matches!(alone.base()[index("plate_width")], Value::Follows(_)));
}

#[test]
fn solver_settings_are_those_that_a_grid_file_may_have() {
    let default = SolverSettings::default();
    for wrong in [
        SolverSettings { rtol: 0.1, ..default },
        SolverSettings { atol: f64::INFINITY, ..default },
        SolverSettings { accuracy: f64::NAN, ..default },
        SolverSettings { max_steps: 0, ..default },
    ] {
        let error = refused(plan(GRID).with_solver(wrong));
        assert!(matches!(error, ChangeError::Solver(_)), "{error:?}");
    }
    let finer = default.with_rtol(1e-9);
    assert_eq!(*plan(GRID).with_solver(finer).unwrap().solver(), finer);
}

#[test]
fn derivatives_and_states_are_those_of_models_with_motions() {
    for error in [
        refused(plan(GRID).with_slopes(vec![0])),
        refused(plan(GRID).with_initial_states(vec![])),
        refused(plan(GRID).with_states()),
    ] {
        assert!(matches!(error, ChangeError::NoMotions(_)), "{error:?}");
    }
    let flies = |rest: &str| {
        let text = format!("preset = \"ozaki2018-large\"\n{rest}");
        grid::parse("grid.toml", &text, all()).unwrap_or_else(|mistakes| panic!("{mistakes:?}"))
    };
    let place =
        |name: &str| flies("").parameters().iter().position(|parameter| parameter.name == name).unwrap();
    let begun = flies("axes.drive_frequency = [100, 105]")
        .with_initial_states(vec![None, Some(vec![0.1; 4])])
        .unwrap();
    assert_eq!((begun.point(0).begin, begun.point(1).begin), (None, Some(vec![0.1; 4])));
    assert_eq!(refused(flies("").with_initial_states(vec![])), ChangeError::States(0, 1));
    assert_eq!(flies("").with_states().unwrap().states().len(), 4);

    let stiffness = place("hinge_stiffness");
    let slopes =
        flies("output.columns = [\"lift_mean_mn\", \"cycles\"]").with_slopes(vec![stiffness]).unwrap();
    assert_eq!(slopes.gradient().map(Gradient::len), Some(1));
    for (grid, name, reason) in [
        ("derived.hinge_stiffness = \"1e-6 * drive_frequency\"", "hinge_stiffness", NoDerivative::Derived),
        ("", "lift_sign", NoDerivative::Choice),
    ] {
        assert_eq!(
            refused(flies(grid).with_slopes(vec![place(name)])),
            ChangeError::NoDerivative(name.to_owned(), reason)
        );
    }
    let flag = flies("[measure]\nhigh = \"lift_mean_mn > 3\"\n[output]\ncolumns = [\"high\"]");
    assert_eq!(refused(flag.with_slopes(vec![stiffness])), ChangeError::NoSlope("high".to_owned()));
    let resonant = flies("params.drive_frequency = \"resonance\"\n[resonance]\nfrom = 95\nto = 120");
    assert_eq!(refused(resonant.with_slopes(vec![stiffness])), ChangeError::AtResonance);
}

/// A changed value has neither the standard error nor the correlations of the earlier value.
#[test]
fn changed_values_have_no_standard_errors() {
    let text = "preset = \"fly\"\n[params]\nwing_area = { value = 5e-5, sd = 1e-6 }\nhinge_stiffness = { value = 1e-6, sd = 1e-7 }\n\
                [[correlation]]\nbetween = [\"wing_area\", \"hinge_stiffness\"]\ncoefficient = 0.5\n";
    let (area, stiffness) = (index("wing_area"), index("hinge_stiffness"));
    let errors = |plan: &Plan| [area, stiffness].map(|parameter| plan.uncertainty().error(parameter));
    let whole = plan(text);
    let mut values = whole.point(0).values;
    let same = whole.clone().of_point(&values);
    assert_eq!((errors(&same), same.uncertainty().correlations().len()), ([Some(1e-6), Some(1e-7)], 1));
    values[area] = 6e-5;
    for changed in [whole.clone().of_point(&values), whole.with_parameter(area, 6e-5).unwrap()] {
        assert_eq!(errors(&changed), [None, Some(1e-7)]);
        assert!(changed.uncertainty().correlations().is_empty());
    }
}

#[test]
fn settings_follow_rtol_unless_they_are_set() {
    let settings =
        |rtol, atol, accuracy| SolverSettings { rtol, atol, accuracy, ..SolverSettings::default() };
    for (before, after) in [
        (settings(1e-6, 1e-8, 1e-3), settings(1e-5, 1e-5 / 100.0, 1000.0 * 1e-5)),
        (settings(1e-6, 1e-9, 1e-4), settings(1e-5, 1e-9, 1e-4)),
        (settings(1e-4, 1e-4 / 100.0, 1000.0 * 1e-4), settings(1e-6, 1e-8, 1e-3)),
        (settings(1e-6, 1e-8, 0.5), settings(1e-9, 1e-9 / 100.0, 0.5)),
    ] {
        assert_eq!(with_rtol(before, after.rtol), after);
    }
}
