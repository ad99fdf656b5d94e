//! Parameters that usually change with a varied parameter, such as the stiffness of a transmission with its ratio.

use flap_core::parameter::{Parameter, Preset};

use crate::plan::{Plan, Value};

/// A parameter that stays the same, although it should scale with a parameter that varies.
#[derive(Clone, Debug)]
pub struct Linked<'p> {
    /// The parameter that stays the same.
    pub parameter: &'p Parameter<'p>,
    /// Value of the parameter in SI units.
    pub value: f64,
    /// Names of the varied parameters.
    pub varied: Vec<&'p str>,
    /// Formula for `[derived]` by which the parameter scales with the varied parameters.
    pub formula: String,
}

/// Returns the linked parameters of a plan, in the order of the model's table. The list is empty for a vehicle.
///
/// A parameter is linked if it is neither varied nor derived, is not zero, and scales with a parameter that is varied
/// or derived.
pub fn of(plan: &Plan) -> Vec<Linked<'_>> {
    if plan.vehicle().is_some() {
        return Vec::new();
    }
    let parameters = plan.parameters();
    let changing: Vec<usize> = plan.differing().collect();
    let preset = plan.simulator().presets().iter().find(|preset| preset.name == plan.preset());
    let reference = |index: usize| reference(plan, preset, index);
    let mut linked = Vec::new();
    for (index, parameter) in parameters.iter().enumerate().filter(|(index, _)| !changing.contains(index)) {
        let powers = parameter.scales_with.iter().filter_map(|&(name, power)| {
            let driver = changing.iter().copied().find(|driver| parameters[*driver].name == name)?;
            let scale = format!("({name} / {})", reference(driver)?);
            Some((name, if power == 1.0 { scale } else { format!("{scale}^{power}") }))
        });
        let (varied, powers): (Vec<&str>, Vec<String>) = powers.unzip();
        let Some(factor) = reference(index).filter(|_| !varied.is_empty()) else { continue };
        let formula = format!("{factor} * {}", powers.join(" * "));
        linked.push(Linked { parameter, value: plan.base()[index].in_point(), varied, formula });
    }
    linked
}

/// Returns the value of a parameter before the axes are applied, as text for a formula: `preset.NAME` for the value of
/// the preset, otherwise the number. Returns `None` for a value that is zero or not set.
fn reference(plan: &Plan, preset: Option<&Preset>, index: usize) -> Option<String> {
    let value = plan.base()[index].in_point();
    if value == 0.0 || value.is_nan() {
        return None;
    }
    let published = preset.filter(|_| plan.devices().is_empty());
    let is_published = published
        .is_some_and(|preset| Value::of_preset(plan.parameters(), preset)[index].in_point() == value);
    Some(if is_published {
        format!("preset.{}", plan.parameters()[index].name)
    } else {
        format!("{value:?}")
    })
}
