//! Resonance frequencies, section 4.2 and Fig. 10.

use super::{Type, large, small};
use crate::claim::{Claim, about, closely, said};

pub(super) fn claims() -> Vec<Claim> {
    let small = of(&small(), [190.0, 202.0]);
    let large = of(&large(), [100.0, 115.0]);
    let ratio = small.mode / large.mode;
    vec![
        small.calculated("small type", "209 Hz", 208.5),
        large.calculated("large type", "109 Hz", 109.0),
        small.measured("small type", "210 Hz", 210.0),
        large.measured("large type", "105 Hz", 105.0),
        said("4.2", "frequency of the small type over that of the large one", "roughly 2").is(
            &about(2.0, 0.05),
            ratio,
            format!("{ratio:.2} (small motions)"),
        ),
    ]
}

/// Resonance frequencies (Hz).
pub(super) struct Resonance {
    /// Of small motions.
    mode: f64,
    /// Of the largest stroke at the lower and at the higher voltage.
    peaks: [f64; 2],
    voltages: [f64; 2],
}

/// The resonance of a type, whose driven peaks are looked for within `range`.
pub(super) fn of(actuator: &Type, range: [f64; 2]) -> Resonance {
    let responses = actuator.voltages.map(|v_0| actuator.response(v_0, range));
    let [low, high] = responses.each_ref().map(|response| response.peak("stroke_amplitude_deg"));
    for (peak, _) in [low, high] {
        assert!(range[0] < peak && peak < range[1], "a peak at {peak} Hz may lie outside {range:?}");
    }
    Resonance { mode: low.1.get("mode_1_hz"), peaks: [low.0, high.0], voltages: actuator.voltages }
}

impl Resonance {
    /// Calculated from an impulse of unknown size, so compared with the frequencies of small to largest motions.
    pub(super) fn calculated(&self, what: &str, published: &str, frequency: f64) -> Claim {
        said("4.2, Fig. 10", format!("{what}: calculated, from an impulse"), published).is(
            &closely(frequency, 0.5),
            nearest(frequency, self.mode, self.peaks[1]),
            format!("small motions {:.1} Hz; {}", self.mode, self.driven()),
        )
    }

    /// Measured as the frequency of the largest stroke, at an unknown one of the voltages.
    fn measured(&self, what: &str, published: &str, frequency: f64) -> Claim {
        said("4.2, Fig. 10", format!("{what}: measured, largest stroke"), published).is(
            &closely(frequency, 0.5),
            nearest(frequency, self.peaks[0], self.peaks[1]),
            self.driven(),
        )
    }

    fn driven(&self) -> String {
        let Resonance { peaks: [low, high], voltages: [v_low, v_high], .. } = self;
        format!("driven {low:.1} Hz ({v_low:.0} V) to {high:.1} Hz ({v_high:.0} V)")
    }
}

/// Of the numbers between `a` and `b`, the nearest to `x`.
fn nearest(x: f64, a: f64, b: f64) -> f64 {
    x.clamp(a.min(b), a.max(b))
}
