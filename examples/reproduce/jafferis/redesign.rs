//! Claims about the redesigned vehicle of sections III-B and IV, at 200 V.

use flap_core::model::bimorph::Params;

use super::{bench, response};
use crate::claim::{Claim, about, closely, measured, said};

pub(super) fn claims() -> Vec<Claim> {
    let design = Params::jafferis2016_improved();
    let response = response(&design, 200.0, [145.0, 170.0]);
    let (resonance, _) = response.peak("stroke_pp_deg");
    let (frequency, best) = response.peak("vehicle_lift_mgf");
    let theirs = bench().point(design.to_values());
    // The number at the largest lift, shown with that at 155 Hz.
    let both = |name: &str, column: &str, decimals: usize, unit: &str| {
        let [here, at_155] = [best.get(column), theirs.get(column)];
        (
            here,
            format!(
                "{name} of the redesigned vehicle {here:.decimals$}{unit} at {frequency:.0} Hz, \
                 {at_155:.decimals$}{unit} at 155 Hz"
            ),
        )
    };
    let (stroke, strokes) = both("stroke (peak to peak)", "stroke_pp_deg", 1, "°");
    let (angle, angles) = both("peak pitch", "pitch_peak_deg", 1, "°");
    let (lift, lifts) = both("mean lift", "vehicle_lift_mgf", 0, " mg");
    let (ratio, ratios) = both("lift per power", "efficiency_capacitive_gf_per_w", 1, " mg/mW");
    let (payload, payloads) = both("payload", "payload_mg", 0, " mg");
    let power = 2.0 * theirs.get("power_capacitive_mw");
    vec![
        said("IV", "resonance frequency of the redesigned vehicle", "around 160 Hz").is(
            &about(160.0, 0.5),
            resonance,
            format!("largest stroke of the redesigned vehicle at {resonance:.0} Hz"),
        ),
        said("IV, Fig. 7b", "frequency of the largest lift of the redesigned vehicle", "155 Hz").is(
            &closely(155.0, 0.5),
            frequency,
            format!("largest lift of the redesigned vehicle at {frequency:.0} Hz"),
        ),
        said("IV", "stroke of the redesigned vehicle, peak to peak", "92°").is(
            &measured(92.0, 0.5),
            stroke,
            strokes,
        ),
        said(
            "abstract, III-A",
            "peak pitch of the redesigned vehicle at the best operating point",
            "about 70°",
        )
        .is(&about(70.0, 5.0), angle, angles),
        said("IV, Table II", "mean lift of the redesigned vehicle", "320 mg").is(
            &measured(320.0, 5.0),
            lift,
            lifts,
        ),
        said(
            "IV",
            "power of both actuators of the redesigned vehicle at 155 Hz, computed as ½C V² f",
            "31 mW",
        )
        .is(&closely(31.0, 0.5), power, format!("power of both actuators {power:.1} mW at 155 Hz")),
        said("Table II", "lift per power of the redesigned vehicle", "10.3 mg/mW").is(
            &measured(10.3, 0.05),
            ratio,
            ratios,
        ),
        said("Table II", "payload of the redesigned vehicle", "170 mg").is(
            &measured(170.0, 5.0),
            payload,
            payloads,
        ),
    ]
}
