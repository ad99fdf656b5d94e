//! Drive waveforms.

use std::f64::consts::PI;

use flap_core::drive::{Drive, DriveConstants, Shape, StrokeMode, Wave, Waveform, WaveformParameters};
use flap_core::model::direct_drive::Params;
use flap_core::num::Backend;
use flap_core::simulate::{
    ChirpRequest, ChirpResponse, PointRun, SolverSettings, Status, Unfinished, by_name,
};

const FREQUENCY: f64 = 50.0;
const PERIOD: f64 = 1.0 / FREQUENCY;

/// A sine with a third harmonic of this amplitude.
pub(crate) fn third_harmonic(amplitude: f64) -> WaveformParameters {
    WaveformParameters { drive_third_harmonic: amplitude, ..WaveformParameters::new(Shape::Harmonics) }
}

/// A wave of unit amplitude.
fn constants() -> DriveConstants<f64> {
    let waveform = WaveformParameters {
        drive_second_harmonic: 0.3,
        drive_second_phase: 0.7,
        drive_third_harmonic: -0.2,
        drive_third_phase: -1.1,
        drive_rise: 0.1,
        ..WaveformParameters::new(Shape::Harmonics)
    };
    DriveConstants::new(FREQUENCY, &waveform, [0.0, 1.0])
}

fn wave(waveform: Waveform, t: f64) -> Wave<f64> {
    let constants = if waveform == Waveform::Chirp {
        let sine = DriveConstants::new(FREQUENCY, &WaveformParameters::SINE, [0.0, 1.0]);
        DriveConstants { growth: 2.0 * PI * 300.0, ..sine }
    } else {
        constants()
    };
    Drive { waveform, stroke: StrokeMode::Free }.at(&constants, t)
}

fn at(shape: Shape, t: f64) -> Wave<f64> {
    wave(Waveform::Shape(shape), t)
}

#[test]
fn rates_are_derivatives() {
    let shapes = Shape::ALL.iter().map(|&shape| Waveform::Shape(shape));
    for waveform in shapes.chain([Waveform::Chirp]) {
        let at = |t| wave(waveform.clone(), t);
        for i in 1..400 {
            let t = PERIOD * f64::from(i) / 400.3;
            let dt = 1e-8;
            let difference = (at(t + dt).value - at(t - dt).value) / (2.0 * dt);
            let rate = at(t).rate;
            assert!(
                (difference - rate).abs() < 1e-4 * 2.0 * PI * FREQUENCY,
                "{waveform:?} at {t}: {rate}, {difference}"
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

/// Current and power jump at the edges of a square wave. Steps end at the edges, so that the energy audit is small.
#[test]
fn power_balances_for_every_shape() {
    let model = by_name("direct-drive").unwrap();
    let audit = model.columns().iter().position(|column| column.name == "energy_audit").unwrap();
    for drive_shape in [Shape::Sine, Shape::Harmonics, Shape::Square] {
        for (p, bound) in [(Params::ozaki2018_small(), 1e-5), (Params::ozaki2018_large(), 1e-4)] {
            let waveform = WaveformParameters {
                drive_second_harmonic: 0.3,
                drive_second_phase: 0.5,
                ..WaveformParameters::new(drive_shape)
            };
            let p = Params { waveform, ..p };
            let row = model
                .run_point(&PointRun::new(Backend::best(), &SolverSettings::default(), &p.to_values()), None);
            assert_eq!(row.status, Status::Periodic, "{drive_shape:?}");
            assert!(row.measures[audit].abs() < bound, "{drive_shape:?}: {:e}", row.measures[audit]);
        }
    }
}

/// The field and the capacitive power follow the whole waveform, not its fundamental alone.
#[test]
fn harmonics_count_in_field_and_capacitive_power() {
    let model = by_name("direct-drive").unwrap();
    let measure = |p: &Params, name: &str| {
        let row = model
            .run_point(&PointRun::new(Backend::best(), &SolverSettings::default(), &p.to_values()), None);
        row.measures[model.columns().iter().position(|column| column.name == name).unwrap()]
    };
    // 50 V + 50 V (sin θ + ½ cos 2θ): from −25 to 87.5 V on 100 µm.
    let p = Params {
        waveform: WaveformParameters {
            drive_second_harmonic: 0.5,
            drive_second_phase: PI / 2.0,
            ..WaveformParameters::new(Shape::Harmonics)
        },
        ..Params::ozaki2018_large()
    };
    assert!((measure(&p, "field_max_v_per_um") - 0.875).abs() < 1e-5);
    let sine = measure(&Params::ozaki2018_large(), "power_capacitive_mw");
    assert!((measure(&p, "power_capacitive_mw") / sine - 1.125_f64.powi(2)).abs() < 1e-5);
}

/// A square wave has a larger first harmonic than a sine with the same amplitude, so the stroke is larger.
#[test]
fn the_shape_of_the_drive_reaches_the_wing() {
    let model = by_name("direct-drive").unwrap();
    let amplitude = |p: Params| {
        let row = model
            .run_point(&PointRun::new(Backend::best(), &SolverSettings::default(), &p.to_values()), None);
        assert_eq!(row.status, Status::Periodic);
        row.measures[0]
    };
    let p = Params::ozaki2018_small;
    let sine = amplitude(p());
    assert!(amplitude(Params { waveform: WaveformParameters::new(Shape::Square), ..p() }) > 1.1 * sine);
    // Harmonics of no amplitude are a sine.
    let none = amplitude(Params { waveform: WaveformParameters::new(Shape::Harmonics), ..p() });
    assert!((none / sine - 1.0).abs() < 1e-9);
    let third = amplitude(Params { waveform: third_harmonic(0.5), ..p() });
    assert!((third / sine - 1.0).abs() > 1e-3, "{third} against {sine}");
}

#[test]
fn a_square_wave_must_have_time_to_be_flat() {
    let model = by_name("direct-drive").unwrap();
    let p = Params {
        waveform: WaveformParameters { drive_rise: 0.6, ..WaveformParameters::new(Shape::Square) },
        ..Params::ozaki2018_small()
    };
    let row =
        model.run_point(&PointRun::new(Backend::best(), &SolverSettings::default(), &p.to_values()), None);
    assert_eq!(row.status, Status::Invalid);
    assert!(row.reason.unwrap().contains("drive_rise"));
}

fn chirp(from: f64, to: f64, rate: f64) -> Result<ChirpResponse, Unfinished> {
    let request = ChirpRequest { from, to, rate, samples_per_cycle: 20 };
    let solver = SolverSettings { rtol: 1e-8, atol: 1e-10, ..SolverSettings::default() };
    let values = Params::ozaki2018_small().to_values();
    by_name("direct-drive")
        .unwrap()
        .experiments()
        .unwrap()
        .chirp(&PointRun::new(Backend::best(), &solver, &values), &request)
}

#[test]
fn a_chirp_is_a_chain_of_cycles() {
    let response = chirp(150.0, 260.0, 40.0).unwrap();
    let rows = &response.envelope.rows;
    // Phase f t + r t²/2 after 2.75 s, in cycles.
    assert_eq!(rows.len() as f64, (150.0_f64 * 2.75 + 20.0 * 2.75 * 2.75).ceil());
    for (i, row) in rows.iter().enumerate() {
        let [begin, end] = [row[0], row[1]];
        let cycles = |t: f64| 150.0 * t + 20.0 * t * t;
        assert!((cycles(end) - cycles(begin) - 1.0).abs() < 1e-9);
        assert!((cycles(end) - (i + 1) as f64).abs() < 1e-9);
    }
    let motion = &response.motion.rows;
    assert_eq!(motion.len(), 20 * rows.len() + 1);
    assert!(motion.windows(2).all(|pair| pair[0][0] < pair[1][0]));
}

/// In a slow chirp, the stroke is largest at the resonance of the steady response: at 196 Hz for 30 V.
#[test]
fn a_slow_chirp_finds_the_resonance() {
    let response = chirp(170.0, 230.0, 15.0).unwrap();
    let column = response.envelope.columns.iter().position(|name| name == "stroke_amplitude_deg").unwrap();
    let peak = response.envelope.rows.iter().max_by(|a, b| a[column].total_cmp(&b[column])).unwrap();
    assert!((peak[2] - 196.1).abs() < 2.0, "peak at {} Hz", peak[2]);
    assert!((peak[column] - 11.0).abs() < 0.3, "{} deg", peak[column]);
}

#[test]
fn impossible_chirps_are_refused() {
    assert!(chirp(100.0, 50.0, 15.0).unwrap_err().to_string().contains("sign of the change"));
    assert!(chirp(0.0, 50.0, 15.0).is_err());
    assert!(chirp(100.0, 90.0, -15.0).is_ok());
}
