//! Pictures: lines, maps, fronts, loops, motions.

use std::fmt::Write as _;
use std::fs;

use super::{HEADER, count, folder, refused};
use crate::support::{Folder, frequencies};

/// Draws, and gives what was drawn and what was said.
fn drawn(folder: &Folder, arguments: &str) -> (String, String) {
    let ended = folder.flap(&format!("plot {arguments} --force --out out.svg"));
    assert_eq!((ended.code, ended.stdout.as_str()), (0, ""), "{arguments}\n{}", ended.stderr);
    (folder.read("out.svg"), ended.stderr)
}

/// Texts of an SVG.
fn texts(svg: &str) -> Vec<String> {
    let parts = svg.split("<text").skip(1);
    parts.map(|part| part.split_once('>').unwrap().1.split_once('<').unwrap().0.to_owned()).collect()
}

fn has(svg: &str, wanted: &[&str]) {
    let texts = texts(svg);
    for text in wanted {
        assert!(texts.iter().any(|found| found == text), "{text} is not among {texts:?}");
    }
}

#[test]
fn a_family_of_responses() {
    let folder = folder();
    let (svg, said) = drawn(&folder, "sweep.csv");
    assert!(said.contains("response in out.svg"), "{said}");
    has(&svg, &["Drive frequency (Hz)", "Stroke, amplitude (°)", "sweep.csv", "60", "80", "100"]);
    has(&svg, &["2 of 12 points without a value"]);
    // One line of four points; two lines of two, each with one beyond the gap.
    assert_eq!(count(&svg, "stroke-width=\"2\" fill=\"none\""), 3, "{svg}");
    // A mark at every point that has a value.
    assert_eq!(count(&svg, "<circle"), 10);

    let (svg, _) =
        drawn(&folder, "sweep.csv --by drive_frequency --x drive_voltage_pp --y lift_mean_mn --title Lift");
    has(&svg, &["Drive voltage, peak to peak (V)", "Lift, mean (mN)", "Lift", "90", "120"]);
    let (svg, _) = drawn(
        &folder,
        "sweep.csv --by status --x drive_frequency --y lift_mean_mn --where drive_voltage_pp=60",
    );
    has(&svg, &["periodic", "Drive voltage, peak to peak 60 V"]);
}

#[test]
fn a_map_shows_what_is_missing() {
    let folder = folder();
    let (svg, said) = drawn(&folder, "sweep.csv --color lift_mean_mn");
    assert!(said.contains("map in out.svg"), "{said}");
    has(&svg, &["Drive frequency (Hz)", "Drive voltage, peak to peak (V)", "Lift, mean (mN)", "no value"]);
    has(&svg, &["2 of 12 cells without a value"]);
    // Two cells, and the one that says what they are.
    assert_eq!(count(&svg, "fill=\"#c9c9c9\""), 3);
    // Twelve cells, 64 slices of the colour bar, the sign for missing cells, background, clip and frame.
    assert_eq!(count(&svg, "<rect"), 12 + 64 + 1 + 3);
    // The axes end where the cells do.
    let (svg, _) = drawn(&folder, "sweep.csv --kind map --where drive_frequency=90 --y hinge_stiffness");
    has(&svg, &["Hinge stiffness (µN·m/rad)"]);
    assert!(!texts(&svg).contains(&"no value".to_owned()));
}

#[test]
fn even_ratios_are_drawn_evenly() {
    let folder = Folder::new();
    let mut text = HEADER.to_owned() + "\n";
    for point in 0..8 {
        let (voltage, frequency) = (10_i32.pow(point / 2), 90 + 10 * (point % 2));
        let _ = writeln!(text, "{point},{voltage},{frequency},1e-4,periodic,{point},1,2,3,true");
    }
    fs::write(folder.path("decades.csv"), text).unwrap();
    let (svg, _) = drawn(&folder, "decades.csv --kind map --y drive_voltage_pp --color stroke_amplitude_deg");
    has(&svg, &["1", "10", "100", "1000"]);
    let heights = svg.split("<rect").skip(1).filter_map(|rect| {
        let height = rect.split_once("height=\"")?.1.split_once('"')?.0;
        height.parse::<f64>().ok()
    });
    let cells = heights.filter(|height| (50.0..200.0).contains(height));
    let (low, high) =
        cells.fold((f64::MAX, 0.0_f64), |(low, high), height| (low.min(height), high.max(height)));
    assert!(high - low < 1.0 && high > 50.0, "{low} to {high}");
    let (svg, _) = drawn(&folder, "decades.csv --kind response --x drive_voltage_pp --by drive_frequency");
    has(&svg, &["1", "10", "100", "1000"]);
}

#[test]
fn a_front_of_two_measures() {
    let folder = folder();
    let (svg, said) = drawn(&folder, "sweep.csv --kind pareto");
    assert!(said.contains("pareto in out.svg"), "{said}");
    has(&svg, &["Lift, mean (mN)", "Power, mean (mW)", "designs (10)", "not dominated (3)"]);
    has(&svg, &["better: x larger, y smaller · 2 of 12 designs without values"]);
    // The points, those of the front once more, and the sign in the legend.
    assert_eq!(count(&svg, "<circle"), 10 + 3 + 1);
    let (svg, _) = drawn(&folder, "sweep.csv --kind pareto --x-aim min --y-aim min");
    has(&svg, &["not dominated (1)", "better: x smaller, y smaller · 2 of 12 designs without values"]);
    let (svg, _) =
        drawn(&folder, "sweep.csv --x lift_mean_mn --y stroke_amplitude_deg --color drive_frequency");
    has(&svg, &["Drive frequency (Hz)", "Lift, mean (mN)", "Stroke, amplitude (°)"]);
}

#[test]
fn a_hysteresis_loop() {
    let folder = folder();
    let (svg, said) = drawn(&folder, "response.csv");
    assert!(said.contains("hysteresis in out.svg"), "{said}");
    has(&svg, &["rising", "falling", "unstable", "Drive frequency (Hz)", "Stroke, amplitude (°)"]);
    assert_eq!(count(&svg, "<path"), 3);
    let dashed =
        svg.split("<path").skip(1).filter(|path| path.split('>').next().unwrap().contains("dasharray"));
    assert_eq!(dashed.count(), 1);
    let (svg, _) = drawn(&folder, "response.csv --where branch=up --y lift_mean_mn");
    has(&svg, &["rising", "Lift, mean (mN)", "Branch up"]);
    assert_eq!(count(&svg, "<path"), 1);
}

#[test]
fn a_motion_and_its_phase_portrait() {
    let folder = folder();
    let (svg, said) = drawn(&folder, "motion.csv");
    assert!(said.contains("trajectory in out.svg"), "{said}");
    assert!(said.contains("the rate of the pitch is that of its samples' differences"), "{said}");
    assert!(!said.contains("the rate of the stroke"), "{said}");
    has(&svg, &["Time (ms)", "Angle (°)", "Rate (°/ms)", "stroke", "pitch"]);
    assert_eq!(count(&svg, "<path"), 4);
    // As a line over time, if that is asked for.
    let (svg, _) = drawn(&folder, "motion.csv --x time_s --y stroke_deg");
    has(&svg, &["Time (ms)", "Stroke (°)"]);
}

#[test]
fn slices_are_told() {
    let folder = folder();
    let (svg, said) = drawn(&folder, "sweep.csv --x drive_voltage_pp --y lift_mean_mn --by status");
    assert!(
        said.contains("slice drive_frequency=110.0, the middle of 4 values; --where takes another"),
        "{said}"
    );
    has(&svg, &["Drive frequency 110 Hz · 2 of 3 points without a value"]);
    let arguments =
        "sweep.csv --x drive_voltage_pp --y lift_mean_mn --by status --where drive_frequency=0.12kHz";
    let (svg, said) = drawn(&folder, arguments);
    assert!(!said.contains("slice"), "{said}");
    has(&svg, &["Drive frequency 0.12kHz"]);
}

#[test]
fn png_has_twice_as_many_pixels() {
    let folder = folder();
    for file in ["sweep.csv", "response.csv", "motion.csv"] {
        folder.ends(0, &format!("plot {file} --out out.png --size 400x300 --force"));
        let bytes = fs::read(folder.path("out.png")).unwrap();
        assert_eq!(bytes[..8], *b"\x89PNG\r\n\x1a\n");
        let number = |at: usize| u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap());
        assert_eq!((number(16), number(20)), (800, 600), "{file}");
    }
    let (svg, _) = drawn(&folder, "sweep.csv --size 400x300");
    assert!(svg.contains("width=\"400\" height=\"300\""));
}

#[test]
fn pictures_do_not_depend_on_the_format_of_results() {
    let folder = Folder::with_grid(&(frequencies(6) + "hinge_stiffness = [9e-5, 1e-4]\n"));
    for ending in ["csv", "csv.zst", "parquet"] {
        folder.ends(0, &format!("sweep --grid grid.toml --out rows.{ending}"));
    }
    let svg = |name: &str| drawn(&folder, &format!("{name} --title same")).0;
    let first = svg("rows.csv");
    has(&first, &["Drive frequency (Hz)", "Stroke, amplitude (°)", "90", "100", "same"]);
    // The library counts its clips.
    assert_eq!(first, svg("rows.csv.zst"));
    assert_eq!(first, svg("rows.parquet"));
    // Named after the results, in the working directory.
    assert_eq!(folder.flap("plot rows.csv.zst").code, 0);
    assert!(folder.path("rows.svg").exists());
}

#[test]
fn many_rows_are_thinned_and_said() {
    let folder = Folder::new();
    let mut text = HEADER.to_owned() + "\n";
    for point in 0..50_000 {
        let frequency = 90.0 + f64::from(point % 25_000) * 1e-3;
        let voltage = if point < 25_000 { 60 } else { 80 };
        let _ = writeln!(
            text,
            "{point},{voltage},{frequency:.3},1e-4,periodic,{},{},{},22,true",
            point % 997,
            point % 31,
            point % 29
        );
    }
    fs::write(folder.path("many.csv"), text).unwrap();
    let (svg, said) = drawn(&folder, "many.csv --kind pareto");
    assert!(said.contains("20000 of 50000 points are drawn, evenly chosen; the front is of all"), "{said}");
    assert!(count(&svg, "<circle") < 20_100);
    let (svg, _) = drawn(&folder, "many.csv --by drive_voltage_pp");
    assert!(svg.len() < 1_000_000, "{}", svg.len());
    let ended = refused(&folder, &["many.csv", "--by", "drive_frequency", "--x", "drive_voltage_pp"]);
    ended.says("25000 of 50000 rows have a drive_frequency of their own");

    let mut text = HEADER.to_owned() + "\n";
    for point in 0..200 {
        let _ = writeln!(text, "{point},{},{},1e-4,periodic,1,2,3,22,true", 60 + point / 5, 90 + point % 5);
    }
    fs::write(folder.path("lines.csv"), text).unwrap();
    let (_, said) = drawn(&folder, "lines.csv");
    assert!(said.contains("16 of the 40 values of drive_voltage_pp are drawn, evenly chosen"), "{said}");
}
