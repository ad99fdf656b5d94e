//! Pictures and pages of results.

use std::fmt::Write as _;
use std::fs;

use crate::support::{Ended, Folder, frequencies};

/// The header of the tables below: two axes, one value throughout, a status, measures.
const HEADER: &str = "point,drive_voltage_pp,drive_frequency,hinge_stiffness,status,stroke_amplitude_deg,lift_mean_mn,power_mean_mw,cycles,stable";

/// Rows of a sweep of voltages and frequencies. Those at 110 Hz and 80 V or more have no measures.
fn sweep() -> String {
    let mut text = HEADER.to_owned() + "\n";
    let mut point = 0;
    for voltage in [60, 80, 100] {
        for frequency in [90, 100, 110, 120] {
            let (v, f) = (f64::from(voltage), f64::from(frequency));
            let _ = write!(text, "{point},{v:?},{f:?},0.0001,");
            if frequency == 110 && voltage >= 80 {
                text += "unsettled,,,,400,\n";
            } else {
                let (stroke, lift, power) =
                    (v / 10.0 - (f - 105.0).abs() / 10.0, v * f / 3000.0, v * v / 200.0);
                let _ = writeln!(text, "periodic,{stroke},{lift},{power},22,true");
            }
            point += 1;
        }
    }
    text
}

/// Rows of a response of one design, with its unstable orbits.
fn response() -> String {
    let mut text = "curve,branch,drive_frequency,status,stroke_amplitude_deg,lift_mean_mn\n".to_owned();
    let rows = [
        ("up", [110, 120, 130], [70, 60, 20]),
        ("down", [130, 120, 110], [20, 25, 70]),
        ("unstable", [128, 124, 121], [50, 40, 30]),
    ];
    for (branch, frequencies, strokes) in rows {
        for (frequency, stroke) in frequencies.into_iter().zip(strokes) {
            let _ = writeln!(text, "0,{branch},{frequency}.0,periodic,{stroke}.0,1.0");
        }
    }
    text
}

fn motion() -> String {
    let mut text = "time_s,stroke_rate_rad_s,stroke_deg,pitch_deg\n".to_owned();
    for i in 0..101 {
        let phase = f64::from(i) / 50.0 * std::f64::consts::TAU;
        let _ = writeln!(
            text,
            "{},{},{},{}",
            f64::from(i) * 2e-4,
            phase.cos() * 600.0,
            40.0 * phase.sin(),
            30.0 * phase.cos()
        );
    }
    text
}

fn folder() -> Folder {
    let folder = Folder::new();
    fs::write(folder.path("sweep.csv"), sweep()).unwrap();
    fs::write(folder.path("response.csv"), response()).unwrap();
    fs::write(folder.path("motion.csv"), motion()).unwrap();
    folder
}

/// Draws, and gives what was drawn and what was said.
fn drawn(folder: &Folder, arguments: &str) -> (String, String) {
    let ended = folder.flap(&format!("plot {arguments} --force --out out.svg"));
    assert_eq!((ended.code, ended.stdout.as_str()), (0, ""), "{arguments}\n{}", ended.stderr);
    (folder.read("out.svg"), ended.stderr)
}

fn count(text: &str, part: &str) -> usize {
    text.matches(part).count()
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

fn refused(folder: &Folder, arguments: &[&str]) -> Ended {
    let words: Vec<&str> = std::iter::once("plot").chain(arguments.iter().copied()).collect();
    let before = folder.names();
    let ended = folder.flap_with(&words);
    assert_eq!((ended.code, ended.stdout.as_str()), (2, ""), "{arguments:?}\n{}", ended.stderr);
    assert_eq!(folder.names(), before, "{arguments:?} leaves files behind");
    ended
}

#[test]
fn a_family_of_responses() {
    let folder = folder();
    let (svg, said) = drawn(&folder, "sweep.csv");
    assert!(said.contains("response in out.svg"), "{said}");
    has(&svg, &["Drive frequency (Hz)", "Stroke, amplitude (deg)", "sweep.csv", "60", "80", "100"]);
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
    has(&svg, &["Drive frequency (Hz)", "Lift, mean (mN)", "Stroke, amplitude (deg)"]);
}

#[test]
fn a_hysteresis_loop() {
    let folder = folder();
    let (svg, said) = drawn(&folder, "response.csv");
    assert!(said.contains("hysteresis in out.svg"), "{said}");
    has(&svg, &["rising", "falling", "unstable", "Drive frequency (Hz)", "Stroke, amplitude (deg)"]);
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
    has(&svg, &["Time (ms)", "Angle (deg)", "Rate (deg/ms)", "stroke", "pitch"]);
    assert_eq!(count(&svg, "<path"), 4);
    // As a line over time, if that is asked for.
    let (svg, _) = drawn(&folder, "motion.csv --x time_s --y stroke_deg");
    has(&svg, &["Time (ms)", "Stroke (deg)"]);
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
        let ended = folder.flap(&format!("plot {file} --out out.png --size 400x300 --force"));
        assert_eq!(ended.code, 0, "{}", ended.stderr);
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
        let ended = folder.flap(&format!("sweep --grid grid.toml --out rows.{ending}"));
        assert_eq!(ended.code, 0, "{}", ended.stderr);
    }
    let svg = |name: &str| drawn(&folder, &format!("{name} --title same")).0;
    let first = svg("rows.csv");
    has(&first, &["Drive frequency (Hz)", "Stroke, amplitude (deg)", "90", "100", "same"]);
    // The library counts its clips.
    assert_eq!(first, svg("rows.csv.zst"));
    assert_eq!(first, svg("rows.parquet"));
    // Named after the results, in the working directory.
    assert_eq!(folder.flap("plot rows.csv.zst").code, 0);
    assert!(folder.path("rows.svg").exists());
}

#[test]
fn nothing_is_overwritten_unasked() {
    let folder = folder();
    assert_eq!(folder.flap("plot sweep.csv").code, 0);
    let before = folder.read("sweep.svg");
    let ended = refused(&folder, &["sweep.csv", "--kind", "map"]);
    assert!(
        ended.stderr.contains("sweep.svg exists already") && ended.stderr.contains("--force"),
        "{}",
        ended.stderr
    );
    assert_eq!(folder.read("sweep.svg"), before);
    assert_eq!(folder.flap("plot sweep.csv --kind map --force").code, 0);
    assert_ne!(folder.read("sweep.svg"), before);
    // Not even with --force: the results.
    fs::copy(folder.path("sweep.csv"), folder.path("results.svg")).unwrap();
    for option in ["--out", "--html"] {
        let ended = refused(&folder, &["results.svg", option, "./results.svg", "--force"]);
        assert!(ended.stderr.contains("would overwrite the results"), "{}", ended.stderr);
    }
}

/// XML has no place for control characters, and neither has a page.
#[test]
fn control_characters_in_a_title_are_written_out() {
    let folder = folder();
    let title = "a\u{1b}[31m <b>\u{1}";
    let arguments = ["plot", "sweep.csv", "--title", title, "--out", "a.svg", "--html", "a.html"];
    let ended = folder.flap_with(&arguments);
    assert_eq!(ended.code, 0, "{}", ended.stderr);
    for name in ["a.svg", "a.html"] {
        let text = folder.read(name);
        assert!(text.contains("a\\u{1b}[31m &lt;b&gt;\\u{1}"), "{name}");
        assert!(!text.contains(|letter: char| letter.is_control() && !"\n\r\t".contains(letter)), "{name}");
    }
}

#[test]
fn mistakes_are_told() {
    let folder = folder();
    fs::write(folder.path("empty.csv"), "").unwrap();
    fs::write(folder.path("bare.csv"), HEADER).unwrap();
    fs::write(folder.path("other.csv"), "a,b\n1,2\n").unwrap();
    fs::write(
        folder.path("failed.csv"),
        format!("{HEADER}\n0,60,90,1e-4,diverged,,,,3,\n1,60,91,1e-4,diverged,,,,3,\n"),
    )
    .unwrap();
    let cases: &[(&[&str], &[&str])] = &[
        (
            &["sweep.csv", "--y", "lift_men_mn"],
            &["no column `lift_men_mn`", "did you mean `lift_mean_mn`?", "the columns are point, "],
        ),
        (&["sweep.csv", "--where", "drive_voltage_p=60"], &["did you mean `drive_voltage_pp`?"]),
        (
            &["sweep.csv", "--where", "drive_voltage_pp=61"],
            &["no row has drive_voltage_pp = 61", "drive_voltage_pp is 60.0, 80.0, 100.0 V"],
        ),
        (&["sweep.csv", "--where", "drive_voltage_pp=61 Hz"], &["not a number", "a number in V"]),
        (&["sweep.csv", "--y", "status"], &["column `status` holds words, not numbers"]),
        (
            &["sweep.csv", "--kind", "map", "--by", "status"],
            &["--by goes with lines: --kind response or hysteresis, and this picture is a map"],
        ),
        (
            &["sweep.csv", "--kind", "response", "--color", "cycles"],
            &["--color goes with --kind map or pareto, and this picture is a response"],
        ),
        (&["sweep.csv", "--y-aim", "min"], &["--x-aim and --y-aim go with --kind pareto"]),
        (&["sweep.csv", "--kind", "trajectory"], &["needs a column time_s"]),
        (&["sweep.csv", "--kind", "hysteresis"], &["needs a column `branch`"]),
        (&["sweep.csv", "--out", "picture.pdf"], &["pictures end in .svg or .png"]),
        (&["sweep.csv", "--out", "picture.html"], &["--html writes a page"]),
        (&["sweep.csv", "--size", "10x10"], &["expected WxH"]),
        (
            &["sweep.csv", "--kind", "pie"],
            &["[possible values: response, map, pareto, trajectory, hysteresis]"],
        ),
        (&["empty.csv"], &["empty.csv has no columns"]),
        (&["bare.csv"], &["bare.csv has no rows"]),
        (&["other.csv"], &["not clear", "--x and --y", "the columns are a, b"]),
        (&["failed.csv"], &["none of 2 rows has a value of stroke_amplitude_deg"]),
        (&["failed.csv", "--kind", "pareto"], &["there is nothing to draw"]),
    ];
    for (arguments, wanted) in cases {
        let ended = refused(&folder, arguments);
        for text in *wanted {
            assert!(ended.stderr.contains(text), "{arguments:?}: {text}\n{}", ended.stderr);
        }
    }
    let ended = folder.flap("plot missing.csv");
    assert_eq!(ended.code, 3, "{}", ended.stderr);
    assert!(ended.stderr.contains("cannot read missing.csv"), "{}", ended.stderr);
    let ended = folder.flap("plot sweep.csv --out missing/picture.svg");
    assert_eq!(ended.code, 3, "{}", ended.stderr);
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
    assert!(
        ended.stderr.contains("25000 of 50000 rows have a drive_frequency of their own"),
        "{}",
        ended.stderr
    );

    let mut text = HEADER.to_owned() + "\n";
    for point in 0..200 {
        let _ = writeln!(text, "{point},{},{},1e-4,periodic,1,2,3,22,true", 60 + point / 5, 90 + point % 5);
    }
    fs::write(folder.path("lines.csv"), text).unwrap();
    let (_, said) = drawn(&folder, "lines.csv");
    assert!(said.contains("16 of the 40 values of drive_voltage_pp are drawn, evenly chosen"), "{said}");
}

/// A page of more rows than it takes says so, and has every second one.
#[test]
fn pages_of_many_rows_are_thinned() {
    let folder = Folder::new();
    let mut text = "point,a,status,b\n".to_owned();
    for point in 0..140_000 {
        let _ = writeln!(text, "{point},{},periodic,{}", point % 3, point % 1000);
    }
    fs::write(folder.path("many.csv"), text).unwrap();
    let ended = folder.flap("plot many.csv --x a --y b --html many.html");
    assert_eq!(ended.code, 0, "{}", ended.stderr);
    assert!(ended.stderr.contains("70000 of 140000 rows are in the page, evenly chosen"), "{}", ended.stderr);
    let page = folder.read("many.html");
    assert!(data(&page).starts_with("{\"rows\":70000,\"of\":140000,\"stride\":2,\"single\":true,"));
    // Single precision: no whole number of this size is changed.
    let bytes = from_base64(field(&page, "point", "data", '"').unwrap());
    let points = bytes.chunks(4).map(|four| f32::from_le_bytes(four.try_into().unwrap()));
    assert!(points.map(f64::from).eq((0..70_000).map(|point| f64::from(2 * point))));
}

/// The text of a page's data.
fn data(page: &str) -> &str {
    let start = page.split_once("<script type=\"application/json\" id=\"data\">").unwrap().1;
    start.split_once("</script>").unwrap().0
}

/// What stands behind `"key":` of a column, up to `end`.
fn field<'a>(page: &'a str, column: &str, key: &str, end: char) -> Option<&'a str> {
    let columns = data(page).split_once("\"columns\":[").unwrap().1;
    let object =
        columns.split_once(&format!("{{\"name\":\"{column}\",")).unwrap().1.split_once('}').unwrap().0;
    let rest = object.split_once(&format!("\"{key}\":"))?.1;
    Some(rest.trim_start_matches(['"', '[']).split_once(end).unwrap().0)
}

fn from_base64(text: &str) -> Vec<u8> {
    let digit = |letter: u8| match letter {
        b'A'..=b'Z' => letter - b'A',
        b'a'..=b'z' => letter - b'a' + 26,
        b'0'..=b'9' => letter - b'0' + 52,
        b'+' => 62,
        _ => 63,
    };
    let bits: Vec<u8> = text.bytes().filter(|letter| *letter != b'=').map(digit).collect();
    let four = |part: &[u8]| {
        let number = part.iter().chain(&[0; 4]).take(4).fold(0_u32, |sum, six| sum << 6 | u32::from(*six));
        number.to_be_bytes()[1..part.len()].to_vec()
    };
    bits.chunks(4).flat_map(four).collect()
}

/// The numbers of a column in a page; NaN for none.
fn numbers(page: &str, column: &str) -> Vec<f64> {
    let bytes = from_base64(field(page, column, "data", '"').unwrap());
    match field(page, column, "values", ']') {
        Some(values) => {
            let values: Vec<f64> = values.split(',').map(|value| value.parse().unwrap_or(f64::NAN)).collect();
            bytes.iter().map(|code| values[usize::from(*code)]).collect()
        }
        None => bytes.chunks(8).map(|eight| f64::from_le_bytes(eight.try_into().unwrap())).collect(),
    }
}

#[test]
fn a_page_holds_the_rows_and_needs_no_network() {
    let folder = folder();
    let ended = folder.flap("plot sweep.csv --html page.html");
    assert_eq!(ended.code, 0, "{}", ended.stderr);
    assert!(!folder.path("sweep.svg").exists(), "a picture only if it is asked for");
    let page = folder.read("page.html");
    for outside in ["http:", "https:", "//cdn", "src=", "href=", "import(", "fetch(", "url(", "@import", "{{"]
    {
        assert!(!page.contains(outside), "{outside}");
    }
    assert!(page.contains("default-src 'none'"), "the browser refuses what would be fetched");
    let rows: Vec<Vec<String>> =
        sweep().lines().skip(1).map(|line| line.split(',').map(str::to_owned).collect()).collect();
    for (place, name) in HEADER.split(',').enumerate() {
        let cells = rows.iter().map(|row| row[place].as_str());
        if ["status", "stable"].contains(&name) {
            let words: Vec<&str> = field(&page, name, "words", ']').unwrap().split(',').collect();
            let codes = from_base64(field(&page, name, "data", '"').unwrap());
            let found = codes
                .iter()
                .map(|code| words.get(usize::from(*code)).map_or("", |word| word.trim_matches('"')));
            assert!(found.eq(cells), "{name}");
        } else {
            let wanted: Vec<u64> = cells.map(|cell| cell.parse().unwrap_or(f64::NAN).to_bits()).collect();
            let found: Vec<u64> = numbers(&page, name).into_iter().map(f64::to_bits).collect();
            assert_eq!(found, wanted, "{name}");
        }
    }
    assert_eq!(field(&page, "hinge_stiffness", "unit", '"'), Some("µN·m/rad"));
    assert!(
        data(&page).contains("\"kind\":\"line\",\"x\":2,\"y\":5,\"by\":1,"),
        "it begins as the picture would"
    );
    let ended = refused(&folder, &["sweep.csv", "--html", "page.html"]);
    assert!(ended.stderr.contains("page.html exists already"), "{}", ended.stderr);
}

#[test]
fn a_page_cannot_be_broken_by_names() {
    let folder = Folder::new();
    let evil = "</script><script>alert(1)</script>";
    fs::write(
        folder.path("evil.csv"),
        format!("point,{evil},status,\"a\"\"b\\c{{{{data}}}}\"\n0,1,{evil},3\n1,2,<b>,4\n"),
    )
    .unwrap();
    let ended = folder.flap_with(&[
        "plot",
        "evil.csv",
        "--html",
        "page.html",
        "--title",
        "<img src=x onerror=alert(1)>",
    ]);
    assert_eq!(ended.code, 0, "{}", ended.stderr);
    let page = folder.read("page.html");
    assert_eq!(count(&page, "<script"), 2);
    assert_eq!(count(&page, "</script>"), 2);
    assert!(!page.contains("<img"));
    assert!(page.contains("&lt;img src=x onerror=alert(1)&gt;"));
    assert!(data(&page).contains("a\\\"b\\\\c{{data}}"), "what looks like a place in the page is a name");
    let ended =
        folder.flap_with(&["plot", "evil.csv", "--x", evil, "--y", "a\"b\\c{{data}}", "--title", evil]);
    assert_eq!(ended.code, 0, "{}", ended.stderr);
    assert!(!folder.read("evil.svg").contains("<script"));
}

#[test]
fn a_page_of_any_table() {
    let folder = folder();
    fs::write(folder.path("other.csv"), "a,b\n1,2\n3,4\n").unwrap();
    for file in ["response.csv", "motion.csv", "other.csv"] {
        let ended = folder.flap(&format!("plot {file} --html {file}.html"));
        assert_eq!(ended.code, 0, "{}", ended.stderr);
    }
    assert!(data(&folder.read("response.csv.html")).contains("\"branch\":1,"));
    assert_eq!(numbers(&folder.read("other.csv.html"), "b"), [2.0, 4.0]);
    let ended = folder.flap("plot response.csv --html both.html --out both.png");
    assert_eq!(ended.code, 0, "{}", ended.stderr);
    assert!(folder.path("both.html").exists() && folder.path("both.png").exists());
}
