//! For any text, flap does not panic, and all diagnostics can be printed.

use flap_core::parameter::Kind;
use flap_sweep::plan::Admission;
use proptest::prelude::*;

use crate::fake::MODELS;

const GRID: &str = r#"
preset = "fly"
[params]
arms = "axis"
[axes]
wing_area = { from = "50 mm^2", to = "60 mm²", n = 11, scale = "log" }
drive_frequency = { from = 60, to = 200, step = "1 Hz" }
[[zip]]
stroke_offset = ["1 deg", 0.2, -3e-1]
hinge_position = [1, 2, 3]
[sample]
method = "sobol"
n = 7
[sample.parameters]
drive_voltage_pp = { relative_sd = "5 %", from = 100 }
plate_width = { from = 1e-3, to = 2e-3, scale = "log" }
[derived]
hinge_stiffness = "preset.hinge_stiffness * (wing_area / preset.wing_area)^-1.5"
[where]
narrow = "stroke_offset < 1 and not arms == 'printed'"
[measure]
ratio = "lift_mean_mn / max(power_mean_mw, 1e-3)"
good = "ratio > 2"
[solver]
rtol = 1e-6
max_cycles = 10
[output]
path = 'a.csv'
columns = ["lift_mean_mn"]
"#;

/// Pieces of text with a meaning in a grid file.
const SCRAPS: [&str; 32] = [
    "mean = 0",
    "to = 1",
    " ^ ",
    "(",
    "not ",
    "preset.",
    "* 1e300",
    "stroke_offset",
    "",
    "\n",
    "\"",
    "'",
    "\"\"\"",
    "[",
    "]]",
    "{",
    "}",
    ",",
    ".",
    "=",
    "-",
    "0",
    "1e999",
    "nan",
    "n = 2",
    "[[zip]]",
    "wing_area",
    "step = 0",
    " V",
    "\\u00b5",
    "µ",
    "\u{feff}",
];

proptest! {
    #[test]
    fn damaged_grids(cuts in prop::collection::vec((0.0..1.0_f64, 0..12_usize, 0..SCRAPS.len()), 1..4)) {
        let mut text: Vec<char> = GRID.chars().collect();
        for (place, length, scrap) in cuts {
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a fraction of a length")]
            let start = (place * text.len() as f64) as usize;
            let end = (start + length).min(text.len());
            text.splice(start..end, SCRAPS[scrap].chars());
        }
        let text: String = text.into_iter().collect();
        match flap_sweep::grid::parse("grid.toml", &text, &MODELS) {
            Ok(plan) => {
                for index in [0, plan.len() / 2, plan.len() - 1] {
                    let values = plan.point(index).values;
                    let mut measures = vec![1.0, 0.0, f64::NAN];
                    plan.add_own_measures(&values, &mut measures);
                    prop_assert_eq!(measures.len(), 3 + plan.measures().len());
                    if plan.judge(&values) != Admission::Runs {
                        continue;
                    }
                    for (parameter, value) in plan.parameters().iter().zip(values) {
                        match parameter.kind {
                            Kind::Number(range) => prop_assert!(range.contains(value), "{}", parameter.name),
                            Kind::Following(range, _) => prop_assert!(value.is_nan() || range.contains(value)),
                            Kind::Choice(options) => prop_assert!((0..options.len()).any(|i| i as f64 == value)),
                        }
                    }
                }
            }
            Err(problems) => {
                prop_assert!(!problems.is_empty());
                for problem in problems.iter() {
                    prop_assert!(text.get(problem.span.clone()).is_some(), "{:?}", problem.span);
                    for related in &problem.related {
                        prop_assert!(text.get(related.span.clone()).is_some(), "{:?}", related.span);
                    }
                }
            }
        }
    }
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
