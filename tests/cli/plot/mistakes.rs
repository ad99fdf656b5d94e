//! Refused pictures, files that are not overwritten, and strange titles.

use std::fs;

use super::{HEADER, folder, refused};

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
        ended.says("would overwrite the results");
    }
}

/// XML and HTML pages must not contain control characters.
#[test]
fn control_characters_in_a_title_are_written_out() {
    let folder = folder();
    let title = "a\u{1b}[31m <b>\u{1}";
    let arguments = ["plot", "sweep.csv", "--title", title, "--out", "a.svg", "--html", "a.html"];
    folder.ends_with(0, &arguments);
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
        (&["sweep.csv", "--y", "lift_men_mn"], &["no column `lift_men_mn`", "did you mean `lift_mean_mn`?"]),
        (&["sweep.csv", "--y", "xyz"], &["no column `xyz`", "the columns are point, "]),
        (
            &["sweep.csv", "--where", "hinge_stiffness=90"],
            &["no row has hinge_stiffness = 90", "did you mean --where hinge_stiffness='90 uN*m/rad'?"],
        ),
        (&["sweep.csv", "--where", "drive_voltage_p=60"], &["did you mean `drive_voltage_pp`?"]),
        (
            &["sweep.csv", "--where", "drive_voltage_pp=61"],
            &["no row has drive_voltage_pp = 61", "drive_voltage_pp is 60.0, 80.0, 100.0 V"],
        ),
        (
            &["sweep.csv", "--where", "drive_voltage_pp=61 Hz"],
            &["`Hz` is a frequency, but drive_voltage_pp is in V", "use V, mV, kV"],
        ),
        (&["sweep.csv", "--y", "status"], &["column `status` contains text, not numbers"]),
        (&["sweep.csv", "--x", "status"], &["column `status` contains text, not numbers"]),
        (
            &["sweep.csv", "--kind", "map", "--by", "status"],
            &["--by requires --kind response or hysteresis, but this picture is a map"],
        ),
        (
            &["sweep.csv", "--kind", "response", "--color", "cycles"],
            &["--color requires --kind map, scatter or pareto, but this picture is a response"],
        ),
        (&["sweep.csv", "--y-aim", "min"], &["--x-aim and --y-aim require --kind pareto"]),
        (&["sweep.csv", "--kind", "trajectory"], &["requires the column time_s"]),
        (
            &["sweep.csv", "--kind", "histogram", "--y", "lift_mean_mn"],
            &["a histogram has no --y; choose its measure with --x"],
        ),
        (
            &[
                "sweep.csv",
                "--kind",
                "tornado",
                "--where",
                "drive_voltage_pp=60",
                "--where",
                "drive_frequency=90",
            ],
            &["no parameter has several values"],
        ),
        (
            &["sweep.csv", "--kind", "tornado", "--html", "a.html"],
            &["--html cannot show a tornado; use --out FILE.png"],
        ),
        (&["sweep.csv", "--kind", "hysteresis"], &["requires the columns `branch` and `bistable`"]),
        (&["sweep.csv", "--out", "picture.pdf"], &["pictures end in .svg or .png"]),
        (&["sweep.csv", "--out", "picture.html"], &["--html picture.html writes a page"]),
        (&["sweep.csv", "--size", "10x10"], &["expected WxH"]),
        (
            &["sweep.csv", "--kind", "pie"],
            &[
                "[possible values: response, map, scatter, histogram, tornado, pareto, trajectory, hysteresis, matrix]",
            ],
        ),
        (&["empty.csv"], &["empty.csv has no columns"]),
        (&["bare.csv"], &["bare.csv has no rows"]),
        (
            &["other.csv"],
            &[
                "no kind of picture suits this file: it is neither a sweep nor a motion",
                "--x and --y",
                "the columns are a, b",
            ],
        ),
        (&["failed.csv"], &["none of 2 rows has a value of stroke_amplitude_deg"]),
        (&["failed.csv", "--kind", "pareto"], &["there is nothing to draw"]),
    ];
    for (arguments, wanted) in cases {
        let ended = refused(&folder, arguments);
        for text in *wanted {
            ended.says(text);
        }
    }
    folder.ends(2, "plot missing.csv").says("missing.csv: there is no such file");
    folder.ends(3, "plot sweep.csv --out missing/picture.svg");
}
