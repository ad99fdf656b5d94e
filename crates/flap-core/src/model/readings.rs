//! Functions that compute the values of derived columns, for columns that exist in several models.

use super::signal::{DEGREES, GRAVITY};

/// Returns the phase lag (deg), in the range (−180, 180], of the phase `of` (rad) relative to the phase
/// `behind` (rad).
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

/// Converts a force from newtons to grams-force.
pub fn grams_force(force: f64) -> f64 {
    force / GRAVITY * 1e3
}

/// Returns the lift divided by the power (W), in the unit of `lift` per watt. If the power is zero or
/// negative, the result is NaN.
pub fn efficiency(lift: f64, power: f64) -> f64 {
    if power > 0.0 { lift / power } else { f64::NAN }
}

/// Returns the largest strain of a hinge, given the strain per pitch angle (1/rad) and the largest pitch (rad).
///
/// If the dimensions of the hinge are not set, `per_angle` is zero and the result is NaN.
pub(crate) fn hinge_strain(per_angle: f64, largest: f64) -> f64 {
    if per_angle > 0.0 { per_angle * largest } else { f64::NAN }
}

/// Returns the mean power (W) that charges a capacitance (F) repeatedly at a frequency (Hz), each time from
/// one voltage (V) to another voltage. The discharge returns no energy.
pub(crate) fn charging(capacitance: f64, [low, high]: [f64; 2], frequency: f64) -> f64 {
    let voltage_pp = high - low;
    0.5 * capacitance * voltage_pp * voltage_pp * frequency
}
