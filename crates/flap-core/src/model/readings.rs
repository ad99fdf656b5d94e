//! Values of derived columns that several models have.

use super::signal::{DEGREES, GRAVITY};

/// Phase of a sine (rad), as [`SignalCycle::phase`](super::SignalCycle::phase) counts it: from the cosine.
pub(crate) const SINE_PHASE: f64 = -core::f64::consts::FRAC_PI_2;

/// The angle (deg) by which one phase (rad) lags another, in (−180, 180].
pub fn lag_degrees(of: f64, behind: f64) -> f64 {
    let degrees = (behind - of) * DEGREES;
    if degrees > 180.0 {
        degrees - 360.0
    } else if degrees <= -180.0 {
        degrees + 360.0
    } else {
        degrees
    }
}

/// A force (N) in grams-force.
pub fn grams_force(force: f64) -> f64 {
    force / GRAVITY * 1e3
}

/// Lift over power, in the unit of the lift per watt (W). NaN if the power is not more than zero.
pub fn efficiency(lift: f64, power: f64) -> f64 {
    if power > 0.0 { lift / power } else { f64::NAN }
}

/// Largest strain of a hinge, from its strain per angle (1/rad) and the largest angle (rad). NaN if the strain per angle is zero:
/// the size of the hinge is not known.
pub(crate) fn hinge_strain(per_angle: f64, largest: f64) -> f64 {
    if per_angle > 0.0 { per_angle * largest } else { f64::NAN }
}

/// Power (W) of charging a capacitance (F) at a frequency (Hz) to a voltage (V) from another, without recovery.
pub(crate) fn charging(capacitance: f64, [low, high]: [f64; 2], frequency: f64) -> f64 {
    let voltage_pp = high - low;
    0.5 * capacitance * voltage_pp * voltage_pp * frequency
}
