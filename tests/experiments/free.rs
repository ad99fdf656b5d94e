//! The frequencies of free motions after an impulse.

use std::f64::consts::PI;

use flap_core::modes::Mode;
use flap_core::num::Backend;
use flap_core::simulate::{PointRun, SolverSettings, Unfinished, preset};
use flap_experiments::free::{FreeMotion, FreeRequest, examine, intervals, stroke_rate};

fn assert_near(actual: f64, expected: f64, distance: f64, what: &str) {
    assert!((actual - expected).abs() <= distance, "{what}: {actual} is not {expected}");
}

#[test]
fn impulses_are_sized_by_the_first_mode() {
    let modes =
        |first| [Mode { name: "mode_1", frequency: first }, Mode { name: "mode_2", frequency: 300.0 }];
    assert_near(stroke_rate(&modes(100.0), 0.5).unwrap(), 100.0 * PI, 1e-12, "stroke rate");
    for none in [0.0, f64::NAN, f64::INFINITY] {
        let refused = stroke_rate(&modes(none), 0.5).unwrap_err();
        assert!(refused.to_string().starts_with("mode_1 has a frequency of"), "{refused}");
    }
    assert_eq!(stroke_rate(&[], 0.5).unwrap_err().to_string(), "the model has no natural frequencies");
}

#[test]
fn motions_are_cut_into_as_many_intervals_as_asked_for() {
    // 3/102.3 s with 200 samples in each of 102.3 periods per second: 600 but for rounding.
    for frequency in [102.3, 77.7, 195.761, 31.295] {
        assert_eq!(intervals(3.0 / frequency, 200.0 * frequency).unwrap(), 600);
    }
    assert_eq!(intervals(1.0, 40_000.0).unwrap(), 40_000);
    assert_eq!(intervals(1.0, 0.1).unwrap(), 1);
    for (duration, rate) in [(0.0, 100.0), (-1.0, 100.0), (1e9, 100.0), (f64::NAN, 1.0), (f64::INFINITY, 1.0)]
    {
        let refused = intervals(duration, rate).unwrap_err();
        assert!(refused.to_string().contains("cannot be sampled"), "{refused}");
    }
}

fn free(name: &str, degrees: f64, spectrum_window: f64) -> FreeMotion {
    let (model, preset) = preset(name).unwrap();
    let request = FreeRequest {
        amplitude: degrees.to_radians(),
        fit_cycles: 4,
        spectrum_window,
        samples_per_cycle: 200,
    };
    let (solver, values) = (SolverSettings::default(), (preset.values)());
    let run = PointRun::new(Backend::best(), &solver, &values);
    examine(model.experiments().unwrap(), &run, &request).unwrap()
}

/// Arabagi et al., Fig. 12: 78 and 129 Hz. The reference has bins of 0.125 Hz, and finds 77.75 and 129.62 Hz in the
/// stroke. In the pitch, the reference finds 78.25 and 128.25 Hz, with a stroke of at most 1.3 deg peak to peak.
#[test]
fn the_spectrum_of_the_four_bar_after_an_impulse() {
    let FreeMotion { spectra, .. } = free("arabagi2013-75hz", 0.5, 1.0);
    let [("stroke", stroke_peaks), ("pitch", pitch_peaks)] = &spectra[..] else { panic!("{spectra:?}") };
    println!("{stroke_peaks:?} {pitch_peaks:?}");
    assert_near(stroke_peaks[0].frequency, 77.75, 0.0625, "stroke, first peak");
    assert_near(stroke_peaks[1].frequency, 129.62, 0.0625, "stroke, second peak");
    let mut pitch = pitch_peaks.iter().map(|peak| peak.frequency).collect::<Vec<_>>();
    pitch.sort_by(f64::total_cmp);
    // A bin: the reference does not state its impulse, on which the pitch depends more.
    assert_near(pitch[0], 78.25, 0.125, "pitch, lower peak");
    assert_near(pitch[1], 128.25, 0.125, "pitch, upper peak");
}

#[test]
fn an_examination_that_is_interrupted_ends() {
    let (model, preset) = preset("jafferis2016").unwrap();
    let (solver, values) = (SolverSettings::default(), (preset.values)());
    let run = PointRun::new(Backend::best(), &solver, &values).until(&|| true);
    let request = FreeRequest { amplitude: 0.1, fit_cycles: 10, spectrum_window: 1e3, samples_per_cycle: 20 };
    let ended = examine(model.experiments().unwrap(), &run, &request);
    assert_eq!(ended.err(), Some(Unfinished::Interrupted));
}
