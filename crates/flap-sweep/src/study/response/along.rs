//! Determines the values of the parameter that rises and falls in a response.

use flap_core::parameter::{Kind, Parameter};
use flap_core::simulate::Point;

use crate::notation::UserError;
use crate::plan::axes::Values;
use crate::plan::{Admission, Along, Plan};

/// Largest number of parameter values on a branch.
const MOST_VALUES: f64 = 1e6;

impl Along {
    /// Returns the parameter of the response with its values, and the plan without the axis of this
    /// parameter. The values come from `steps`, which is `[from, to, step]`. If `steps` is `None`, the values
    /// come from the axis of the parameter.
    ///
    /// `tolerance` is the accuracy with which the ends of bistable bands are found. If `tolerance` is `None`,
    /// the accuracy is a sixteenth of the shortest step between values.
    ///
    /// # Errors
    /// [`UserError`] in one of the following cases:
    ///
    /// - The parameter is a choice, or a formula determines the parameter.
    /// - The axis of the parameter varies several parameters together.
    /// - The parameter has no axis, and `steps` is `None`.
    /// - The axis or `steps` contains fewer than two values, or `steps` contains more than a million steps.
    pub fn new(
        plan: Plan,
        parameter: usize,
        steps: Option<[f64; 3]>,
        tolerance: Option<f64>,
        unstable: bool,
    ) -> Result<(Plan, Along), UserError> {
        let Parameter { name, kind, .. } = plan.parameters()[parameter];
        let name = &*name.to_owned();
        if let Kind::Choice(_) = kind {
            return Err(UserError::new(format!("`{name}` is a choice and cannot rise and fall"), None));
        }
        if plan.derived().parameters().any(|derived| derived == parameter) {
            let message = format!("`{name}` is derived from other parameters and cannot rise and fall");
            return Err(UserError::new(
                message,
                Some("remove its formula from [derived], or follow another parameter"),
            ));
        }
        let (plan, axis) = plan.without_axis(parameter);
        if plan.axes().varied().any(|varied| varied == parameter) {
            let message = format!("`{name}` is varied together with other parameters");
            return Err(UserError::new(message, Some("follow a parameter that has its own axis or no axis")));
        }
        let values = match (steps, axis) {
            (Some(steps), _) => self::steps(name, steps)?,
            (None, Some(axis)) => rising(name, &axis)?,
            (None, None) => {
                let help = "give the first value, the last and the step, or a grid file with an axis of its own for the \
                            parameter";
                return Err(UserError::new(format!("the values of `{name}` are not given"), Some(help)));
            }
        };
        let shortest = values.windows(2).map(|two| two[1] - two[0]).fold(f64::INFINITY, f64::min);
        let tolerance = tolerance.unwrap_or(shortest / 16.0);
        if tolerance > 0.0 {
            Ok((plan, Along { parameter, values, tolerance, unstable }))
        } else {
            Err(UserError::new("the tolerance must be more than zero".to_owned(), None))
        }
    }

    /// Returns the entry for the parameter of the response in the plan's parameter table.
    pub fn parameter<'p>(&self, plan: &'p Plan) -> &'p Parameter<'p> {
        &plan.parameters()[self.parameter]
    }

    /// Returns the values of all parameters of a design after the parameter of the response is set to
    /// `value`.
    pub(super) fn values_at(&self, plan: &Plan, design: &Point, value: f64) -> Vec<f64> {
        let mut values = design.values.clone();
        values[self.parameter] = value;
        plan.derived().fill(&mut values, &[]);
        values
    }

    /// Decides if the response of a design is computed. For at least one value of the response's parameter,
    /// the point must be possible and satisfy all conditions.
    pub(super) fn judge(&self, plan: &Plan, design: &Point) -> Admission {
        let mut verdicts = self.values.iter().map(|&value| plan.judge(&self.values_at(plan, design, value)));
        let first = verdicts.next().unwrap_or(Admission::Runs);
        if first == Admission::Runs || verdicts.any(|verdict| verdict == Admission::Runs) {
            Admission::Runs
        } else {
            first
        }
    }
}

fn steps(name: &str, [from, to, step]: [f64; 3]) -> Result<Vec<f64>, UserError> {
    // A last step that is short because of rounding counts as a step.
    let whole = ((to - from) / step + 1e-9).floor();
    if !(step > 0.0 && (1.0..MOST_VALUES).contains(&whole)) {
        let message = format!("`{name}` cannot rise from {from} to {to} in steps of {step}");
        let help = "the last value must be larger than the first, by one step to a million steps";
        return Err(UserError::new(message, Some(help)));
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "1 to a million")]
    let count = whole as u64 + 1;
    let values = Values::Step { from, step, count };
    Ok((0..count).map(|i| values.get(i)).collect())
}

/// Returns the different values of an axis in ascending order.
fn rising(name: &str, axis: &Values) -> Result<Vec<f64>, UserError> {
    let mut values: Vec<f64> = (0..axis.len()).map(|i| axis.get(i)).collect();
    values.sort_by(f64::total_cmp);
    values.dedup();
    if values.len() < 2 {
        let message = format!("the axis of `{name}` has one value, but needs at least two to rise and fall");
        return Err(UserError::new(message, None));
    }
    Ok(values)
}
