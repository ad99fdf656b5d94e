//! Claims about the frequencies at which the stroke has a peak.

use flap_experiments::free::FreeMotion;

use super::{bench, system_30, system_75};
use crate::claim::{Claim, assumed, closely, said};
use crate::points::Response;

const STROKE: &str = "stroke_pp_deg";

pub(super) fn claims() -> Vec<Claim> {
    let [response_75, response_30] = [system_75(), system_30()].map(|system| system.response());
    let [gentle_75, gentle_30] = [system_75().at(20.0), system_30().at(20.0)].map(|system| system.response());
    let [humps_75, humps_30] = [&response_75, &response_30].map(|response| response.humps(STROKE));
    let [second_75, second_30] = [&gentle_75, &gentle_30].map(|response| peak(&response.humps(STROKE), 1));
    let mut claims = vec![
        frequency(
            "V-B, Fig. 11",
            "(T) frequency of the first stroke peak of the 75 Hz system",
            75.0,
            ("first stroke peak of the 75 Hz system", peak(&humps_75, 0)),
        ),
        frequency(
            "V-B, Fig. 11",
            "(T) simulated frequency of the second stroke peak of the 75 Hz system",
            115.0,
            ("second stroke peak of the 75 Hz system", peak(&humps_75, 1)),
        ),
        said(
            "V-C",
            "the frequency of the second stroke peak of the 75 Hz system falls with a stronger drive",
            "129 to 115 Hz",
        )
        .holds(
            peak(&humps_75, 1) < second_75,
            format!(
                "second stroke peak of the 75 Hz system at {second_75:.0} Hz with 20 V, at {:.0} Hz with 150 V",
                peak(&humps_75, 1)
            ),
        ),
        frequency(
            "V-A, Fig. 9",
            "(T) frequency of the first stroke peak of the 30 Hz system",
            30.0,
            ("first stroke peak of the 30 Hz system", peak(&humps_30, 0)),
        ),
        said("V-A, Fig. 8", "measured frequency of the second stroke peak of the 30 Hz system", "36 Hz").is(
            &closely(36.0, 0.5),
            peak(&humps_30, 1),
            if humps_30.len() > 1 {
                format!("second stroke peak of the 30 Hz system at {:.1} Hz", peak(&humps_30, 1))
            } else {
                format!(
                    "no second stroke peak of the 30 Hz system up to {:.0} Hz at 180 V. Second stroke peak at \
                     {second_30:.1} Hz with 20 V",
                    system_30().range[1]
                )
            },
        ),
    ];
    for (name, response) in [("75 Hz system", &response_75), ("30 Hz system", &response_30)] {
        let [low, high] = half_power_band(response);
        let quality = response.peak(STROKE).0 / (high - low);
        claims.push(said("V-A", format!("quality factor of the stroke response of the {name}"), "≈ 2").is(
            &assumed(2.0, 0.05),
            quality,
            format!(
                "quality factor of the {name} {quality:.2} (half-power band from {low:.1} to {high:.1} Hz)"
            ),
        ));
    }
    claims
}

/// Returns claims about the free motion of the 75 Hz system after an impulse.
pub(super) fn small_motions() -> Vec<Claim> {
    let values = system_75().params.to_values();
    let modes = bench().experiments().modes(&values).expect("the preset is possible");
    let FreeMotion { spectra, .. } = bench().spectra(&values, 0.5_f64.to_radians());
    let [stroke, pitch] = ["stroke", "pitch"].map(|name| {
        let (_, peaks) = spectra.iter().find(|(signal, _)| *signal == name).expect("it is a signal");
        let mut peaks: Vec<f64> = peaks.iter().map(|peak| peak.frequency).collect();
        peaks.sort_by(f64::total_cmp);
        peaks
    });
    let claim = |index: usize, statement: &str, published: f64| {
        let computed = peak(&stroke, index);
        said("V-C, Fig. 12", statement, format!("{published:.0} Hz")).is(
            &closely(published, 0.5),
            computed,
            format!(
                "peak of the 75 Hz system at {computed:.1} Hz for the stroke, {:.1} Hz for the pitch, {:.1} Hz \
                 for the undamped mode",
                peak(&pitch, index),
                modes[index].frequency
            ),
        )
    };
    vec![
        claim(0, "(T) frequency of the first peak of the 75 Hz system at amplitudes below 5°", 78.0),
        claim(1, "(T) frequency of the second peak of the 75 Hz system at amplitudes below 5°", 129.0),
    ]
}

/// Returns the frequency of peak number `index`, or NaN if the response has fewer peaks.
fn peak(humps: &[f64], index: usize) -> f64 {
    humps.get(index).copied().unwrap_or(f64::NAN)
}

fn frequency(
    place: &'static str,
    statement: &str,
    published: f64,
    (quantity, computed): (&str, f64),
) -> Claim {
    said(place, statement, format!("{published:.0} Hz")).is(
        &closely(published, 0.5),
        computed,
        format!("{quantity} at {computed:.1} Hz"),
    )
}

/// Returns the ends of the frequency band in which the stroke is at least 1/√2 of the largest stroke. The
/// ends of the band are interpolated between the computed frequencies.
fn half_power_band(response: &Response) -> [f64; 2] {
    let strokes = response.column(STROKE);
    let (peak, point) = response.peak(STROKE);
    let half = point.get(STROKE) * core::f64::consts::FRAC_1_SQRT_2;
    let crossing = |pair: &[(f64, f64)]| {
        let [(f_0, s_0), (f_1, s_1)] = [pair[0], pair[1]];
        ((s_0 < half) != (s_1 < half)).then(|| f_0 + (f_1 - f_0) * (half - s_0) / (s_1 - s_0))
    };
    let crossings: Vec<f64> = strokes.windows(2).filter_map(crossing).collect();
    let below = crossings.iter().copied().filter(|f| *f < peak).fold(f64::NAN, f64::max);
    let above = crossings.iter().copied().filter(|f| *f > peak).fold(f64::NAN, f64::min);
    [below, above]
}
