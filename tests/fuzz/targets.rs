//! Properties that hold for any input: the bodies of the fuzz targets in `fuzz`, which an ordinary test runs too.

use std::path::Path;

use flap_core::drive::Repeat;
use flap_core::parameter::Kind;
use flap_core::simulate::all;
use flap_sweep::files::record::{self, Record};
use flap_sweep::files::sidecar::Sidecar;
use flap_sweep::files::{journal, outline};
use flap_sweep::grid;
use flap_sweep::notation::expression::{Expression, Meaning, Scope};
use flap_sweep::notation::units;
use flap_sweep::plan::{Admission, Plan};
use xxhash_rust::xxh3::xxh3_64;

/// For any text, the parser returns a plan whose points can be computed, or a list of mistakes with valid places. The
/// values of each point that is run are allowed.
pub(crate) fn grid(bytes: &[u8]) {
    let Ok(text) = str::from_utf8(bytes) else { return };
    match grid::parse("grid.toml", text, all()) {
        Ok(plan) => {
            for index in [0, plan.len() / 2, plan.len().saturating_sub(1)] {
                if index < plan.len() {
                    check_point(&plan, &plan.point(index).values);
                }
            }
        }
        Err(mistakes) => {
            assert!(!mistakes.is_empty());
            for mistake in mistakes.iter() {
                assert!(text.get(mistake.span.clone()).is_some(), "{mistake}");
                for related in &mistake.related {
                    assert!(text.get(related.span.clone()).is_some(), "{mistake}: {:?}", related.span);
                }
            }
        }
    }
}

fn check_point(plan: &Plan, values: &[f64]) {
    assert_eq!(values.len(), plan.parameters().len());
    let columns = plan.rows().columns().len();
    let mut measures = vec![f64::NAN; columns];
    plan.add_own_measures(values, &mut measures);
    assert_eq!(measures.len(), columns + plan.measures().len());
    if plan.judge(values) != Admission::Runs {
        return;
    }
    let is_searched = |name: &str| plan.resonance().is_some() && name == "drive_frequency";
    for (parameter, &value) in plan.parameters().iter().zip(values) {
        let is_allowed = match parameter.kind {
            Kind::Number(range) => range.contains(value),
            Kind::Following(range, _) => value.is_nan() || range.contains(value),
            Kind::Choice(options) => (0..options.len()).any(|option| option as f64 == value),
        };
        assert!(is_allowed || is_searched(parameter.name), "{} is {value}", parameter.name);
    }
}

/// For any text, the parser returns a quantity, or an error with a message.
pub(crate) fn units(bytes: &[u8]) {
    let Ok(text) = str::from_utf8(bytes) else { return };
    for unit in ["", "m", "Hz", "N*m/rad", "kg*m^2"] {
        match units::parse_as(text, unit) {
            Ok(number) => assert!(!number.is_nan(), "{text}"),
            Err(error) => assert!(!error.message("it").is_empty()),
        }
    }
}

/// Names of every kind.
struct Names;

impl Scope for Names {
    fn meaning(&self, name: &str) -> Option<Meaning<'_>> {
        Some(match name {
            "x" => Meaning::Number(0),
            "y" => Meaning::Number(1),
            "arms" => Meaning::Choice(2, &["printed", "axis"]),
            "ok" => Meaning::Condition(3),
            "preset.x" => Meaning::Constant(2.5),
            "width" => Meaning::Unset("half of the length", String::new()),
            _ => return None,
        })
    }

    fn names(&self) -> Vec<String> {
        ["x", "y", "arms", "ok", "preset.x", "width"].map(str::to_owned).to_vec()
    }
}

/// For any text, the parser returns an expression that always has the same value, or a list of mistakes within the
/// text.
pub(crate) fn expression(bytes: &[u8]) {
    let Ok(text) = str::from_utf8(bytes) else { return };
    match Expression::parse(text, &Names) {
        Ok(expression) => {
            for values in [[2.0, 3.0, 1.0, 1.0], [f64::NAN, -0.0, 0.0, f64::NAN]] {
                let bits = || expression.value(&values).to_bits();
                assert_eq!(bits(), bits(), "{text}");
            }
        }
        Err(mistakes) => {
            assert!(!mistakes.is_empty());
            for mistake in mistakes {
                assert!(text.get(mistake.span.clone()).is_some(), "{text}: {}", mistake.message);
            }
        }
    }
}

/// For any text, the parser returns an outline of finite size and area, or an error with a message.
pub(crate) fn outline(bytes: &[u8]) {
    let Ok(text) = str::from_utf8(bytes) else { return };
    match outline::parse(Path::new("wing.csv"), text) {
        Ok(outline) => assert!(outline.length() > 0.0 && outline.width() > 0.0, "{text}"),
        Err(error) => assert!(error.to_string().starts_with("wing.csv"), "{text}: {error}"),
    }
}

/// For any text, the parser returns a record whose quantities have limited size, or an error with a message.
pub(crate) fn record(bytes: &[u8]) {
    let Ok(text) = str::from_utf8(bytes) else { return };
    let record = match Record::parse("motion.csv".to_owned(), text) {
        Ok(record) => record,
        Err(error) => return assert!(error.to_string().starts_with("motion.csv"), "{text}: {error}"),
    };
    for quantity in [record::STROKE, record::PITCH, record::WAVE] {
        if let Ok(column) = record.column(&quantity) {
            assert!(column.iter().all(|number| number.abs() <= quantity.most), "{text}");
        }
        for repeat in [Repeat::Once, Repeat::Periodic] {
            if let Ok(samples) = record.samples(&quantity, repeat) {
                let middle = samples.motion(0.5 * samples.duration());
                assert!(middle.iter().all(|number| number.is_finite()), "{text}: {middle:?}");
            }
        }
    }
    let _ = record.points("tip");
}

/// The parser of journals reads any bytes up to the first line that is not whole. The target adds a checksum to each
/// line, because few random lines have a valid checksum.
pub(crate) fn journal(bytes: &[u8]) {
    let _ = journal::parse(bytes);
    let line =
        |contents: &[u8]| [format!("{:016x} ", xxh3_64(contents)).as_bytes(), contents, b"\n"].concat();
    let whole: Vec<u8> = bytes.split(|&byte| byte == b'\n').flat_map(line).collect();
    if let Some(journal) = journal::parse(&whole) {
        let mut end = journal.header_bytes;
        for (checkpoint, next) in journal.checkpoints {
            assert!(end < next && next <= whole.len() as u64);
            end = next;
            assert!(checkpoint.summary.done() >= checkpoint.summary.ran);
        }
    }
}

/// For any bytes, the parser returns a sidecar that can be written again, or an error. The plan of the sidecar has only
/// points of its grid. The target adds the checksum, because random bytes have no valid checksum.
pub(crate) fn sidecar(bytes: &[u8]) {
    let _ = Sidecar::parse(Path::new("rows.csv.meta.toml"), bytes);
    let Ok(sidecar) = Sidecar::parse(Path::new("rows.csv.meta.toml"), &with_checksum(bytes)) else { return };
    if let Ok(again) = sidecar.text() {
        assert!(Sidecar::parse(Path::new("rows.csv.meta.toml"), again.as_bytes()).is_ok(), "{again}");
    }
    if let Ok(plan) = sidecar.plan(all())
        && plan.selected() > 0
    {
        assert!(plan.selected_point(plan.selected() - 1).index < plan.len());
    }
}

/// The contents of a sidecar after a line with their checksum.
pub(crate) fn with_checksum(contents: &[u8]) -> Vec<u8> {
    [format!("checksum = \"{:016x}\"\n", xxh3_64(contents)).as_bytes(), contents].concat()
}
