//! Derived parameters, conditions and measures that the user defines.

use flap_core::parameter::Invalid;
use flap_sweep::plan::Admission;
use flap_sweep::table::layout::{CellKind, Layout};

use crate::fake::{index, plan};

#[test]
fn derived_parameters_follow_axes_and_preset() {
    let plan = plan(
        r#"
preset = "fly"
[axes]
wing_area = ["50 mm^2", "100 mm^2"]
[derived]
# Neither in the order of evaluation nor of the table.
stroke_offset = "hinge_position - 1"
hinge_position = "plate_width * 100"
plate_width = "0.005 * (wing_area / preset.wing_area)^2"
[params]
drive_frequency = 120
"#,
    );
    assert_eq!(plan.len(), 2);
    let values = plan.point(1).values;
    let found =
        ["wing_area", "plate_width", "hinge_position", "stroke_offset"].map(|name| values[index(name)]);
    assert_eq!(found, [1e-4, 0.02, 2.0, 1.0]);
    assert_eq!(plan.judge(&values), Admission::Runs);
    // After the varied ones, in the order of the file.
    let names = Layout::of(&plan).names();
    assert_eq!(names[..5], ["point", "wing_area", "stroke_offset", "hinge_position", "plate_width"]);
}

#[test]
fn a_derived_value_that_was_set_instead_is_kept() {
    let plan = plan(
        "preset = \"fly\"\n[derived]\nwing_area = \"2 * hinge_position\"\nplate_width = \"wing_area\"\n",
    );
    let mut values = plan.point(0).values;
    assert_eq!(values[index("wing_area")], 1.0);
    values[index("hinge_position")] = 3.0;
    values[index("wing_area")] = 7.0;
    plan.derived().fill(&mut values, &[index("wing_area")]);
    assert_eq!((values[index("wing_area")], values[index("plate_width")]), (7.0, 7.0));
}

#[test]
fn derived_values_out_of_range_make_a_point_invalid() {
    let plan = plan(
        "preset = \"fly\"\n[axes]\nhinge_position = [1, -1, -2]\n[derived]\nwing_area = \"sqrt(hinge_position + 1)\"\n",
    );
    let judged: Vec<Admission> = (0..3).map(|point| plan.judge(&plan.point(point).values)).collect();
    assert_eq!(
        judged,
        [
            Admission::Runs,
            Admission::Invalid(Invalid::new(
                "`wing_area` is computed as 0.0 m^2, but must be more than zero"
            )),
            Admission::Invalid(Invalid::new("`wing_area` is computed as not a number")),
        ]
    );
}

#[test]
fn conditions_exclude_points() {
    let plan = plan(
        r#"
preset = "fly"
[axes]
hinge_position = [-1, 0, 1, 2]
arms = ["printed", "axis"]
[derived]
wing_area = "hinge_position"
[where]
small = "wing_area < 2"
# Not known for -1, but `positive` decides.
root = "sqrt(wing_area) < 5"
positive = "wing_area >= 0"
read = "arms == 'axis' or wing_area > preset.stroke_offset"
"#,
    );
    let names: Vec<&str> = plan.conditions().iter().map(|condition| condition.name.as_str()).collect();
    assert_eq!(names, ["small", "root", "positive", "read"]);
    let judged: Vec<Admission> = (0..8).map(|point| plan.judge(&plan.point(point).values)).collect();
    let zero =
        Admission::Invalid(Invalid::new("`wing_area` is computed as 0.0 m^2, but must be more than zero"));
    assert_eq!(
        judged,
        [
            Admission::Excluded(vec![2, 3]),
            Admission::Excluded(vec![2]),
            Admission::Excluded(vec![3]),
            zero,
            Admission::Runs,
            Admission::Runs,
            Admission::Excluded(vec![0]),
            Admission::Excluded(vec![0]),
        ]
    );
}

#[test]
fn a_condition_that_cannot_be_computed_excludes_nothing() {
    let plan = plan("preset = \"fly\"\n[where]\nroot = \"sqrt(stroke_offset - 1) < 5\"\n");
    let reason = "the condition `root` cannot be computed";
    assert_eq!(plan.judge(&plan.point(0).values), Admission::Invalid(Invalid::new(reason)));
}

#[test]
fn measures_of_ones_own() {
    let plan = plan(
        r#"
preset = "fly"
[measure]
ratio = "lift_mean_mn / power_mean_mw"
feasible = "ratio > 1 and stroke_pp_deg < 90"
per_area = "ratio / (wing_area / preset.wing_area)"
both = "feasible and arms == 'printed'"
"#,
    );
    let measure = |lift: f64, power: f64, stroke: f64| {
        let mut measures = vec![lift, power, stroke];
        plan.add_own_measures(&plan.point(0).values, &mut measures);
        measures
    };
    assert_eq!(measure(3.0, 2.0, 80.0), [3.0, 2.0, 80.0, 1.5, 1.0, 1.5, 1.0]);
    assert_eq!(measure(3.0, 2.0, 100.0), [3.0, 2.0, 100.0, 1.5, 0.0, 1.5, 0.0]);
    // A lift without power is no finite ratio. What is known decides.
    let unknown = measure(3.0, 0.0, 100.0);
    assert!(unknown[3].is_nan() && unknown[5].is_nan());
    assert_eq!(unknown[4], 0.0);
    // A row without measures stays without.
    let mut none = Vec::new();
    plan.add_own_measures(&plan.point(0).values, &mut none);
    assert!(none.is_empty());

    let layout = Layout::of(&plan);
    let kinds: Vec<(&str, CellKind)> = layout
        .measures()
        .skip(3)
        .map(|measure| (measure.column.name.as_str(), measure.column.kind))
        .collect();
    let expected = [
        ("ratio", CellKind::Number),
        ("feasible", CellKind::Flag),
        ("per_area", CellKind::Number),
        ("both", CellKind::Flag),
    ];
    assert_eq!(kinds, expected);
}

#[test]
fn own_measures_can_be_selected() {
    let plan = plan(
        "preset = \"fly\"\n[output]\ncolumns = [\"b\", \"lift_mean_mn\", \"a\"]\n\
         [measure]\na = \"1\"\nb = \"2 * stroke_pp_deg > a\"\n",
    );
    let layout = Layout::of(&plan);
    let found: Vec<(&str, usize)> =
        layout.measures().map(|measure| (measure.column.name.as_str(), measure.index)).collect();
    assert_eq!(found, [("b", 4), ("lift_mean_mn", 0), ("a", 3)]);
}
