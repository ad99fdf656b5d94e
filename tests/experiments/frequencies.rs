//! Frequencies of sampled motions that are known exactly.

use std::f64::consts::TAU;

use flap_experiments::damped_sine::fit;
use flap_experiments::spectrum::Spectrum;

/// A e^{−λt} sin(2πft + p), `count` samples `interval` seconds apart.
fn damped(
    [amplitude, decay, frequency, phase]: [f64; 4],
    interval: f64,
    count: usize,
) -> impl Iterator<Item = f64> {
    let times = (0..count).map(move |i| interval * i as f64);
    times.map(move |t| amplitude * (-decay * t).exp() * (TAU * frequency * t + phase).sin())
}

#[test]
fn a_damped_sine_is_found_whatever_its_size_phase_and_decay() {
    for amplitude in [1e-6, 30.0] {
        for decay in [-5.0, 0.0, 10.0, 80.0] {
            for phase in [-3.0, -1.0, 0.0, 0.5, 2.0] {
                let wanted = [amplitude, decay, 103.0, phase];
                let samples: Vec<f64> = damped(wanted, 1e-4, 400).collect();
                let found = fit(1e-4, &samples).unwrap();
                assert!((found.amplitude / amplitude - 1.0).abs() < 1e-9, "{wanted:?}: {found:?}");
                assert!((found.decay - decay).abs() < 1e-7, "{wanted:?}: {found:?}");
                assert!((found.frequency / 103.0 - 1.0).abs() < 1e-10, "{wanted:?}: {found:?}");
                assert!((found.phase - phase).abs() < 1e-9, "{wanted:?}: {found:?}");
                assert!(found.relative_rms < 1e-9, "{wanted:?}: {found:?}");
            }
        }
    }
}

#[test]
fn what_a_fit_leaves_over_is_told() {
    let samples: Vec<f64> = damped([1.0, 5.0, 100.0, 0.0], 1e-4, 1000)
        .zip(damped([0.1, 0.0, 317.0, 0.3], 1e-4, 1000))
        .map(|(one, other)| one + other)
        .collect();
    let found = fit(1e-4, &samples).unwrap();
    assert!((found.frequency - 100.0).abs() < 0.1, "{found:?}");
    assert!(found.relative_rms > 0.05 && found.relative_rms < 0.2, "{found:?}");
}

#[test]
fn nothing_is_fitted_to_what_does_not_swing() {
    assert_eq!(fit(1e-4, &[]), None);
    assert_eq!(fit(1e-4, &[0.0; 100]), None);
    assert_eq!(fit(1e-4, &damped([1.0, 0.0, 10.0, 0.0], 1e-4, 700).collect::<Vec<_>>()), None);
}

#[test]
fn the_peaks_of_two_sines_are_found_and_nothing_else() {
    // 77.31 and 130.03 Hz over 0.5 s: not whole periods.
    let samples: Vec<f64> = damped([3.0, 0.0, 77.31, 0.4], 1e-4, 5000)
        .zip(damped([0.4, 0.0, 130.03, -1.0], 1e-4, 5000))
        .map(|(one, other)| one + other)
        .collect();
    let spectrum = Spectrum::of(1e-4, &samples);
    assert!((spectrum.bin - 0.25).abs() < 1e-12);
    let peaks = spectrum.peaks(10);
    assert_eq!(peaks.len(), 2, "{peaks:?}");
    // Each leaks into the other.
    assert!((peaks[0].frequency - 77.31).abs() < 0.02, "{peaks:?}");
    assert!((peaks[0].amplitude - 3.0).abs() < 0.03, "{peaks:?}");
    assert!((peaks[1].frequency - 130.03).abs() < 0.1, "{peaks:?}");
    assert!((peaks[1].amplitude - 0.4).abs() < 0.04, "{peaks:?}");
    assert_eq!(spectrum.peaks(1), peaks[..1]);
}

#[test]
fn a_spectrum_without_samples_has_no_peaks() {
    assert_eq!(Spectrum::of(1e-4, &[]).peaks(3), []);
    assert_eq!(Spectrum::of(1e-4, &[1.0]).peaks(3), []);
    assert_eq!(Spectrum::of(1e-4, &[0.0; 64]).peaks(3), []);
}
