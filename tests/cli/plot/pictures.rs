//! Pictures: lines, maps, fronts, loops, motions.

use std::fmt::Write as _;
use std::fs;

use super::drawn::drawn;
use super::{HEADER, count, folder, refused};
use crate::support::{Folder, frequencies};

#[test]
fn a_family_of_responses() {
    let folder = folder();
    drawn(&folder, "sweep.csv")
        .says("response in out.svg")
        .has(&["Drive frequency (Hz)", "Stroke, amplitude (°)", "sweep.csv", "60", "80", "100"])
        .has(&["2 of 12 points without a value"])
        // One line of four points; two lines of two, each with one beyond the gap.
        .counts("stroke-width=\"2\" fill=\"none\"", 3)
        // A mark at every point that has a value.
        .counts("<circle", 10);

    drawn(&folder, "sweep.csv --by drive_frequency --x drive_voltage_pp --y lift_mean_mn --title Lift")
        .has(&["Drive voltage, peak to peak (V)", "Lift, mean (mN)", "Lift", "90", "120"]);
    drawn(&folder, "sweep.csv --by status --x drive_frequency --y lift_mean_mn --where drive_voltage_pp=60")
        .has(&["periodic", "Drive voltage, peak to peak 60 V"]);
}

#[test]
fn a_map_shows_what_is_missing() {
    let folder = folder();
    drawn(&folder, "sweep.csv --color lift_mean_mn")
        .says("map in out.svg")
        .has(&["Drive frequency (Hz)", "Drive voltage, peak to peak (V)", "Lift, mean (mN)", "no value"])
        .has(&["2 of 12 cells without a value"])
        // Two cells, and the one that says what they are.
        .counts("fill=\"#c9c9c9\"", 3)
        // Twelve cells, 64 slices of the colour bar, the sign for missing cells, background, clip and frame.
        .counts("<rect", 12 + 64 + 1 + 3);
    // The axes end where the cells do.
    let picture = drawn(&folder, "sweep.csv --kind map --where drive_frequency=90 --y hinge_stiffness");
    picture.has(&["Hinge stiffness (µN·m/rad)"]);
    assert!(!picture.texts().contains(&"no value".to_owned()));
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
    let picture = drawn(&folder, "decades.csv --kind map --y drive_voltage_pp --color stroke_amplitude_deg");
    picture.has(&["1", "10", "100", "1000"]);
    let heights = picture.svg.split("<rect").skip(1).filter_map(|rect| {
        let height = rect.split_once("height=\"")?.1.split_once('"')?.0;
        height.parse::<f64>().ok()
    });
    let cells = heights.filter(|height| (50.0..200.0).contains(height));
    let (low, high) =
        cells.fold((f64::MAX, 0.0_f64), |(low, high), height| (low.min(height), high.max(height)));
    assert!(high - low < 1.0 && high > 50.0, "{low} to {high}");
    drawn(&folder, "decades.csv --kind response --x drive_voltage_pp --by drive_frequency")
        .has(&["1", "10", "100", "1000"]);
}

#[test]
fn a_front_of_two_measures() {
    let folder = folder();
    drawn(&folder, "sweep.csv --kind pareto")
        .says("pareto in out.svg")
        // The cost across, the benefit up.
        .has(&["Power, mean (mW), less is better", "Lift, mean (mN), more is better"])
        .has(&["designs", "front (3 of 10", "2 of 12 designs without values"])
        // The points, a ring around those of the front, and the same marks in the legend.
        .counts("<circle", 10 + 3 + 2);
    drawn(&folder, "sweep.csv --kind pareto --x-aim min --y-aim min").has(&[
        "front (1 of 10",
        "Lift, mean (mN), less is better",
        "2 of 12 designs without values",
    ]);
    drawn(&folder, "sweep.csv --x lift_mean_mn --y stroke_amplitude_deg --color drive_frequency").has(&[
        "Drive frequency (Hz)",
        "Lift, mean (mN), more is better",
        "Stroke, amplitude (°), more is better",
    ]);
}

/// The outlines of many points would merge and hide the colours of the points.
#[test]
fn a_front_of_many_designs_is_a_line_alone() {
    let folder = Folder::new();
    let row = |point: u32| {
        format!("{point},{},{},1e-4,periodic,20,{point},{point},22,true\n", 60 + point % 7, 90 + point)
    };
    for (designs, rings) in [(40, 40 + 1), (41, 0)] {
        let text = format!("{HEADER}\n") + &(0..designs).map(row).collect::<String>();
        fs::write(folder.path("many.csv"), text).unwrap();
        let picture = drawn(&folder, "many.csv --kind pareto");
        picture.counts("<circle", designs as usize + 1 + rings);
    }
}

#[test]
fn a_hysteresis_loop() {
    let folder = folder();
    let picture = drawn(&folder, "response.csv");
    picture.says("hysteresis in out.svg").has(&[
        "up",
        "down",
        "unstable",
        "Drive frequency (Hz)",
        "Stroke, amplitude (°)",
    ]);
    picture.has(&["shaded: bistable, 120 to 120 Hz"]);
    // A line for each branch, none across its jump; an arrow and its head for each jump.
    picture.counts("<path", 3 + 2 * 2);
    let dashed = picture
        .svg
        .split("<path")
        .skip(1)
        .filter(|path| path.split('>').next().unwrap().contains("dasharray"));
    assert_eq!(dashed.count(), 1 + 2, "the unstable branch and two jumps");
    drawn(&folder, "response.csv --where branch=up --y lift_mean_mn")
        .has(&["up", "Lift, mean (mN)", "Branch up"])
        .counts("<path", 1);
}

/// In a picture of several designs, dashed lines show unstable orbits. Without unstable orbits, no line is dashed and
/// the picture has no note.
#[test]
fn several_loops_without_unstable_orbits_name_none() {
    let folder = folder();
    let stable = "curve,drive_voltage_pp,branch,drive_frequency,status,bistable,stroke_amplitude_deg\n\
                  0,60.0,up,110.0,periodic,false,70\n0,60.0,up,120.0,periodic,true,60\n0,60.0,up,130.0,periodic,false,20\n\
                  0,60.0,down,130.0,periodic,false,20\n0,60.0,down,120.0,periodic,true,25\n0,60.0,down,110.0,periodic,false,70\n\
                  1,80.0,up,110.0,periodic,false,75\n1,80.0,up,120.0,periodic,false,65\n\
                  1,80.0,down,120.0,periodic,false,65\n1,80.0,down,110.0,periodic,false,75\n";
    let unstable = "1,80.0,unstable,115.0,unstable,,70\n1,80.0,unstable,114.0,unstable,,69\n";
    fs::write(folder.path("stable.csv"), stable).unwrap();
    fs::write(folder.path("both.csv"), format!("{stable}{unstable}")).unwrap();
    let told = |name: &str| drawn(&folder, name).texts().iter().any(|text| text.contains("dashed: unstable"));
    assert_eq!((told("stable.csv"), told("both.csv")), (false, true));
}

/// If the parameter of an axis is a choice, the axis shows the options, each with its points.
#[test]
fn an_axis_of_words() {
    let folder = Folder::new();
    let grid = "preset = \"ozaki2018-large\"\n[axes]\ndrive_shape = [\"sine\", \"square\", \"harmonics\"]\n";
    fs::write(folder.path("shapes.toml"), grid).unwrap();
    folder.ends(0, "sweep shapes.toml --out shapes.csv");
    drawn(&folder, "shapes.csv")
        .says("response in out.svg")
        .has(&["sine", "square", "harmonics", "Drive shape"])
        .counts("<circle", 3)
        .counts("<path", 0);
    folder.ends(0, "plot shapes.csv --html shapes.html");

    // With an axis of numbers, words are lines.
    fs::write(folder.path("lines.toml"), format!("{grid}drive_voltage_pp = [\"60 V\", \"70 V\"]\n")).unwrap();
    folder.ends(0, "sweep lines.toml --out lines.csv");
    drawn(&folder, "lines.csv").says("response in out.svg").has(&[
        "sine",
        "square",
        "harmonics",
        "Drive voltage, peak to peak (V)",
    ]);
}

/// Each curve has its own frequencies and fills its stripe of the map without gaps.
#[test]
fn a_map_of_refined_responses_has_no_holes() {
    let folder = Folder::new();
    let mut text =
        "curve,drive_voltage_pp,branch,drive_frequency,status,bistable,stroke_amplitude_deg\n".to_owned();
    let curves: [(f64, &[f64]); 2] =
        [(60.0, &[110.0, 120.0, 130.0]), (80.0, &[110.0, 120.0, 125.0, 127.5, 130.0])];
    for (curve, (voltage, frequencies)) in curves.into_iter().enumerate() {
        for (branch, place) in [("up", 1.0), ("down", 2.0)] {
            for frequency in frequencies {
                let stroke =
                    if *frequency == 127.5 { String::new() } else { (frequency * place).to_string() };
                let _ = writeln!(text, "{curve},{voltage:?},{branch},{frequency:?},periodic,false,{stroke}");
            }
        }
    }
    fs::write(folder.path("curves.csv"), text).unwrap();
    for axes in ["", "--x drive_voltage_pp --y drive_frequency"] {
        drawn(&folder, &format!("curves.csv --kind map --color stroke_amplitude_deg {axes}"))
            .says("drawn: branch = up")
            .has(&["Drive frequency (Hz)", "Drive voltage, peak to peak (V)"])
            .has(&["Branch up · 1 of 8 cells without a value"])
            // The cell without a value, and the one of the legend.
            .counts("fill=\"#c9c9c9\"", 2)
            // The cells of both curves, 64 slices of the colour bar, the sign for missing cells, background, clip and frame.
            .counts("<rect", 8 + 64 + 1 + 3);
    }
    drawn(&folder, "curves.csv --kind map --color stroke_amplitude_deg --where branch=down");
}

/// At small sizes the label of a colour bar is shorter than the picture.
#[test]
fn a_colour_bar_fits_a_small_picture() {
    let folder = folder();
    let picture = drawn(&folder, "sweep.csv --color stroke_amplitude_deg --size 260x200");
    let label = picture.texts().into_iter().find(|text| text.starts_with("Stroke")).unwrap();
    assert!(label.ends_with('…'), "{label}");
    let large = drawn(&folder, "sweep.csv --color stroke_amplitude_deg --size 900x600");
    large.has(&["Stroke, amplitude (°)"]);
}

#[test]
fn a_motion_and_its_phase_portrait() {
    let folder = folder();
    let picture = drawn(&folder, "motion.csv");
    picture
        .says("trajectory in out.svg")
        .says("the rate of the pitch is computed from differences of its samples");
    assert!(!picture.said.contains("the rate of the stroke"), "{}", picture.said);
    picture.has(&["Time (ms)", "Angle (°)", "Rate (°/ms)", "Stroke", "Pitch"]);
    picture.counts("<path", 4);
    // As a line over time, if that is asked for.
    drawn(&folder, "motion.csv --x time_s --y stroke_deg").has(&["Time (ms)", "Stroke (°)"]);
}

#[test]
fn slices_are_told() {
    let folder = folder();
    let sliced = "sweep.csv --x drive_voltage_pp --y lift_mean_mn --by status";
    drawn(&folder, sliced)
        .says("drawn: drive_frequency = 110 Hz, the middle of 4 values; --where chooses another value")
        .has(&["Drive frequency 110 Hz · 2 of 3 points without a value"]);
    let picture = drawn(&folder, &format!("{sliced} --where drive_frequency=0.12kHz"));
    assert!(!picture.said.contains("drawn:"), "{}", picture.said);
    picture.has(&["Drive frequency 120 Hz"]);
}

/// Each cell shows the largest number along the axis that the picture leaves out. stderr names the best cell.
#[test]
fn the_best_row_over_an_axis_is_drawn() {
    let folder = folder();
    fs::write(
        folder.path("cube.csv"),
        "point,a,b,c,status,lift_mean_mn\n0,1,1,5,periodic,1\n1,1,1,6,periodic,7\n2,1,2,5,periodic,2\n\
         3,1,2,6,unsettled,\n4,2,1,5,periodic,4\n5,2,1,6,periodic,3\n6,2,2,5,unsettled,\n7,2,2,6,unsettled,\n",
    )
    .unwrap();
    drawn(&folder, "cube.csv --kind map --best-over c")
        .says("best: lift_mean_mn = 7 mN at a = 1, b = 1, c = 6")
        .has(&["best over c · 1 of 4 cells without a value"]);
    drawn(&folder, "cube.csv --kind map --best-over a --where c=5")
        .says("best: lift_mean_mn = 4 mN at a = 2, b = 1, c = 5");
    drawn(&folder, "cube.csv --kind response --y lift_mean_mn --x b --by c --best-over a")
        .says("best: lift_mean_mn = 7 mN at a = 1, b = 1, c = 6");
    let refuses = |options: &str, says: &str| {
        folder.ends(2, &format!("plot cube.csv --out none.svg {options}")).says(says);
    };
    refuses("--kind map --best-over c --x c", "--best-over c: not an axis that the picture leaves out");
    refuses("--kind scatter --best-over c", "--best-over requires --kind map or response");
    refuses("--kind map --best-over d", "there is no column `d`");
    refuses("--kind map --best-over c --html page.html", "without the choice of --best-over c");
}

/// Comparisons select rows before flap draws the picture.
#[test]
fn comparisons_choose_rows() {
    let folder = folder();
    let lines = "sweep.csv --x drive_frequency --y lift_mean_mn --by drive_voltage_pp";
    drawn(&folder, lines).has(&["60", "80", "100"]);
    assert!(folder.read("out.svg").contains(">60<"));
    let fewer = drawn(&folder, &format!("{lines} --where drive_voltage_pp>70"));
    fewer.has(&["80", "100"]);
    assert!(!folder.read("out.svg").contains(">60<"), "no line of 60 V");
    let ended = folder.flap(&format!("plot {lines} --where lift_mean_mn>1e9 --out none.svg"));
    assert_eq!(ended.code, 2);
    ended.says("error: no row of sweep.csv satisfies --where\n");
    folder
        .ends(2, &format!("plot {lines} --where lift_men_mn>1 --out none.svg"))
        .says("did you mean `lift_mean_mn`?");
    assert!(!folder.path("none.svg").exists());
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
    let picture = drawn(&folder, "sweep.csv --size 400x300");
    assert!(picture.svg.contains("width=\"400\" height=\"300\""));
}

#[test]
fn pictures_do_not_depend_on_the_format_of_results() {
    let folder = Folder::with_grid(&(frequencies(6) + "hinge_stiffness = [9e-5, 1e-4]\n"));
    for ending in ["csv", "csv.zst", "parquet"] {
        folder.ends(0, &format!("sweep --grid grid.toml --out rows.{ending}"));
    }
    let titled = |name: &str| drawn(&folder, &format!("{name} --title same"));
    let first = titled("rows.csv");
    first.has(&["Drive frequency (Hz)", "Stroke, peak to peak (°)", "90", "100", "same"]);
    // The library counts its clips.
    assert_eq!(first.svg, titled("rows.csv.zst").svg);
    assert_eq!(first.svg, titled("rows.parquet").svg);
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
    let picture = drawn(&folder, "many.csv --kind pareto");
    picture.says("20000 of 50000 points are drawn, evenly chosen; the front is the front of all points");
    assert!(count(&picture.svg, "<circle") < 20_100);
    let picture = drawn(&folder, "many.csv --by drive_voltage_pp");
    assert!(picture.svg.len() < 1_000_000, "{}", picture.svg.len());
    let ended = refused(&folder, &["many.csv", "--by", "drive_frequency", "--x", "drive_voltage_pp"]);
    ended.says("25000 of 50000 rows have different values of drive_frequency");

    let mut text = HEADER.to_owned() + "\n";
    for point in 0..200 {
        let _ = writeln!(text, "{point},{},{},1e-4,periodic,1,2,3,22,true", 60 + point / 5, 90 + point % 5);
    }
    fs::write(folder.path("lines.csv"), text).unwrap();
    drawn(&folder, "lines.csv").says("16 of the 40 values of drive_voltage_pp are drawn, evenly chosen");
}
