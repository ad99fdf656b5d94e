//! Functions for the values of derived columns that several models have.

use super::signal::{DEGREES, GRAVITY};

/// Returns the angle (deg) by which one phase (rad) lags another, in (−180, 180].
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

/// Returns a force (N) in grams-force.
pub fn grams_force(force: f64) -> f64 {
    force / GRAVITY * 1e3
}

/// Returns lift divided by power, in the unit of the lift per watt. The result is NaN unless the power is more than
/// zero.
pub fn efficiency(lift: f64, power: f64) -> f64 {
    if power > 0.0 { lift / power } else { f64::NAN }
}

/// Returns the largest strain of a hinge, given the strain per pitch angle (1/rad) and the largest pitch (rad).
///
/// The result is NaN if the strain per angle is zero, because the dimensions of the hinge are not set.
pub(crate) fn hinge_strain(per_angle: f64, largest: f64) -> f64 {
    if per_angle > 0.0 { per_angle * largest } else { f64::NAN }
}

/// Returns the power (W) that charges a capacitance (F) between two voltages (V) at a frequency (Hz), without charge
/// recovery.
pub(crate) fn charging(capacitance: f64, [low, high]: [f64; 2], frequency: f64) -> f64 {
    let voltage_pp = high - low;
    0.5 * capacitance * voltage_pp * voltage_pp * frequency
}
