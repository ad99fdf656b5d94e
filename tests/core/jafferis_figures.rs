//! Figs. 2 and 3 of Jafferis, Graule and Wood (2016), with the oscillators and coefficients of the example.

use std::f64::consts::PI;

#[path = "../../examples/jafferis_fig2_3/coefficients.rs"]
pub(crate) mod coefficients;
#[path = "../../examples/jafferis_fig2_3/oscillators.rs"]
mod oscillators;
#[path = "../../examples/jafferis_fig2_3/response.rs"]
mod response;

use coefficients::{FIG_3, highest};
use oscillators::{DAMPING, HeldWing, Linear, TABLE_I};
use response::{Response, peaks, response};

use crate::data::assert_close;

/// Responses of the wing that rotates about its hinge.
fn turning(force: f64) -> Vec<Response> {
    response(TABLE_I, force, DAMPING)
}

/// The only peak of a curve.
fn peak(curve: &[Response]) -> Response {
    let peaks = peaks(curve);
    assert_eq!(peaks.len(), 1, "{peaks:?}");
    peaks[0]
}

/// The part of the frequency axis on which the stroke is within 10 % of the peak's.
fn width(curve: &[Response]) -> f64 {
    let top = 0.9 * peak(curve).stroke;
    0.01 * curve.iter().filter(|point| point.stroke > top).count() as f64
}

/// (i): "the normalized frequency response is independent of the magnitude of the input force". The response is 1 /
/// √((1 − ω²)² + d²ω²).
#[test]
fn linear_oscillator_has_its_textbook_response() {
    for force in [0.1, 1.0] {
        for point in response(Linear, force, DAMPING) {
            let square = point.frequency * point.frequency;
            let expected = 1.0 / ((1.0 - square).powi(2) + DAMPING * DAMPING * square).sqrt();
            assert_close(point.stroke, expected, 1e-3, &format!("{point:?}"));
        }
    }
}

/// (ii): quadratic damping has nearly the effect of linear damping d C_D 8ωA/(3π), which takes the same energy from a
/// harmonic motion. The linear damping leaves out the third harmonic.
#[test]
fn held_wing_is_damped_as_by_its_equivalent_linear_damping() {
    for degrees in [0.0, 75.0] {
        let wing = HeldWing::at(degrees);
        let drag = wing.drag;
        for point in response(wing, 0.1, DAMPING) {
            let amplitude = 0.1 * point.stroke;
            let square = point.frequency * point.frequency;
            let damping = DAMPING * drag * 8.0 / (3.0 * PI) * square * amplitude;
            let expected = 1.0 / ((1.0 - square).powi(2) + damping * damping).sqrt();
            assert_close(point.stroke, expected, 2e-2, &format!("{degrees} deg, {point:?}"));
        }
    }
}

/// (ii): "a reduction of the resonance frequency and a reduction in the peak normalized amplitude as the force is
/// increased".
#[test]
fn held_wing_peaks_lower_in_both_ways_with_more_force() {
    for degrees in [0.0, 75.0] {
        let peaks = [0.1, 0.2, 0.4].map(|force| peak(&response(HeldWing::at(degrees), force, DAMPING)));
        println!("held at {degrees} deg: {peaks:?}");
        for pair in peaks.windows(2) {
            assert!(pair[1].stroke < pair[0].stroke && pair[1].frequency < pair[0].frequency, "{pair:?}");
        }
    }
}

/// (iii): "three regimes emerge".
#[test]
fn turning_wing_has_three_regimes() {
    // "(a) for low force amplitudes … behaves as in (ii), with a high drag coefficient": a broad and low peak.
    let low = turning(0.2);
    let held = peak(&response(HeldWing::at(0.0), 0.2, DAMPING));
    assert_close(peak(&low).stroke, held.stroke, 2e-2, "low force");
    assert!((peak(&low).frequency - held.frequency).abs() < 0.025);
    assert!(peak(&low).second.to_degrees() < 15.0);

    // "(c) … an initial broad peak corresponding to the highly damped resonance, followed by a sharp peak", here
    // slightly past the undamped resonance.
    let [broad, sharp] = peaks(&turning(0.4)).try_into().unwrap();
    println!("medium force: {broad:?}, {sharp:?}");
    assert!(broad.frequency < 0.8 && (1.0..1.1).contains(&sharp.frequency));
    assert!(sharp.stroke > 1.2 * broad.stroke);
    assert!(broad.second.to_degrees() < 30.0 && sharp.second.to_degrees() > 60.0);

    // "this resonance frequency decreases with increasing force, but … the normalized amplitude peak actually
    // increases".
    let strong = turning(0.5);
    println!("strong force: {:?}, widths {} and {}", peak(&strong), width(&low), width(&strong));
    assert!(peak(&strong).frequency < sharp.frequency && peak(&strong).stroke > sharp.stroke);
    assert!(width(&strong) < 0.5 * width(&low));

    // "(b) for high force amplitudes … approaches that of (ii) but with a lower drag coefficient": lower again.
    let high = peak(&turning(1.0));
    assert!(high.frequency < peak(&strong).frequency && high.stroke < peak(&strong).stroke);
    let held = peak(&response(HeldWing::at(75.0), 1.0, DAMPING));
    println!("high force: {high:?}, held at 75 deg {held:?}");
    assert_close(high.stroke, held.stroke, 0.2, "high force");
    assert!((high.frequency - held.frequency).abs() < 0.03);
    // With the high drag coefficient it would peak below the static response, if at all.
    let upright = response(HeldWing::at(0.0), 1.0, DAMPING);
    assert!(upright.iter().all(|point| point.stroke < 0.8 * high.stroke));
}

/// "the instantaneous lift-to-drag ratio is maximized at ~70 deg", II-A; "about 50% higher at 70 deg than at
/// 45-50 deg", III-A.
#[test]
fn lift_to_drag_is_largest_near_70_degrees() {
    let curve = |degrees| FIG_3.lift_to_drag(degrees);
    let (angle, ratio) = highest(curve);
    assert_close(angle, 71.07, 1e-3, "angle");
    assert_close(ratio, 1.543, 1e-3, "lift over drag");
    assert_close(ratio / (0.5 * (curve(45.0) + curve(50.0))), 1.52, 5e-3, "gain");
}

/// "instantaneous lift is maximized at 45 deg, and mean lift (for ideal-phase sinusoidal flapping) when the max hinge
/// angle is 51 deg", II-A.
#[test]
fn mean_lift_is_largest_near_51_degrees() {
    let lift = |degrees: f64| FIG_3.lift((2.0 * degrees).to_radians().sin());
    assert_close(highest(lift).0, 45.0, 1e-3, "instantaneous lift");
    assert_close(highest(|degrees| FIG_3.mean_lift(degrees)).0, 50.8, 1e-3, "mean lift");
}
