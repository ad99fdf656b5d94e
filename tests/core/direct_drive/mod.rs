//! The direct-drive model against independent references and its own conservation laws.

mod constants;
mod equations;
mod impulse;
mod motion;
mod physics;
mod steady;

use flap_core::model::direct_drive::{CentreOfPressure, FlowDirection, Params};

/// Whichever way the air flows.
const FLOWS: [FlowDirection; 2] = [FlowDirection::Uniform, FlowDirection::Blade];

/// The parameters of `small` or `large` in the reference tables.
fn params(kind: &str) -> Params {
    match kind {
        "small" => Params::ozaki2018_small(),
        "large" => Params::ozaki2018_large(),
        other => panic!("no type {other}"),
    }
}

/// The reading called `name` in the reference tables.
fn centre_of_pressure(name: &str) -> CentreOfPressure {
    let options = ["directional", "folded", "literal"];
    let index =
        options.iter().position(|&option| option == name).unwrap_or_else(|| panic!("no reading {name}"));
    CentreOfPressure::ALL[index]
}
