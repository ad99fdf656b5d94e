//! Code that several options of `flap vehicle` share.

use flap_core::vehicle::Vehicle;
use flap_sweep::notation::UserError;

use super::super::point::Chosen;
use crate::failure::Failure;

/// Headings of the table columns with the three components of force and the three components of torque.
pub(super) const HEADINGS: [&str; 6] = ["forward", "left", "up", "roll", "pitch", "yaw"];

pub(super) fn title(chosen: &Chosen, vehicle: &Vehicle) -> String {
    let wings: Vec<&str> = vehicle.mounts().iter().map(|mount| mount.name.as_str()).collect();
    let wings_are = if wings.len() == 1 { "wing" } else { "wings" };
    format!("{}: a vehicle with the {wings_are} {}", chosen.title(), wings.join(", "))
}

/// Returns the failure for a mistake in the value of the command-line option `option`.
pub(super) fn refused(option: &str, error: UserError) -> Failure {
    Failure::usage(format!("{option}: {error}")).helps(error.help)
}

/// Returns the number, or zero if the number is as small as a rounding error of 1 mN or 1 µN·m.
pub(super) fn tidy(number: f64) -> f64 {
    if number.abs() < 1e-12 { 0.0 } else { number }
}
