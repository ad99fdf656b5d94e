//! Experiments with a wing: waveforms and strokes from files, forces along a filmed motion.

use std::fmt::Write as _;
use std::fs;

use crate::support::Folder;

/// A table with 401 samples of a sine of 75 Hz with the amplitude `amplitude`.
fn sine(heading: &str, amplitude: f64) -> String {
    let mut text = format!("time_ms,{heading}\n");
    for i in 0..=400 {
        let phase = f64::from(i) / 400.0;
        let _ =
            writeln!(text, "{},{}", phase * 1e3 / 75.0, amplitude * (std::f64::consts::TAU * phase).sin());
    }
    text
}

fn folder_with(name: &str, text: &str) -> Folder {
    let folder = Folder::new();
    fs::write(folder.path(name), text).unwrap();
    folder
}

/// The number after a column's name on a page of results.
fn value(page: &str, name: &str) -> f64 {
    let mut lines = page.lines().map(|line| line.split_whitespace().collect::<Vec<_>>());
    let line =
        lines.find(|words| words.first() == Some(&name)).unwrap_or_else(|| panic!("no {name} in\n{page}"));
    line[1].parse().unwrap()
}

#[test]
fn a_waveform_from_a_file_drives_like_its_shape() {
    let folder = folder_with("wave.csv", &sine("wave", 1.0));
    let shaped = folder.flap("run arabagi2013-75hz").stdout;
    let ended = folder.ends(0, "run arabagi2013-75hz --waveform wave.csv");
    for column in ["stroke_pp_deg", "lift_mean_mn", "power_mean_mw"] {
        let (file, shape) = (value(&ended.stdout, column), value(&shaped, column));
        assert!((file - shape).abs() < 1e-4 * shape.abs(), "{column}: {file} and {shape}");
    }
    // Formulas use the frequency of the file.
    let derived = |formula: &str| {
        let grid = format!(
            "preset = \"arabagi2013-75hz\"\n[axes]\ndrive_frequency = [50, 60]\n[derived]\n{formula}\n"
        );
        fs::write(folder.path("grid.toml"), grid).unwrap();
    };
    derived("drive_voltage_pp = \"2 * drive_frequency\"");
    let of_grid = folder.ends(0, "run grid.toml --waveform wave.csv --format csv");
    of_grid.says("drive_frequency = 75.0 Hz, from the record, not from the point of the grid");
    let volts =
        folder.ends(0, "run arabagi2013-75hz --waveform wave.csv --set drive_voltage_pp=150 --format csv");
    assert_eq!(of_grid.stdout, volts.stdout);
    derived("drive_voltage_pp = \"55 - drive_frequency\"");
    folder.ends(2, "run grid.toml --waveform wave.csv").says("`drive_voltage_pp` is computed as -20.0 V");
    let grid = "preset = \"arabagi2013-75hz\"\n[derived]\ndrive_frequency = \"50\"\n";
    fs::write(folder.path("grid.toml"), grid).unwrap();
    folder
        .ends(2, "run grid.toml --waveform wave.csv")
        .says("the grid file derives drive_frequency, but the record");
    // The period of the file gives way to a frequency that is set.
    let slow = folder.flap("run arabagi2013-75hz --waveform wave.csv --set drive_frequency=60").stdout;
    assert!((value(&slow, "stroke_pp_deg") - value(&ended.stdout, "stroke_pp_deg")).abs() > 1.0);

    assert!(!ended.stderr.contains("spline"), "{}", ended.stderr);

    folder.ends(0, "run arabagi2013-75hz --waveform wave.csv --once --trajectory t.csv --samples 50");
    assert_eq!(folder.read("t.csv").lines().count(), 1 + 51);
}

/// The lag of the stroke refers to the first harmonic of the waveform, wherever the record begins.
#[test]
fn the_lag_does_not_depend_on_the_beginning_of_a_waveform() {
    let wave = |i: u32| (std::f64::consts::TAU * f64::from(i % 100) / 100.0).cos();
    let rows: Vec<String> = (0..=100).map(|i| format!("{},{}", f64::from(i) * 1e-4, wave(i))).collect();
    let folder = folder_with("wave.csv", &format!("time_s,wave\n{}\n", rows.join("\n")));
    for preset in ["jafferis2016", "ozaki2018-large", "arabagi2013-75hz"] {
        let sine = folder.flap(&format!("run {preset} --set drive_frequency=100")).stdout;
        let cosine = folder.ends(0, &format!("run {preset} --waveform wave.csv")).stdout;
        let [expected, lag] = [&sine, &cosine].map(|page| value(page, "stroke_lag_deg"));
        assert!((lag - expected).abs() < 1e-2, "{preset}: {lag}, not {expected}");
    }
}

/// A spline through five samples of a square wave exceeds the range of the samples, so the electric field is also
/// larger.
#[test]
fn a_waveform_with_too_few_samples_is_warned_of() {
    let folder = folder_with("wave.csv", "time_ms,wave\n0,1\n1,1\n1.1,-1\n4,-1\n5,1\n");
    let ended = folder.ends(0, "run jafferis2016 --waveform wave.csv --set drive_voltage_pp=20");
    ended.says("warning: wave.csv: the spline through the samples lies between -10.308 and 4.162");
    ended.says("but the samples between -1.000 and 1.000; add samples where the wave changes quickly");
    let field = 10.0 * (1.0 + 10.308) / 135.0;
    assert!((value(&ended.stdout, "field_max_v_per_um") - field).abs() < 1e-4 * field, "{}", ended.stdout);
}

#[test]
fn a_stroke_from_a_file_is_prescribed() {
    let folder = folder_with("stroke.csv", &sine("stroke_deg", 12.0));
    let ended = folder.ends(0, "run arabagi2013-75hz --stroke stroke.csv");
    let set = ["--set", "stroke_mode=prescribed", "--set", "stroke_amplitude=12 deg"];
    let shaped = folder.flap_with(&[&["run", "arabagi2013-75hz"], &set[..]].concat()).stdout;
    for column in ["stroke_pp_deg", "pitch_pp_deg", "lift_mean_mn"] {
        let (file, shape) = (value(&ended.stdout, column), value(&shaped, column));
        assert!((file - shape).abs() < 1e-4 * shape.abs(), "{column}: {file} and {shape}");
    }
    folder.ends(2, "run jafferis2016 --stroke stroke.csv").says("cannot be prescribed");
}

/// Forces along a simulated motion equal the forces of the simulation.
#[test]
fn lift_of_a_given_motion_is_that_of_the_simulation() {
    for preset in ["ozaki2018-small", "arabagi2013-75hz"] {
        let folder = Folder::new();
        let simulated = folder
            .flap(&format!("run {preset} --trajectory motion.csv --cycles 1 --samples 800 --rtol 1e-8"));
        assert_eq!(simulated.code, 0, "{}", simulated.stderr);
        let ended =
            folder.ends(0, &format!("test lift {preset} motion.csv --periodic --trajectory forces.csv"));
        let (lift, expected) = (value(&ended.stdout, "lift_mn"), value(&simulated.stdout, "lift_mean_mn"));
        assert!((lift - expected).abs() < 2e-3 * expected, "{preset}: {lift} and {expected}");
        assert!(!ended.stdout.contains("power_mw"), "the voltage is not known:\n{}", ended.stdout);
        assert!(folder.read("forces.csv").starts_with("time_s,stroke_rad,pitch_rad,"));
        assert_eq!(folder.read("forces.csv").lines().count(), 1 + 2001);
    }
}

/// The summary does not depend on the samples of the trajectory, and a stroke in the wrong unit causes a warning.
#[test]
fn the_summary_of_forces_has_its_own_samples() {
    let motion = |stroke: f64| {
        let mut text = "time_s,stroke_rad,pitch_rad\n".to_owned();
        for i in 0..=50 {
            let (sin, cos) = (std::f64::consts::TAU * f64::from(i) / 20.0).sin_cos();
            let _ = writeln!(text, "{},{},{}", 2e-4 * f64::from(i), stroke * sin, 0.6 * cos);
        }
        text
    };
    let folder = folder_with("motion.csv", &motion(0.5));
    let lift = "test lift ozaki2018-small motion.csv";
    let summary = folder.ends(0, lift);
    assert_eq!(summary.stderr, "");
    let few = folder.ends(0, &format!("{lift} --trajectory forces.csv --samples 3"));
    assert_eq!(few.stdout, summary.stdout);
    assert_eq!(folder.read("forces.csv").lines().count(), 1 + 4);
    folder.refuses(&format!("{lift} --samples 3"), "--trajectory");
    fs::write(folder.path("degrees.csv"), motion(50.0)).unwrap();
    folder
        .ends(0, "test lift ozaki2018-small degrees.csv")
        .says("warning: degrees.csv: the stroke reaches 2864.79°, which is more than 180°")
        .says("check the unit in the heading of the stroke");
}

#[test]
fn tracked_points_become_a_motion() {
    let mut points = "time_s,root_x,root_y,tip_x,tip_y,edge_x,edge_y\n".to_owned();
    for i in 0..60 {
        let (stroke, pitch) = (0.2 * (0.1 * f64::from(i)).sin(), 0.6 * (0.1 * f64::from(i)).cos());
        let at = |along: f64, across: f64| {
            let (sin, cos) = stroke.sin_cos();
            [3.0 + along * cos - across * sin, -1.0 + along * sin + across * cos]
        };
        let ([a, b], [c, d], [e, f]) = (at(5.0, 0.0), at(22.0, 0.0), at(15.0, -6.5 * pitch.sin()));
        let _ = writeln!(points, "{},{a},{b},{c},{d},{e},{f}", 1e-4 * f64::from(i));
    }
    let folder = folder_with("points.csv", &points);
    let ended = folder.ends(0, "test track points.csv --chord 6.5 --out motion.csv");
    assert_eq!(ended.stdout, "rotation centre at x = 3.0, y = -1.0\n");
    let motion = folder.read("motion.csv");
    let streamed = folder.ends(0, "test track points.csv --chord 6.5 --out -");
    assert_eq!((streamed.stdout.as_str(), folder.path("-").exists()), (motion.as_str(), false));
    let mut lines = motion.lines();
    assert_eq!(lines.next(), Some("time_s,stroke_deg,pitch_deg"));
    let row: Vec<f64> = lines.nth(9).unwrap().split(',').map(|cell| cell.parse().unwrap()).collect();
    assert!((row[1] - (0.2 * 0.9_f64.sin()).to_degrees()).abs() < 1e-9, "{row:?}");
    assert!((row[2] - (0.6 * 0.9_f64.cos()).to_degrees()).abs() < 1e-9, "{row:?}");
    // The lower edge lags, so the wing lifts.
    let lift = folder.ends(0, "test lift ozaki2018-small motion.csv");
    assert!(value(&lift.stdout, "lift_mn") > 0.0, "{}", lift.stdout);
    // To stdout, with the centre beside it.
    let piped = folder.flap("test track points.csv");
    assert!(piped.stdout.starts_with("time_s,stroke_deg\n") && piped.stderr.contains("rotation centre"));
    let short = folder.flap("test track points.csv --chord 3");
    assert!(
        short.code == 2 && short.stderr.contains("points.csv: image 1: the lower edge is at a distance of"),
        "{}",
        short.stderr
    );
    folder.refuses("test track points.csv --chord -1", "expected a finite number more than zero");
    let heading = points.lines().next().unwrap();
    fs::write(folder.path("empty.csv"), heading).unwrap();
    folder.refuses("test track empty.csv", "empty.csv: the centre of rotation requires two images");
    fs::write(folder.path("comma.csv"), "time_s;root_x\n0;1,5\n").unwrap();
    for command in ["test track", "top --by root_x", "plot", "device wing --preset jafferis2016"] {
        folder.refuses(&format!("{command} comma.csv"), "the first line contains `;` instead of commas");
    }
}

/// For a filmed stroke without pitch, the message names the command that computes the pitch.
#[test]
fn a_stroke_alone_is_run_and_not_lifted() {
    let mut stroke = "time_s,stroke_deg\n".to_owned();
    for i in 0..=100 {
        let angle = 30.0 * (0.02 * std::f64::consts::PI * f64::from(i)).sin();
        let _ = writeln!(stroke, "{},{}", 1e-4 * f64::from(i), if i == 100 { 0.0 } else { angle });
    }
    let folder = folder_with("stroke.csv", &stroke);
    let ended = folder.ends(2, "test lift ozaki2018-large stroke.csv");
    ended.says("stroke.csv: there is no column pitch_rad or pitch_deg");
    let command = "run ozaki2018-large --stroke stroke.csv";
    ended.says(&format!(
        "help: `flap {command}` computes the pitch of a wing that follows the stroke, and its lift\n"
    ));
    folder.ends(0, command).prints("lift_mean_mn");
    folder.ends(2, "test lift jafferis2016 stroke.csv").says("`flap run PRESET --stroke stroke.csv`");
}

/// A file may have two columns of the time if the columns agree.
#[test]
fn contradictory_columns_are_refused() {
    let lift = |text: &str| {
        let folder = folder_with("motion.csv", text);
        folder.flap("test lift ozaki2018-small motion.csv")
    };
    let rows = |third: &str| format!("0,0,0,0\n0.001,1,1,2\n0.002,{third},2,4\n0.003,3,3,6\n0.004,4,4,8\n");
    let headings = "time_s,time_ms,stroke_deg,pitch_deg\n";
    assert_eq!(lift(&(headings.to_owned() + &rows("2"))).code, 0);
    let ended = lift(&(headings.to_owned() + &rows("7")));
    assert_eq!(ended.code, 2);
    assert_eq!(
        ended.stderr,
        "error: motion.csv: columns time_s and time_ms contradict each other in row 3: keep one of them\n"
    );
    let ended = lift(&("time_s,pitch_deg,stroke_deg,pitch_deg\n".to_owned() + &rows("2")));
    assert_eq!(ended.code, 2);
    assert_eq!(ended.stderr, "error: motion.csv: two columns are called pitch_deg: keep one of them\n");
}

#[test]
fn unusable_files_are_named_with_line_and_column() {
    let folder = folder_with("wave.csv", "time_s,wave\n0,0\n1,x\n");
    let refused = |arguments: &str, text: &str, expected: &str| {
        fs::write(folder.path("file.csv"), text).unwrap();
        folder.ends(2, arguments).says(expected);
    };
    let run = "run ozaki2018-small --waveform file.csv";
    refused(run, "time_s,wave\n0,0\n1,x\n", "file.csv, line 3, column wave: `x` is not a number");
    refused(run, "time_s,volts\n0,0\n1,1\n", "there is no column wave; the file has time_s, volts");
    refused(run, "time_s,wave\n0,0\n1,1\n", "too few");
    refused(
        run,
        "time_s,wave\n0,0\n1,1\n2,0\n3,1\n",
        "the first and last value of a periodic record must be equal",
    );
    refused(run, "time_s,wave\n0,0\n2,1\n1,1\n3,0\n", "times do not increase");
    refused("run ozaki2018-small --waveform none.csv", "", "none.csv");
    refused(
        "test lift ozaki2018-small file.csv",
        "time_s,stroke_deg\n0,0\n1,1\n2,0\n3,1\n",
        "no column pitch_rad or pitch_deg",
    );
    refused("run ozaki2018-small --once --trajectory -", "", "--once requires --waveform or --stroke");
}

/// flap rejects a chirp that would last for years, and the message contains its numbers and the allowed rate.
#[test]
fn chirps_end() {
    let folder = Folder::new();
    let chirp = "test chirp jafferis2016 --from 100 --to";
    for (rest, numbers) in [
        (
            "400 --rate 1e-9",
            "lasts 3.000e11 s, which is 7.500e13 drive periods: at most 100000 are allowed\n",
        ),
        ("400 --rate 1e-300", "at 1e-300 Hz/s lasts 3.000e302 s, which is 7.500e304 drive periods"),
        ("1e308", "to 1e308 Hz at 15.0 Hz/s lasts 6.667e306 s, which is inf drive periods"),
        ("1 --rate=-1e-9", "lasts 9.900e10 s, which is 5.000e12 drive periods"),
    ] {
        let ended = folder.ends(2, &format!("{chirp} {rest} --trajectory chirp.csv"));
        ended.says(numbers);
        assert_eq!(ended.stdout, "");
    }
    let ended = folder.ends(2, &format!("{chirp} 400 --rate 1e-9"));
    ended.says("help: sweep at 7.500e-1 Hz/s or faster");
    let samples = "--rate 1 --samples 1000 --trajectory chirp.csv";
    folder
        .ends(2, &format!("{chirp} 400 {samples}"))
        .says(
            "a chirp of 75000 drive periods with 1000 samples each has 75000000 samples: at most 5000000 are allowed",
        )
        .says("help: take at most 66 samples per drive period");
    for (range, cycles, rate) in
        [("1 --to 1.5 --rate 1000", "6.250e-4", "6.250e-1"), ("150 --to 150.0000001", "1.000e-6", "1.500e-5")]
    {
        folder
            .ends(2, &format!("test chirp jafferis2016 --from {range}"))
            .says(&format!("which is {cycles} drive periods: at least 1 is needed"))
            .says(&format!("help: sweep at {rate} Hz/s or slower, or over a larger range"));
    }
    // The estimate is the number of rows.
    let ended = folder.ends(0, "test chirp ozaki2018-small --from 150 --to 170 --rate 100");
    assert_eq!(ended.stdout.lines().count(), 1 + 32, "160 Hz for 0.2 s");
    assert!(folder.names().is_empty(), "{:?}", folder.names());
    // The motion goes to stdout, and the rows per cycle to their file.
    let short = "test chirp ozaki2018-small --from 150 --to 152 --trajectory - --samples 50";
    let ended = folder.ends(0, &format!("{short} --out envelope.csv"));
    assert!(ended.stdout.starts_with("time_s,stroke_rad,"), "{}", ended.stdout);
    assert_eq!(folder.ends(0, short).stdout, ended.stdout);
    assert_eq!(folder.names(), ["envelope.csv"]);
}

/// flap rejects numbers whose rates or forces exceed the range of numbers, and the message contains the allowed range.
#[test]
fn motions_have_finite_forces() {
    let motion = |time: [&str; 2], stroke: &str, pitch: &str| {
        format!(
            "time_s,stroke_deg,pitch_deg\n0,0,0\n{},1,1\n{},{stroke},{pitch}\n0.003,3,3\n0.004,4,4\n",
            time[0], time[1]
        )
    };
    let usual = ["0.001", "0.002"];
    for (text, message) in [
        (
            motion(usual, "1e308", "0"),
            "stroke_deg is 1e308 in row 3, and must be from -3600000.0 to 3600000.0\n",
        ),
        (
            motion(usual, "0", "-1e308"),
            "pitch_deg is -1e308 in row 3, and must be from -3600000.0 to 3600000.0\n",
        ),
        (
            motion(["1e-200", "0.002"], "0", "0"),
            "rows 1 and 2 are 1e-200 s apart, and must be at least 1e-12 s\n",
        ),
        (motion(["0.001", "1e308"], "0", "0"), "time_s is 1e308 in row 3, and must be from -1e12 to 1e12\n"),
    ] {
        let folder = folder_with("motion.csv", &text);
        folder.refuses("test lift ozaki2018-small motion.csv", message);
    }
    let folder = folder_with("motion.csv", &motion(usual, "2", "2"));
    folder.ends(0, "test lift ozaki2018-small motion.csv").prints("lift_mn");
    let folder = folder_with("motion.csv", &motion(usual, "3e6", "2"));
    folder
        .ends(2, "test lift ozaki2018-small motion.csv --set drag_coefficient_max=1e308")
        .says("the forces along this motion are too large for 64-bit floats\nhelp: compare the parameters");
    let points = "time_s,root_x,root_y,tip_x,tip_y\n0,0,0,1e308,0\n1,0,0,1,1\n";
    fs::write(folder.path("points.csv"), points).unwrap();
    folder.refuses("test track points.csv", "tip_x is 1e308 in row 1, and must be from -1e12 to 1e12\n");
}

/// Each line of `flap test terms` contains the changes that `--set` with the same parameter causes.
#[test]
fn terms_change_the_measures_as_their_parameters_do() {
    let folder = Folder::new();
    let point = "jafferis2016 --set drive_voltage_pp=160 --set hinge_damping=1e-10";
    let csv = folder.ends(0, &format!("test terms {point} --format csv")).stdout;
    let lines: Vec<Vec<&str>> = csv.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(lines[0][..5], ["parameter", "from", "to", "status", "stroke_pp_deg_change_percent"]);
    let before = value(&folder.flap(&format!("run {point}")).stdout, "stroke_pp_deg");
    for (name, after) in [("circulation_factor", "1"), ("stroke_stiffening", "1e-05"), ("hinge_damping", "0")]
    {
        let line = lines.iter().find(|line| line[0] == name).unwrap_or_else(|| panic!("no {name} in\n{csv}"));
        let point = point.replace(&format!(" --set {name}=1e-10"), "");
        let row = folder.flap(&format!("run {point} --set {name}={after}")).stdout;
        let expected = 100.0 * (value(&row, "stroke_pp_deg") / before - 1.0);
        let found: f64 = line[4].parse().unwrap();
        assert!((found - expected).abs() < 2e-3 && expected.abs() > 0.1, "{name}: {found} and {expected}");
    }
    // A derived parameter that the command line sets keeps its value.
    let derived = "preset = \"jafferis2016\"\n[derived]\ndrive_voltage_pp = \"100\"\nhinge_damping = \"0\"\n";
    fs::write(folder.path("derived.toml"), derived).unwrap();
    let set = "--set drive_voltage_pp=160 --set hinge_damping=1e-10";
    assert_eq!(folder.ends(0, &format!("test terms derived.toml {set} --format csv")).stdout, csv);
    let page = folder.ends(0, &format!("test terms {point}")).stdout;
    assert!(page.contains("hinge_damping") && page.contains("100 pN*m*s"), "{page}");
    folder.ends(2, "test terms jafferis2016 --max-cycles 2").says("is not periodic");
}

/// The size of each term is small enough for a periodic motion, and some measure changes.
#[test]
fn terms_of_lift_drag_and_pressure_have_sizes_in_all_presets() {
    const TERMS: [&str; 6] =
        ["drag_term_0", "drag_term_1", "lift_term_1", "lift_term_2", "pressure_term_0", "pressure_term_1"];
    let folder = Folder::new();
    for preset in [
        "jafferis2016",
        "jafferis2016-improved",
        "ozaki2018-small",
        "ozaki2018-large",
        "ozaki2018-small-kw-swapped",
        "ozaki2018-large-kw-swapped",
        "arabagi2013-75hz",
        "arabagi2013-30hz",
    ] {
        let csv = folder.ends(0, &format!("test terms {preset} --format csv")).stdout;
        let lines: Vec<Vec<&str>> = csv.lines().skip(1).map(|line| line.split(',').collect()).collect();
        for name in TERMS {
            let line =
                lines.iter().find(|line| line[0] == name).unwrap_or_else(|| panic!("no {name} in\n{csv}"));
            let size = if name.starts_with("pressure") { "0.05" } else { "0.3" };
            assert_eq!(line[1..4], ["0.0", size, "periodic"], "{preset}");
            let changes: Vec<f64> = line[4..].iter().map(|cell| cell.parse().unwrap()).collect();
            assert!(changes.iter().all(|change| change.is_finite()), "{preset}: {line:?}");
            assert!(changes.iter().any(|change| change.abs() > 0.05), "{preset}: {line:?}");
        }
    }
}
