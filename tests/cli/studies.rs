//! The numbers of `docs/how-to/studies.md`.

use std::collections::BTreeMap;
use std::fs;

use crate::documents::root;
use crate::support::Folder;

/// The page without line breaks.
fn page() -> String {
    fs::read_to_string(root().join("docs/how-to/studies.md")).unwrap().replace('\n', " ")
}

/// The rows of an example grid with some text replaced, each by the names of its columns.
fn rows<const N: usize>(grid: &str, replace: [(&str, &str); N]) -> Vec<BTreeMap<String, String>> {
    let mut text = fs::read_to_string(root().join("examples").join(grid)).unwrap();
    for (old, new) in replace {
        assert!(text.contains(old), "{grid} has no {old}");
        text = text.replace(old, new);
    }
    let folder = Folder::with_grid(&text);
    folder.ends(0, "sweep --grid grid.toml --out o.csv --strict");
    let text = folder.read("o.csv");
    let mut lines = text.lines().map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>());
    let names = lines.next().unwrap();
    lines.map(|cells| names.iter().cloned().zip(cells).collect()).collect()
}

fn number(row: &BTreeMap<String, String>, column: &str) -> f64 {
    row[column].parse().unwrap_or_else(|_| panic!("{column} = {}", row[column]))
}

/// The row of the largest lift among those with this transmission ratio.
fn peak(rows: &[BTreeMap<String, String>], ratio: f64) -> &BTreeMap<String, String> {
    let lift = |row: &BTreeMap<String, String>| number(row, "vehicle_lift_mgf");
    let of_ratio = rows.iter().filter(|row| (number(row, "transmission_ratio") - ratio).abs() < 1e-6);
    of_ratio.max_by(|a, b| lift(a).total_cmp(&lift(b))).unwrap()
}

#[test]
fn the_table_of_the_scaling_law() {
    let rows = rows("jafferis_scaling.toml", []);
    assert_eq!(rows.len(), 145);
    assert!(rows.iter().all(|row| row["feasible"] == "true"));
    let page = page();
    for ratio in [3333.0, 2999.7, 2666.4, 2333.1, 1999.8] {
        let row = peak(&rows, ratio);
        let exponent = |column: &str| match row[column].as_str() {
            "" => "|".to_owned(),
            text => format!("{:.2} |", text.parse::<f64>().unwrap()),
        };
        let expected = format!(
            "| {ratio} | {} | {:.1} | {:.1} | {:.1} | {} {}",
            number(row, "drive_frequency"),
            number(row, "vehicle_lift_mgf"),
            number(row, "stroke_pp_deg"),
            number(row, "pitch_peak_deg"),
            exponent("lift_exponent"),
            exponent("speed_squared_exponent"),
        );
        assert!(page.contains(&expected), "{expected}");
    }
}

#[test]
fn the_scaling_law_at_a_higher_voltage() {
    let rows = rows(
        "jafferis_scaling.toml",
        [
            ("160 V\"", "200 V\""),
            ("n = 9", "n = 3"),
            (
                "128 * (transmission_ratio / preset.transmission_ratio)^-0.94",
                "119 * 3333 / transmission_ratio",
            ),
        ],
    );
    let unscaled = peak(&rows, 3333.0);
    let lift = |row: &BTreeMap<String, String>| number(row, "vehicle_lift_mgf");
    let exponent = |ratio: f64| (lift(peak(&rows, ratio)) / lift(unscaled)).ln() / (3333.0 / ratio).ln();
    let frequency = |ratio: f64| number(peak(&rows, ratio), "drive_frequency");
    let page = page();
    for expected in [
        format!("{:.2} for a ratio of 0.8, and {:.2} for 0.6", exponent(2666.4), exponent(1999.8)),
        format!("at {}, {} and {} Hz", frequency(3333.0), frequency(2666.4), frequency(1999.8)),
        format!("unscaled lift is {:.1} mgf", lift(unscaled)),
    ] {
        assert!(page.contains(&expected), "{expected}");
    }
}

#[test]
fn the_percentiles_of_the_tolerance() {
    let rows = rows("jafferis_tolerance.toml", []);
    let mut lift: Vec<f64> = rows.iter().map(|row| number(row, "vehicle_lift_mgf")).collect();
    lift.sort_by(f64::total_cmp);
    assert_eq!(lift.len(), 2000);
    // As Python's statistics.quantiles: of n values, number k of m lies at k (n + 1) / m, counted from 1.
    let quantile = |share: f64| {
        let place = share * 2001.0 - 1.0;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a place among 2000")]
        let below = place as usize;
        lift[below] + (lift[below + 1] - lift[below]) * place.fract()
    };
    let drawn = Folder::new().flap("run jafferis2016").stdout;
    let drawn = drawn.lines().find_map(|line| line.strip_prefix("vehicle_lift_mgf")).unwrap();
    let drawn: f64 = drawn.split_whitespace().next().unwrap().parse().unwrap();
    let page = page();
    for expected in [
        format!("| as drawn | {drawn:.1} |"),
        format!("| median of 2000 builds | {:.1} |", quantile(0.5)),
        format!("| 10th percentile | {:.1} |", quantile(0.1)),
    ] {
        assert!(page.contains(&expected), "{expected}");
    }
}
