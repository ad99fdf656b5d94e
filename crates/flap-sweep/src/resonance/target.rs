//! Target of a search for a resonance: range of the drive frequency, and quantity to maximise.

use flap_core::parameter::{Invalid, Parameter};
use flap_core::simulate::{Simulator, Unfinished};

use crate::notation::text;

/// Quantity to maximise at a resonance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Objective {
    /// The stroke.
    Stroke,
    /// The mean lift.
    Lift,
    /// Mean lift divided by mean electrical power.
    Efficiency,
}

impl Objective {
    /// All objectives, in the order of [`Objective::NAMES`].
    pub const ALL: [Objective; 3] = [Objective::Stroke, Objective::Lift, Objective::Efficiency];

    /// Names in grid files.
    pub const NAMES: [&'static str; 3] = ["stroke", "lift", "efficiency"];

    /// Returns the name in grid files.
    pub fn name(self) -> &'static str {
        Objective::NAMES[self as usize]
    }

    /// Returns the column with the quantity.
    pub(super) fn column(self) -> &'static str {
        match self {
            Objective::Stroke => "stroke_amplitude_deg",
            Objective::Lift => "lift_mean_mn",
            Objective::Efficiency => "efficiency_gf_per_w",
        }
    }
}

/// Range and accuracy of the search for resonances.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// Quantity to maximise.
    pub of: Objective,
    /// Lowest drive frequency (Hz); half of the design's lower natural frequency if `None`.
    pub from: Option<f64>,
    /// Highest drive frequency (Hz); one and a half times the design's upper natural frequency if `None`.
    pub to: Option<f64>,
    /// Largest error of the frequency (Hz); must be more than zero.
    pub tolerance: f64,
}

impl Default for Range {
    fn default() -> Self {
        Range { of: Objective::Stroke, from: None, to: None, tolerance: 0.05 }
    }
}

/// Name of the parameter that the search varies.
pub const DRIVE_FREQUENCY: &str = "drive_frequency";

/// Quantity of a model to maximise, and the range of the search.
#[derive(Clone)]
pub(super) struct Target {
    pub(super) model: &'static dyn Simulator,
    pub(super) range: Range,
    /// Index of the drive frequency in the parameters.
    pub(super) frequency: usize,
    /// Index of the maximised quantity in the columns.
    pub(super) objective: usize,
}

impl Target {
    /// Returns the target for designs of `model`; `None` if the model has no drive frequency or does not measure the
    /// objective.
    pub(super) fn new(model: &'static dyn Simulator, range: Range) -> Option<Target> {
        let [frequency, objective] = places(model, range.of)?;
        Some(Target { model, range, frequency, objective })
    }

    /// Returns the lowest and highest frequency (Hz) of the search for a design.
    pub(super) fn ends(&self, values: &[f64]) -> Result<[f64; 2], Unfinished> {
        let Range { of, from, to, .. } = self.range;
        if of == Objective::Stroke && has_prescribed_stroke(self.model.parameters(), values) {
            return Err(prescribed("so it has no resonance").into());
        }
        let [from, to] = match (from, to) {
            (Some(from), Some(to)) => [from, to],
            (from, to) => {
                let mut values = values.to_vec();
                // Small motions do not depend on the frequency, but it must be set.
                values[self.frequency] = from.or(to).filter(|given| *given > 0.0).unwrap_or(1.0);
                let modes = self.model.experiments()?.modes(&values)?;
                let natural = modes.iter().map(|mode| mode.frequency);
                let lowest = 0.5 * natural.clone().fold(f64::NAN, f64::min);
                let highest = 1.5 * natural.fold(f64::NAN, f64::max);
                [from.unwrap_or(lowest), to.unwrap_or(highest)]
            }
        };
        let is_range = from > 0.0 && from < to && to.is_finite();
        if is_range {
            return Ok([from, to]);
        }
        let rule = "the first must be more than zero and less than the last";
        Err(Invalid::new(format!("there are no drive frequencies from {from} to {to} Hz: {rule}")).into())
    }
}

/// Returns the index of the drive frequency in the parameters of a model, and of the objective in its columns; `None`
/// if one is missing.
pub(super) fn places(model: &dyn Simulator, of: Objective) -> Option<[usize; 2]> {
    let frequency = model.parameters().iter().position(|parameter| parameter.name == DRIVE_FREQUENCY)?;
    let objective = model.columns().iter().position(|column| column.name == of.column())?;
    Some([frequency, objective])
}

/// Returns true if the stroke of a point is prescribed, and therefore equal at every frequency.
pub(super) fn has_prescribed_stroke(parameters: &[Parameter], values: &[f64]) -> bool {
    parameters.iter().zip(values).any(|(parameter, &value)| {
        parameter.name == "stroke_mode" && text::option(parameter, value) == Some("prescribed")
    })
}

/// Returns the error of a prescribed stroke. `end` is the last part of the error message.
pub(super) fn prescribed(end: &str) -> Invalid {
    Invalid::new(format!("stroke_mode is \"prescribed\": the stroke is the same at every frequency, {end}"))
}
