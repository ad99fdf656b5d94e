//! Parameters, presets and readings by their names.

use std::ops::Range;

use flap_core::parameter::Parameter;
use flap_core::piezo::Layer;
use flap_core::simulate::{Simulator, preset};
use proptest::prelude::*;

/// Returns the element of `things` at the position of `name` in `names`.
pub(crate) fn named<T: Clone>(name: &str, names: &[&str], things: &[T]) -> T {
    let position = names.iter().position(|&one| one == name);
    things[position.unwrap_or_else(|| panic!("no {name} among {names:?}"))].clone()
}

fn position(table: &[Parameter], name: &str) -> usize {
    let position = table.iter().position(|parameter| parameter.name == name);
    position.unwrap_or_else(|| panic!("no parameter {name}"))
}

/// A preset with the values `changes`, and its model.
pub(crate) fn design(name: &str, changes: &[(&str, f64)]) -> (&'static dyn Simulator, Vec<f64>) {
    let (model, preset) = preset(name).unwrap();
    let mut values = (preset.values)();
    for &(name, value) in changes {
        values[position(model.parameters(), name)] = value;
    }
    (model, values)
}

/// The layer of an actuator whose parameters begin with `name`.
pub(crate) fn layer(table: &[Parameter], values: &[f64], name: &str) -> Layer {
    let value = |what: &str| values[position(table, &format!("{name}_{what}"))];
    Layer { thickness: value("thickness"), modulus: value("modulus"), density: value("density") }
}

/// Random values: one of `presets`, with the parameters `names` multiplied by factors within `range`. Spaces separate
/// the names in `names`.
pub(crate) fn scaled(
    table: &'static [Parameter<'static>],
    presets: Vec<Vec<f64>>,
    names: &'static str,
    range: Range<f64>,
) -> impl Strategy<Value = Vec<f64>> {
    let names: Vec<&str> = names.split_whitespace().collect();
    let factors = prop::collection::vec(range, names.len());
    (prop::sample::select(presets), factors).prop_map(move |(mut values, factors)| {
        for (name, factor) in names.iter().zip(factors) {
            values[position(table, name)] *= factor;
        }
        values
    })
}
