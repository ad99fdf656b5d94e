//! Pictures of samples: scatters, histograms, tornados.

use std::fmt::Write as _;
use std::fs;

use super::drawn::drawn;
use super::{HEADER, refused};
use crate::support::{Folder, WINGS};

/// A sample of voltage, frequency and stiffness: lift grows with the voltage, and does not depend on the stiffness.
fn sample() -> String {
    let mut text = HEADER.to_owned() + "\n";
    let part = |place: u32, step: f64| (f64::from(place) * step).fract();
    for point in 0..200 {
        let (a, b, c) = (part(point, 0.618_033_988), part(point, 0.754_877_666), part(point, 0.569_840_291));
        let (voltage, frequency, stiffness) = (60.0 + 40.0 * a, 90.0 + 30.0 * b, 1e-4 + 1e-5 * c);
        let lift = voltage / 50.0 - frequency / 60.0;
        let _ = writeln!(
            text,
            "{point},{voltage},{frequency},{stiffness},periodic,{},{lift},{},22,true",
            voltage / 3.0,
            voltage * frequency / 400.0
        );
    }
    text
}

fn folder() -> Folder {
    let folder = Folder::new();
    fs::write(folder.path("sample.csv"), sample()).unwrap();
    folder
}

#[test]
fn a_sample_is_a_scatter_of_three_measures() {
    let folder = folder();
    drawn(&folder, "sample.csv")
        .says("scatter in out.svg")
        .has(&["Power, mean (mW)", "Lift, mean (mN)", "Stroke, amplitude (°)", "200 designs"])
        .counts("<circle", 200);
    // Whatever columns are named, there are points and no front.
    for (columns, wanted) in [
        ("--x drive_voltage_pp --y lift_mean_mn", "Drive voltage, peak to peak (V)"),
        ("--x drive_voltage_pp --y drive_frequency --color lift_mean_mn", "Lift, mean (mN)"),
        ("--y power_mean_mw", "Power, mean (mW)"),
    ] {
        drawn(&folder, &format!("sample.csv {columns}"))
            .says("scatter in out.svg")
            .has(&[wanted])
            .counts("<circle", 200);
    }
    drawn(&folder, "sample.csv --kind pareto").says("pareto in out.svg");
    drawn(&folder, "sample.csv --y-aim min").says("pareto in out.svg");
    let ended = refused(&folder, &["sample.csv", "--by", "drive_voltage_pp"]);
    ended.says("--x is not given, and a sample has no axes");
    let ended = refused(&folder, &["sample.csv", "--by", "drive_voltage_pp", "--x", "drive_frequency"]);
    ended.says("draw a sample with --kind scatter");
}

/// Lines and cells need axes, and a sample has none.
#[test]
fn a_sample_has_no_lines_and_no_cells() {
    let folder = folder();
    for (kind, form) in [("response", "lines"), ("map", "cells")] {
        let ended = refused(&folder, &["sample.csv", "--kind", kind]);
        ended.says(&format!("a sample has no axes: its designs form no {form} over "));
        ended.says("draw a sample with --kind scatter, histogram or tornado");
    }
    refused(&folder, &["sample.csv", "--kind", "response", "--x", "power_mean_mw"])
        .says("its designs form no lines over power_mean_mw");
}

#[test]
fn a_histogram_marks_percentiles() {
    let folder = folder();
    let picture = drawn(&folder, "sample.csv --kind histogram");
    picture.says("histogram in out.svg").has(&["Lift, mean (mN)", "Number of designs", "200 designs"]);
    for percent in ["5 %: ", "50 %: ", "95 %: "] {
        assert!(picture.texts().iter().any(|text| text.starts_with(percent) && text.ends_with(" mN")));
    }
    picture.says("lift_mean_mn of 200 designs: 5 % below ");
    // Of a hundred even numbers, and one row without a value.
    let mut text = HEADER.to_owned() + "\n";
    for point in 0..=100 {
        let _ = writeln!(text, "{point},{point},90,1e-4,periodic,{point},1,2,22,true");
    }
    text += "101,101,90,1e-4,unsettled,,,,400,\n";
    fs::write(folder.path("even.csv"), text).unwrap();
    drawn(&folder, "even.csv --kind histogram --x stroke_amplitude_deg")
        .has(&["5 %: 5 °", "50 %: 50 °", "95 %: 95 °", "101 designs · 1 of 102 without a value"])
        .says("stroke_amplitude_deg of 101 designs: 5 % below 5 °, 50 % below 50 °, 95 % below 95 °");
}

#[test]
fn a_tornado_has_the_rank_correlations_of_a_sample() {
    let folder = folder();
    let picture = drawn(&folder, "sample.csv --kind tornado");
    picture.says("tornado in out.svg").has(&[
        "Rank correlation (Spearman) with lift, mean",
        "Drive voltage, peak to peak",
        "Drive frequency",
        "Hinge stiffness",
        "200 designs; sizes below 0.14 may be chance",
    ]);
    let sizes: Vec<f64> = (picture.texts().iter())
        // Ticks have one decimal.
        .filter(|text| {
            text.starts_with(['+', '−']) && text.split('.').nth(1).is_some_and(|part| part.len() == 2)
        })
        .map(|text| text.replace('−', "-").parse().unwrap())
        .collect();
    // From the bottom: the smallest first.
    assert!(sizes.is_sorted_by(|a, b| a.abs() <= b.abs()), "{sizes:?}");
    let ends: Vec<String> =
        picture.texts().into_iter().filter(|text| ["−1.0", "1.0"].contains(&text.as_str())).collect();
    assert_eq!(ends, ["−1.0", "1.0"], "the axis ends at 1");
    assert!(sizes.len() == 3 && sizes[2] > 0.7 && sizes[1] < -0.3 && sizes[0].abs() < 0.14, "{sizes:?}");
}

/// The sidecar lists the parameters of the sample; other axes are fixed at their middle value.
#[test]
fn a_sample_may_be_crossed_with_an_axis() {
    let folder = Folder::with_grid(
        "preset = \"ozaki2018-large\"\n[axes]\ndrive_frequency = [100, 105, 110]\n[sample]\nn = 6\nmethod = \"sobol\"\n\
         [sample.parameters]\nhinge_stiffness = { from = 8e-5, to = 1e-4 }\nair_density = { from = 1.1, to = 1.3 }\n",
    );
    folder.ends(0, "sweep grid.toml --out rows.csv");
    for kind in ["scatter", "histogram", "tornado"] {
        let picture = drawn(&folder, &format!("rows.csv --kind {kind}"));
        picture
            .says("drawn: drive_frequency = 105 Hz, the middle of 3 values; --where chooses another value");
    }
    drawn(&folder, "rows.csv --kind response").says("response in out.svg");
    drawn(&folder, "rows.csv").says("scatter in out.svg").has(&["Drive frequency 105 Hz · 6 designs"]);
    let picture = drawn(&folder, "rows.csv --kind tornado --where drive_frequency=110");
    picture.has(&["Air density", "Hinge stiffness"]);
}

/// A scatter of a sample of several presets shows all presets, in different colours.
#[test]
fn a_scatter_has_colours_for_designs() {
    let folder = Folder::with_grid(
        "preset = [\"ozaki2018-large\", \"ozaki2018-small\"]\n[sample]\nn = 6\nmethod = \"sobol\"\n\
         [sample.parameters]\nhinge_stiffness = { from = 8e-5, to = 1e-4 }\nair_density = { from = 1.1, to = 1.3 }\n",
    );
    folder.ends(0, "sweep grid.toml --out rows.csv");
    let picture = drawn(&folder, "rows.csv --kind scatter");
    picture.has(&["ozaki2018-large", "ozaki2018-small", "12 designs"]);
    // Six points of each preset, and a point in the legend.
    for colour in ["#0072b2", "#d55e00"] {
        let points = picture.svg.to_lowercase().matches(colour).count();
        assert!(points >= 7, "{points} points of {colour}");
    }
    let picture = drawn(&folder, "rows.csv --kind scatter --where preset=ozaki2018-small");
    picture.has(&["Preset ozaki2018-small · 6 designs"]);
    assert!(!picture.svg.contains(">ozaki2018-large<"));
}

/// Designs along one axis are a curve, so a Pareto front would contain no information.
#[test]
fn two_measures_along_one_axis_are_no_front() {
    let folder = Folder::new();
    let mut text = HEADER.to_owned() + "\n";
    for point in 0..20 {
        let _ = writeln!(
            text,
            "{point},{},90,1e-4,periodic,{point},{point},{},22,true",
            60 + point,
            point * point
        );
    }
    fs::write(folder.path("line.csv"), text).unwrap();
    drawn(&folder, "line.csv --x power_mean_mw --y lift_mean_mn")
        .says("scatter in out.svg")
        .counts("<circle", 20);
    drawn(&folder, "line.csv").says("response in out.svg");
}

/// Derivatives belong to the same value of a crossed axis as the drawn rows.
#[test]
fn derivatives_are_at_the_drawn_value_of_an_axis() {
    let sample = "[sample]\nn = 16\nmethod = \"sobol\"\n[sample.parameters]\n\
                  hinge_stiffness = { relative_sd = \"1 %\" }\nair_density = { relative_sd = \"1 %\" }\n\
                  [output]\ncolumns = [\"lift_mean_mn\"]\n";
    let axes = "[axes]\ndrive_voltage_pp = [\"40 V\", \"80 V\"]\n";
    let folder = Folder::with_grid(&format!("preset = \"ozaki2018-large\"\n{axes}{sample}"));
    folder.ends(0, "sweep grid.toml --out rows.csv");
    let all_together = |options: &str| -> [f64; 2] {
        let ended = folder
            .ends(0, &format!("plot rows.csv --kind tornado --derivatives --out out.svg --force {options}"));
        let cells: Vec<&str> = ended.stdout.lines().last().unwrap().split_whitespace().collect();
        [2, 1].map(|from_end| cells[cells.len() - from_end].parse().unwrap())
    };
    let [low, high] = [40, 80].map(|voltage| {
        let [derivatives, sample] = all_together(&format!("--where drive_voltage_pp={voltage}"));
        assert!((derivatives - sample).abs() < 0.1 * sample, "{voltage} V: {derivatives} {sample}");
        derivatives
    });
    assert!(high > 1.5 * low, "{low} {high}");
    assert_eq!(all_together("")[0], high, "the drawn slice is at 80 V");
}

/// At hover, the inputs change with the design: in the rows of the sample, and in the derivatives.
#[test]
fn effects_at_hover_contain_the_change_of_the_inputs() {
    let sample = "[sample]\nn = 8\nmethod = \"sobol\"\n[sample.parameters]\nhinge_stiffness = { relative_sd = \"1 %\" }\n\
                  [output]\ncolumns = [\"power_mean_mw\"]\n";
    let folder = Folder::with_grid(&format!(
        "preset = \"jafferis2016\"\n{sample}[vehicle]\ntotal_mass = \"69 mg\"\ntrim = \"hover\"\n{WINGS}"
    ));
    folder.ends(0, "sweep grid.toml --out rows.csv");
    let ended = folder.ends(0, "plot rows.csv --kind tornado --derivatives --out out.svg");
    let line = ended.stdout.lines().find(|line| line.starts_with("hinge_stiffness")).unwrap();
    let cells: Vec<&str> = line.split_whitespace().collect();
    let [derivative, sample]: [f64; 2] =
        [2, 1].map(|from_end| cells[cells.len() - from_end].parse().unwrap());
    assert!((derivative / sample - 1.0).abs() < 0.02, "{line}");
}

/// For small deviations a measure is linear in the parameters, so derivatives and sample have the same effects.
#[test]
fn effects_from_derivatives_and_from_the_sample_agree() {
    let sample = "[sample]\nn = 64\nmethod = \"sobol\"\n[sample.parameters]\nhinge_stiffness = { relative_sd = \"1 %\" }\n\
                  drive_voltage_pp = { relative_sd = \"1 %\" }\nair_density = { relative_sd = \"1 %\" }\n\
                  [output]\ncolumns = [\"lift_mean_mn\"]\n";
    let gradient = "[gradient]\nof = [\"lift_mean_mn\"]\nwith_respect_to = [\"hinge_stiffness\", \"drive_voltage_pp\"]\n";
    let preset = "preset = \"ozaki2018-large\"\n";
    let folder = Folder::with_grid(&format!("{preset}{sample}{gradient}"));
    folder.ends(0, "sweep grid.toml --out columns.csv");
    fs::write(folder.path("plain.toml"), format!("{preset}{sample}")).unwrap();
    folder.ends(0, "sweep plain.toml --out plain.csv");
    let effects = |file: &str| {
        let ended =
            folder.ends(0, &format!("plot {file} --kind tornado --derivatives --out out.svg --force"));
        let cells = |line: &str| line.split_whitespace().map(str::to_owned).collect::<Vec<String>>();
        let lines = ended.stdout.lines().skip(2).map(cells).collect::<Vec<_>>();
        (lines, ended.stderr)
    };
    let number = |cells: &[String], from_end: usize| cells[cells.len() - from_end].parse::<f64>().unwrap();
    // The sidecar has the model, so flap computes derivatives that the file lacks.
    let (plain, said) = effects("plain.csv");
    assert!(said.contains("derivatives are computed at the means of the parameters"), "{said}");
    assert_eq!(plain[0], ["PARAMETER", "STANDARD", "DEVIATION", "UNIT", "DERIVATIVES", "SAMPLE"]);
    assert_eq!(plain[1][0], "drive_voltage_pp");
    assert_eq!(plain.last().unwrap()[..2], ["all", "together"]);
    let largest = number(&plain[1], 1).abs();
    for cells in &plain[1..] {
        assert!((number(cells, 2) - number(cells, 1)).abs() < 0.05 * largest, "{cells:?}");
    }
    let (columns, said) = effects("columns.csv");
    assert!(!said.contains("computed"), "{said}");
    for name in ["drive_voltage_pp", "hinge_stiffness"] {
        let of = |lines: &[Vec<String>]| number(lines.iter().find(|cells| cells[0] == name).unwrap(), 2);
        assert!((of(&columns) - of(&plain)).abs() < 0.02 * largest, "{columns:?} {plain:?}");
    }
    let density = columns.iter().find(|cells| cells[0] == "air_density").unwrap();
    assert_eq!(density[density.len() - 2], "none", "[gradient] leaves out the density");
    // Three parameters with two bars each, and the axis at zero.
    folder.ends(0, "plot plain.csv --kind tornado --derivatives --out out.svg --force");
    let picture = folder.read("out.svg");
    for text in
        [">derivatives<", ">sample<", "Change for one standard deviation: Lift, mean (mN)", "64 designs"]
    {
        assert!(picture.contains(text), "{text}");
    }
    fs::remove_file(folder.path("plain.csv.meta.toml")).unwrap();
    let ended = refused(&folder, &["plain.csv", "--kind", "tornado", "--derivatives"]);
    ended.says("--derivatives requires derivatives of lift_mean_mn, or the sidecar of the results");
    refused(&folder, &["columns.csv", "--derivatives"]).says("--derivatives requires --kind tornado");
}
