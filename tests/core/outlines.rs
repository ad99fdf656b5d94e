//! Outlines of wings: moments, masses, and chords between stations.

use core::f64::consts::FRAC_PI_4;

use flap_core::aero::{ChordTable, Material, Outline, STATIONS, Station, Tabulated, Wing};
use flap_core::model::Model;
use flap_core::model::bimorph::Bimorph;
use flap_core::model::direct_drive::DirectDrive;
use flap_core::model::four_bar::{Constants, Params};

fn rectangle(leading: f64, trailing: f64) -> Outline {
    let station = |span| Station { span, leading, trailing };
    Outline::new(vec![station(0.0), station(4e-3), station(10e-3)]).unwrap()
}

fn wing(material: Material) -> Wing {
    Wing { outline: rectangle(1e-3, 2e-3), offset: 2e-3, material: Some(material), air_density: 1.2 }
}

fn close(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-13 * expected.abs(), "{found} against {expected}");
}

#[test]
fn a_rectangle_has_its_moments() {
    let wing = wing(Material { membrane: 0.02, spar: 0.0, weighed: None });
    close(wing.area(), 30e-6);
    let of = |parameters: Vec<(&str, f64)>, name: &str| {
        parameters.iter().find(|(other, _)| *other == name).map(|(_, value)| *value).unwrap()
    };
    let lumped = |name| of(Bimorph::DESCRIPTION.wing.unwrap()(&wing), name);
    let [radius_2, width_2] = [lumped("wing_radius_2") * 12e-3, lumped("wing_width_2") * 2e-3];
    close(radius_2 * radius_2 * 30e-6, 3e-3 * (12e-3_f64.powi(3) - 2e-3_f64.powi(3)) / 3.0);
    let width_moment = width_2 * width_2 * 30e-6;
    close(width_moment, 10e-3 * (1e-9 + 8e-9) / 3.0);
    close(lumped("rotation_pressure_width") * width_moment, 10e-3 * (1e-12 + 16e-12) / 4.0);
    close(lumped("added_inertia_stroke"), FRAC_PI_4 * 1.2 * 9e-6 * (12e-3_f64.powi(3) - 8e-9) / 3.0);
    let masses = wing.masses().unwrap();
    close(masses.mass, 0.6e-6);
    close(masses.radius, 7e-3);
    close(masses.depth, 0.5e-3);
    // About the chordwise axis count distances along the span.
    let [span, product, chord] = ["wing_inertia_chord", "wing_inertia_product", "wing_inertia_span"]
        .map(|name| of(DirectDrive::DESCRIPTION.wing.unwrap()(&wing), name));
    close(span, 0.6e-6 * 1e-4 / 12.0);
    close(chord, 0.6e-6 * 9e-6 / 12.0);
    assert!(product.abs() < 1e-24, "{product}");
}

#[test]
fn a_weighed_wing_keeps_its_shares() {
    let material = Material { membrane: 0.02, spar: 1e-4, weighed: None };
    let before = wing(material).masses().unwrap();
    close(before.mass, 0.6e-6 + 1e-6);
    let after = wing(Material { weighed: Some(0.8e-6), ..material }).masses().unwrap();
    close(after.mass, 0.8e-6);
    close(after.rr, 0.5 * before.rr);
    close(after.depth, before.depth);
}

#[test]
fn other_stations_are_refused() {
    let station = |span, leading, trailing| Station { span, leading, trailing };
    let refused = |stations: &[Station], reason: &str| {
        let error = Outline::new(stations.to_vec()).unwrap_err().to_string();
        assert!(error.contains(reason), "{error}");
    };
    refused(&[station(0.0, 0.0, 1.0)], "at least two stations, not 1");
    refused(&[station(1.0, 0.0, 1.0), station(2.0, 0.0, 1.0)], "at 1 m along the span");
    refused(&[station(0.0, 0.0, 1.0), station(0.0, 0.0, 1.0)], "station 2 is not farther out");
    refused(&[station(0.0, 0.0, 1.0), station(1.0, 0.0, -1.0)], "negative at station 2");
    refused(&[station(0.0, 0.0, 0.0), station(1.0, 0.0, 0.0)], "no area");
}

#[test]
fn the_chord_is_straight_between_stations() {
    let mut chords = [0.0; STATIONS];
    for (station, chord) in chords.iter_mut().enumerate() {
        *chord = [2e-3, 3e-3][station % 2];
    }
    let with = |chords| Params { chords, ..Params::arabagi2013_75hz() };
    let table = ChordTable::new(Tabulated::On, chords);
    for (x, chord) in [(0.0, 2e-3), (0.1, 3e-3), (0.05, 2.5e-3), (0.925, 2.75e-3), (1.0, 2e-3)] {
        let found = with(table.clone()).chord(x);
        assert!((found - chord).abs() < 1e-15, "{x}: {found:?}");
    }
    assert!((table.mean() - 2.5e-3).abs() < 1e-15);
    let off = with(ChordTable::new(Tabulated::Off, chords)).chord(0.5);
    assert_eq!(off, Params::arabagi2013_75hz().chord(0.5));
    assert!(Constants::derive(&with(ChordTable::new(Tabulated::On, [0.0; STATIONS]))).is_err());
}
