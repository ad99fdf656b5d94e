//! Grid files with mistakes, and what is said about them.

mod any;
mod axes;
mod formulas;
mod sample;
mod sections;
mod syntax;
mod values;

use crate::fake::{problems, report};

/// Compares all that is said about a grid file with `expected`, see [`report`].
fn check(text: &str, expected: &str) {
    let text = text.strip_prefix('\n').unwrap_or(text);
    let report = report(&problems(text));
    assert_eq!(report, expected.trim_matches('\n'), "\n{text}\n{report}\n");
}

#[test]
fn on_one_line_a_mistake_reads_like_a_compiler_error() {
    let problems = problems("preset = \"fly\"\n\n[params]\nwing_area = \"µ\"\n");
    assert_eq!(problems[0].to_string(), "grid.toml:4:14: `wing_area` must start with a number");
}
