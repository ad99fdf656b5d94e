//! Units of the models' columns.

/// Degrees per radian.
pub(super) const DEGREES: f64 = 180.0 / core::f64::consts::PI;

/// Standard gravity (m/s²): newtons per kilogram-force.
pub(super) const GRAVITY: f64 = 9.80665;

/// An angle (rad) in degrees, in (−180, 180].
pub(super) fn wrap_degrees(radians: f64) -> f64 {
    let degrees = radians * DEGREES;
    if degrees > 180.0 {
        degrees - 360.0
    } else if degrees <= -180.0 {
        degrees + 360.0
    } else {
        degrees
    }
}

/// Lift over power; not a number where there is no power, or the air gives energy to the wing.
pub(super) fn efficiency(lift: f64, power: f64) -> f64 {
    if power > 0.0 { lift / power } else { f64::NAN }
}
