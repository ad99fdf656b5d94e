//! Wings with the user's own tables of chords.

use flap_core::aero::ChordTable;
use flap_core::num::Backend;
use flap_core::parameter::Parameter;
use flap_core::simulate::{PointRun, SolverSettings, Status, preset};

use crate::data::assert_close;

/// The measures of a preset with some parameters changed.
fn measures(name: &str, changes: &[(String, f64)]) -> Vec<(String, f64)> {
    let (model, preset) = preset(name).unwrap();
    let mut values = (preset.values)();
    for (name, value) in changes {
        values[Parameter::index(model.parameters(), name).unwrap()] = *value;
    }
    let solver = SolverSettings::default();
    let row = model.run_point(&PointRun::new(Backend::best(), &solver, &values), None);
    assert_eq!(row.status, Status::Periodic, "{name}: {:?}", row.reason);
    model.columns().iter().map(|column| column.name.clone()).zip(row.measures).collect()
}

fn changes(changes: &[(&str, f64)]) -> Vec<(String, f64)> {
    changes.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect()
}

/// A table of the chord (m) along the span.
fn table(chord: impl Fn(f64) -> f64) -> Vec<(String, f64)> {
    let names = ChordTable::TABLE[1..].iter().map(|parameter| parameter.name.to_owned());
    let chords = (0..11).map(|station| chord(0.1 * f64::from(station)));
    names.zip(chords).chain([("chord_table".to_owned(), 1.0)]).collect()
}

fn assert_same(one: &[(String, f64)], other: &[(String, f64)], tolerance: f64) {
    for ((name, a), (_, b)) in one.iter().zip(other) {
        let is_small = name.ends_with("audit") || name.ends_with("_mean_deg") || a.abs() < 1e-12;
        if !is_small && !a.is_nan() {
            assert_close(*a, *b, tolerance, name);
        }
    }
}

/// A straight chord has the same measures as a table, as a polynomial, and as Legendre polynomials.
#[test]
fn a_straight_chord_is_the_same_in_a_table() {
    let tapered = [("chord_term_0", 1.2), ("chord_term_1", -0.5), ("chord_term_4", 0.0)];
    let polynomial = measures("arabagi2013-75hz", &changes(&tapered));
    let tabulated = measures("arabagi2013-75hz", &table(|x| 8.3e-3 * (1.2 - 0.5 * x)));
    assert_same(&tabulated, &polynomial, 1e-9);

    let legendre = changes(&[
        ("flow_direction", 1.0),
        ("chord_legendre_1", -0.3),
        ("chord_legendre_2", 0.0),
        ("chord_legendre_3", 0.0),
    ]);
    let mut tabulated = table(|x| 8.34e-3 * (1.0 - 0.3 * (2.0 * x - 1.0)));
    tabulated.extend(changes(&[("flow_direction", 1.0)]));
    assert_same(&measures("ozaki2018-large", &tabulated), &measures("ozaki2018-large", &legendre), 1e-9);
}

/// In a uniform flow the table replaces mean chord and shape moments.
#[test]
fn a_table_replaces_shape_moments() {
    let table = table(|x| 7e-3 * (1.0 + 0.5 * x - x * x));
    let mut other = table.clone();
    other.extend(changes(&[
        ("mean_chord", 1e-3),
        ("shape_moment_21", 5.0),
        ("rotation_moment", 1.0),
        ("midspan_chord", 1.0),
    ]));
    assert_same(&measures("ozaki2018-large", &other), &measures("ozaki2018-large", &table), 1e-15);
}

#[test]
fn an_empty_table_is_invalid() {
    for name in ["arabagi2013-75hz", "ozaki2018-large"] {
        let (model, preset) = preset(name).unwrap();
        let mut values = (preset.values)();
        values[Parameter::index(model.parameters(), "chord_table").unwrap()] = 1.0;
        let solver = SolverSettings::default();
        let row = model.run_point(&PointRun::new(Backend::best(), &solver, &values), None);
        assert_eq!(row.status, Status::Invalid);
        assert!(row.reason.unwrap().contains("chord_0 to chord_10 are all zero"));
    }
}
