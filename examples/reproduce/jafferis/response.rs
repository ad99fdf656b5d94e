//! Claims about the frequency responses of the design of Table I and of the scaled transmissions of Fig. 5.

use super::{bench, response, transmission};
use crate::claim::{Claim, about, said};
use crate::points::{Response, steps};
use flap_core::model::bimorph::Params;

const PER_VOLT: &str = "stroke_pp_deg_per_v";

pub(super) fn claims() -> Vec<Claim> {
    let families =
        [(1.0, [95.0, 140.0]), (0.8, [115.0, 175.0]), (0.6, [150.0, 230.0])].map(|(ratio, range)| {
            [160.0, 180.0, 200.0, 240.0].map(|voltage| response(&transmission(ratio), voltage, range))
        });
    let mut claims = regimes();
    claims.extend([steep_rise(&families), phase(&families)]);
    claims.extend(small_peaks());
    claims.extend(scaling(&families));
    claims
}

/// The responses of the transmissions T₁, T₂ and T₃, each at 160, 180, 200 and 240 V.
type Families = [[Response; 4]; 3];

/// Index of the response at 160 V in the four responses of one transmission. The next constant contains the
/// index for 200 V.
const V_160: usize = 0;
const V_200: usize = 2;

/// Returns claims about the three regimes of motion in section II-A, for the transmission T₁.
fn regimes() -> Vec<Claim> {
    let at = |voltage: f64| response(&transmission(1.0), voltage, [80.0, 160.0]);
    let [low, middle, sharp, high] = [80.0, 140.0, 160.0, 200.0].map(at);
    let peak = |response: &Response| {
        let (frequency, point) = response.peak(PER_VOLT);
        (frequency, point.get(PER_VOLT))
    };
    let [(f_low, r_low), (f_sharp, r_sharp), (f_high, r_high)] = [&low, &sharp, &high].map(peak);
    let humps = middle.humps(PER_VOLT);
    vec![
        said(
            "II-A (a)",
            "at a low drive force, the frequency response of the stroke has one broad peak",
            "one peak",
        )
        .holds(
            low.humps(PER_VOLT).len() == 1,
            format!("one stroke peak of design T₁ at 80 V: {r_low:.3}° of stroke per volt at {f_low:.0} Hz"),
        ),
        said(
            "II-A (c), Fig. 4a",
            "at a medium drive force, the frequency response of the stroke has a broad peak, \
             then a sharp peak",
            "two peaks",
        )
        .holds(
            humps.len() == 2,
            format!("stroke peaks of design T₁ at {} Hz with a voltage of 140 V", list(&humps)),
        ),
        said("II-A (c)", "the frequency of the sharp stroke peak falls as the drive force grows", "falls")
            .holds(
                f_high < f_sharp,
                format!(
                    "sharp stroke peak of design T₁ at {f_sharp:.0} Hz for 160 V, at {f_high:.0} Hz for 200 V"
                ),
            ),
        said("II-A (c)", "the stroke per volt at the sharp peak rises as the drive force grows", "rises")
            .holds(
                r_high > r_sharp && r_sharp > r_low,
                format!("stroke per volt of design T₁ {r_sharp:.3} °/V at 160 V, {r_high:.3} °/V at 200 V"),
            ),
    ]
}

/// Returns the peak pitch at the lowest frequency at which the stroke rises by more than 1° per Hz. The slope
/// is a central difference.
fn onset(response: &Response) -> f64 {
    let strokes = response.column("stroke_pp_deg");
    let angles = response.column("pitch_peak_deg");
    let steep = strokes.windows(3).position(|three| three[2].1 - three[0].1 > 2.0);
    steep.map_or(f64::NAN, |i| angles[i + 1].1)
}

fn steep_rise(families: &Families) -> Claim {
    let angles: Vec<f64> = families.iter().flatten().map(onset).collect();
    let (low, high) = extremes(&angles);
    said("II-A, Fig. 4", "peak pitch at the frequency where the stroke starts to rise steeply", "around 50°")
        .is(
            &about(50.0, 0.5),
            farther_from(50.0, low, high),
            format!("peak pitch {low:.1}° to {high:.1}° for the designs T₁, T₂ and T₃ at 160 to 240 V"),
        )
}

fn phase(families: &Families) -> Claim {
    let lags: Vec<f64> = families
        .iter()
        .flatten()
        .map(|response| response.peak("stroke_pp_deg").1.get("pitch_lag_deg").abs())
        .collect();
    let (low, high) = extremes(&lags);
    said(
        "II-A",
        "phase difference between stroke and pitch at the frequency of the largest stroke",
        "near 90°",
    )
    .is(
        &about(90.0, 0.5),
        farther_from(90.0, low, high),
        format!("phase difference {low:.0}° to {high:.0}° for the designs T₁, T₂ and T₃ at 160 to 240 V"),
    )
}

fn small_peaks() -> Vec<Claim> {
    let response = bench().response(&steps(30.0, 70.0, 0.5), |drive_frequency| {
        Params { drive_voltage_pp: 160.0, drive_frequency, ..transmission(1.0) }.to_values()
    });
    let humps = response.humps("pitch_peak_deg");
    [("first", 35.0), ("second", 60.0)]
        .map(|(which, published)| {
            let nearest =
                humps.iter().copied().min_by(|a, b| (a - published).abs().total_cmp(&(b - published).abs()));
            let nearest = nearest.unwrap_or(f64::NAN);
            said(
                "II-C",
                format!("frequency of the {which} small peak of the pitch in the simulation of the paper"),
                format!("about {published:.0} Hz"),
            )
            .is(
                &about(published, 0.5),
                nearest,
                format!("pitch peak of design T₁ at {nearest:.1} Hz for 160 V"),
            )
        })
        .into()
}

/// Returns claims about the effect of a lower transmission ratio (section III-A).
fn scaling(families: &Families) -> Vec<Claim> {
    let [t_1, t_2, t_3] = families;
    let mut claims = Vec::new();
    for (name, scaled, ratio) in [("T₂", t_2, 0.8_f64), ("T₃", t_3, 0.6)] {
        let frequency = |response: &Response| response.peak("stroke_pp_deg").0;
        let [f_1, f_r] = [&t_1[V_160], &scaled[V_160]].map(frequency);
        claims.push(
            said(
                "III-A",
                format!(
                    "frequency of the largest stroke at 160 V, design {name} divided by design T₁, if \
                     the frequency is proportional to 1/T"
                ),
                format!("{:.2}", 1.0 / ratio),
            )
            .is(
                &about(1.0 / ratio, 0.005),
                f_r / f_1,
                format!(
                    "ratio of the frequencies {:.2} (largest stroke of design T₁ at {f_1:.0} Hz, of design \
                     {name} at {f_r:.0} Hz)",
                    f_r / f_1
                ),
            ),
        );
        for (voltage, v) in [(160, V_160), (200, V_200)] {
            let expected = ratio.powf(-1.47);
            let gain = lift(&scaled[v]) / lift(&t_1[v]);
            claims.push(
                said(
                    "III-A",
                    format!(
                        "largest mean lift at {voltage} V, design {name} divided by design T₁, if the lift \
                         is proportional to 1/T^1.47"
                    ),
                    format!("{expected:.2}"),
                )
                .is(
                    &about(expected, 0.005),
                    gain,
                    format!(
                        "largest mean lift of design {name} is {gain:.2} times the lift of design T₁ at \
                         {voltage} V"
                    ),
                ),
            );
        }
        let expected = ratio.powf(-0.47);
        let efficiency =
            |response: &Response| response.peak("vehicle_lift_mgf").1.get("efficiency_capacitive_gf_per_w");
        let gain = efficiency(&scaled[V_160]) / efficiency(&t_1[V_160]);
        claims.push(
            said(
                "III-A",
                format!(
                    "lift per power at the largest lift with 160 V, design {name} divided by design T₁, \
                     if lift per power is proportional to 1/T^0.47"
                ),
                format!("{expected:.2}"),
            )
            .is(
                &about(expected, 0.005),
                gain,
                format!(
                    "lift per power of design {name} is {gain:.2} times the lift per power of design T₁ \
                     at 160 V"
                ),
            ),
        );
    }
    let (at, best) = t_2[V_200].peak("vehicle_lift_mgf");
    let predicted = best.get("vehicle_lift_mgf");
    claims.push(
        said(
            "IV",
            "lift of the vehicle with design T₂, which the paper scales from 140 mg (the agreement \
             with flap is chance)",
            "~290 mg",
        )
        .is(
            &about(290.0, 5.0),
            predicted,
            format!("lift of the vehicle with design T₂ {predicted:.1} mg at 200 V and {at:.0} Hz"),
        ),
    );
    claims
}

/// Returns the largest lift of the vehicle in a response (mg).
fn lift(response: &Response) -> f64 {
    response.peak("vehicle_lift_mgf").1.get("vehicle_lift_mgf")
}

fn extremes(values: &[f64]) -> (f64, f64) {
    let smallest = values.iter().copied().fold(f64::INFINITY, f64::min);
    (smallest, values.iter().copied().fold(f64::NEG_INFINITY, f64::max))
}

fn farther_from(from: f64, a: f64, b: f64) -> f64 {
    if (a - from).abs() > (b - from).abs() { a } else { b }
}

fn list(values: &[f64]) -> String {
    values.iter().map(|value| format!("{value:.0}")).collect::<Vec<_>>().join(" and ")
}
