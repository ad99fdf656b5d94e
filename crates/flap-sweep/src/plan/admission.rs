//! Decides if flap simulates a point.

use flap_core::parameter::{Invalid, Kind, Parameter, Range};

use super::Plan;
use super::axes::Values;
use crate::notation::text;

/// Decision if flap simulates a point, with the reason if flap does not simulate the point.
#[derive(Clone, Debug, PartialEq)]
pub enum Admission {
    /// flap simulates the point.
    Runs,
    /// The point has no row, because it does not satisfy all conditions. The list contains the indices of the
    /// unsatisfied conditions.
    Excluded(Vec<usize>),
    /// The point cannot be simulated. The row of the point contains the reason.
    Invalid(Invalid),
}

impl Plan {
    /// Decides if flap simulates the point with the given values.
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

    /// Computes the derived parameters of a point from its other parameters. Derived parameters in `fixed`
    /// keep their values. If the point cannot be simulated, returns the reason.
    pub fn update(&self, values: &mut [f64], fixed: &[usize]) -> Option<Invalid> {
        self.derived().fill(values, fixed);
        self.invalid(values)
    }

    /// If a point with the given values cannot be simulated, returns the reason. An unsatisfied condition
    /// does not count as a reason.
    pub fn invalid(&self, values: &[f64]) -> Option<Invalid> {
        match self.judge(values) {
            Admission::Runs => None,
            Admission::Excluded(_) => self.not_allowed(values),
            Admission::Invalid(invalid) => Some(invalid),
        }
    }

    /// Checks the values that are sampled, derived or set by a program. Returns the error of the first value
    /// that is not allowed.
    fn not_allowed(&self, values: &[f64]) -> Option<Invalid> {
        computed(self).find_map(|parameter| not_allowed(&self.parameters()[parameter], values[parameter]))
    }
}

/// Returns the parameters whose values were not checked when the grid file was read: sampled and derived
/// parameters, and parameters that a program sets.
fn computed(plan: &Plan) -> impl Iterator<Item = usize> + '_ {
    let unchecked = plan.axes().parameters().filter(|(_, values)| {
        matches!(values, Values::Sampled { .. } | Values::Correlated { .. } | Values::Unchecked(_))
    });
    unchecked.map(|(parameter, _)| *parameter).chain(plan.derived().parameters())
}

/// If a computed value is not allowed for a parameter, returns the error.
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

/// Returns the range of the numbers that a parameter accepts.
fn range(parameter: &Parameter) -> Range {
    match parameter.kind {
        Kind::Number(range) | Kind::Following(range, _) => range,
        Kind::Choice(_) => Range::NonNegative,
    }
}
