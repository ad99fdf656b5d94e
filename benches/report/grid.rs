//! The grids that sweeps are measured on.

use flap_core::simulate;
use flap_sweep::grid;
use flap_sweep::plan::Plan;

pub(crate) const PRESETS: [&str; 6] = [
    "jafferis2016",
    "jafferis2016-improved",
    "ozaki2018-small",
    "ozaki2018-large",
    "arabagi2013-75hz",
    "arabagi2013-30hz",
];

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
