//! The reference equations: a bimorph of Jafferis, Graule and Wood (2016) with constant stiffness and a sinusoidal
//! force, as in examples/own_equations. States are in units of their typical sizes, so that one absolute tolerance serves all.

use core::f64::consts::FRAC_2_PI;

pub const PERIODS: f64 = 40.0; // from rest
pub const MEASURED: f64 = 5.0; // the last of them
pub const SAMPLES_PER_PERIOD: f64 = 64.0;

/// Tip of the actuator (m), its rate (m/s), hinge angle (rad), its rate (rad/s).
pub const SCALE: [f64; 4] = [1e-4, 0.1, 1.0, 1e3];

const TRANSMISSION: f64 = 3333.0; // T (rad/m)
const MASS: f64 = (51.1 + 10.22) * 1e-12 * TRANSMISSION * TRANSMISSION; // at the tip (kg)
const STIFFNESS: f64 = 395.0; // of the actuator (N/m)
const INERTIA: f64 = 1.2255e-12; // I_xx (kg m²)
const COUPLING: f64 = 0.812e-12; // I_xz (kg m²)
const HINGE: f64 = 1.497e-6; // κ (N m/rad)
const DRAG_MEAN: f64 = 0.5 * (4.25 + 0.156);
const DRAG_SWING: f64 = 0.5 * (4.25 - 0.156);
pub const LIFT: f64 = 1.8;
/// ½ ρ A r₂² (R T)²: pressure on the wing per squared tip speed (kg/m).
pub const PRESSURE: f64 =
    0.5 * 1.2 * 54.59e-6 * 0.564 * 0.564 * (0.017 * TRANSMISSION) * (0.017 * TRANSMISSION);
const TIP_DRAG: f64 = PRESSURE * 13.58e-3 * TRANSMISSION;
const MOMENT: f64 = PRESSURE * 54.59e-6 / 0.017;
const HINGE_DRAG: f64 = 0.5 * 1.2 * 54.59e-6 * 0.753e-3 * 0.43 * 0.43 * 4.5e-3 * 4.5e-3 * 4.25;

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
