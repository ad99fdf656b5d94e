//! Claims of the paper of Ozaki and Hamaguchi (2018).

mod hypothesis;
mod performance;
mod resonance;

use flap_core::model::direct_drive::Params;

use crate::points::{Bench, Response, Settled, steps};
use crate::table::{Group, Paper};

pub(crate) const PAPER: Paper = Paper {
    title: "Ozaki and Hamaguchi (2018)",
    preface: "The paper describes a small and a large type of one actuator with a wing.\n\
              The model for the paper of Ozaki and Hamaguchi is `direct-drive` with the presets `ozaki2018-small` and `ozaki2018-large`.\n\
              The two presets have the parameters of Table A1 in the paper as printed, except for the sign of y_g.\n\
              The drive voltage is V₀ sin ωt + V₀, and the rows give V₀.",
    groups: &[
        Group {
            title: "Resonance after an impulse",
            preface: "The paper fits A e^(-λt) sin(ω_r t + θ) to the [stroke](../glossary.md#stroke) after an impulse of the voltage.\n\
                      The paper gives neither the size of the impulse nor the duration of the fitted motion.\n\
                      The fitted frequency depends on the impulse and on the duration, because the model has no linear damping.\n\
                      The numbers 208.5 Hz and 109.0 Hz in parentheses follow from the errors that the paper reports.\n\
                      The reported errors are -0.7 % of the measured frequency of 210 Hz, and 3.8 % of the measured frequency of 105 Hz.\n\
                      If a row gives no duration, the fit covers 4 periods of small motions.\n\
                      The impulses are sized so that the stroke of small motions without damping would reach 0.3, 0.5 and 0.8 rad.\n\
                      The duration of the fit and the sizes of the impulses were chosen after the results were known.",
            quick: true,
            claims: resonance::calculated,
        },
        Group {
            title: "Resonance, driven",
            preface: "The paper does not give the drive voltage of the measured resonance frequencies.\n\
                      Each row gives the computed resonance frequencies at the lowest and at the highest drive voltage of the paper.\n\
                      The verdict compares the published frequency with the nearest frequency in the range from the lowest to the highest voltage.\n\
                      The computed frequency responses of this section have steps of 0.1 Hz.",
            quick: false,
            claims: resonance::driven,
        },
        Group {
            title: "Performance at the paper's frequencies",
            preface: "The paper does not state if the efficiencies of Fig. 17 are measured or calculated.",
            quick: true,
            claims: performance::claims,
        },
        Group {
            title: "Hypotheses on Table A1",
            preface: "Table A1 of the paper may contain misprints, and this section tests two hypotheses about misprints.\n\
                      **The presets `ozaki2018-small` and `ozaki2018-large` have the printed values instead of the hypothetical values.**\n\
                      The first hypothesis is that the table swaps the hinge stiffnesses k_w of the small and the large type (presets `ozaki2018-small-kw-swapped` and `ozaki2018-large-kw-swapped`).\n\
                      The second hypothesis is that the inertia J_B of the small type is 3.39e-9 kg·m² instead of 3.89e-9 kg·m².\n\
                      The two hypotheses were found by trying to match the paper.\n\
                      Nothing in the paper proves the hypotheses, so agreement is weak evidence.\n\
                      The impulses are the same as in the section [Resonance after an impulse](#resonance-after-an-impulse).\n\
                      The verdict on a resonance frequency uses the impulse of 0.5 rad, because the first stroke peak after this impulse is nearest to 20°.",
            quick: true,
            claims: hypothesis::claims,
        },
        Group {
            title: "Hypotheses on Table A1, driven",
            preface: "The rows test the two hypotheses of the section [Hypotheses on Table A1](#hypotheses-on-table-a1) with settled motions.\n\
                      The computed frequency responses of this section have steps of 0.1 Hz.",
            quick: false,
            claims: hypothesis::driven,
        },
    ],
};

/// One of the two actuators of the paper (small and large type), with the drive voltages V₀ and the drive
/// frequency of Figs. 13 to 16.
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

/// Returns the values of the parameters `p` with the drive voltage V₀ sin ωt + V₀.
fn driven(p: &Params, v_0: f64, drive_frequency: f64) -> Vec<f64> {
    Params { drive_voltage_pp: 2.0 * v_0, drive_frequency, ..p.clone() }.to_values()
}

fn bench() -> Bench {
    Bench::new("direct-drive", 1e-6)
}

impl Type {
    /// Returns two settled motions of the actuator: at the lower and at the higher drive voltage.
    fn performance(&self) -> [Settled; 2] {
        self.voltages.map(|v_0| bench().point(driven(&self.params, v_0, self.frequency)))
    }

    /// Returns the settled motions at drive frequencies in steps of 0.1 Hz.
    fn response(&self, v_0: f64, [from, to]: [f64; 2]) -> Response {
        bench().response(&steps(from, to, 0.1), |frequency| driven(&self.params, v_0, frequency))
    }
}
