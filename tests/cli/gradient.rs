//! `[gradient]`: columns with the derivatives of measures.

use std::fs;

use crate::support::{Folder, numbers};

const GRID: &str = r#"
preset = "ozaki2018-large"

[axes]
drive_voltage_pp = { from = "60 V", to = "100 V", n = 4 }
drive_frequency = { from = "95 Hz", to = "115 Hz", n = 10 }

[derived]
air_density = "preset.air_density * (drive_voltage_pp / preset.drive_voltage_pp)^0.1"

[measure]
lift_per_stroke = "lift_mean_mn / stroke_pp_deg * hinge_stiffness / preset.hinge_stiffness"

[output]
columns = ["lift_mean_mn", "stroke_lag_deg", "lift_per_stroke"]

[solver]
rtol = 1e-9
settle_tol = 1e-9

[gradient]
of = ["lift_mean_mn", "stroke_lag_deg", "lift_per_stroke"]
with_respect_to = ["hinge_stiffness", "drive_frequency", "drive_voltage_pp"]
"#;

/// `flap check` estimates the size of the rows with the columns of derivatives.
#[test]
fn the_size_of_derivatives_is_estimated() {
    let folder = Folder::with_grid(GRID);
    let csv = folder.ends(0, "check grid.toml --format csv").stdout;
    let bytes = csv.lines().find_map(|line| line.strip_prefix("estimate,,csv_bytes,")).unwrap();
    let swept = folder.ends(0, "sweep grid.toml --out -").stdout;
    let rows = swept.split_once('\n').unwrap().1.len() as f64;
    assert!((bytes.parse::<f64>().unwrap() / rows - 1.0).abs() < 0.1, "{bytes} of {rows} bytes");
}

#[test]
fn rows_with_derivatives_have_the_same_bytes_however_they_are_made() {
    let folder = Folder::with_grid(GRID);
    folder.ends(0, "sweep grid.toml --out one.csv --threads 1");
    folder.ends(0, "sweep grid.toml --out two.csv --threads 2");
    let one = folder.read("one.csv");
    assert!(one == folder.read("two.csv"));
    assert_eq!(one.lines().count(), 41);

    for shard in ["1/3", "2/3", "3/3"] {
        folder.ends(0, &format!("sweep grid.toml --shard {shard}"));
    }
    folder.ends(0, "results merge merged.csv grid.1of3.csv grid.2of3.csv grid.3of3.csv");
    assert!(one == folder.read("merged.csv"));
    folder.ends(0, "results convert one.csv rows.parquet");
    folder.ends(0, "results convert rows.parquet again.csv");
    assert!(one == folder.read("again.csv"));
    folder.ends(0, "sweep grid.toml --out swept.parquet");
    assert!(
        fs::read(folder.path("swept.parquet")).unwrap() == fs::read(folder.path("rows.parquet")).unwrap()
    );
}

/// The changes of `measures` per one per cent of a factor in `grid`, by extrapolated two-sided differences of rows.
fn differences<const N: usize>(grid: impl Fn(f64) -> String, measures: [&str; N]) -> [Vec<f64>; N] {
    let [more, less, most, least] = [1.003, 0.997, 1.006, 0.994].map(|factor| {
        let folder = Folder::with_grid(&grid(factor));
        folder.ends(0, "sweep grid.toml --out rows.csv");
        folder.read("rows.csv")
    });
    measures.map(|measure| {
        let difference = |[more, less]: [&String; 2], share: f64| {
            let pairs = numbers(more, measure).into_iter().zip(numbers(less, measure));
            pairs.map(|(more, less)| (more - less) / (200.0 * share)).collect::<Vec<f64>>()
        };
        let [wide, narrow] = [difference([&most, &least], 6e-3), difference([&more, &less], 3e-3)];
        wide.iter().zip(narrow).map(|(wide, narrow)| (4.0 * narrow - wide) / 3.0).collect()
    })
}

#[test]
fn derivatives_follow_derived_parameters_and_measures_of_ones_own() {
    let folder = Folder::with_grid(GRID);
    folder.ends(0, "sweep grid.toml --out rows.csv");
    let rows = folder.read("rows.csv");
    let (rows_only, _) = GRID.split_once("[gradient]").unwrap();
    for (parameter, old, [from, to], unit) in [
        ("drive_voltage_pp", "from = \"60 V\", to = \"100 V\"", [60.0, 100.0], "V"),
        ("drive_frequency", "from = \"95 Hz\", to = \"115 Hz\"", [95.0, 115.0], "Hz"),
    ] {
        let grid = |factor: f64| {
            rows_only.replace(
                old,
                &format!("from = \"{} {unit}\", to = \"{} {unit}\"", from * factor, to * factor),
            )
        };
        let measures = ["lift_mean_mn", "stroke_lag_deg", "lift_per_stroke"];
        for (measure, exact) in measures.into_iter().zip(differences(grid, measures)) {
            let found = numbers(&rows, &format!("d_{measure}_per_pct_{parameter}"));
            let largest = found.iter().fold(0.0, |largest: f64, slope| largest.max(slope.abs()));
            for (found, exact) in found.iter().zip(exact) {
                assert!((found - exact).abs() < 5e-5 * largest, "{measure}, {parameter}: {found} {exact}");
            }
        }
    }
    assert!(rows.lines().skip(1).all(|row| row.ends_with(',')), "no derivative is missing");
}

/// If a derivative is missing, the row contains the reason and all other derivatives.
#[test]
fn missing_derivatives_have_a_reason() {
    let folder = Folder::with_grid(
        r#"
preset = "arabagi2013-75hz"
[params]
hinge_damping = 0
[gradient]
of = ["lift_mean_mn", "stroke_pp_deg"]
with_respect_to = ["hinge_damping", "drive_voltage_pp"]
[output]
columns = ["lift_mean_mn"]
"#,
    );
    folder.ends(0, "sweep grid.toml --out rows.csv");
    let rows = folder.read("rows.csv");
    let row: Vec<&str> = rows.lines().nth(1).unwrap().split(',').collect();
    assert_eq!(row[1], "periodic");
    assert_eq!([row[3], row[5], row[7]], ["", "", "zero"], "{rows}");
    assert!(row[4].parse::<f64>().unwrap() > 0.0 && row[6].parse::<f64>().unwrap() > 0.0, "{rows}");

    // Each reason once.
    let folder = Folder::with_grid(
        r#"
preset = "ozaki2018-large"
[params]
charge_recovery = 1
hinge_damping = 0
[gradient]
of = ["lift_mean_mn", "stroke_pp_deg", "hinge_strain_max"]
with_respect_to = ["charge_recovery", "hinge_damping", "drive_voltage_pp"]
[output]
columns = ["lift_mean_mn"]
"#,
    );
    folder.ends(0, "sweep grid.toml --out rows.csv");
    let rows = folder.read("rows.csv");
    assert!(rows.trim_end().ends_with(",edge;zero;missing"), "{rows}");
}

#[test]
fn mistakes_in_the_section_are_told_with_their_place() {
    let messages = |change: (&str, &str)| {
        assert!(GRID.contains(change.0));
        Folder::with_grid(&GRID.replacen(change.0, change.1, 1)).ends(2, "check grid.toml").stderr
    };
    for (change, expected) in [
        (
            ("\"stroke_lag_deg\", \"lift_per_stroke\"]\nwith", "\"stroke_lag\"]\nwith"),
            "there is no measure `stroke_lag`",
        ),
        (
            ("\"stroke_lag_deg\", \"lift_per_stroke\"]\nwith", "\"lift_mean_mn\"]\nwith"),
            "`lift_mean_mn` is listed twice",
        ),
        (("\"hinge_stiffness\",", "\"air_density\","), "`air_density` is derived from other parameters"),
        (
            ("\"hinge_stiffness\",", "\"drive_shape\","),
            "`drive_shape` is a choice, so there is no derivative with respect to it",
        ),
        (
            ("\"hinge_stiffness\",", "\"drive_bias\","),
            "`drive_bias` is not set: it follows half of drive_voltage_pp",
        ),
        (("with_respect_to =", "by ="), "[gradient] lacks `with_respect_to`"),
        (
            ("of = [\"lift_mean_mn\", \"stroke_lag_deg\", \"lift_per_stroke\"]", "of = []"),
            "`of` must be a list of names",
        ),
        (
            (
                "drive_frequency = { from = \"95 Hz\", to = \"115 Hz\", n = 10 }\n",
                "[params]\ndrive_frequency = \"resonance\"\n",
            ),
            "rows at the resonance of each design have no derivatives",
        ),
    ] {
        let told = messages(change);
        assert!(told.contains(&format!("error: {expected}\n")) && told.contains(" --> grid.toml:"), "{told}");
    }
}

#[test]
fn one_point_prints_the_parameters_that_move_a_measure_most() {
    let folder = Folder::with_grid(GRID);
    let printed = folder.ends(0, "run grid.toml --point 15 --gradient lift_mean_mn").stdout;
    let table = printed.split("and in % of the measure:\n\n").nth(1).unwrap_or_else(|| panic!("{printed}"));
    let lines: Vec<Vec<&str>> = table.lines().map(|line| line.split_whitespace().collect()).collect();
    assert_eq!(lines[0][0], "PARAMETER");
    assert_eq!(lines.len(), 11);
    // The same number as in the row of a sweep, in which the air follows the voltage.
    folder.ends(0, "sweep grid.toml --out rows.csv");
    let [swept, lift] = ["d_lift_mean_mn_per_pct_drive_frequency", "lift_mean_mn"]
        .map(|name| numbers(&folder.read("rows.csv"), name)[15]);
    let line = lines.iter().find(|line| line[0] == "drive_frequency").unwrap();
    let [found, percent] = [line[3], line[4]].map(|cell| cell.parse::<f64>().unwrap());
    assert!((found / swept - 1.0).abs() < 1e-5, "{found} {swept}");
    assert!((percent / (100.0 * swept / lift) - 1.0).abs() < 1e-5, "{percent} {swept} {lift}");
    let json = folder.ends(0, "run grid.toml --point 15 --gradient lift_mean_mn --format json").stdout;
    let slopes: Vec<serde_json::Value> = serde_json::from_str(&json).unwrap();
    let slope = slopes.iter().find(|slope| slope["parameter"] == "drive_frequency").unwrap();
    let found = slope["change_per_pct"].as_f64().unwrap();
    assert!((found / swept - 1.0).abs() < 1e-5, "{found} {swept}");
    let sizes: Vec<f64> =
        lines[1..].iter().map(|line| line[line.len() - 2].parse::<f64>().unwrap().abs()).collect();
    assert!(sizes.is_sorted_by(|one, other| one >= other), "{sizes:?}");

    let told = folder.ends(2, "run grid.toml --gradient lift_meen_mn").stderr;
    assert!(
        told.contains("there is no measure `lift_meen_mn`") && told.contains("did you mean `lift_mean_mn`?")
    );
    folder.ends(2, "test chirp ozaki2018-large --gradient lift_mean_mn");
}
