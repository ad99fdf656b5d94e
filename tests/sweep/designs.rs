//! Several designs at the start of a grid: an axis along which several parameters change at once.

use std::fs;

use flap_core::parameter::Kind;
use flap_sweep::grid;
use flap_sweep::plan::Plan;
use temp_dir::TempDir;

use crate::fake::{FLY, MODELS, index, plan};

/// The values of all points, without the parameter that names the design.
fn points(plan: &Plan) -> Vec<Vec<u64>> {
    let bits = |values: &[f64]| values.iter().take(FLY.len()).map(|value| value.to_bits()).collect();
    (0..plan.len()).map(|index| bits(&plan.point(index).values)).collect()
}

/// The points of a grid with two presets. The points must equal the points of two grids with one preset each.
#[track_caller]
fn same(rest: &str) -> Plan {
    let both = plan(&format!("preset = [\"fly\", \"moth\"]\n{rest}"));
    let each = ["fly", "moth"].map(|preset| points(&plan(&format!("preset = \"{preset}\"\n{rest}"))));
    assert_eq!(points(&both), each.concat(), "{rest}");
    both
}

#[test]
fn points_of_a_design_axis_are_the_points_of_each_design() {
    let axes = "[axes]\ndrive_frequency = [1, 2, 3]\n";
    let both = same(axes);
    let design = both.design().unwrap();
    assert_eq!((both.len(), design), (6, FLY.len()));
    let Kind::Choice(options) = both.parameters()[design].kind else { panic!("no choice") };
    assert_eq!((both.parameters()[design].name, options), ("preset", ["fly", "moth"].as_slice()));
    let named: Vec<f64> = (0..6).map(|point| both.point(point).values[design]).collect();
    assert_eq!(named, [0.0, 0.0, 0.0, 1.0, 1.0, 1.0]);
    // Only the name of the design and the frequency are columns.
    assert_eq!(both.differing().collect::<Vec<_>>(), [design, index("drive_frequency")]);
    assert_eq!(both.in_designs(index("wing_area")), Some(&[FLY[2], 2.0 * FLY[2]][..]));
    assert_eq!(both.in_designs(index("stroke_offset")), None);
}

#[test]
fn the_grid_overrides_all_designs() {
    same("[params]\nwing_area = 1\n[axes]\nhinge_stiffness = [1, 2]\n");
    same("[[zip]]\nwing_area = [1, 2]\nplate_width = [3, 4]\n");
    same("[params]\nplate_width = 2\n");
    let sample = "[sample]\nmethod = \"random\"\nn = 4\n[sample.parameters]\n";
    same(&format!("{sample}wing_area = {{ from = 1, to = 2 }}\n"));
}

#[test]
fn formulas_use_the_values_of_each_design() {
    let formula = "preset.hinge_stiffness * (wing_area / preset.wing_area)^2 + preset.stroke_offset";
    same(&format!("[axes]\nwing_area = [1, 2]\n[derived]\nhinge_stiffness = \"{formula}\"\n"));
    let both = plan("preset = [\"fly\", \"moth\"]\n[where]\nlight = \"preset == 'moth'\"\n");
    let holds: Vec<Option<bool>> =
        (0..2).map(|point| both.conditions()[0].holds(&both.point(point).values)).collect();
    assert_eq!(holds, [Some(false), Some(true)]);
    let measure = "[measure]\nown = \"lift_mean_mn / preset.wing_area\"\n";
    let both = plan(&format!("preset = [\"fly\", \"moth\"]\n{measure}"));
    let mut measures = vec![3.0, 1.0, 1.0];
    both.add_own_measures(&both.point(1).values, &mut measures);
    assert_eq!(measures[3], 3.0 / (2.0 * FLY[2]));
}

#[test]
fn a_changed_parameter_is_the_same_in_all_designs() {
    let both = plan("preset = [\"fly\", \"moth\"]\n");
    let area = index("wing_area");
    let set = both.clone().with_parameter(area, 1.0).unwrap();
    assert_eq!([0, 1].map(|point| set.point(point).values[area]), [1.0, 1.0]);
    let moth = both.clone().of_point(&both.point(1).values);
    assert_eq!(points(&moth), points(&plan("preset = \"moth\"\n")));
    let crossed = both.crossed_with(vec![(area, vec![5.0])]).unwrap();
    assert_eq!([0, 1].map(|point| crossed.point(point).values[area]), [5.0, 5.0]);
}

#[test]
fn devices_are_named_by_their_files_and_recorded_once() {
    let folder = TempDir::new().expect("a folder");
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).expect("written");
    write("base.toml", "preset = \"fly\"\n[params]\nwing_area = { value = 3, sd = 1 }\n");
    write("short.toml", "device = \"base.toml\"\n[params]\nwing_area = 1\n");
    write("wide.toml", "device = \"base.toml\"\n[params]\nplate_width = \"4 m\"\n");
    let text =
        "device = [\"short.toml\", \"wide.toml\"]\n[measure]\nshare = \"wing_area / device.wing_area\"\n";
    let name = folder.path().join("grid.toml").display().to_string();
    let both = grid::parse(&name, text, &MODELS).expect("a plan");
    let names: Vec<String> = both.devices().iter().map(|device| device.name.clone()).collect();
    let known = |file: &str| folder.path().join(file).display().to_string();
    assert_eq!(names, ["short.toml", "base.toml", "wide.toml"].map(known));
    let [first, second] = [0, 1].map(|point| both.point(point).values);
    assert_eq!([first[index("wing_area")], second[index("wing_area")]], [1.0, 3.0]);
    // A device that does not set a parameter leaves it unset.
    assert!(first[index("plate_width")].is_nan());
    assert_eq!(second[index("plate_width")], 4.0);
    // Standard errors belong to one device.
    assert!(both.uncertainty().is_empty());
    // The recorded devices give the same plan without the files.
    drop(folder);
    let again = grid::parse_recorded(&name, text, both.devices(), &MODELS).expect("a plan");
    assert_eq!(points(&again), points(&both));
    assert_eq!(again.parameters().len(), FLY.len() + 1);
}
