//! Grid files with mistakes, and the messages about the mistakes.

mod sample;
mod syntax;

use crate::fake::{problems, report};

/// Compares all messages about a grid file with `expected`, see [`report`].
fn check(text: &str, expected: &str) {
    let text = text.strip_prefix('\n').unwrap_or(text);
    let report = report(&problems(text));
    assert_eq!(report, expected.trim_matches('\n'), "\n{text}\n{report}\n");
}

/// Files of cases: below each heading, a grid file and all messages about it.
const CASES: [(&str, &str); 4] = [
    ("axes", include_str!("mistakes/axes.md")),
    ("formulas", include_str!("mistakes/formulas.md")),
    ("sections", include_str!("mistakes/sections.md")),
    ("values", include_str!("mistakes/values.md")),
];

#[test]
fn all_that_is_said_about_mistakes() {
    let mut failed = Vec::new();
    for (file, text) in CASES {
        let cases: Vec<&str> = text.split("\n## ").skip(1).collect();
        assert!(!cases.is_empty(), "{file}");
        for case in cases {
            let (name, rest) = case.split_once("\n\n```toml\n").expect("a grid file");
            let (grid, expected) = rest.split_once("```\n\n```text\n").expect("a report");
            let expected = expected.trim_end().strip_suffix("\n```").expect("the end of the report");
            let report = report(&problems(grid));
            if report != expected {
                failed.push(format!("{file}, {name}:\n{grid}\n{report}\n"));
            }
        }
    }
    assert!(failed.is_empty(), "\n{}", failed.join("\n"));
}

#[test]
fn on_one_line_a_mistake_reads_like_a_compiler_error() {
    let problems = problems("preset = \"fly\"\n\n[params]\nwing_area = \"µ\"\n");
    assert_eq!(problems[0].to_string(), "grid.toml:4:14: `wing_area` must start with a number");
}
