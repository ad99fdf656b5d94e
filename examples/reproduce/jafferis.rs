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
    preface: "Model `bimorph`. T₁ is Table I (preset `jafferis2016`), T₂ and T₃ its transmission scaled by \
              0.8 and 0.6 as in Fig. 5, the redesign preset `jafferis2016-improved`. Many parameters of \
              Table I are fits to the same vehicle, so agreement tests the transcription and the \
              corrections rather than the physics.",
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
            preface: "Its wings have another shape than those of Table I, whose coefficients the model \
                      has. Values at the model's own largest lift, then at the paper's 155 Hz.",
            quick: true,
            claims: redesign::claims,
        },
        Group { title: "Swept frequencies", preface: "", quick: false, claims: sweep::claims },
        Group { title: "Without numbers in the text", preface: "", quick: true, claims: unchecked },
    ],
};

fn bench() -> Bench {
    // Kinks make the states at the ends of cycles jitter, so that a motion settles no further.
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
        said("Figs. 4, 7", "measured strokes, hinge angles and lifts", "drawn")
            .cannot_be_checked("neither the points nor the voltages are in the text", ""),
        said("II-C", "deflection at DC: about 480 µm peak to peak", "480 µm")
            .cannot_be_checked("the text gives no voltage", ""),
        said("Table II", "the previous vehicle: lift, lift per power", "140 mg, 7 mg/mW")
            .cannot_be_checked("its actuators are not those of Table I, and not described", ""),
    ]
}
