//! Samples in grid files.

use std::fs;

use flap_core::parameter::Invalid;
use flap_sweep::plan::axes::Values;
use flap_sweep::plan::sample::{Distribution, Method};
use flap_sweep::plan::{Admission, Plan};
use temp_dir::TempDir;

use crate::fake::{MODELS, index, plan};

fn column(plan: &Plan, name: &str) -> Vec<f64> {
    (0..plan.len()).map(|point| plan.point(point).values[index(name)]).collect()
}

#[test]
fn distributions_of_every_kind() {
    let plan = plan(
        r#"
preset = "fly"
[sample]
method = "latin-hypercube"
n = 100
seed = 0xff
[sample.parameters]
wing_area = { from = "50 mm^2", to = "60 mm^2" }
drive_frequency = { from = 10, to = "1 kHz", scale = "log" }
hinge_stiffness = { relative_sd = "5 %" }
stroke_offset = { mean = "10 deg", sd = "1 deg", to = "10 deg" }
arms = ["axis", "printed"]
"#,
    );
    let [axis] = plan.axes().as_slice() else { panic!("one axis") };
    let distributions: Vec<&Distribution> = axis
        .parameters()
        .iter()
        .map(|(_, values)| match values {
            Values::Sampled { sample, distribution, .. } => {
                assert_eq!((sample.method(), sample.count()), (Method::LatinHypercube, 100));
                distribution
            }
            other => panic!("{other:?}"),
        })
        .collect();
    let degree = std::f64::consts::PI / 180.0;
    let expected = [
        Distribution::Uniform { from: 50e-6, to: 60e-6 },
        Distribution::LogUniform { from: 10.0, to: 1000.0 },
        Distribution::Normal { mean: 1e-6, sd: 1e-6 * 0.05, from: f64::NEG_INFINITY, to: f64::INFINITY },
        Distribution::Normal { mean: 10.0 * degree, sd: degree, from: f64::NEG_INFINITY, to: 10.0 * degree },
        Distribution::Among(vec![1.0, 0.0]),
    ];
    assert_eq!(distributions, expected.iter().collect::<Vec<_>>());

    assert_eq!(plan.len(), 100);
    // Each hundredth of a uniform parameter once, and each option fifty times.
    let mut hundredths: Vec<f64> =
        column(&plan, "wing_area").into_iter().map(|area| ((area - 50e-6) / 0.1e-6).floor()).collect();
    hundredths.sort_by(f64::total_cmp);
    assert!(hundredths.into_iter().eq((0..100).map(f64::from)));
    assert_eq!(column(&plan, "arms").iter().sum::<f64>(), 50.0);
    let stiffness = column(&plan, "hinge_stiffness");
    let mean = stiffness.iter().sum::<f64>() / 100.0;
    assert!((mean / 1e-6 - 1.0).abs() < 1e-3, "{mean}");
}

#[test]
fn a_sample_is_one_axis_in_its_place_in_the_file() {
    let plan = plan(
        "preset = \"fly\"\n[axes]\nwing_area = [1, 2]\n[sample]\nmethod = \"sobol\"\nn = 5\n\
         [sample.parameters]\nhinge_position = { from = 0, to = 1 }\nstroke_offset = { from = 0, to = 1 }\n\
         [[zip]]\ndrive_frequency = [10, 20, 30]\n",
    );
    assert_eq!(plan.len(), 2 * 5 * 3);
    let alone = self::plan(
        "preset = \"fly\"\n[sample]\nmethod = \"sobol\"\nn = 5\nseed = 0\n\
         [sample.parameters]\nhinge_position = { from = 0, to = 1 }\nstroke_offset = { from = 0, to = 1 }\n",
    );
    let [position, offset] = ["hinge_position", "stroke_offset"].map(|name| column(&alone, name));
    let mut number = 0;
    for area in [1.0, 2.0] {
        for sampled in 0..5 {
            for frequency in [10.0, 20.0, 30.0] {
                let values = plan.point(number).values;
                let found = ["wing_area", "hinge_position", "stroke_offset", "drive_frequency"]
                    .map(|name| values[index(name)]);
                assert_eq!(found, [area, position[sampled], offset[sampled], frequency], "{number}");
                number += 1;
            }
        }
    }
}

#[test]
fn a_sample_of_four_billion_points_is_not_stored() {
    for method in ["sobol", "latin-hypercube", "random"] {
        let plan = plan(&format!(
            "preset = \"fly\"\n[sample]\nmethod = \"{method}\"\nn = 4294967296\n\
             parameters.wing_area = {{ from = 1, to = 2 }}\n"
        ));
        assert_eq!(plan.len(), 1 << 32);
        let area = plan.point(plan.len() - 1).values[index("wing_area")];
        assert!(area > 1.0 && area < 2.0, "{area}");
    }
}

#[test]
fn sampled_values_out_of_range_make_a_point_invalid() {
    let plan = plan(
        "preset = \"fly\"\n[sample]\nmethod = \"random\"\nn = 1000\n\
         parameters.wing_area = { mean = 1, sd = 1 }\n",
    );
    let areas = column(&plan, "wing_area");
    let below = areas.iter().filter(|area| **area <= 0.0).count();
    // A share of 0.1587, with a standard deviation of 11.6 points.
    assert!((112..206).contains(&below), "{below}");
    for (point, area) in (0..).zip(areas) {
        let reason = format!(
            "`wing_area` is computed as {} m^2, but must be more than zero",
            flap_sweep::notation::text::float(area)
        );
        let expected = if area > 0.0 { Admission::Runs } else { Admission::Invalid(Invalid::new(reason)) };
        assert_eq!(plan.judge(&plan.point(point).values), expected);
    }
}

#[test]
fn points_come_from_a_file_beside_the_grid() {
    let folder = TempDir::new().expect("a folder");
    let points = "\u{feff}wing_area [mm^2], drive_frequency ,arms,hinge_stiffness\r\n\
                  50, 100, axis, 1e-6\r\n\r\n  54.5,\"0.2 kHz\",printed,1.5 uN*m/rad\n";
    fs::write(folder.path().join("points.csv"), points).expect("a file");
    let name = folder.path().join("grid.toml").display().to_string();
    let grid = "preset = \"fly\"\n[sample]\nmethod = \"file\"\npath = \"points.csv\"\n[axes]\nstroke_offset = [0, 1]\n";
    let plan = flap_sweep::grid::parse(&name, grid, &MODELS).expect("a proper grid");
    assert_eq!(plan.len(), 4);
    let names = ["wing_area", "drive_frequency", "arms", "hinge_stiffness", "stroke_offset"];
    let found: Vec<Vec<f64>> = (0..4)
        .map(|point| plan.point(point).values)
        .map(|values| names.map(|name| values[index(name)]).to_vec())
        .collect();
    let (first, second) = ([50e-6, 100.0, 1.0, 1e-6], [54.5e-6, 200.0, 0.0, 1.5e-6]);
    let with = |point: [f64; 4], offset: f64| [&point[..], &[offset]].concat();
    assert_eq!(found, [with(first, 0.0), with(first, 1.0), with(second, 0.0), with(second, 1.0)]);
    let file = plan.points_file().expect("a file");
    assert_eq!(file.path, folder.path().join("points.csv"));
}

/// Messages about a file of points; the places in the messages are places in the file of points.
fn mistakes_of(points: &str) -> Vec<String> {
    let folder = TempDir::new().expect("a folder");
    fs::write(folder.path().join("points.csv"), points).expect("a file");
    let name = folder.path().join("grid.toml").display().to_string();
    let grid = "preset = \"fly\"\n[sample]\nmethod = \"file\"\npath = \"points.csv\"\n";
    let problems = flap_sweep::grid::parse(&name, grid, &MODELS).err().expect("mistakes");
    let place = folder.path().display().to_string() + "/";
    let line = |problem: &flap_sweep::grid::diagnostic::Diagnostic| {
        let part = &problem.source.text[problem.span.clone()];
        format!("{problem} |{part}| {}", problem.help.join("; ")).replace(&place, "")
    };
    problems.iter().map(line).collect()
}

#[test]
fn mistakes_in_files_of_points_have_a_line_and_a_column() {
    assert_eq!(mistakes_of(""), ["points.csv:1:1: the file of points is empty || "]);
    assert_eq!(
        mistakes_of("wing_area\n"),
        ["grid.toml:4:8: points.csv: the file has no points |\"points.csv\"| "]
    );
    assert_eq!(
        mistakes_of("wing_aera, arms, hinge_position [mm], speed\n1,2,3,4\n"),
        [
            "points.csv:1:1: model `flapper` has no parameter `wing_aera` |wing_aera| did you mean `wing_area`?",
            "points.csv:1:18: `mm` is a length, but `hinge_position` is a pure number |hinge_position [mm]| \
             write a bare number, or use %",
            "points.csv:1:39: model `flapper` has no parameter `speed` |speed| the first line names the parameters; \
             `flap models` lists them",
        ]
    );
    assert_eq!(
        mistakes_of("wing_area, arms\n1, axis\n-2, axes\n3\n4 s, printed\n,axis\n"),
        [
            "points.csv:3:1: `wing_area` must be more than zero, not -2 |-2| ",
            "points.csv:3:5: `arms` has no option `axes` |axes| options: printed, axis",
            "points.csv:4:1: the line has 1 cells, but there are 2 headings |3| ",
            "points.csv:5:1: `s` is a time, but `wing_area` is in m^2 |4 s| use m^2, mm^2, um^2",
            "points.csv:6:1: `wing_area` must start with a number || write a bare number, or a number with its unit \
             such as \"200 V\"",
        ]
    );
    assert_eq!(
        mistakes_of("wing_area,wing_area\n1,2\n"),
        ["points.csv:1:11: `wing_area` has two columns |wing_area| "]
    );
    for heading in
        ["hinge_stiffness [uN*m/rad", "hinge_stiffness uN*m/rad]", "hinge_stiffness [a] b", "[m][m]"]
    {
        let told = mistakes_of(&format!("wing_area,{heading}\n1,2\n"));
        assert_eq!(
            told,
            [format!(
                "points.csv:1:11: the brackets in the heading `{heading}` do not enclose a unit |{heading}| \
                 write the name, then the unit in brackets: `wing_area [mm^2]`"
            )]
        );
    }
    assert_eq!(mistakes_of(&format!("wing_area\n{}", "x\n".repeat(1000))).len(), 10);
    let windows = "\u{feff}\r\n\"wing_area\" , arms\r\n  \r\n1,axis\r\n\r\n 2 , \"axes\"\r\n";
    assert_eq!(
        mistakes_of(windows),
        ["points.csv:6:6: `arms` has no option `axes` |\"axes\"| options: printed, axis"]
    );
    let told = mistakes_of("\u{feff}\u{feff}µ,wing_area\n1,2\n");
    assert_eq!(told.len(), 1);
    assert!(told[0].starts_with("points.csv:1:1: model `flapper` has no parameter"), "{told:?}");
}
