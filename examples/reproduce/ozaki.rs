//! Ozaki and Hamaguchi (2018).

mod hypothesis;
mod performance;
mod resonance;

use flap_core::model::direct_drive::Params;

use crate::points::{Bench, Response, Settled, steps};
use crate::table::{Group, Paper};

pub(crate) const PAPER: Paper = Paper {
    title: "Ozaki and Hamaguchi (2018)",
    preface: "The model is `direct-drive` with the presets `ozaki2018-small` and `ozaki2018-large`.\n\
              They are Table A1 as printed, except for the sign of y_g.\n\
              The drive is V₀ sin ωt + V₀.",
    groups: &[
        Group {
            title: "Resonance after an impulse",
            preface: "The paper fits A e^(-λt) sin(ω_r t + θ) to the [stroke](../glossary.md#stroke) after an impulse of the voltage.\n\
                      It gives neither the size of the impulse nor the time that is fitted.\n\
                      The frequency depends on both, because the model has no linear damping.\n\
                      208.5 and 109.0 Hz follow from the errors that the paper reports (-0.7 % and 3.8 %) against the measured 210 and 105 Hz.\n\
                      Here the fit covers 4 periods of small motions.\n\
                      The impulses are sized so that small motions without damping would reach 0.3, 0.5 and 0.8 rad.\n\
                      These choices were made after the results were known.",
            quick: true,
            claims: resonance::calculated,
        },
        Group {
            title: "Resonance, driven",
            preface: "The paper does not give the voltage of the measurement.\n\
                      Each row gives the computed frequencies at the lowest and at the highest voltage.\n\
                      The verdict uses the frequency between these two that is nearest to the published one.\n\
                      The steps are 0.1 Hz.",
            quick: false,
            claims: resonance::driven,
        },
        Group {
            title: "Performance at the paper's frequencies",
            preface: "The paper does not state if these efficiencies are measured or calculated.",
            quick: true,
            claims: performance::claims,
        },
        Group {
            title: "Hypotheses on Table A1",
            preface: "**These parameters are not the defaults.**\n\
                      One hypothesis is that the columns of k_w are swapped (presets `ozaki2018-small-kw-swapped` and `ozaki2018-large-kw-swapped`).\n\
                      The other is that J_B of the small type is 3.39e-9 kg·m² instead of 3.89e-9 kg·m².\n\
                      Both were found by trying to match the paper, and nothing in the paper proves either, so agreement is weak evidence.\n\
                      The impulses are the same as above.\n\
                      The verdict uses the impulse of 0.5 rad, because its first stroke peak is nearest to 20°.",
            quick: true,
            claims: hypothesis::claims,
        },
        Group {
            title: "Hypotheses on Table A1, driven",
            preface: "The hypotheses and the steps of 0.1 Hz are the same as above.",
            quick: false,
            claims: hypothesis::driven,
        },
    ],
};

/// A type of actuator, with the voltages V₀ and the frequency it is driven with in the calculations of Figs. 13 to 16.
struct Type {
    name: &'static str,
    params: Params,
    voltages: [f64; 2],
    frequency: f64,
}

fn small() -> Type {
    Type { name: "small", params: Params::ozaki2018_small(), voltages: [15.0, 30.0], frequency: 209.0 }
}

fn large() -> Type {
    Type { name: "large", params: Params::ozaki2018_large(), voltages: [20.0, 50.0], frequency: 109.0 }
}

/// `p` driven with V₀ sin ωt + V₀.
fn driven(p: &Params, v_0: f64, drive_frequency: f64) -> Vec<f64> {
    Params { drive_voltage_pp: 2.0 * v_0, drive_frequency, ..p.clone() }.to_values()
}

fn bench() -> Bench {
    Bench::new("direct-drive", 1e-6)
}

impl Type {
    /// Settled at the lower and at the higher voltage.
    fn performance(&self) -> [Settled; 2] {
        self.voltages.map(|v_0| bench().point(driven(&self.params, v_0, self.frequency)))
    }

    /// The response to frequencies, in steps of 0.1 Hz.
    fn response(&self, v_0: f64, [from, to]: [f64; 2]) -> Response {
        bench().response(&steps(from, to, 0.1), |frequency| driven(&self.params, v_0, frequency))
    }
}
