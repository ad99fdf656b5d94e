//! Claims about the lift as a function of the drive frequency, and about the parts of the lift.

use super::{System, straightness, system_30, system_75};
use crate::claim::{Claim, about, between, said};
use crate::points::Response;

const LIFT: &str = "lift_mean_mn";

pub(super) fn claims() -> Vec<Claim> {
    let [system_75, system_30] = [system_75(), system_30()];
    let mut claims = Vec::new();
    for (system, theirs) in [(&system_75, [75.0, 95.0, 115.0, 140.0]), (&system_30, [30.0, 40.0, 50.0, 60.0])]
    {
        let response = system.response();
        let resonance = response.humps("stroke_pp_deg")[0];
        claims.extend([rise(system, &response, resonance), largest(system, &response, resonance)]);
        claims.push(collapse(system, &response, theirs));
    }
    claims
}

fn rise(system: &System, response: &Response, resonance: f64) -> Claim {
    let mut rising = response.column(LIFT);
    rising.retain(|(frequency, _)| (0.7 * resonance..=resonance).contains(frequency));
    let straightness = straightness(&rising);
    said(
        "VI",
        format!(
            "the lift of the {} rises linearly with the frequency up to the first resonance",
            system.name
        ),
        "linearly",
    )
    .is(
        &about(1.0, 0.01),
        straightness,
        format!(
            "a straight line through the lift from 0.7 times the first resonance frequency to the first \
             resonance frequency has R² = {straightness:.3}"
        ),
    )
}

fn largest(system: &System, response: &Response, resonance: f64) -> Claim {
    let (frequency, _) = response.peak(LIFT);
    said(
        "V-C",
        format!(
            "(S) frequency of the largest lift minus frequency of the first resonance of the {}",
            system.name
        ),
        "10 to 20 Hz",
    )
    .is(
        &between(10.0, 20.0),
        frequency - resonance,
        format!(
            "largest lift of the {} at {frequency:.1} Hz, {:.1} Hz above the first resonance",
            system.name,
            frequency - resonance
        ),
    )
}

fn collapse(system: &System, response: &Response, frequencies: [f64; 4]) -> Claim {
    let at = |column: &str, frequency: f64| {
        let values = response.column(column);
        values.iter().find(|(f, _)| *f == frequency).expect("the frequency is in the response").1
    };
    let lags = frequencies.map(|frequency| at("pitch_lag_deg", frequency));
    let negative = response.column(LIFT).into_iter().rev().take_while(|(_, lift)| *lift < 0.0).last();
    let from = negative.map_or(f64::NAN, |(frequency, _)| frequency);
    let words: Vec<String> =
        lags.iter().zip(frequencies).map(|(lag, f)| format!("{lag:.0}° at {f:.0} Hz")).collect();
    said(
        "V-C",
        format!(
            "(S) above the frequency of the largest lift, the lift of the {} falls sharply as \
             the phase lag of the pitch grows",
            system.name
        ),
        "lag grows to 180°",
    )
    .holds(
        lags.windows(2).all(|pair| pair[1] > pair[0]) && lags[3] > 135.0 && from.is_finite(),
        format!(
            "phase lag of the pitch {}. The lift of the {} is negative from {from:.0} Hz",
            words.join(", "),
            system.name
        ),
    )
}

/// Returns claims about the parts of the lift of each robot, at the drive frequency of the robot's preset.
pub(super) fn parts() -> Vec<Claim> {
    let [split_75, split_30] = [system_75(), system_30()].map(|system| {
        let point = super::bench().point(system.params.to_values());
        ["translational", "added_mass", "rotational"].map(|part| point.get(&format!("lift_{part}_mean_mn")))
    });
    let shown = |name: &str, split: [f64; 3]| {
        format!("lift of translation {:.3} mN, lift of added mass {:.3} mN in the {name}", split[0], split[1])
    };
    let [translational, added_mass, rotational] = split_30;
    vec![
        said(
            "V-B, Fig. 11",
            "(S) in the 75 Hz system, translation makes more lift than added mass",
            "dominant",
        )
        .holds(split_75[0] > split_75[1], shown("75 Hz system", split_75)),
        said(
            "IV-A, Fig. 7b",
            "(S) in the 30 Hz system, most lift comes from translation and little lift from added mass",
            "most",
        )
        .holds(
            translational > 0.5 * (translational + added_mass + rotational),
            shown("30 Hz system", split_30),
        ),
        said("IV-A, Fig. 7b", "the rotational lift of the 30 Hz system is very low", "very low").holds(
            rotational.abs() < 0.05 * translational,
            format!("rotational lift of the 30 Hz system {rotational:.3} mN"),
        ),
    ]
}
