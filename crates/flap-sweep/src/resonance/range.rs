//! The range in which a resonance is looked for.

/// The quantity that is largest at a resonance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Objective {
    /// The stroke.
    Stroke,
    /// The mean lift.
    Lift,
    /// Mean lift over mean electrical power.
    Efficiency,
}

impl Objective {
    /// The objectives, in the order of [`Objective::NAMES`].
    pub const ALL: [Objective; 3] = [Objective::Stroke, Objective::Lift, Objective::Efficiency];

    /// Their names in grid files.
    pub const NAMES: [&'static str; 3] = ["stroke", "lift", "efficiency"];

    /// The name in grid files.
    pub fn name(self) -> &'static str {
        Objective::NAMES[self as usize]
    }

    /// The column with the quantity.
    pub(super) fn column(self) -> &'static str {
        match self {
            Objective::Stroke => "stroke_amplitude_deg",
            Objective::Lift => "lift_mean_mn",
            Objective::Efficiency => "efficiency_gf_per_w",
        }
    }
}

/// The range in which resonances are looked for, and the accuracy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// The quantity that is largest.
    pub of: Objective,
    /// Lowest drive frequency (Hz); half of the design's lower natural frequency if `None`.
    pub from: Option<f64>,
    /// Highest drive frequency (Hz); one and a half times the design's upper natural frequency if `None`.
    pub to: Option<f64>,
    /// Largest error of the frequency (Hz), more than zero.
    pub tolerance: f64,
}

impl Default for Range {
    fn default() -> Self {
        Range { of: Objective::Stroke, from: None, to: None, tolerance: 0.05 }
    }
}
