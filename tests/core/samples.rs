//! Records of samples, and motions that records drive.

use std::f64::consts::TAU;

use flap_core::drive::{Repeat, Samples};

fn times(count: u32, duration: f64) -> Vec<f64> {
    // Unevenly spaced, but for the ends.
    (0..count)
        .map(|i| {
            let phase = f64::from(i) / f64::from(count - 1);
            duration * (phase + 0.03 * (TAU * phase).sin())
        })
        .collect()
}

fn record(count: u32, repeat: Repeat, f: impl Fn(f64) -> f64) -> Samples {
    let times = times(count, 0.02);
    let mut values: Vec<f64> = times.iter().map(|&t| f(t)).collect();
    if repeat == Repeat::Periodic {
        let last = values.len() - 1;
        values[last] = values[0];
    }
    Samples::new(&times, &values, repeat).unwrap()
}

/// Largest errors of value, rate and second derivative of sin ωt + ½ cos 3ωt, relative to the powers of ω.
fn errors(count: u32, repeat: Repeat) -> [f64; 3] {
    let w = TAU / 0.02;
    let samples = record(count, repeat, |t| (w * t).sin() + 0.5 * (3.0 * w * t).cos());
    let mut worst = [0.0_f64; 3];
    for i in 0..=1000 {
        let t = 0.02 * f64::from(i) / 1000.0;
        let expected = [
            (w * t).sin() + 0.5 * (3.0 * w * t).cos(),
            w * (w * t).cos() - 1.5 * w * (3.0 * w * t).sin(),
            -(w * w) * ((w * t).sin() + 4.5 * (3.0 * w * t).cos()),
        ];
        let actual = samples.motion(t);
        for order in 0..3 {
            let size = w.powi(i32::try_from(order).unwrap());
            worst[order] = worst[order].max((actual[order] - expected[order]).abs() / size);
        }
    }
    worst
}

/// With twice as many samples, the errors of value, rate and second derivative fall by factors of 2⁴, 2³ and 2².
#[test]
fn a_spline_converges_with_its_order() {
    for repeat in [Repeat::Periodic, Repeat::Once] {
        let (coarse, fine) = (errors(101, repeat), errors(201, repeat));
        for (order, least) in [12.0, 6.0, 3.0].into_iter().enumerate() {
            let gain = coarse[order] / fine[order];
            assert!(gain > least, "{repeat:?}, derivative {order}: {coarse:?} to {fine:?}");
        }
        assert!(fine[0] < 5e-6 && fine[2] < 5e-2, "{repeat:?}: {fine:?}");
    }
}

/// Through samples of a cubic polynomial, the spline of a record without repetition is the cubic polynomial.
#[test]
fn a_cubic_is_reproduced() {
    let samples = record(7, Repeat::Once, |t| 2.0 - 30.0 * t + 4e3 * t * t - 1e5 * t * t * t);
    for i in 0..=50 {
        let t = 0.02 * f64::from(i) / 50.0;
        let [value, rate, bend] = samples.motion(t);
        assert!((value - (2.0 - 30.0 * t + 4e3 * t * t - 1e5 * t * t * t)).abs() < 1e-12);
        assert!((rate - (-30.0 + 8e3 * t - 3e5 * t * t)).abs() < 1e-9);
        assert!((bend - (8e3 - 6e5 * t)).abs() < 1e-6);
    }
}

#[test]
fn a_periodic_spline_is_smooth_at_the_seam() {
    let samples = record(30, Repeat::Periodic, |t| (TAU * t / 0.02).sin().exp());
    let (begin, end) = (samples.motion(0.0), samples.motion(0.02));
    for order in 0..3 {
        assert!((begin[order] - end[order]).abs() < 1e-9 * end[order].abs().max(1.0), "{begin:?} {end:?}");
    }
}

#[test]
fn impossible_records_are_refused() {
    let reason =
        |times: &[f64], values: &[f64], repeat| Samples::new(times, values, repeat).unwrap_err().to_string();
    assert!(reason(&[0.0, 1.0], &[1.0, 2.0], Repeat::Once).contains("too few"));
    assert!(reason(&[0.0, 1.0, 1.0, 2.0], &[0.0; 4], Repeat::Once).contains("sample 3"));
    assert!(reason(&[0.0, 1.0, f64::NAN, 2.0], &[0.0; 4], Repeat::Once).contains("sample 3"));
    assert!(reason(&[0.0, 1.0, 2.0, 3.0], &[0.0, 1.0, 0.5, 0.3], Repeat::Periodic).contains("must be equal"));
}

/// With few samples the spline exceeds the range of the samples. The smallest and the largest value include the excess.
#[test]
fn the_range_contains_values_between_samples() {
    let times = [0.0, 1.0, 1.1, 4.0, 5.0];
    for (values, repeat) in
        [([1.0, 1.0, -1.0, -1.0, 1.0], Repeat::Periodic), ([0.0, 2.0, 1.0, 3.0, -1.0], Repeat::Once)]
    {
        let samples = Samples::new(&times, &values, repeat).unwrap();
        let dense = (0..=200_000).map(|i| samples.motion(5.0 * f64::from(i) / 200_000.0)[0]);
        let [low, high] =
            dense.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(v), high.max(v)]);
        let range = samples.range();
        assert!(
            (range[0] - low).abs() < 1e-6 && (range[1] - high).abs() < 1e-6,
            "{range:?}, {low} to {high}"
        );
        assert!(range[0] < samples.sample_range()[0] - 0.5, "{range:?}");
    }
}
