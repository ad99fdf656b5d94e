//! Decision about running a point.

use flap_core::parameter::{Invalid, Kind, Parameter, Range};

use super::Plan;
use super::axes::Values;
use crate::notation::text;

/// Decision about running a point.
#[derive(Clone, Debug, PartialEq)]
pub enum Admission {
    /// The point is run.
    Runs,
    /// The point does not satisfy the conditions with the contained indices. The point has no row.
    Excluded(Vec<usize>),
    /// The point cannot be run. The row of the point contains the reason.
    Invalid(Invalid),
}

impl Plan {
    /// Returns the decision whether the point with the given values is run.
    pub fn judge(&self, values: &[f64]) -> Admission {
        let held: Vec<Option<bool>> =
            self.conditions().iter().map(|condition| condition.holds(values)).collect();
        let unsatisfied: Vec<usize> = (0..held.len()).filter(|&number| held[number] == Some(false)).collect();
        if !unsatisfied.is_empty() {
            return Admission::Excluded(unsatisfied);
        }
        let parameters = self.parameters();
        let mut computed = computed(self).map(|parameter| (&parameters[parameter], values[parameter]));
        if let Some((parameter, value)) =
            computed.find(|(parameter, value)| !range(parameter).contains(*value))
        {
            return Admission::Invalid(not_allowed(parameter, value));
        }
        let unknown = self.conditions().iter().zip(held).find(|(_, holds)| holds.is_none());
        match unknown {
            Some((condition, _)) => Admission::Invalid(Invalid::new(format!(
                "the condition `{}` cannot be computed",
                condition.name
            ))),
            None => Admission::Runs,
        }
    }
}

/// Returns the parameters with unchecked values: sampled and derived parameters, and parameters set by a program.
fn computed(plan: &Plan) -> impl Iterator<Item = usize> + '_ {
    let unchecked = plan.axes().parameters().filter(|(_, values)| {
        matches!(values, Values::Sampled { .. } | Values::Correlated { .. } | Values::Unchecked(_))
    });
    unchecked.map(|(parameter, _)| *parameter).chain(plan.derived().parameters())
}

/// Returns the error of a computed value that is not allowed.
fn not_allowed(parameter: &Parameter, value: f64) -> Invalid {
    let Parameter { name, unit, .. } = parameter;
    if value.is_nan() {
        return Invalid::new(format!("`{name}` is computed as not a number"));
    }
    let value = format!("{} {unit}", text::float(value));
    let allowed = range(parameter).describe();
    Invalid::new(format!("`{name}` is computed as {}, but must be {allowed}", value.trim_end()))
}

/// Returns the numbers that a parameter accepts.
fn range(parameter: &Parameter) -> Range {
    match parameter.kind {
        Kind::Number(range) | Kind::Following(range, _) => range,
        Kind::Choice(_) => Range::NonNegative,
    }
}
