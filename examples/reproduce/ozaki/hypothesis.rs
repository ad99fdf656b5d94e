//! Claims with corrected numbers of Table A1, which test hypotheses about misprints in the table.

use flap_core::model::direct_drive::Params;

use super::performance::{LARGE, SMALL, efficiency};
use super::resonance::{self, after_an_impulse, largest_stroke_of_large, largest_stroke_of_small};
use super::{Type, large, small};
use crate::claim::{Claim, measured, said};

/// Inertia of the leading edge of the small actuator (kg·m²). Compared with Table A1, one digit is changed.
const LIGHTER: f64 = 3.39e-9;

/// Texts that name a hypothesis at the end of the statement of a claim.
const SWAPPED: &str = ", with swapped hinge stiffnesses k_w";
const SMALLER: &str = ", with J_B = 3.39e-9 kg·m² (small type)";
const BOTH: &str = ", with swapped hinge stiffnesses k_w and J_B = 3.39e-9 kg·m² (small type)";

/// Actuators with the parameters of Table A1, after one or both hypothetical misprints are corrected.
struct Variants {
    swapped_small: Type,
    swapped_large: Type,
    lighter_small: Type,
    both: Type,
}

fn variants() -> Variants {
    let (table_small, table_large) = (Params::ozaki2018_small(), Params::ozaki2018_large());
    let swapped = Params { hinge_stiffness: table_large.hinge_stiffness, ..table_small.clone() };
    let swapped_large = Params { hinge_stiffness: table_small.hinge_stiffness, ..table_large };
    Variants {
        lighter_small: Type { params: lighter(&small().params), ..small() },
        both: Type { params: lighter(&swapped), ..small() },
        swapped_small: Type { params: swapped, ..small() },
        swapped_large: Type { params: swapped_large, ..large() },
    }
}

pub(super) fn claims() -> Vec<Claim> {
    let Variants { swapped_small, swapped_large, lighter_small, both } = variants();
    let mut claims = efficiencies(SWAPPED, &swapped_small, &swapped_large);
    claims.push(after_an_impulse(SWAPPED, &swapped_small, &resonance::SMALL));
    claims.push(after_an_impulse(SWAPPED, &swapped_large, &resonance::LARGE));
    claims.extend(efficiencies(SMALLER, &lighter_small, &large()));
    claims.push(after_an_impulse(SMALLER, &lighter_small, &resonance::SMALL));
    claims.extend(efficiencies(BOTH, &both, &swapped_large));
    claims.push(after_an_impulse(BOTH, &both, &resonance::SMALL));
    claims
}

/// Returns claims about measured resonances.
pub(super) fn driven() -> Vec<Claim> {
    let Variants { swapped_small, swapped_large, lighter_small, both } = variants();
    vec![
        largest_stroke_of_small(SWAPPED, &swapped_small, [185.0, 212.0]),
        largest_stroke_of_large(SWAPPED, &swapped_large, [100.0, 118.0]),
        largest_stroke_of_small(SMALLER, &lighter_small, [185.0, 212.0]),
        largest_stroke_of_small(BOTH, &both, [185.0, 212.0]),
    ]
}

fn lighter(p: &Params) -> Params {
    Params { leading_edge_inertia: LIGHTER, ..p.clone() }
}

/// Returns claims about the efficiencies at the largest drive voltages.
fn efficiencies(hypothesis: &str, small: &Type, large: &Type) -> Vec<Claim> {
    let [s, l] = [small, large].map(|actuator| efficiency(&actuator.performance()[1]));
    vec![
        said(
            "4.3, Fig. 17",
            format!("efficiency of the small type at 30 V and 209 Hz{hypothesis}"),
            "10.8 gf/W",
        )
        .is(&measured(SMALL, 0.05), s, format!("efficiency of the small type {s:.2} gf/W")),
        said(
            "4.3, Fig. 17",
            format!("efficiency of the large type at 50 V and 109 Hz{hypothesis}"),
            "7.31 gf/W",
        )
        .is(&measured(LARGE, 0.005), l, format!("efficiency of the large type {l:.2} gf/W")),
        said(
            "4.3, Fig. 17",
            format!("the small type is more efficient than the large type{hypothesis}"),
            "10.8 > 7.31 gf/W",
        )
        .holds(
            s > l,
            format!(
                "efficiency {s:.2} gf/W of the small type at 30 V, {l:.2} gf/W of the large type at 50 V"
            ),
        ),
    ]
}
