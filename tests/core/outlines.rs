//! Outlines of wings: moments, masses, and chords between stations.

use core::f64::consts::FRAC_PI_4;

use flap_core::aero::{ChordTable, Material, Outline, OutlineError, STATIONS, Station, Tabulated, Wing};

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
    close(wing.area_moment(2), 3e-3 * (12e-3_f64.powi(3) - 2e-3_f64.powi(3)) / 3.0);
    close(wing.width_moment(2), 10e-3 * (1e-9 + 8e-9) / 3.0);
    close(wing.width_moment(3), 10e-3 * (1e-12 + 16e-12) / 4.0);
    close(wing.added_inertia(), FRAC_PI_4 * 1.2 * 9e-6 * (12e-3_f64.powi(3) - 8e-9) / 3.0);
    let masses = wing.masses().unwrap();
    close(masses.mass, 0.6e-6);
    close(masses.radius, 7e-3);
    close(masses.depth, 0.5e-3);
    let [span, product, chord] = masses.about_centre();
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
    let refused = |stations: &[Station], error| assert_eq!(Outline::new(stations.to_vec()), Err(error));
    refused(&[station(0.0, 0.0, 1.0)], OutlineError::TooFew(1));
    refused(&[station(1.0, 0.0, 1.0), station(2.0, 0.0, 1.0)], OutlineError::NotAtRoot(1.0));
    refused(&[station(0.0, 0.0, 1.0), station(0.0, 0.0, 1.0)], OutlineError::NotOutwards(2));
    refused(&[station(0.0, 0.0, 1.0), station(1.0, 0.0, -1.0)], OutlineError::NegativeChord(2));
    refused(&[station(0.0, 0.0, 0.0), station(1.0, 0.0, 0.0)], OutlineError::NoArea);
}

#[test]
fn the_chord_is_straight_between_stations() {
    let mut chords = [0.0; STATIONS];
    for (station, chord) in chords.iter_mut().enumerate() {
        *chord = [2e-3, 3e-3][station % 2];
    }
    let table = ChordTable::new(Tabulated::On, chords);
    for (x, chord) in [(0.0, 2e-3), (0.1, 3e-3), (0.05, 2.5e-3), (0.925, 2.75e-3), (1.0, 2e-3)] {
        assert!((table.chord(x).unwrap() - chord).abs() < 1e-15, "{x}: {:?}", table.chord(x));
    }
    assert!((table.mean() - 2.5e-3).abs() < 1e-15);
    assert_eq!(ChordTable::new(Tabulated::Off, chords).chord(0.5), None);
    assert!(ChordTable::new(Tabulated::On, [0.0; STATIONS]).check().is_err());
}
