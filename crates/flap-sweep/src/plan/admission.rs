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
        if let Some(invalid) = self.not_allowed(values) {
            return Admission::Invalid(invalid);
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

    /// Computes the derived parameters from the other `values` of a point, except parameters in `fixed`. Returns the
    /// reason if the point cannot be run.
    pub fn update(&self, values: &mut [f64], fixed: &[usize]) -> Option<Invalid> {
        self.derived().fill(values, fixed);
        self.invalid(values)
    }

    /// Returns the reason why a point with these values cannot be run. Conditions exclude no point.
    pub fn invalid(&self, values: &[f64]) -> Option<Invalid> {
        match self.judge(values) {
            Admission::Runs => None,
            Admission::Excluded(_) => self.not_allowed(values),
            Admission::Invalid(invalid) => Some(invalid),
        }
    }

    /// Returns the error of the first sampled or derived value, or value of a program, that is not allowed.
    fn not_allowed(&self, values: &[f64]) -> Option<Invalid> {
        computed(self).find_map(|parameter| not_allowed(&self.parameters()[parameter], values[parameter]))
    }
}

/// Returns the parameters with unchecked values: sampled and derived parameters, and parameters set by a program.
fn computed(plan: &Plan) -> impl Iterator<Item = usize> + '_ {
    let unchecked = plan.axes().parameters().filter(|(_, values)| {
        matches!(values, Values::Sampled { .. } | Values::Correlated { .. } | Values::Unchecked(_))
    });
    unchecked.map(|(parameter, _)| *parameter).chain(plan.derived().parameters())
}

/// Returns the error of a computed value, if the value is not allowed.
pub(crate) fn not_allowed(parameter: &Parameter, value: f64) -> Option<Invalid> {
    let Parameter { name, unit, .. } = parameter;
    if range(parameter).contains(value) {
        return None;
    }
    if value.is_nan() {
        return Some(Invalid::new(format!("`{name}` is computed as not a number")));
    }
    let value = format!("{} {unit}", text::float(value));
    let allowed = range(parameter).describe();
    Some(Invalid::new(format!("`{name}` is computed as {}, but must be {allowed}", value.trim_end())))
}

/// Returns the numbers that a parameter accepts.
fn range(parameter: &Parameter) -> Range {
    match parameter.kind {
        Kind::Number(range) | Kind::Following(range, _) => range,
        Kind::Choice(_) => Range::NonNegative,
    }
}
