//! Drive waveforms.

use std::f64::consts::PI;

use flap_core::drive::{Shape, Wave, Waveform};
use flap_core::model::direct_drive::Params;
use flap_core::num::InstructionSet;
use flap_core::simulate::{SolverSettings, Status, by_name};

const FREQUENCY: f64 = 50.0;
const PERIOD: f64 = 1.0 / FREQUENCY;

fn waveform() -> Waveform<f64> {
    Waveform::new(FREQUENCY, [0.3, -0.2], [0.7, -1.1], 0.1)
}

fn at(shape: Shape, t: f64) -> Wave<f64> {
    waveform().at(shape, t)
}

#[test]
fn rates_are_derivatives() {
    for shape in [Shape::Sine, Shape::Harmonics, Shape::Square] {
        for i in 1..400 {
            let t = PERIOD * f64::from(i) / 400.3;
            let dt = 1e-8;
            let difference = (at(shape, t + dt).value - at(shape, t - dt).value) / (2.0 * dt);
            let rate = at(shape, t).rate;
            assert!(
                (difference - rate).abs() < 1e-4 * 2.0 * PI * FREQUENCY,
                "{shape:?} at {t}: {rate}, {difference}"
            );
        }
    }
}

#[test]
fn harmonics_add_up() {
    for i in 0..100 {
        let t = PERIOD * f64::from(i) / 100.0;
        let theta = 2.0 * PI * FREQUENCY * t;
        let expected = theta.sin() + 0.3 * (2.0 * theta + 0.7).sin() - 0.2 * (3.0 * theta - 1.1).sin();
        assert!((at(Shape::Harmonics, t).value - expected).abs() < 1e-14);
    }
}

#[test]
fn a_square_wave_is_flat_between_its_edges_and_odd() {
    let value = |phase: f64| at(Shape::Square, phase * PERIOD).value;
    for (phase, expected) in [(0.0, 0.0), (0.05, 1.0), (0.25, 1.0), (0.45, 1.0), (0.55, -1.0), (0.75, -1.0)] {
        assert!((value(phase) - expected).abs() < 1e-12, "{phase}: {}", value(phase));
    }
    // Half-way up an edge that takes a tenth of the period.
    assert!((value(0.025) - 0.5_f64.sqrt()).abs() < 1e-12);
    assert!(value(0.5).abs() < 1e-12 && value(1.0).abs() < 1e-12);
    for i in 1..50 {
        let phase = f64::from(i) / 100.0;
        assert!((value(phase) + value(1.0 - phase)).abs() < 1e-12);
    }
}

/// A square wave's first harmonic is larger than that of a sine of the same amplitude, so the wing strokes wider.
#[test]
fn the_shape_of_the_drive_reaches_the_wing() {
    let model = by_name("direct-drive").unwrap();
    let amplitude = |p: Params| {
        let row = model.run_point(InstructionSet::best(), &SolverSettings::default(), &p.to_values());
        assert_eq!(row.status, Status::Periodic);
        row.measures[0]
    };
    let p = Params::ozaki2018_small;
    let sine = amplitude(p());
    assert!(amplitude(Params { drive_shape: Shape::Square, ..p() }) > 1.1 * sine);
    // Harmonics of no amplitude are a sine.
    let none = amplitude(Params { drive_shape: Shape::Harmonics, ..p() });
    assert!((none / sine - 1.0).abs() < 1e-9);
    let third = amplitude(Params { drive_shape: Shape::Harmonics, drive_third_harmonic: 0.5, ..p() });
    assert!((third / sine - 1.0).abs() > 1e-3, "{third} against {sine}");
}

#[test]
fn a_square_wave_must_have_time_to_be_flat() {
    let model = by_name("direct-drive").unwrap();
    let p = Params { drive_shape: Shape::Square, drive_rise: 0.6, ..Params::ozaki2018_small() };
    let row = model.run_point(InstructionSet::best(), &SolverSettings::default(), &p.to_values());
    assert_eq!(row.status, Status::Invalid);
    assert!(row.reason.unwrap().contains("drive_rise"));
}
