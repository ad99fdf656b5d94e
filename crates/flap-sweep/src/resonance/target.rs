//! The target of a search: a quantity of a model over its drive frequency.

use flap_core::parameter::Parameter;
use flap_core::simulate::Simulator;

use super::error::SearchError;
use super::range::{Objective, Range};
use crate::notation::text;

/// The parameter that is searched for.
pub const DRIVE_FREQUENCY: &str = "drive_frequency";

/// The quantity of a model that a search makes largest, and the range of the search.
#[derive(Clone)]
pub(super) struct Target {
    pub(super) model: &'static dyn Simulator,
    pub(super) range: Range,
    /// Index of the drive frequency among the parameters.
    pub(super) frequency: usize,
    /// Index of the quantity among the columns.
    pub(super) objective: usize,
}

impl Target {
    /// The target for designs of `model`; `None` if that has no drive frequency or does not measure the objective.
    pub(super) fn new(model: &'static dyn Simulator, range: Range) -> Option<Target> {
        let [frequency, objective] = places(model, range.of)?;
        Some(Target { model, range, frequency, objective })
    }

    /// The frequencies (Hz) between which the resonance of a design is looked for.
    pub(super) fn ends(&self, values: &[f64]) -> Result<[f64; 2], SearchError> {
        let Range { of, from, to, .. } = self.range;
        if of == Objective::Stroke && has_prescribed_stroke(self.model.parameters(), values) {
            return Err(SearchError::Prescribed("and has no resonance"));
        }
        let [from, to] = match (from, to) {
            (Some(from), Some(to)) => [from, to],
            (from, to) => {
                let mut values = values.to_vec();
                // Small motions do not depend on it, but it must be there.
                values[self.frequency] = from.or(to).filter(|given| *given > 0.0).unwrap_or(1.0);
                let modes = self.model.experiments()?.modes(&values)?;
                let natural = modes.iter().map(|mode| mode.frequency);
                let lowest = 0.5 * natural.clone().fold(f64::NAN, f64::min);
                let highest = 1.5 * natural.fold(f64::NAN, f64::max);
                [from.unwrap_or(lowest), to.unwrap_or(highest)]
            }
        };
        let is_range = from > 0.0 && from < to && to.is_finite();
        if is_range { Ok([from, to]) } else { Err(SearchError::Range { from, to }) }
    }
}

/// The places of the drive frequency among the parameters of a model, and of the objective among its columns; `None` if it
/// lacks one of them.
pub(super) fn places(model: &dyn Simulator, of: Objective) -> Option<[usize; 2]> {
    let frequency = model.parameters().iter().position(|parameter| parameter.name == DRIVE_FREQUENCY)?;
    let objective = model.columns().iter().position(|column| column.name == of.column())?;
    Some([frequency, objective])
}

/// True if the stroke of a point is prescribed, and so the same at every frequency.
pub(super) fn has_prescribed_stroke(parameters: &[Parameter], values: &[f64]) -> bool {
    parameters.iter().zip(values).any(|(parameter, &value)| {
        parameter.name == "stroke_mode" && text::option(parameter, value) == Some("prescribed")
    })
}
