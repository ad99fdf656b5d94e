//! The target of a search for a resonance: the range of the drive frequency, and the quantity to maximise.

use flap_core::parameter::{Invalid, Parameter};
use flap_core::simulate::{Simulator, Unfinished};

use crate::notation::text;

/// The quantity that is largest at the resonance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Objective {
    /// The stroke.
    Stroke,
    /// The mean lift.
    Lift,
    /// The mean lift divided by the mean electrical power.
    Efficiency,
}

impl Objective {
    /// All objectives, in the order of [`Objective::NAMES`].
    pub const ALL: [Objective; 3] = [Objective::Stroke, Objective::Lift, Objective::Efficiency];

    /// Names of the objectives in grid files.
    pub const NAMES: [&'static str; 3] = ["stroke", "lift", "efficiency"];

    /// Returns the name of the objective in grid files.
    pub fn name(self) -> &'static str {
        Objective::NAMES[self as usize]
    }

    /// Returns the name of the column that contains the quantity.
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
    /// Lowest drive frequency (Hz). If `None`, the search begins at half of the design's lower natural
    /// frequency.
    pub from: Option<f64>,
    /// Highest drive frequency (Hz). If `None`, the search ends at 1.5 times the design's upper natural
    /// frequency.
    pub to: Option<f64>,
    /// Largest allowed error of the resonance frequency (Hz), which must be more than zero.
    pub tolerance: f64,
}

impl Default for Range {
    fn default() -> Self {
        Range { of: Objective::Stroke, from: None, to: None, tolerance: 0.05 }
    }
}

/// Name of the parameter that the search for a resonance varies.
pub const DRIVE_FREQUENCY: &str = "drive_frequency";

/// Value of the drive frequency in grid files that stands for the resonance of each design.
pub const AT_RESONANCE: &str = "resonance";

/// The model whose resonance is searched, the quantity to maximise, and the range of the search.
#[derive(Clone)]
pub(super) struct Target {
    pub(super) model: &'static dyn Simulator,
    pub(super) range: Range,
    /// Index of the drive frequency among the parameters of the model.
    pub(super) frequency: usize,
    /// Index of the quantity to maximise among the columns of the model.
    pub(super) objective: usize,
}

impl Target {
    /// Returns the target for designs of `model`. If the model has no drive frequency or does not measure the
    /// objective, returns `None`.
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

/// Returns the index of the drive frequency among the parameters of a model, and the index of the objective
/// among the columns of the model. If the model has no drive frequency or no column of the objective, returns
/// `None`.
pub(super) fn places(model: &dyn Simulator, of: Objective) -> Option<[usize; 2]> {
    let frequency = model.parameters().iter().position(|parameter| parameter.name == DRIVE_FREQUENCY)?;
    let objective = model.columns().iter().position(|column| column.name == of.column())?;
    Some([frequency, objective])
}

/// Returns true if the stroke of a point is prescribed, so that the stroke is the same at every drive
/// frequency.
pub(super) fn has_prescribed_stroke(parameters: &[Parameter], values: &[f64]) -> bool {
    parameters.iter().zip(values).any(|(parameter, &value)| {
        parameter.name == "stroke_mode" && text::option(parameter, value) == Some("prescribed")
    })
}

/// Returns the error that is reported for a point with a prescribed stroke. `end` is the last part of the
/// error message.
pub(super) fn prescribed(end: &str) -> Invalid {
    Invalid::new(format!("stroke_mode is \"prescribed\": the stroke is the same at every frequency, {end}"))
}
