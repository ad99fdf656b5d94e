//! Compares the parameter values of a plan with the preset. A very large difference suggests that a unit
//! prefix is missing.

use flap_core::parameter::{Kind, Parameter, Preset};

use crate::notation::text;
use crate::notation::units;
use crate::plan::axes::Values;
use crate::plan::sample::Distribution;
use crate::plan::{Plan, Value};

/// If a value is more than 100 times larger or smaller than the preset's value, the value is probably a
/// mistake.
pub const FAR: f64 = 100.0;

/// A parameter with at least one value that differs from the preset.
#[derive(Clone, Debug)]
pub struct Deviation<'p> {
    /// The parameter.
    pub parameter: &'p Parameter<'p>,
    /// The value of the parameter, or the first and the last value of the parameter's axis.
    pub values: Vec<f64>,
    /// Value of the parameter in the preset, or NaN if the preset sets no value.
    pub preset: f64,
    /// True if each value of the parameter has a unit in the grid file.
    pub has_unit: bool,
}

/// Returns the parameters of a plan that differ from the preset, in the order of the model's parameter table.
pub fn of(plan: &Plan) -> Vec<Deviation<'_>> {
    let mut values: Vec<Vec<f64>> = plan.base().iter().map(|value| vec![value.in_point()]).collect();
    let are_devices = plan.design().is_some_and(|design| plan.parameters()[design].name == "device");
    for (parameter, values) in values.iter_mut().enumerate() {
        if let Some(of_designs) = plan.in_designs(parameter) {
            *values = if are_devices { extremes(of_designs) } else { Vec::new() };
        }
    }
    for (parameter, along) in plan.axes().parameters() {
        values[*parameter] = ends(along);
    }
    for parameter in plan.derived().parameters() {
        values[parameter] = [0, plan.len() - 1].map(|index| plan.point(index).values[parameter]).to_vec();
    }
    compare(plan, values, |parameter| plan.has_unit(parameter))
}

/// Returns the parameters of one point that differ from the preset, in the order of the model's parameter
/// table. `values` are the parameter values of the point.
///
/// The function `has_unit` must return true if the user gave the value of a parameter with a unit.
pub fn of_point<'p>(plan: &'p Plan, values: &[f64], has_unit: impl Fn(usize) -> bool) -> Vec<Deviation<'p>> {
    compare(plan, values.iter().map(|value| vec![*value]).collect(), has_unit)
}

fn compare(plan: &Plan, values: Vec<Vec<f64>>, has_unit: impl Fn(usize) -> bool) -> Vec<Deviation<'_>> {
    let preset = plan.simulator().presets().iter().find(|preset| preset.name == plan.preset());
    let preset = match preset {
        Some(preset) => of_preset(plan, preset),
        None => plan.base().iter().map(|value| value.in_point()).collect(),
    };
    let all = plan.parameters().iter().enumerate().zip(values).zip(preset);
    all.map(|(((index, parameter), mut values), preset)| {
        values.dedup();
        Deviation { parameter, values, preset, has_unit: has_unit(index) }
    })
    .filter(|deviation| {
        plan.design().is_none_or(|design| deviation.parameter.name != plan.parameters()[design].name)
    })
    .filter(|deviation| deviation.values.iter().any(|value| !value.is_nan() && *value != deviation.preset))
    .collect()
}

/// Returns the parameter values of the preset. If a parameter of one wing is not set, the result contains the
/// value of the parameter for all wings.
fn of_preset(plan: &Plan, preset: &Preset) -> Vec<f64> {
    let parameters = plan.parameters();
    let values: Vec<f64> =
        Value::of_preset(plan.parameters(), preset).into_iter().map(Value::in_point).collect();
    let own = parameters.iter().zip(&values).map(|(parameter, value)| match parameter.kind {
        Kind::Following(_, shared) if value.is_nan() && plan.vehicle().is_some() => {
            Parameter::index(parameters, shared).map_or(*value, |index| values[index])
        }
        _ => *value,
    });
    own.collect()
}

/// Returns the first and the last value of an axis. For a list, the result is the smallest and the largest
/// value. For a normal distribution, the result is only the mean.
fn ends(values: &Values) -> Vec<f64> {
    match values {
        Values::Sampled { distribution, .. } => match distribution {
            Distribution::Among(list) => extremes(list),
            Distribution::Uniform { from, to } | Distribution::LogUniform { from, to } => vec![*from, *to],
            Distribution::Normal { mean, .. } => vec![*mean],
        },
        Values::Correlated { mean, .. } => vec![*mean],
        Values::List(list) | Values::Unchecked(list) => extremes(list),
        Values::Linear { .. } | Values::Step { .. } | Values::Log { .. } => {
            vec![values.get(0), values.get(values.len() - 1)]
        }
    }
}

fn extremes(list: &[f64]) -> Vec<f64> {
    let least = list.iter().copied().fold(f64::INFINITY, f64::min);
    vec![least, list.iter().copied().fold(f64::NEG_INFINITY, f64::max)]
}

impl Deviation<'_> {
    /// Returns the value of the parameter as text. For an axis, the text contains the first and the last
    /// value.
    pub fn shown(&self) -> String {
        let values: Vec<String> = self.values.iter().map(|value| self.text(*value)).collect();
        values.join(" to ")
    }

    /// Returns the preset's value as text.
    pub fn preset_shown(&self) -> String {
        self.text(self.preset)
    }

    /// Returns the ratio of the value to the preset's value, as text. The text is empty if the ratio is not
    /// finite.
    pub fn ratio(&self) -> String {
        let ratios: Vec<String> =
            self.values.iter().filter_map(|value| self.ratio_of(*value)).map(short).collect();
        ratios.join(" to ")
    }

    /// Returns a warning if a value differs from the preset's value by more than a factor of 100. The warning
    /// suggests the value that the user probably meant.
    ///
    /// If the user gave the value with a unit, there is no warning.
    pub fn warning(&self) -> Option<String> {
        if self.has_unit {
            return None;
        }
        let far = |value: &&f64| {
            let size = self.ratio_of(**value).map_or(1.0, f64::abs);
            size > 0.0 && !(1.0 / FAR..=FAR).contains(&size)
        };
        let value = *self.values.iter().find(far)?;
        let Parameter { name, unit, .. } = self.parameter;
        let message = format!(
            "{name} = {} is {} times the preset's {}",
            self.text(value),
            short(self.ratio_of(value)?),
            self.preset_shown()
        );
        let meant = units::meant(value, self.preset, unit).map(|meant| self.text(meant));
        Some(match meant {
            Some(meant) => format!("{message}; if you mean {meant}, write \"{meant}\""),
            None => message,
        })
    }

    fn ratio_of(&self, value: f64) -> Option<f64> {
        let is_number = !matches!(self.parameter.kind, Kind::Choice(_));
        Some(value / self.preset).filter(|ratio| is_number && ratio.is_finite())
    }

    fn text(&self, value: f64) -> String {
        if value.is_nan() { "not set".to_owned() } else { text::shown(self.parameter, value) }
    }
}

/// Returns a ratio as text with three significant digits.
fn short(ratio: f64) -> String {
    units::prefixed(format!("{ratio:.2e}").parse().unwrap_or(ratio), "")
}
