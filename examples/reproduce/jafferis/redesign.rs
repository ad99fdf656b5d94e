//! The redesigned vehicle of sections III-B and IV, at 200 V.

use flap_core::model::bimorph::Params;

use super::{bench, response};
use crate::claim::{Claim, about, closely, measured, said};

pub(super) fn claims() -> Vec<Claim> {
    let design = Params::jafferis2016_improved();
    let response = response(&design, 200.0, [145.0, 170.0]);
    let (resonance, _) = response.peak("stroke_pp_deg");
    let (frequency, best) = response.peak("vehicle_lift_mgf");
    let theirs = bench().point(design.to_values());
    let both = |column: &str| [best.get(column), theirs.get(column)];
    let [lift, lift_155] = both("vehicle_lift_mgf");
    let [stroke, stroke_155] = both("stroke_pp_deg");
    let [ratio, ratio_155] = both("efficiency_capacitive_gf_per_w");
    let [angle, angle_155] = both("pitch_peak_deg");
    let [payload, payload_155] = both("payload_mg");
    let power = 2.0 * theirs.get("power_capacitive_mw");
    vec![
        said("IV", "resonance", "around 160 Hz").is(
            &about(160.0, 0.5),
            resonance,
            format!("{resonance:.0} Hz"),
        ),
        said("IV, Fig. 7b", "frequency of the largest lift", "155 Hz").is(
            &closely(155.0, 0.5),
            frequency,
            format!("{frequency:.0} Hz"),
        ),
        said("IV", "stroke, peak to peak", "92°").is(
            &measured(92.0, 0.5),
            stroke,
            format!("{stroke:.1}°; {stroke_155:.1}°"),
        ),
        said("abstract, III-A", "hinge angle of the best operation", "about 70°").is(
            &about(70.0, 5.0),
            angle,
            format!("{angle:.1}°; {angle_155:.1}°"),
        ),
        said("IV, Table II", "mean lift", "320 mg").is(
            &measured(320.0, 5.0),
            lift,
            format!("{lift:.0} mg; {lift_155:.0} mg"),
        ),
        said("IV", "power of both actuators, ½C V² f at 155 Hz", "31 mW").is(
            &closely(31.0, 0.5),
            power,
            format!("{power:.1} mW"),
        ),
        said("Table II", "lift over power", "10.3 mg/mW").is(
            &measured(10.3, 0.05),
            ratio,
            format!("{ratio:.1} mg/mW; {ratio_155:.1} mg/mW"),
        ),
        said("Table II", "payload", "170 mg").is(
            &measured(170.0, 5.0),
            payload,
            format!("{payload:.0} mg; {payload_155:.0} mg"),
        ),
    ]
}
