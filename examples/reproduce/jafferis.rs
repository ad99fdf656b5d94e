//! Claims of the paper of Jafferis, Graule and Wood (2016).

mod design;
mod redesign;
mod response;
mod sweep;

use flap_core::model::bimorph::{Constants, Params};

use crate::claim::{Claim, said};
use crate::points::{Bench, Response, steps};
use crate::table::{Group, Paper};

pub(crate) const PAPER: Paper = Paper {
    title: "Jafferis, Graule and Wood (2016)",
    preface: "The [model](../glossary.md#model) for the paper of Jafferis, Graule and Wood is `bimorph`.\n\
              The symbol T is the [transmission ratio](../glossary.md#transmission-ratio).\n\
              The design T₁ has the parameters of Table I in the paper (preset `jafferis2016`).\n\
              The designs T₂ and T₃ have 0.8 times and 0.6 times the transmission ratio of T₁, as in Fig. 5 of the paper.\n\
              The redesigned vehicle of the paper is the preset `jafferis2016-improved`.\n\
              In the paper, many parameters of Table I were fitted to the vehicle of the paper.\n\
              Agreement therefore tests the transcription of the paper and the corrected equations rather than the physics of the model.",
    groups: &[
        Group { title: "From Table I, without a motion", preface: "", quick: true, claims: design::claims },
        Group {
            title: "Frequency responses of Table I and Fig. 5",
            preface: "",
            quick: false,
            claims: response::claims,
        },
        Group {
            title: "The redesigned vehicle",
            preface: "The wings of the redesigned vehicle and of Table I differ in shape, but the preset uses the coefficients of Table I.\n\
                      In rows with two computed numbers, the first number is computed at the frequency of the largest computed lift.\n\
                      The verdict uses the first number.\n\
                      The second number of a row is computed at 155 Hz, the frequency of the largest lift in the paper.",
            quick: true,
            claims: redesign::claims,
        },
        Group { title: "Swept frequencies", preface: "", quick: false, claims: sweep::claims },
        Group { title: "Without numbers in the text", preface: "", quick: true, claims: unchecked },
    ],
};

fn bench() -> Bench {
    // Kinks make the state at the end of a period jitter, so a motion cannot settle to a smaller residual.
    Bench::new("bimorph", 1e-4)
}

/// Returns the design of Table I with a scaled transmission. The scale factor `ratio` is 1 for T₁, 0.8 for T₂
/// and 0.6 for T₃.
fn transmission(ratio: f64) -> Params {
    Params::jafferis2016().with_transmission_scaled(ratio)
}

fn constants(p: &Params) -> Constants<f64> {
    Constants::derive(p).expect("published parameters are possible")
}

/// Returns the settled motions of a design at drive frequencies in steps of 1 Hz.
fn response(p: &Params, drive_voltage_pp: f64, [from, to]: [f64; 2]) -> Response {
    bench().response(&steps(from, to, 1.0), |drive_frequency| {
        Params { drive_voltage_pp, drive_frequency, ..p.clone() }.to_values()
    })
}

fn unchecked() -> Vec<Claim> {
    vec![
        said("Figs. 4, 7", "measured strokes, pitches and lifts", "drawn").cannot_be_checked(
            "the text of the paper gives neither the measured numbers nor the voltages",
            "",
        ),
        said("II-C", "peak-to-peak deflection of the actuator at a constant voltage (DC)", "about 480 µm")
            .cannot_be_checked("the text of the paper gives no voltage", ""),
        said("Table II", "lift and lift per power of the previous vehicle", "140 mg, 7 mg/mW")
            .cannot_be_checked(
                "the actuators of the previous vehicle differ from Table I, and the paper does not \
                 describe these actuators",
                "",
            ),
    ]
}
