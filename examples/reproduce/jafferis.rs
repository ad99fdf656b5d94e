//! Jafferis, Graule and Wood (2016).

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
    preface: "The [model](../glossary.md#model) is `bimorph`.\n\
              T₁ is Table I (preset `jafferis2016`).\n\
              T₂ and T₃ scale its [transmission ratio](../glossary.md#transmission-ratio) by 0.8 and 0.6, as in Fig. 5.\n\
              The redesign is the preset `jafferis2016-improved`.\n\
              Many parameters of Table I were fitted to the same vehicle.\n\
              Agreement therefore tests the transcription and the corrections rather than the physics.",
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
            preface: "The redesigned wings have another shape than the wings of Table I, but the model uses the coefficients of Table I.\n\
                      Rows with two values give the value at the largest lift of the model, then the value at 155 Hz, as in the paper.",
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

/// The design with the transmission of Table I scaled: 1 for T₁, 0.8 for T₂, 0.6 for T₃.
fn transmission(ratio: f64) -> Params {
    Params::jafferis2016().with_transmission_scaled(ratio)
}

fn constants(p: &Params) -> Constants<f64> {
    Constants::derive(p).expect("published parameters are possible")
}

/// The response of a design to frequencies, in steps of 1 Hz.
fn response(p: &Params, drive_voltage_pp: f64, [from, to]: [f64; 2]) -> Response {
    bench().response(&steps(from, to, 1.0), |drive_frequency| {
        Params { drive_voltage_pp, drive_frequency, ..p.clone() }.to_values()
    })
}

fn unchecked() -> Vec<Claim> {
    vec![
        said("Figs. 4, 7", "measured strokes, pitches and lifts", "drawn")
            .cannot_be_checked("neither the points nor the voltages are in the text", ""),
        said("II-C", "peak-to-peak deflection at DC", "about 480 µm")
            .cannot_be_checked("the text gives no voltage", ""),
        said("Table II", "previous vehicle: lift, and lift per power", "140 mg, 7 mg/mW")
            .cannot_be_checked("its actuators differ from Table I and are not described", ""),
    ]
}
