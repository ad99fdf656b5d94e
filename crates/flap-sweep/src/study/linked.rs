//! Finds parameters that should change together with a varied parameter. For example, the stiffness of a
//! transmission changes with the transmission ratio.

use flap_core::parameter::{Parameter, Preset};

use crate::plan::{Plan, Value};

/// A parameter that a plan keeps constant, although the parameter should scale with a parameter that the plan
/// varies.
#[derive(Clone, Debug)]
pub struct Linked<'p> {
    /// The parameter that the plan keeps constant.
    pub parameter: &'p Parameter<'p>,
    /// Value of the constant parameter in SI units.
    pub value: f64,
    /// Names of the varied parameters with which the constant parameter should scale.
    pub varied: Vec<&'p str>,
    /// Formula for the table `[derived]` of the grid file. With this formula, the constant parameter scales
    /// with the varied parameters.
    pub formula: String,
}

/// Returns the parameters that a plan keeps constant although they should change, in the order of the model's
/// parameter table. The list is empty for a vehicle.
///
/// The list contains parameters that are constant and not zero, and that scale with a varied or derived
/// parameter.
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

/// Returns a text that represents the constant value of a parameter in a formula. The text is `preset.NAME`
/// if the value is the preset's value, and otherwise the number. Returns `None` if the value is zero or not
/// set.
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
