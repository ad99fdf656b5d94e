//! Files that are not TOML.

use super::check;
use crate::fake::MODELS;

#[test]
fn values() {
    check(
        r#"
preset = "fly"
[params]
wing_area = 54 mm^2
drive_voltage_pp =
drive_frequency = "60 Hz
hinge_position = 1,5
stroke_offset = .5
"#,
        r#"
3:13 |54 mm^2| `54 mm^2` needs quotes
  help: write "54 mm^2"
4:19 || a value is missing
  help: write a number, text in quotes, a list or a range
5:25 || a closing quote is missing
  help: end text with the quote it begins with
6:19 || not valid TOML: unexpected key or value, expected newline, `#`
  help: start each key on a new line; numbers have a decimal point, not a comma
7:17 || not valid TOML: invalid mantissa, expected digits
"#,
    );
}

#[test]
fn keys_defined_twice() {
    check(
        r#"
preset = "fly"
[params]
wing_area = 1
wing_area = 2
[params]
stroke_offset = 2
"#,
        r"
4:1 |wing_area| `wing_area` is defined twice
  help: keep one of them
5:2 |params| `params` is defined twice
  help: keep one of them
",
    );
}

#[test]
fn headers() {
    check(
        r#"
preset = "fly"
[params
wing_area = 1
"#,
        r"
2:8 || not valid TOML: unclosed table, expected `]`
",
    );
}

#[test]
fn lists() {
    check(
        r#"
preset = "fly"
[axes]
wing_area = [1, 2
arms = ["axis"]
"#,
        r"
4:1 || not valid TOML: missing comma between array elements, expected `,`
  help: put commas between the values of a list, and ] after the last
",
    );
}

#[test]
fn deep_nesting_is_refused() {
    let deep = |piece: &str| piece.repeat(50_000);
    let texts = [
        format!("a = {}1{}", deep("["), deep("]")),
        format!("a = {}1{}", deep("{ a = "), deep(" }")),
        format!("{}a = 1", deep("a.")),
        format!("[{}a]", deep("a.")),
    ];
    for text in texts {
        assert!(flap_sweep::grid::parse("grid.toml", &text, &MODELS).is_err());
    }
}
