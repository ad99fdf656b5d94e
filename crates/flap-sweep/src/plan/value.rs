//! Values that parameters have if no axis varies them, and the set of parameters whose values have units.

use std::collections::BTreeSet;

use flap_core::parameter::{Kind, Parameter, Preset};

/// Value that a parameter has if no axis varies the parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value {
    /// A number in SI units, or the index of an option.
    Given(f64),
    /// The parameter is not set. The text describes the parameters that determine the value of this
    /// parameter.
    Follows(&'static str),
    /// The drive frequency is set to the resonance of each design.
    Resonance,
    /// The designs of the plan have different values of the parameter, see
    /// [`Plan::in_designs`](super::Plan::in_designs).
    OfDesign,
}

impl Value {
    /// Returns the values of a preset, one for each parameter. Parameters that are not in the preset have
    /// their default values.
    pub(crate) fn of_preset(parameters: &[Parameter<'_>], preset: &Preset) -> Vec<Value> {
        let given = (preset.values)();
        // A vehicle has more parameters than its model.
        let more = parameters.iter().skip(given.len()).map(|parameter| parameter.default);
        let values = parameters.iter().zip(given.iter().copied().chain(more));
        let value = |(parameter, value): (&Parameter, f64)| match parameter.kind {
            Kind::Following(_, follows) if value.is_nan() => Value::Follows(follows),
            Kind::Following(..) | Kind::Number(_) | Kind::Choice(_) => Value::Given(value),
        };
        values.map(value).collect()
    }

    /// Returns the number in [`Value::Given`]. For all other values, returns `None`.
    pub fn given(self) -> Option<f64> {
        match self {
            Value::Given(value) => Some(value),
            Value::Follows(_) | Value::Resonance | Value::OfDesign => None,
        }
    }

    /// Returns the number that represents this value in the list of a point's parameter values. If no number
    /// is given, returns NaN.
    pub fn in_point(self) -> f64 {
        self.given().unwrap_or(f64::NAN)
    }
}

/// Parameters whose values have units in a file, such as `"17 mm"`.
#[derive(Clone, Debug, Default)]
pub(crate) struct WithUnits(BTreeSet<usize>);

impl WithUnits {
    /// Returns true if the value of the parameter has a unit in the file.
    pub(crate) fn contain(&self, parameter: usize) -> bool {
        self.0.contains(&parameter)
    }

    /// Records if a new value of the parameter has a unit. If `has_unit` is `None`, the function changes
    /// nothing.
    pub(crate) fn note(&mut self, parameter: usize, has_unit: Option<bool>) {
        match has_unit {
            Some(true) => _ = self.0.insert(parameter),
            Some(false) => _ = self.0.remove(&parameter),
            None => {}
        }
    }
}
