//! Claims about the rotation of the wing with a prescribed stroke (Figs. 8 and 10).

use flap_core::drive::StrokeParameters;
use flap_core::model::four_bar::{Arms, Params};

use super::{System, bench, system_30, system_75};
use crate::claim::{Claim, assumed, said};
use crate::points::Settled;

pub(super) fn claims() -> Vec<Claim> {
    let mut claims = lags();
    claims.extend(parts());
    claims.push(growth());
    claims.push(large_strokes());
    claims
}

/// Returns the settled motion with a prescribed sinusoidal stroke of `amplitude` (deg).
fn alone(system: &System, drive_frequency: f64, amplitude: f64, arms: Arms) -> Settled {
    let params = Params {
        stroke: StrokeParameters::prescribed(amplitude.to_radians()),
        drive_frequency,
        arms,
        ..system.params.clone()
    };
    bench().point(params.to_values())
}

/// Returns the mean lift of translation and the mean lift of added mass (mN).
fn split(point: &Settled) -> [f64; 2] {
    ["lift_translational_mean_mn", "lift_added_mass_mean_mn"].map(|part| point.get(part))
}

/// Returns claims about the phase lag of the pitch behind the stroke at 95 Hz.
fn lags() -> Vec<Claim> {
    let lag = |amplitude: f64, arms: Arms| alone(&system_75(), 95.0, amplitude, arms).get("pitch_lag_deg");
    let [small, large] = [7.5, 12.5].map(|amplitude| lag(amplitude, Arms::Printed));
    let axis = lag(12.5, Arms::Axis);
    let simulated = |assumption: &str, lag: f64| {
        said(
            "V-B, Fig. 10",
            format!("(S) simulated phase lag of the pitch at 95 Hz and a stroke amplitude of {assumption}"),
            "81°",
        )
        .is(&assumed(81.0, 0.5), lag, format!("phase lag of the pitch {lag:.1}°"))
    };
    vec![
        simulated("7.5°", small),
        simulated("12.5°", large),
        simulated("12.5°, with lever arms from the axis of rotation", axis),
        said("V-B, Fig. 10", "measured phase lag of the pitch behind the stroke at 95 Hz", "138°").is(
            &assumed(138.0, 0.5),
            large,
            format!(
                "phase lag of the pitch {small:.1}° at a stroke amplitude of 7.5°, {large:.1}° at a stroke \
                 amplitude of 12.5°"
            ),
        ),
    ]
}

/// Returns claims about the parts of the lift of the 75 Hz system.
fn parts() -> Vec<Claim> {
    const PLACE: &str = "V-B, Fig. 10b";
    let strokes = [(75.0, [7.5, 10.0, 12.5].as_slice()), (95.0, [7.5, 12.5].as_slice())];
    let mut largest = Vec::new();
    let mut half = Vec::new();
    for (frequency, amplitudes) in strokes {
        let mut shown = Vec::new();
        let mut holds = true;
        for amplitude in amplitudes {
            let [translation, added_mass] = split(&alone(&system_75(), frequency, *amplitude, Arms::Printed));
            holds &= added_mass > translation;
            shown.push(format!(
                "Lift of added mass {added_mass:.3} mN and lift of translation {translation:.3} mN \
                 at a stroke amplitude of {amplitude}°"
            ));
            let ratio = translation / added_mass;
            half.push(
                said(
                    PLACE,
                    format!(
                        "lift of translation divided by lift of added mass in the 75 Hz system at \
                         {frequency} Hz and a stroke amplitude of {amplitude}°"
                    ),
                    "0.5",
                )
                .is(
                    &assumed(0.5, 0.05),
                    ratio,
                    format!("lift of translation is {ratio:.2} times the lift of added mass"),
                ),
            );
        }
        largest.push(
            said(
                PLACE,
                format!("in the 75 Hz system at {frequency} Hz, added mass makes more lift than translation"),
                "added mass is largest",
            )
            .holds(holds, shown.join(". ")),
        );
    }
    largest.extend(half);
    largest
}

/// Returns a claim about a ratio: the translational lift in the full simulation divided by the translational
/// lift with a prescribed stroke.
fn growth() -> Claim {
    let system = system_75();
    let full = bench().point(system.params.to_values());
    let [lift, stroke] = ["lift_translational_mean_mn", "stroke_pp_deg"].map(|column| full.get(column));
    let frequency = system.params.drive_frequency;
    let over = |amplitude: f64| lift / split(&alone(&system, frequency, amplitude, Arms::Printed))[0];
    let amplitude = 0.5 * (stroke - 20.0);
    let [growth, over_10] = [over(amplitude), over(10.0)];
    said(
        "V-B, Figs. 10b, 11",
        "growth of the translational lift of the 75 Hz system in the full simulation, where \
         the stroke is ≈20° larger, peak to peak",
        "eightfold",
    )
    .is(
        &assumed(8.0, 0.5),
        growth,
        format!(
            "translational lift is {growth:.1} times the lift at a prescribed stroke amplitude of {amplitude:.1}° \
             (20° less than {stroke:.1}°, peak to peak). Translational lift is {over_10:.1} times the lift at \
             a prescribed stroke amplitude of 10°"
        ),
    )
}

fn large_strokes() -> Claim {
    let [translation, added_mass] = split(&alone(&system_30(), 30.0, 30.0, Arms::Printed));
    said(
        "V-B, Fig. 8b",
        "translation dominates the lift of the 30 Hz system at 30 Hz and a stroke amplitude of 30°",
        "dominates",
    )
    .holds(
        translation > added_mass,
        format!(
            "lift of translation {translation:.3} mN, lift of added mass {added_mass:.3} mN in the 30 Hz \
             system"
        ),
    )
}
