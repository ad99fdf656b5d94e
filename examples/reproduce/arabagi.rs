//! Arabagi, Hines and Sitti (2013).

mod control;
mod lift;
mod resonance;
mod reynolds;
mod rotation;

use flap_core::model::four_bar::Params;

use crate::claim::{Claim, said};
use crate::points::{Bench, Response, steps};
use crate::table::{Group, Paper};

pub(crate) const PAPER: Paper = Paper {
    title: "Arabagi, Hines and Sitti (2013)",
    preface: "The model is `four-bar` with the presets `arabagi2013-75hz` and `arabagi2013-30hz`.\n\
              The paper gives neither the wings nor the [actuators](../glossary.md#actuator), and no lifts or amplitudes as numbers.\n\
              The presets assume them, so you can compare only frequencies, trends and ratios.\n\
              **(T)** marks a number to which the assumed values were tuned: agreement proves nothing.\n\
              **(S)** marks a number that was in sight when the values were chosen: agreement is weak evidence.",
    groups: &[
        Group { title: "Resonances", preface: "", quick: false, claims: resonance::claims },
        Group {
            title: "Resonances of small motions",
            preface: "The numbers are peaks of the spectrum of the first second after an impulse.\n\
                      The impulse is sized so that the first mode alone, without damping, would reach 0.5°.\n\
                      In the paper, amplitudes are below 5°, and they are amplitudes of the first link of the four-bar, which moves with the stroke.",
            quick: true,
            claims: resonance::small_motions,
        },
        Group { title: "Lift against frequency", preface: "", quick: false, claims: lift::claims },
        Group { title: "Parts of the lift", preface: "", quick: true, claims: lift::parts },
        Group {
            title: "Voltage, hinge and slider-crank",
            preface: "Figs. 13 to 15 are computed at 70 Hz with the 75 Hz system.",
            quick: false,
            claims: control::claims,
        },
        Group { title: "Reynolds number", preface: "", quick: true, claims: reynolds::claims },
        Group {
            title: "Rotation alone",
            preface: "The stroke is a sinusoid of the measured amplitude.\n\
                      The paper does not give this amplitude as a number, so each row states the assumed one.\n\
                      The paper measures arms from the leading edge instead of the axis of rotation.\n\
                      The preset does the same; this choice was made with such trends in sight.\n\
                      The paper first states that the full simulation underpredicts the stroke by ≈20° peak to peak, then that its larger strokes make more lift.\n\
                      Only the second statement agrees with its lift, so the rows use the second one.",
            quick: true,
            claims: rotation::claims,
        },
        Group { title: "Magnitudes", preface: "", quick: true, claims: unchecked },
    ],
};

/// One of the two systems, with the frequencies its responses are looked at.
struct System {
    name: &'static str,
    params: Params,
    /// From, to and step (Hz).
    range: [f64; 3],
}

fn system_75() -> System {
    System { name: "75 Hz system", params: Params::arabagi2013_75hz(), range: [30.0, 160.0, 1.0] }
}

fn system_30() -> System {
    System { name: "30 Hz system", params: Params::arabagi2013_30hz(), range: [12.0, 70.0, 0.5] }
}

fn bench() -> Bench {
    Bench::new("four-bar", 1e-6)
}

impl System {
    /// The response to frequencies.
    fn response(&self) -> Response {
        let [from, to, step] = self.range;
        bench().response(&steps(from, to, step), |drive_frequency| {
            Params { drive_frequency, ..self.params.clone() }.to_values()
        })
    }

    /// The same system at another voltage.
    fn at(self, drive_voltage_pp: f64) -> System {
        System { params: Params { drive_voltage_pp, ..self.params }, ..self }
    }
}

/// Coefficient of determination of a straight line fitted to points.
fn straightness(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let mean = |of: fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / n;
    let (x_mean, y_mean) = (mean(|point| point.0), mean(|point| point.1));
    let sum =
        |of: &dyn Fn(f64, f64) -> f64| points.iter().map(|(x, y)| of(x - x_mean, y - y_mean)).sum::<f64>();
    let (xx, xy, yy) = (sum(&|x, _| x * x), sum(&|x, y| x * y), sum(&|_, y| y * y));
    xy * xy / (xx * yy)
}

fn unchecked() -> Vec<Claim> {
    const SIZES: &str = "they depend on wings and actuators that the paper does not give";
    vec![said("Figs. 7 to 15", "lifts and amplitudes", "drawn").cannot_be_checked(SIZES, "")]
}
