//! Claims of the paper of Arabagi, Hines and Sitti (2013).

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
    preface: "The model for the paper of Arabagi, Hines and Sitti is `four-bar`.\n\
              The 75 Hz system of the paper is the preset `arabagi2013-75hz`, and the 30 Hz system is the preset `arabagi2013-30hz`.\n\
              The paper describes neither the wings nor the [actuators](../glossary.md#actuator), and gives no numbers for lifts or amplitudes.\n\
              The presets contain assumed wings and actuators, so you can compare only frequencies, trends and ratios.\n\
              The mark **(T)** stands for a published number to which the assumed parameters were tuned, so agreement proves nothing.\n\
              The mark **(S)** stands for a published number that was known when the assumed parameters were chosen, so agreement is weak evidence.",
    groups: &[
        Group { title: "Resonances", preface: "", quick: false, claims: resonance::claims },
        Group {
            title: "Resonances of small motions",
            preface: "The computed numbers are frequencies of peaks in the spectra of stroke and pitch during the first second after an impulse.\n\
                      The impulse is sized so that the stroke of the first mode alone, without damping, would reach 0.5°.\n\
                      In the paper, the first link of the four-bar has amplitudes below 5°.\n\
                      The first link of the four-bar moves with the stroke.",
            quick: true,
            claims: resonance::small_motions,
        },
        Group { title: "Lift against frequency", preface: "", quick: false, claims: lift::claims },
        Group { title: "Parts of the lift", preface: "", quick: true, claims: lift::parts },
        Group {
            title: "Voltage, hinge and slider-crank",
            preface: "The rows about Figs. 13 to 15 are computed with the 75 Hz system at 70 Hz.",
            quick: false,
            claims: control::claims,
        },
        Group { title: "Reynolds number", preface: "", quick: true, claims: reynolds::claims },
        Group {
            title: "Rotation alone",
            preface: "The rows about rotation alone compute the pitch for a prescribed stroke, which is a sinusoid of the measured amplitude.\n\
                      The paper does not give the measured stroke amplitude as a number, so each row states an assumed amplitude.\n\
                      The paper measures the lever arms of the air forces from the leading edge instead of the axis of rotation.\n\
                      The preset also measures the lever arms from the leading edge.\n\
                      The lever arms of the preset were chosen when the trends of the paper were known.\n\
                      The paper first states that the strokes of the full simulation are ≈20° smaller, peak to peak, than the measured strokes.\n\
                      Later the paper states that the strokes of the full simulation are larger than the measured strokes, and make more lift.\n\
                      Only the statement about larger strokes agrees with the lift of the full simulation in the paper, so the rows use this statement.",
            quick: true,
            claims: rotation::claims,
        },
        Group { title: "Magnitudes", preface: "", quick: true, claims: unchecked },
    ],
};

/// One of the two robots of the paper, with the range of drive frequencies of the robot's responses.
struct System {
    name: &'static str,
    params: Params,
    /// First frequency, last frequency and step (Hz).
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
    /// Returns the settled motions at the drive frequencies of the range.
    fn response(&self) -> Response {
        let [from, to, step] = self.range;
        bench().response(&steps(from, to, step), |drive_frequency| {
            Params { drive_frequency, ..self.params.clone() }.to_values()
        })
    }

    /// Returns a copy of this robot with a different drive voltage.
    fn at(self, drive_voltage_pp: f64) -> System {
        System { params: Params { drive_voltage_pp, ..self.params }, ..self }
    }
}

/// Returns the coefficient of determination (R²) of a straight line that is fitted to points.
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
    const SIZES: &str = "lifts and amplitudes depend on wings and actuators that the paper does not describe";
    vec![said("Figs. 7 to 15", "lifts and amplitudes of both systems", "drawn").cannot_be_checked(SIZES, "")]
}
