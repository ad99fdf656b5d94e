//! The four-bar model against independent references and its own conservation laws.

mod composite;
mod constants;
mod equations;
mod kinematics;
mod lanes;
mod physics;
mod prescribed;
mod steady;
mod transient;

use flap_core::model::four_bar::{Arms, Params};

use crate::by_name::named;

/// The parameters of `sys75` or `sys30` in the reference tables.
fn params(system: &str) -> Params {
    named(system, &["sys75", "sys30"], &[Params::arabagi2013_75hz(), Params::arabagi2013_30hz()])
}

/// The reading called `name` in the reference tables.
fn arms(name: &str) -> Arms {
    named(name, Arms::NAMES, Arms::ALL)
}

/// Fails unless `actual` is within `tolerance` of `expected`, relative to `size`.
fn assert_close_to(actual: f64, expected: f64, size: f64, tolerance: f64, what: &str) {
    let error = (actual - expected).abs() / size;
    assert!(error <= tolerance, "{what}: {actual} is not {expected}: error {error:.1e} of {size:.1e}");
}
