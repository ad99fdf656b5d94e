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

use flap_core::drive::Wave;
use flap_core::model::four_bar::{Arms, Constants, FourBar, Params, transmission};
use flap_core::num::Real;
use flap_core::ode::Ode;

use crate::by_name::named;
use crate::probe::Probe;

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

/// The mass matrix [M₁₁, M₁₂, M₂₂] of (13).
fn mass_matrix(c: &Constants<f64>, theta: f64, phi: f64) -> [f64; 3] {
    let (sin, cos) = Real::sin_cos(phi);
    let links = transmission(c, theta).inertia;
    let stroke = c.wing.upright + c.wing.j_sin * sin * sin + c.wing.j_cos * cos * cos + links;
    [stroke, c.wing.coupling * cos, c.wing.j_pitch]
}

/// The side of a state: the sign of tan φ.
fn side(c: &Constants<f64>, y: &[f64; 4]) -> f64 {
    FourBar::SINE.switch(c, y, y)[0].signum()
}

/// Moments of the air without added mass.
#[derive(Debug, PartialEq)]
struct Moments {
    /// Moment about the stroke axis from the wing's translation, Eq. (16).
    stroke: f64,
    /// Moment about the rotation axis from the wing's translation, Eqs. (16) and (17).
    pitch: f64,
    /// Moment about the stroke axis from the wing's rotation.
    rotation_stroke: f64,
    /// Moment about the rotation axis from the wing's rotation, Eq. (18).
    rotation_pitch: f64,
}

/// The moments at a state, from loads without accelerations.
fn moments(c: &Constants<f64>, side: f64, y: &[f64; 4]) -> Moments {
    let load = |constants: &Constants<f64>, y: &[f64; 4], dy: [f64; 4]| {
        let input = &Wave::with_rate(0.0, 0.0);
        Probe { model: &FourBar::SINE, constants, input, side }.load(y, &dy)
    };
    let (mut translating, mut rotating) = (*c, *c);
    (translating.air.rotation_stroke, translating.air.rotation_pitch) = (0.0, 0.0);
    (rotating.air.lift, rotating.air.drag) = ([0.0; 4], [0.0; 4]);
    let [translation, rotation] = [&translating, &rotating].map(|constants| load(constants, y, [0.0; 4]));
    Moments {
        stroke: -translation.drag_moment,
        pitch: -translation.span_moment,
        rotation_stroke: -rotation.drag_moment,
        rotation_pitch: -rotation.span_moment,
    }
}
