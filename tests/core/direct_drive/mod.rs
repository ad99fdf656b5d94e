//! The direct-drive model against independent references and its own conservation laws.

mod constants;
mod equations;
mod motion;
mod physics;
mod steady;

use flap_core::model::direct_drive::{CentreOfPressure, FlowDirection, Params};

use crate::by_name::named;

/// All directions of flow.
const FLOWS: [FlowDirection; 2] = [FlowDirection::Uniform, FlowDirection::Blade];

/// The parameters of `small` or `large` in the reference tables.
pub(crate) fn params(kind: &str) -> Params {
    named(kind, &["small", "large"], &[Params::ozaki2018_small(), Params::ozaki2018_large()])
}

/// The reading called `name` in the reference tables.
fn centre_of_pressure(name: &str) -> CentreOfPressure {
    named(name, CentreOfPressure::NAMES, CentreOfPressure::ALL)
}
