//! What Table A1 might have been.

use flap_core::model::direct_drive::Params;

use super::performance::{LARGE, SMALL, efficiency};
use super::{Type, large, resonance, small};
use crate::claim::{Claim, measured, said};

/// Inertia of the small type's leading edge (kg·m²), with one digit of Table A1 changed.
const LIGHTER: f64 = 3.39e-9;

pub(super) fn claims() -> Vec<Claim> {
    let swapped_small = Type { params: Params::ozaki2018_small_kw_swapped(), ..small() };
    let swapped_large = Type { params: Params::ozaki2018_large_kw_swapped(), ..large() };
    let lighter_small = Type { params: lighter(&small().params), ..small() };
    let both = Type { params: lighter(&swapped_small.params), ..small() };

    let mut claims = efficiencies("k_w swapped", &swapped_small, &swapped_large);
    claims.push(resonance_of_small("k_w swapped", &swapped_small));
    claims.push(resonance::of(&swapped_large, [100.0, 118.0]).calculated(
        "k_w swapped, large type",
        "109 Hz",
        109.0,
    ));
    claims.extend(efficiencies("J_B lighter", &lighter_small, &large()));
    claims.push(resonance_of_small("J_B lighter", &lighter_small));
    claims.extend(efficiencies("both", &both, &swapped_large));
    claims.push(resonance_of_small("both", &both));
    claims
}

fn lighter(p: &Params) -> Params {
    Params { leading_edge_inertia: LIGHTER, ..p.clone() }
}

/// Efficiencies at the largest voltages.
fn efficiencies(hypothesis: &str, small: &Type, large: &Type) -> Vec<Claim> {
    let [s, l] = [small, large].map(|actuator| efficiency(&actuator.performance()[1]));
    vec![
        said("4.3, Fig. 17", format!("{hypothesis}: efficiency of the small type"), "10.8 gf/W").is(
            &measured(SMALL, 0.05),
            s,
            format!("{s:.2} gf/W"),
        ),
        said("4.3, Fig. 17", format!("{hypothesis}: efficiency of the large type"), "7.31 gf/W").is(
            &measured(LARGE, 0.005),
            l,
            format!("{l:.2} gf/W"),
        ),
        said(
            "4.3, Fig. 17",
            format!("{hypothesis}: the small type is the more efficient one"),
            "10.8 > 7.31",
        )
        .holds(s > l, format!("{s:.2} and {l:.2}")),
    ]
}

fn resonance_of_small(hypothesis: &str, small: &Type) -> Claim {
    let what = format!("{hypothesis}, small type");
    resonance::of(small, [185.0, 212.0]).calculated(&what, "209 Hz", 208.5)
}
