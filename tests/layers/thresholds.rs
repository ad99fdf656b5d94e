//! The thresholds of flap-core, compared with the table in the documentation.

use std::collections::BTreeSet;

use crate::source::source_files;

const METHODS: &str = include_str!("../../docs/models/methods.md");

/// Modules whose thresholds decide about steps, orbits and measures.
const MODULES: &[&str] = &["ode/", "measure/", "simulate/"];

/// Files whose constants are coefficients of published methods, not thresholds.
const COEFFICIENTS: &[&str] = &["ode/tableau.rs"];

/// File, name and value of each constant number.
fn in_sources() -> BTreeSet<[String; 3]> {
    let mut found = BTreeSet::new();
    for file in source_files("flap-core") {
        let decides = MODULES.iter().any(|module| file.path.starts_with(module));
        if !decides || COEFFICIENTS.contains(&file.path.as_str()) {
            continue;
        }
        for (_, line) in file.code() {
            let Some((_, constant)) = line.split_once("const ") else { continue };
            let Some((declared, value)) = constant.split_once(" = ") else { continue };
            let Some((name, kind)) = declared.split_once(": ") else { continue };
            // A name for another constant of the file is none of its own.
            let is_other = value.contains(" as ");
            if ["f64", "u32", "u64", "usize"].contains(&kind) && !is_other && name != "N" {
                let value = value.trim_end().trim_end_matches(';').replace("_f64", "");
                found.insert([file.path.clone(), name.to_owned(), value]);
            }
        }
    }
    found
}

/// File, name and value of each threshold in the table of the documentation.
fn in_documentation() -> BTreeSet<[String; 3]> {
    let section = METHODS.split("## Thresholds").nth(1).expect("a section on thresholds");
    let section = section.split("\n## ").next().unwrap_or_default();
    let rows = section.lines().filter(|line| line.starts_with("| `"));
    rows.map(|row| {
        let cells: Vec<&str> = row.split(" | ").map(|cell| cell.trim_matches(['|', ' ', '`'])).collect();
        assert!(cells.len() == 4 && !cells[3].is_empty(), "a threshold without a reason: {row}");
        [cells[0].to_owned(), cells[1].to_owned(), cells[2].to_owned()]
    })
    .collect()
}

#[test]
fn every_threshold_is_documented_with_its_value_and_reason() {
    let (sources, documentation) = (in_sources(), in_documentation());
    assert!(sources.len() > 60, "{} thresholds", sources.len());
    let missing: Vec<_> = sources.difference(&documentation).collect();
    let stale: Vec<_> = documentation.difference(&sources).collect();
    assert!(
        missing.is_empty() && stale.is_empty(),
        "docs/models/methods.md, Thresholds: missing are {missing:#?}, and in no source are {stale:#?}"
    );
}
