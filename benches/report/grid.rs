//! The grids that sweeps are measured on.

use flap_core::simulate;
use flap_sweep::grid;
use flap_sweep::plan::Plan;

/// The names of the presets of all models, without the variants with a swapped hinge stiffness.
pub(crate) fn presets() -> impl Iterator<Item = &'static str> {
    let presets = simulate::all().iter().flat_map(|model| model.presets());
    presets.map(|preset| preset.name).filter(|name| !name.ends_with("-kw-swapped"))
}

/// A square grid around the flight of a preset.
pub(crate) fn grid(preset: &str, side: usize) -> Plan {
    let (simulator, published) = simulate::preset(preset).expect("a preset");
    let values = (published.values)();
    let value = |name: &str| {
        let position = simulator.parameters().iter().position(|parameter| parameter.name == name);
        values[position.expect("a parameter")]
    };
    let axis = |name: &str, from: f64, to: f64| {
        let value = value(name);
        format!("{name} = {{ from = {:?}, to = {:?}, n = {side} }}\n", from * value, to * value)
    };
    let text = format!(
        "preset = \"{preset}\"\n[axes]\n{}{}",
        axis("drive_voltage_pp", 0.6, 1.0),
        axis("drive_frequency", 0.85, 1.1)
    );
    grid::parse(preset, &text, simulate::all()).expect("a good grid")
}
