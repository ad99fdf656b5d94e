//! Parts that are the same in several outputs of `flap vehicle`.

use flap_core::vehicle::Vehicle;
use flap_sweep::grid;
use flap_sweep::vehicle::control::{ControlInputError, Input};

use super::super::point::Chosen;
use crate::failure::Failure;

/// Headings of force and torque components.
pub(super) const HEADINGS: [&str; 6] = ["forward", "left", "up", "roll", "pitch", "yaw"];

pub(super) fn title(chosen: &Chosen, vehicle: &Vehicle) -> String {
    let wings: Vec<&str> = vehicle.mounts().iter().map(|mount| mount.name.as_str()).collect();
    let wings_are = if wings.len() == 1 { "wing" } else { "wings" };
    format!("{}: a vehicle with the {wings_are} {}", chosen.title(), wings.join(", "))
}

/// Returns the input called `name`, which the user gave with `option`.
pub(super) fn input(vehicle: &Vehicle, chosen: &Chosen, name: &str, option: &str) -> Result<Input, Failure> {
    Input::of(vehicle, name).map_err(|error| {
        let failure = Failure::usage(format!("{option}: {error}"));
        match error {
            ControlInputError::Unknown(_) => {
                if let Some(reason) = grid::why_absent(chosen.plan.parameters(), name) {
                    return failure.help(reason);
                }
                let known = Input::names(vehicle);
                let known = known.iter().map(String::as_str);
                failure.nearest(name, known, "`flap vehicle --help` lists words for inputs")
            }
            ControlInputError::Choice(_) => failure,
        }
    })
}

/// Returns the number, or zero if the number is a rounding error compared with 1 mN or 1 uN·m.
pub(super) fn tidy(number: f64) -> f64 {
    if number.abs() < 1e-12 { 0.0 } else { number }
}
