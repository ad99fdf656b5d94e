//! The reference equations: a bimorph of Jafferis, Graule and Wood (2016) with constant stiffness and a sinusoidal
//! force, as in examples/own_equations. States are in units of their typical sizes, so that one absolute tolerance serves all.

#[path = "../../../../examples/own_equations/constants.rs"]
mod constants;

use core::f64::consts::FRAC_2_PI;

use constants::{
    COUPLING, DRAG_MEAN, DRAG_SWING, HINGE, HINGE_DRAG, INERTIA, MASS, MOMENT, STIFFNESS, TIP_DRAG,
    TRANSMISSION,
};
pub(crate) use constants::{LIFT, PRESSURE, SCALE};

pub const PERIODS: f64 = 40.0; // from rest
pub const MEASURED: f64 = 5.0; // the last of them
pub const SAMPLES_PER_PERIOD: f64 = 64.0;

/// The rates of the states under this force.
#[inline(always)]
pub fn rates(force: f64, [x, v, psi, w]: [f64; 4]) -> [f64; 4] {
    let (v, w) = (v * SCALE[1], w * SCALE[3]);
    let (sine, cosine) = psi.sin_cos();
    let (sin_2psi, cos_2psi) = (2.0 * sine * cosine, 1.0 - 2.0 * sine * sine);
    let speed = v * v.abs();
    let drag = DRAG_MEAN + DRAG_SWING * cos_2psi;
    let a = (force - STIFFNESS * SCALE[0] * x - TIP_DRAG * drag * speed) * (1.0 / MASS);
    let arm = 0.132 + (0.151 - 0.132) * (1.0 - psi.abs() * FRAC_2_PI).abs();
    let air = MOMENT * arm * (drag * cosine + LIFT * sin_2psi * sine) * speed;
    let swing = (COUPLING * TRANSMISSION * a + INERTIA * TRANSMISSION * TRANSMISSION * v * v * sine) * cosine;
    let spring = HINGE * psi + HINGE_DRAG * w * w.abs();
    let alpha = (air + swing - spring) * (1.0 / INERTIA);
    [v * (1.0 / SCALE[0]), a * (1.0 / SCALE[1]), w, alpha * (1.0 / SCALE[3])]
}
