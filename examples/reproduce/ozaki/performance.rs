//! Claims about motion, lift, power and efficiency (section 4.3 and Figs. 13 to 17).

use super::{Type, large, small};
use crate::claim::{Claim, measured, said};
use crate::points::Settled;

/// Published efficiency of the small actuator at its largest drive voltage (gf/W). The next constant is the
/// efficiency of the large actuator.
pub(super) const SMALL: f64 = 10.8;
pub(super) const LARGE: f64 = 7.31;

pub(super) fn efficiency(point: &Settled) -> f64 {
    point.get("efficiency_gf_per_w")
}

pub(super) fn claims() -> Vec<Claim> {
    let types = [small(), large()];
    let [points_small, points_large] = types.each_ref().map(Type::performance);
    let [[s_15, s_30], [l_20, l_50]] =
        [&points_small, &points_large].map(|points| points.each_ref().map(efficiency));
    let mut claims = vec![
        said("4.3, Fig. 17", "efficiency of the small type at 30 V and 209 Hz", "10.8 gf/W").is(
            &measured(SMALL, 0.05),
            s_30,
            format!("efficiency of the small type {s_30:.2} gf/W"),
        ),
        said("4.3, Fig. 17", "efficiency of the large type at 50 V and 109 Hz", "7.31 gf/W").is(
            &measured(LARGE, 0.005),
            l_50,
            format!("efficiency of the large type {l_50:.2} gf/W"),
        ),
        said("4.3, Fig. 17", "the small type is more efficient than the large type", "10.8 > 7.31 gf/W")
            .holds(
                s_30 > l_50,
                format!(
                    "efficiency {s_30:.2} gf/W of the small type at 30 V, {l_50:.2} gf/W of the large \
                     type at 50 V"
                ),
            ),
        said("4.3, Fig. 17", "the efficiency of the small type falls as the voltage rises", "falls").holds(
            s_30 < s_15,
            format!("efficiency of the small type {s_15:.2} gf/W at 15 V, {s_30:.2} gf/W at 30 V"),
        ),
        said("4.3, Fig. 17", "the efficiency of the large type falls as the voltage rises", "falls").holds(
            l_50 < l_20,
            format!("efficiency of the large type {l_20:.2} gf/W at 20 V, {l_50:.2} gf/W at 50 V"),
        ),
        said(
            "4.3",
            "errors of the calculated stroke, pitch, lift and power relative to the measurements \
             of the paper",
            "20, 8.1, 15, 8.7 %",
        )
        .cannot_be_checked("the paper shows the measured points only in figures", ""),
    ];
    for (actuator, points) in types.iter().zip([&points_small, &points_large]) {
        for (v_0, point) in actuator.voltages.iter().zip(points) {
            claims.push(drawn(actuator, *v_0, point));
        }
    }
    claims
}

fn drawn(actuator: &Type, v_0: f64, point: &Settled) -> Claim {
    let Type { name, frequency, .. } = actuator;
    let computed = format!(
        "amplitudes of the {name} type: stroke {:.2}° and pitch {:.1}°. Mean lift {:.4} gf, mean power \
         {:.2} mW",
        point.get("stroke_amplitude_deg"),
        point.get("pitch_amplitude_deg"),
        point.get("lift_mean_gf"),
        point.get("power_mean_mw"),
    );
    let statement = format!(
        "amplitudes of stroke and pitch, mean lift and mean power of the {name} type at \
         {v_0:.0} V and {frequency:.0} Hz"
    );
    said("Figs. 13 to 16", statement, "drawn")
        .cannot_be_checked("the paper shows the calculated curves only in figures", computed)
}
